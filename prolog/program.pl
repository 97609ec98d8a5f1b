/*  Reads the files of a domain and its programs into a module, and finds their faults before the robot does. Each
    file is plain Prolog without a module. What several files define adds up in their order for the predicates of a
    domain (situation.pl), so that the first procedure that fits counts; any other predicate is that of the first
    file. */
:- module(program, [load_program/4, unload_program/1, action_place/3, program_faults/3, fault_text/3]).
:- use_module(library(apply)).
:- use_module(library(lists)).
:- use_module(library(error)).
:- use_module(library(occurs)).
:- use_module(situation).
:- use_module(travel, []).

:- dynamic procedure_at/4.  % domain, Name/Arity, file, line
:- dynamic action_at/4.     % domain, name, file, line
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
    ->  findall(Text, ( member(Clause, Clauses), clause_fault(Clause, Clauses, D, Text) ), Found),
        findall(Text, ( Files = [File | _], main_fault(Facts, D, Fault), at(File, 1, golog(Fault, D), Text) ), Missing),
        append(Found, Missing, Faults)
    ;   Faults = ReadFaults
    ).

main_fault(_, D, no_main) :- \+ D:proc(main, _).
main_fault(Facts, D, Fault) :- member(proc(main, P), Facts), program_fault(P, D, Fault).

%!  action_place(+Domain, ?Name, -Place) is nondet.
%   Where a file declares an action, "FILE:LINE", both as strings.
action_place(D, Text, Place) :-
    action_at(D, Name, File, Line),
    atom_string(Name, Text),
    format(string(Place), "~w:~d", [File, Line]).

%!  unload_program(+Domain) is det.
unload_program(D) :-
    retractall(action_at(D, _, _, _)),
    retractall(procedure_at(D, _, _, _)),
    retractall(defined_in(D, _, _)),
    forall(( current_predicate(D:Name/Arity),
             functor(Head, Name, Arity),
             \+ predicate_property(D:Head, imported_from(_)) ),
           retractall(D:Head)).

% Reading: each clause as clause(File, where(Line, Character, Positions of its terms), Term, Names of its variables).
read_files([], _, [], []).
read_files([File | Files], D, Clauses, Faults) :-
    catch(setup_call_cleanup(open(File, read, In, [encoding(utf8)]),
                             read_clauses(In, File, D, Here, FaultsHere),
                             close(In)),
          error(E, _),
          ( Here = [], reading_fault(E, Why), at(File, 1, Why, Fault), FaultsHere = [Fault] )),
    read_files(Files, D, There, FaultsThere),
    append(Here, There, Clauses),
    append(FaultsHere, FaultsThere, Faults).

reading_fault(E, Why) :- ( E = existence_error(source_sink, _) -> Why = golog(no_file) ; Why = E ).

read_clauses(In, File, D, Clauses, Faults) :-
    read_one(In, D, Read),
    (   Read = read(end_of_file, _, _, _)
    ->  Clauses = [], Faults = []
    ;   Read = fault(Line, E)
    ->  syntax_text(File, Line, E, Fault), Clauses = Rest, Faults = [Fault | RestFaults],
        read_clauses(In, File, D, Rest, RestFaults)
    ;   Read = read(Term, Where, Names, Singletons),
        Clause = clause(File, Where, Term, Names),
        singleton_faults(Singletons, Clause, D, Faults, Faults1),
        Where = where(Line, _, _),
        take(Term, File, Line, D, Faults1, RestFaults),
        ( Term = (:- _) -> Clauses = Rest ; Clauses = [Clause | Rest] ),
        read_clauses(In, File, D, Rest, RestFaults)
    ).

read_one(In, D, Read) :-
    catch(( read_term(In, Term, [module(D), term_position(At), subterm_positions(Positions), variable_names(Names),
                                 singletons(Singletons), syntax_errors(error)]),
            stream_position_data(line_count, At, Line),
            stream_position_data(char_count, At, Start),
            Read = read(Term, where(Line, Start, Positions), Names, Singletons) ),
          error(syntax_error(E), Where),
          ( error_line(Where, Line), Read = fault(Line, syntax_error(E)) )).

error_line(stream(_, Line, _, _), Line) :- !.
error_line(file(_, Line, _, _), Line) :- !.
error_line(_, 1).

