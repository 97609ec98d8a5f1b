/*  Reads the files of a domain and its programs into a module, and finds their faults before the robot does. Each
    file is plain Prolog without a module. What several files define adds up in their order for the predicates of a
    domain (situation.pl), so that the first procedure that fits counts; any other predicate is that of the first
    file. */
:- module(program, [load_program/4, unload_program/1, program_faults/3, fault_text/3]).
:- use_module(library(apply)).
:- use_module(library(lists)).
:- use_module(library(error)).
:- use_module(situation).
:- use_module(travel, []).

:- dynamic procedure_at/4.  % domain, Name/Arity, file, line
:- dynamic defined_in/3.    % domain, Name/Arity, file

%!  load_program(+Domain, +Files, +Facts, -Faults) is det.
%   Domain: the name of a module that is not in use. Facts: clauses that the caller adds, as if they stood in a file
%   before the others. Faults: lines "FILE:LINE: what is wrong"; empty where the program may run.
load_program(D, Files, Facts, Faults) :-
    add_import_module(D, travel, start),
    complete_domain(D),
    forall(member(Fact, Facts), add_clause(Fact, facts, D)),
    read_files(Files, D, Clauses, ReadFaults),
    (   ReadFaults == []
    ->  findall(Text, ( member(Clause, Clauses), clause_fault(Clause, D, Text) ), Found),
        findall(Text, ( \+ D:proc(main, _), Files = [File | _], at(File, 1, golog(no_main), Text) ), Missing),
        append(Found, Missing, Faults)
    ;   Faults = ReadFaults
    ).

%!  unload_program(+Domain) is det.
unload_program(D) :-
    retractall(procedure_at(D, _, _, _)),
    retractall(defined_in(D, _, _)),
    forall(( current_predicate(D:Name/Arity),
             functor(Head, Name, Arity),
             \+ predicate_property(D:Head, imported_from(_)) ),
           retractall(D:Head)).

% Reading: each clause as clause(File, Line, Term, Names of its variables).
read_files([], _, [], []).
read_files([File | Files], D, Clauses, Faults) :-
    catch(setup_call_cleanup(open(File, read, In, [encoding(utf8)]),
                             read_clauses(In, File, D, Here, FaultsHere),
                             close(In)),
          error(E, _),
          ( Here = [], at(File, 1, E, Fault), FaultsHere = [Fault] )),
    read_files(Files, D, There, FaultsThere),
    append(Here, There, Clauses),
    append(FaultsHere, FaultsThere, Faults).

read_clauses(In, File, D, Clauses, Faults) :-
    read_one(In, D, Read),
    (   Read = read(end_of_file, _, _, _)
    ->  Clauses = [], Faults = []
    ;   Read = fault(Line, E)
    ->  at(File, Line, E, Fault), Clauses = Rest, Faults = [Fault | RestFaults],
        read_clauses(In, File, D, Rest, RestFaults)
    ;   Read = read(Term, Line, Names, Singletons),
        singleton_faults(Singletons, File, Line, Faults, Faults1),
        take(Term, File, Line, D, Faults1, RestFaults),
        ( Term = (:- _) -> Clauses = Rest ; Clauses = [clause(File, Line, Term, Names) | Rest] ),
        read_clauses(In, File, D, Rest, RestFaults)
    ).

read_one(In, D, Read) :-
    catch(( read_term(In, Term, [module(D), term_position(At), variable_names(Names), singletons(Singletons),
                                 syntax_errors(error)]),
            stream_position_data(line_count, At, Line),
            Read = read(Term, Line, Names, Singletons) ),
          error(syntax_error(E), Where),
          ( error_line(Where, Line), Read = fault(Line, syntax_error(E)) )).

error_line(stream(_, Line, _, _), Line) :- !.
error_line(file(_, Line, _, _), Line) :- !.
error_line(_, 1).

singleton_faults([], _, _, Faults, Faults).
singleton_faults([Name = _ | More], File, Line, [Fault | Faults], Rest) :-
    at(File, Line, golog(singleton(Name)), Fault),
    singleton_faults(More, File, Line, Faults, Rest).

take(Term, File, Line, D, Faults, Rest) :-
    catch(take(Term, File, Line, D), error(E, _), true),
    ( var(E) -> Faults = Rest ; at(File, Line, E, Fault), Faults = [Fault | Rest] ).

take((:- module(_, _)), _, _, _) :- !, throw(error(golog(module), _)).
take((:- Goal), _, _, D) :- !, ( D:Goal -> true ; throw(error(golog(directive(Goal)), _)) ).
take(Term, File, Line, D) :-
    expand_term(Term, Expanded),
    ( is_list(Expanded) -> Clauses = Expanded ; Clauses = [Expanded] ),
    forall(member(Clause, Clauses), add_clause(Clause, File, D)),
    forall(( member(proc(Head, _), Clauses), callable(Head), functor(Head, Name, Arity),
             \+ procedure_at(D, Name/Arity, _, _) ),
           assertz(procedure_at(D, Name/Arity, File, Line))).

