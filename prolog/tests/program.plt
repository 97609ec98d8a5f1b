:- module(program_tests, []).
:- use_module('../program').
:- use_module('../agent').
:- use_module(library(plunit)).
:- use_module(library(lists)).

domain_clauses([ fluent(wet), functional(n(_)), action(walk(_)), poss(walk(_), true), room(hall), expects(walk(X), room(X)), expects(in_room(X), room(X)) ]).

% The faults of a file with this text, each without the file's name.
faults(Text, Faults) :-
    setup_call_cleanup(tmp_file_stream(text, File, Out), write(Out, Text), close(Out)),
    unload_program(faulty),
    domain_clauses(Clauses),
    load_program(faulty, [File], Clauses, All),
    findall(Fault, ( member(F, All), atom_concat(File, ':', Front), atom_concat(Front, Fault, F) ), Faults),
    assertion(same_length(All, Faults)),
    delete_file(File).

:- begin_tests(program).

test(a_good_program, F == []) :- faults("proc(main, [walk(hall), ?(wet)]).\n", F).
test(a_missing_main, F == ['1: there is no proc(main, ...)']) :- faults("proc(other, []).\n", F).
test(a_syntax_error) :-
    faults("proc(main, []).\n\nproc(go, [walk(hall).\n", [F]), assertion(sub_atom(F, 0, _, _, '3: Syntax error')).
test(several_syntax_errors, L == ['1', '3']) :-
    faults("proc(main, [).\nproc(a, []).\nproc(b, ]).\n", Fs),
    findall(N, ( member(F, Fs), atomic_list_concat([N | _], ':', F) ), L).
test(an_unknown_action, F == ['2: jump is neither an action nor a procedure']) :-
    faults("proc(main, go).\nproc(go, [walk(hall), jump]).\n", F).
test(deep_inside, F == ['1: jump is neither an action nor a procedure']) :-
    faults("proc(main, prioritized([interrupt(wet, walk(hall)), within(5, while(wet, conc([], if(wet, pi(X, [?(X = 1), star(jump)]), []))))])).\n", F).
test(an_unknown_exhibit, F == ['1: walk(moon): there is no room(moon)']) :- faults("proc(main, walk(moon)).\n", F).
test(an_unknown_exhibit_in_a_condition, F == ['2: in_room(moon): there is no room(moon)']) :-
    faults("fluent(in_room(_)).\nproc(main, ?(in_room(moon))).\n", F).
test(an_unknown_fluent, F == ['1: dry/0 is no fluent and no predicate']) :- faults("proc(main, ?(\\+ dry)).\n", F).
test(an_unknown_predicate, F == ['2: grows/1 is no fluent and no predicate']) :-
    faults("proc(main, ?(tall(hall))).\ntall(X) :- grows(X).\n", F).
test(an_effect_on_nothing, F == ['1: dry is no fluent']) :-
    faults("causes_true(walk(_), dry, true).\nproc(main, []).\n", F).
test(an_action_without_precondition, F == ['1: nothing says when the action sit is possible']) :-
    faults("action(sit).\nproc(main, sit).\n", F).
test(a_precondition_of_nothing, F == ['1: sit is neither an action nor a procedure']) :-
    faults("poss(sit, true).\nproc(main, []).\n", F).
test(a_variable_without_pi, [F] == ['1: nothing introduces the variable R: it is no parameter, and no pi, interrupt or some names it']) :-
    faults("proc(main, [?(room(R)), walk(R)]).\n", [F]).
test(a_single_variable) :-
    faults("proc(main, go(hall)).\nproc(go(R), []).\n", F),
    assertion(F == ['2: the variable R stands here only once']).
test(parameters_are_introduced, F == []) :-
    faults("proc(main, go(hall)).\nproc(go(R), [walk(R), while(some(N, (n(N), N < 3)), walk(R))]).\n", F).
test(a_directive_that_fails, F == ['2: the directive fail fails']) :- faults("proc(main, []).\n:- fail.\n", F).
test(a_directive_that_throws) :-
    faults("proc(main, []).\n:- atom_length(_, _).\n", [F]),
    assertion(sub_atom(F, 0, _, _, '2: Arguments are not sufficiently instantiated')).
test(no_module, F == ['1: a program is no module']) :- faults(":- module(tour, []).\nproc(main, []).\n", F).
test(a_built_in_predicate_stays) :-
    faults("append([], _, _).\natom_length(_, 3).\nproc(main, []).\n", [F]),
    assertion(sub_atom(F, 0, _, _, '2: No permission')).
test(a_file_that_is_not_there) :-
    unload_program(none), load_program(none, ['no/such/tour.pl'], [], [F]),
    assertion(sub_string(F, 0, _, _, "no/such/tour.pl:1: ")).
test(definite_clause_grammars_are_prolog, F == []) :-
    faults("greeting --> [hello].\nproc(main, ?(phrase(greeting, [hello]))).\n", F).
test(the_first_file_counts_for_predicates) :-
    setup_call_cleanup(tmp_file_stream(text, A, S), write(S, "speed(1).\nproc(main, walk(hall)).\n"), close(S)),
    setup_call_cleanup(tmp_file_stream(text, B, T), write(T, "speed(2).\nproc(main, []).\n"), close(T)),
    domain_clauses(Clauses), unload_program(two), load_program(two, [A, B], Clauses, Faults), assertion(Faults == []),
    findall(V, two:speed(V), Vs), assertion(Vs == [1]),
    start(two, Agent), step(Agent, 0.0, [], R, _), assertion(R == begin(walk(hall))).
test(programs_live_side_by_side) :-
    domain_clauses(Clauses),
    forall(member(D, [left, right]), ( unload_program(D), load_program(D, [], [proc(main, walk(D)) | Clauses], []) )),
    start(left, L), start(right, R), step(L, 0.0, [], RL, _), step(R, 0.0, [], RR, _),
    assertion(RL-RR == begin(walk(left))-begin(walk(right))).
test(a_fault_while_it_runs_names_its_procedure) :-
    setup_call_cleanup(tmp_file_stream(text, File, S), write(S, "proc(main, go).\n\nproc(go, ?(some(X, (X = hall, X > 3)))).\n"), close(S)),
    domain_clauses(Clauses), unload_program(late), load_program(late, [File], Clauses, []), start(late, Agent),
    catch(step(Agent, 0.0, [], 10000, _, _), E, true), fault_text(E, late, Text),
    format(string(Front), "~w:3: in go/0: >/2: Arithmetic: ", [File]), assertion(sub_string(Text, 0, _, _, Front)).
test(so_does_a_time_out) :-
    setup_call_cleanup(tmp_file_stream(text, File, S), write(S, "proc(main, go).\nproc(go, while(true, ?(true))).\n"), close(S)),
    domain_clauses(Clauses), unload_program(late), load_program(late, [File], Clauses, []), start(late, Agent),
    catch(step(Agent, 0.0, [], 10000, _, _), E, true), fault_text(E, late, Text),
    format(string(Wanted), "~w:2: in go/0: Prolog time-out: the step took more than 10,000 inferences", [File]),
    assertion(Text == Wanted).

:- end_tests(program).