% What Prolog says, and what it is most often about.
syntax_text(File, Line, E, Text) :-
    at(File, Line, E, Said),
    (   file_line(File, Line, Written), split_string(Written, "", " \t", [Bare]), sub_string(Bare, 0, 1, _, "#")
    ->  Hint = "comments begin with %"
    ;   Hint = "is a bracket, a comma or a full stop missing before this?"
    ),
    format(string(Text), "~s; ~s", [Said, Hint]).

file_line(File, Line, Text) :-
    file_text(File, All),
    split_string(All, "\n", "", Lines),
    nth1(Line, Lines, Text).

% Not by library(readutil): a part of that library lies in a package that a robot need not have.
file_text(File, Text) :- setup_call_cleanup(open(File, read, In, [encoding(utf8)]), read_string(In, _, Text), close(In)).

singleton_faults([], _, _, Faults, Faults).
singleton_faults([Name = V | More], Clause, D, [Fault | Faults], Rest) :-
    clause_text(Clause, V, singleton(Name), D, Fault),
    singleton_faults(More, Clause, D, Faults, Rest).

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
           assertz(procedure_at(D, Name/Arity, File, Line))),
    forall(( member(Clause, Clauses), clause_head(Clause, action(A)), callable(A), functor(A, Name, _),
             \+ action_at(D, Name, _, _) ),
           assertz(action_at(D, Name, File, Line))).

clause_head(Clause, Head) :- ( Clause = (Head0 :- _) -> Head = Head0 ; Head = Clause ).

add_clause(Clause, File, D) :-
    clause_head(Clause, Head),
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
clause_fault(Clause, Clauses, D, Text) :-
    Clause = clause(_, _, Term, Names),
    (   term_fault(Term, Names, D, Fault)
    ;   hidden_fault(Clause, Clauses, D, Fault)
    ),
    culprit(Fault, Term, Names, Culprit),
    clause_text(Clause, Culprit, Fault, D, Text).

% The part of the clause that is wrong, if the fault names one.
culprit(unbound(Name), _, Names, V) :- !, memberchk(Name = V, Names).
culprit(Fault, _, _, Culprit) :- compound(Fault), !, arg(1, Fault, Culprit).
culprit(_, Term, _, Term).

%   With the line of the culprit, and with the names that variables have in the file.
clause_text(clause(File, Where, Term, Names), Culprit, Fault, D, Text) :-
    culprit_line(Where, File, Term, Culprit, Line),
    findall(Text, ( maplist(name_variable, Names), term_variables(Fault, Nameless), maplist(=('$VAR'('_')), Nameless),
                    at(File, Line, golog(Fault, D), Text) ), [Text]).

name_variable(Name = '$VAR'(Name)).

culprit_line(where(Line0, Start, Positions), File, Term, Culprit, Line) :-
    (   subterm_start(Term, Positions, Culprit, At)
    ->  file_text(File, All),
        Length is At - Start,
        sub_string(All, Start, Length, _, Between),
        split_string(Between, "\n", "", Lines),
        length(Lines, Count),
        Line is Line0 + Count - 1
    ;   Line = Line0
    ).

%   The first character of the first subterm that is identical to the culprit.
subterm_start(Term, Positions, Culprit, At) :- Term == Culprit, !, arg(1, Positions, At).
subterm_start(Term, parentheses_term_position(_, _, Positions), Culprit, At) :- !,
    subterm_start(Term, Positions, Culprit, At).
subterm_start(Term, term_position(_, _, _, _, Positions), Culprit, At) :- !,
    nth1(I, Positions, Inner),
    arg(I, Term, Arg),
    subterm_start(Arg, Inner, Culprit, At), !.
subterm_start(Term, list_position(_, _, Positions, _), Culprit, At) :-
    nth0(I, Positions, Inner),
    length(Front, I),
    append(Front, [Element | _], Term),
    subterm_start(Element, Inner, Culprit, At), !.

% What Prolog takes, but nobody means.
hidden_fault(clause(_, _, Term, _), _, _, wrong_arity(Head, Wanted)) :-
    clause_head(Term, Head),
    functor(Head, Name, Arity),
    domain_predicate(Name/Wanted), Wanted =\= Arity.
hidden_fault(clause(File, where(_, Start, _), proc(Head, _), _), Clauses, _, repeated(Head, Line)) :-
    once(( member(clause(File, where(Line, Earlier, _), proc(Head0, _), _), Clauses),
           Earlier < Start, subsumes_term(Head0, Head) )).