add_clause(Clause, File, D) :-
    ( Clause = (Head :- _) -> true ; Head = Clause ),
    must_be(callable, Head),
    functor(Head, Name, Arity),
    (   domain_predicate(Name/Arity)
    ->  assertz(D:Clause)
    ;   defined_in(D, Name/Arity, Other), Other \== File
    ->  true
    ;   assertz(D:Clause),
        ( defined_in(D, Name/Arity, File) -> true ; assertz(defined_in(D, Name/Arity, File)) )
    ).

% Faults of what was read, each with its place.
clause_fault(clause(File, Line, Term, Names), D, Text) :-
    term_fault(Term, Names, D, Fault),
    at(File, Line, golog(Fault), Text).

term_fault(proc(Head, P), Names, D, Fault) :- !,
    (   program_fault(P, D, Fault)
    ;   term_variables(Head, Bound),
        findall(Name, ( member(Name = V, Names), free_variable(P, Bound, W), V == W ), Free),
        list_to_set(Free, Set),
        member(Name, Set), Fault = unbound(Name)
    ).
term_fault(poss(A, C), _, D, Fault) :- !, ( action_fault(A, D, Fault) ; condition_fault(C, D, Fault) ).
term_fault(derived(_, C), _, D, Fault) :- !, condition_fault(C, D, Fault).
term_fault(duration(_, _, C), _, D, Fault) :- !, condition_fault(C, D, Fault).
term_fault(causes_true(_, F, C), _, D, Fault) :- !, ( fluent_fault(F, D, Fault) ; condition_fault(C, D, Fault) ).
term_fault(causes_false(_, F, C), _, D, Fault) :- !, ( fluent_fault(F, D, Fault) ; condition_fault(C, D, Fault) ).
term_fault(initially(F), _, D, Fault) :- !, fluent_fault(F, D, Fault).
term_fault(action(A), _, D, impossible(A)) :- !, \+ D:poss(A, _).
term_fault((_ :- Body), _, D, Fault) :- goal_fault(Body, D, Fault).

action_fault(A, D, unknown(A)) :- \+ D:action(A).

fluent_fault(F, D, no_fluent(F)) :- \+ situation:is_fluent(F, D).

%!  program_faults(+P, +Domain, -Faults) is det.
%   Constructs, actions, procedures and predicates of the program that are not there.
program_faults(P, D, Faults) :- findall(Fault, program_fault(P, D, Fault), Faults).

program_fault(P, _, Fault) :- var(P), !, Fault = variable_program.
program_fault(P, D, Fault) :- parts(P, Programs, Conditions), !,
    (   member(Q, Programs), program_fault(Q, D, Fault)
    ;   member(C, Conditions), condition_fault(C, D, Fault)
    ).
program_fault(stop(A), D, Fault) :- !, nonvar(A), action_fault(A, D, Fault).
program_fault(under_way(A), D, Fault) :- !, action_fault(A, D, Fault).
program_fault(Call, D, Fault) :- callable(Call), ( D:action(Call) -> true ; D:proc(Call, _) -> true ), !,
    ground(Call), D:expects(Call, Goal), \+ D:Goal, Fault = unexpected(Call, Goal).
program_fault(Call, _, unknown(Call)).

% What a construct is made of.
parts([], [], []).
parts([P | Ps], [P | Ps], []) :- is_list(Ps).
parts(?(C), [], [C]).
parts(ndet(P, Q), [P, Q], []).
parts(pi(_, P), [P], []).
parts(if(C, P, Q), [P, Q], [C]).
parts(while(C, P), [P], [C]).
parts(star(P), [P], []).
parts(conc(P, Q), [P, Q], []).
parts(iconc(P), [P], []).
parts(prioritized(Ps), Ps, []) :- is_list(Ps), Ps = [_ | _].
parts(interrupt(C, P), [P], [C]).
parts(interrupt(_, C, P), [P], [C]).
parts(within(_, P), [P], []).
parts(within(_, P, Q), [P, Q], []).
parts(until(_, P, Q), [P, Q], []).
parts(search(P), [P], []).
parts(search(P, least(F)), [P], [F]).
parts(following(_, _, P, _), [P], []).
parts(in(_, P), [P], []).

condition_fault(C, _, Fault) :- var(C), !, Fault = variable_condition.
condition_fault((A, B), D, Fault) :- !, ( condition_fault(A, D, Fault) ; condition_fault(B, D, Fault) ).
condition_fault((A ; B), D, Fault) :- !, ( condition_fault(A, D, Fault) ; condition_fault(B, D, Fault) ).
condition_fault(\+ C, D, Fault) :- !, condition_fault(C, D, Fault).
condition_fault(some(_, C), D, Fault) :- !, condition_fault(C, D, Fault).
condition_fault(all(_, A, B), D, Fault) :- !, ( condition_fault(A, D, Fault) ; condition_fault(B, D, Fault) ).
condition_fault(set(_, C, _), D, Fault) :- !, condition_fault(C, D, Fault).
condition_fault(F, D, unexpected(F, Goal)) :- ground(F), D:expects(F, Goal), \+ D:Goal, !.
condition_fault(F, D, _) :- ( situation:is_fluent(F, D) ; \+ \+ D:derived(F, _) ), !, fail.
condition_fault(Goal, D, Fault) :- goal_fault(Goal, D, Fault).