hidden_fault(clause(File, _, Term, _), Clauses, D, unused(Head, Other)) :-
    clause_head(Term, Head),
    functor(Head, Name, Arity),
    defined_in(D, Name/Arity, File),
    once(( defined_in(D, Other/Arity, Elsewhere), Elsewhere \== File, is_misspelt(Name, Other) )),
    \+ ( member(clause(_, _, Using, _), Clauses), clause_head(Using, UsingHead), \+ functor(UsingHead, Name, Arity),
         sub_term(Use, Using), nonvar(Use), functor(Use, Name, Arity) ).

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
term_fault(causes_true(A, F, C), _, D, Fault) :- !, effect_fault(A, F, C, D, Fault).
term_fault(causes_false(A, F, C), _, D, Fault) :- !, effect_fault(A, F, C, D, Fault).
term_fault(initially(F), _, D, Fault) :- !, fluent_fault(F, D, Fault).
term_fault(action(A), _, D, impossible(A)) :- !, \+ D:poss(A, _).
term_fault((_ :- Body), _, D, Fault) :- goal_fault(Body, D, Fault).

action_fault(A, D, unknown(A)) :- \+ D:action(A).

effect_fault(A, _, _, D, no_event(A)) :- \+ \+ cannot_happen(A, D).
effect_fault(_, F, _, D, Fault) :- fluent_fault(F, D, Fault).
effect_fault(_, _, C, D, Fault) :- condition_fault(C, D, Fault).

cannot_happen(A, _) :- var(A), !, fail.
cannot_happen(A, D) :- phase(A, B), !, nonvar(B), \+ D:action(B).
cannot_happen(A, D) :- \+ D:action(A), \+ clause(D:exogenous(A), _).

phase(begin(A), A).
phase(ended(A), A).
phase(failed(A), A).
phase(stopped(A), A).
phase(sensed(A, _), A).

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
    ground(Call), misleads(Call, [], D, Goal), Fault = unexpected(Call, Goal).
program_fault(Call, _, unknown(Call)).

% The call, or one that it is certain to make with the same argument, expects a goal that fails.
misleads(Call, _, D, Goal) :- D:expects(Call, Goal), \+ D:Goal, !.
misleads(Call, Within, D, Goal) :-
    compound(Call),
    functor(Call, Name, Arity),
    \+ memberchk(Name/Arity, Within),
    once(D:proc(Call, P)),
    certain_call(P, Inner),
    ground(Inner),
    misleads(Inner, [Name/Arity | Within], D, Goal),
    arg(_, Call, Argument),
    sub_term(Part, Goal), Part == Argument, !.

certain_call(P, _) :- var(P), !, fail.
certain_call(P, Call) :- is_list(P), !, member(Q, P), certain_call(Q, Call).
certain_call(pi(_, P), Call) :- !, certain_call(P, Call).
certain_call(conc(P, Q), Call) :- !, ( certain_call(P, Call) ; certain_call(Q, Call) ).
certain_call(within(_, P), Call) :- !, certain_call(P, Call).
certain_call(within(_, P, _), Call) :- !, certain_call(P, Call).
certain_call(search(P), Call) :- !, certain_call(P, Call).
certain_call(search(P, _), Call) :- !, certain_call(P, Call).
certain_call(P, P) :- callable(P), \+ parts(P, _, _), P \= stop(_).

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
goal_fault(Goal, D, undefined(Goal)) :- \+ predicate_property(D:Goal, visible).

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
fault_text(error(E0, Context), D, Text) :-
    ( E0 = golog(Fault) -> E = golog(Fault, D) ; E = E0 ),
    (   nonvar(Context), Context = in(Name, Inner)
    ->  message_text(E, Inner, Message),
        (   procedure_at(D, Name, File, Line)
        ->  format(string(Text), "~w:~d: in ~q: ~s", [File, Line, Name, Message])
        ;   format(string(Text), "in ~q: ~s", [Name, Message])
        )
    ;   message_text(E, Context, Message),
        string_codes(Text, Message)
    ), !.
fault_text(E, D, Text) :- procedure_at(D, main/0, File, _), !, format(string(Text), "~w: the program throws ~q", [File, E]).
fault_text(E, _, Text) :- format(string(Text), "~q", [E]).