goal_fault(Goal, _, _) :- var(Goal), !, fail.
goal_fault((A, B), D, Fault) :- !, ( goal_fault(A, D, Fault) ; goal_fault(B, D, Fault) ).
goal_fault((A ; B), D, Fault) :- !, ( goal_fault(A, D, Fault) ; goal_fault(B, D, Fault) ).
goal_fault((A -> B), D, Fault) :- !, ( goal_fault(A, D, Fault) ; goal_fault(B, D, Fault) ).
goal_fault(\+ A, D, Fault) :- !, goal_fault(A, D, Fault).
goal_fault(_:_, _, _) :- !, fail.
goal_fault(Goal, D, undefined(Name/Arity)) :-
    \+ predicate_property(D:Goal, visible),
    functor(Goal, Name, Arity).

% A variable of a program that is no parameter and that nothing introduces.
free_variable(T, Bound, V) :- var(T), !, \+ ( member(B, Bound), B == T ), V = T.
free_variable(T, Bound, V) :- binder(T, X, Scope, Rest), !,
    (   free_variable(Rest, Bound, V)
    ;   term_variables(X-Bound, More), free_variable(Scope, More, V)
    ).
free_variable(T, Bound, V) :- compound(T), arg(_, T, Arg), free_variable(Arg, Bound, V).

binder(pi(X, P), X, P, []).
binder(interrupt(X, C, P), X, C-P, []).
binder(some(X, C), X, C, []).
binder(all(X, A, B), X, A-B, []).
binder(set(X, C, Xs), X, C, Xs).
binder(search(P, least(F)), F, P, []).

%   Texts.
at(File, Line, E, Text) :- message_text(E, _, Message), format(string(Text), "~w:~d: ~s", [File, Line, Message]).

%!  fault_text(+Error, +Domain, -Text) is det.
%   The error(E, Context) that a step of the domain's program has thrown, with file and line of its procedure.
fault_text(error(E, Context), D, Text) :-
    (   nonvar(Context), Context = in(Name, Inner)
    ->  message_text(E, Inner, Message),
        (   procedure_at(D, Name, File, Line)
        ->  format(string(Text), "~w:~d: in ~q: ~s", [File, Line, Name, Message])
        ;   format(string(Text), "in ~q: ~s", [Name, Message])
        )
    ;   message_text(E, Context, Message),
        string_codes(Text, Message)
    ), !.
fault_text(E, _, Text) :- format(string(Text), "~q", [E]).

message_text(golog(Fault), _, Codes) :- !, phrase(fault(Fault), Parts), format_parts(Parts, Codes).
message_text(E, Context, Codes) :-
    catch(prolog_message(E, Context, Line), _, fail), !,
    atom_codes(Line, Codes).
message_text(E, _, Codes) :- format(codes(Codes), "~q", [E]).

%   The first line of what Prolog says of its own errors.
prolog_message(E, Context, Line) :-
    phrase('$messages':translate_message(error(E, Context)), Parts),
    with_output_to(string(Text), print_message_lines(current_output, '', Parts)),
    split_string(Text, "\n", " ", Split),
    once(( member(First, Split), First \== "" )),
    atom_string(Line, First).

format_parts([Format-Arguments], Codes) :- format(codes(Codes), Format, Arguments).

fault(singleton(Name)) --> ["the variable ~w stands here only once"-[Name]].
fault(open_action(A)) --> ["the action ~p has a variable that nothing binds"-[A]].
fault(no_main) --> ["there is no proc(main, ...)"-[]].
fault(module) --> ["a program is no module"-[]].
fault(directive(Goal)) --> ["the directive ~q fails"-[Goal]].
fault(unbound(Name)) -->
    ["nothing introduces the variable ~w: it is no parameter, and no pi, interrupt or some names it"-[Name]].
fault(unknown(Call)) --> ["~q is neither an action nor a procedure"-[Call]].
fault(unknown_event(Event)) --> ["~q is no event of the domain"-[Event]].
fault(no_fluent(F)) --> ["~q is no fluent"-[F]].
fault(impossible(A)) --> ["nothing says when the action ~q is possible"-[A]].
fault(undefined(Name)) --> ["~q is no fluent and no predicate"-[Name]].
fault(unexpected(Call, Goal)) --> ["~q: there is no ~q"-[Call, Goal]].
fault(variable_program) --> ["a variable stands where a program should"-[]].
fault(variable_condition) --> ["a variable stands where a condition should"-[]].
fault(timeout(Most)) --> ["Prolog time-out: the step took more than ~D inferences"-[Most]].
fault(no_snapshot) --> ["this is no snapshot of a program"-[]].
fault(foreign_snapshot(Fault)) --> fault(Fault).