message_text(golog(Fault), _, Codes) :- !, phrase(fault(Fault), Parts), format_parts(Parts, Codes).
message_text(golog(Fault, D), _, Codes) :- !,
    message_text(golog(Fault), _, Said),
    ( hint(Fault, D, Format-Arguments) -> format(codes(Hint), Format, Arguments) ; Hint = [] ),
    append(Said, Hint, Codes).
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

%   What may have been meant.
hint(unknown(Call), D, Hint) :- meant(Call, program_name(D), Hint).
hint(unknown_event(Event), D, Hint) :- meant(Event, event_name(D), Hint).
hint(no_event(Event), D, Hint) :- ( phase(Event, A) -> true ; A = Event ), meant(A, occurrence_name(D), Hint).
hint(no_fluent(F), D, Hint) :- meant(F, fluent_name(D), Hint).
hint(undefined(Goal), D, Hint) :- meant(Goal, condition_name(D), Hint).
hint(unexpected(_, Goal), D, Hint) :-
    first_alternative(Goal, Expected),
    Expected =.. [Kind, Argument],
    Known =.. [Kind, Right],
    (   format(atom(Right), "~w", [Argument]), Right \== Argument, D:Known
    ->  Hint = "; write ~q"-[Right]
    ;   atom(Argument), Right = Other, D:Known, atom(Other), is_misspelt(Argument, Other)
    ->  Hint = "; did you mean ~q?"-[Other]
    ).

meant(Call, Known, Hint) :-
    functor(Call, Name, Arity),
    (   call(Known, Name, Wanted)
    ->  Wanted =\= Arity, Hint = "; did you mean ~q?"-[Name/Wanted]
    ;   call(Known, Other, _), is_misspelt(Name, Other)
    ->  Hint = "; did you mean ~q?"-[Other]
    ).

is_misspelt(Name, Other) :- Name \== Other, dwim_match(Name, Other).

program_name(D, Name, Arity) :- ( action_name(D, Name, Arity) ; procedure_name(D, Name, Arity) ; construct_name(Name, Arity) ).
occurrence_name(D, Name, Arity) :- ( action_name(D, Name, Arity) ; event_name(D, Name, Arity) ).
condition_name(D, Name, Arity) :- ( fluent_name(D, Name, Arity) ; defined_in(D, Name/Arity, _) ).

action_name(D, Name, Arity) :- clause(D:action(A), _), is_name(A, Name, Arity).
event_name(D, Name, Arity) :- clause(D:exogenous(Event), _), is_name(Event, Name, Arity).
procedure_name(D, Name, Arity) :- clause(D:proc(Head, _), _), is_name(Head, Name, Arity).
fluent_name(D, Name, Arity) :-
    ( clause(D:fluent(F), _) ; clause(D:functional(F), _) ; clause(D:derived(F, _), _) ),
    is_name(F, Name, Arity).
construct_name(Name, Arity) :-
    clause(parts(P, _, _), _),
    \+ memberchk(P, [until(_, _, _), following(_, _, _, _), in(_, _)]),  % of programs under way
    is_name(P, Name, Arity).

is_name(Term, Name, Arity) :- callable(Term), functor(Term, Name, Arity).

first_alternative(Goal, First) :- ( Goal = (First ; _) -> true ; First = Goal ).

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
fault(undefined(Goal)) --> { functor(Goal, Name, Arity) }, ["~q is no fluent and no predicate"-[Name/Arity]].
fault(unexpected(Call, Goal)) --> { first_alternative(Goal, Expected) }, ["~q: there is no ~q"-[Call, Expected]].
fault(no_event(A)) --> ["~q is neither an action nor an event"-[A]].
fault(wrong_arity(Head, Wanted)) --> { functor(Head, Name, Arity) }, ["~q means nothing; did you mean ~q?"-[Name/Arity, Name/Wanted]].
fault(repeated(Head, Line)) --> ["the procedure ~q stands on line ~d already, and that one counts"-[Head, Line]].
fault(unused(Head, Other)) --> ["~q is used nowhere; did you mean ~q?"-[Head, Other]].
fault(no_file) --> ["there is no such file"-[]].
fault(variable_program) --> ["a variable stands where a program should"-[]].
fault(variable_condition) --> ["a variable stands where a condition should"-[]].
fault(timeout(Most)) --> ["Prolog time-out: the step took more than ~D inferences"-[Most]].
fault(no_snapshot) --> ["this is no snapshot of a program"-[]].
fault(foreign_snapshot(Fault)) --> fault(Fault).
