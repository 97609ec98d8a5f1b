:- module(program_tests, []).
:- use_module('../program').
:- use_module('../agent').
:- use_module(library(plunit)).
:- use_module(library(lists)).

domain_clauses([ fluent(wet), functional(n(_)), action(walk(_)), poss(walk(_), true), room(hall), room('tv-sat'), expects(walk(X), room(X)), expects(in_room(X), room(X)) ]).

% The faults of a file with this text, each without the file's name.
faults(Text, Faults) :-
    setup_call_cleanup(tmp_file_stream(text, File, Out), write(Out, Text), close(Out)),
    unload_program(faulty),
    domain_clauses(Clauses),
    load_program(faulty, [File], Clauses, All),
    findall(Fault, ( member(F, All), atom_concat(File, ':', Front), atom_concat(Front, Fault, F) ), Faults),
    assertion(same_length(All, Faults)),
    delete_file(File).

% The same beside another file that says speed(1).
faults_beside_speed(Text, Faults) :-
    setup_call_cleanup(tmp_file_stream(text, Other, S), write(S, "speed(1).\n"), close(S)),
    setup_call_cleanup(tmp_file_stream(text, File, T), write(T, Text), close(T)),
    domain_clauses(Clauses), unload_program(beside), load_program(beside, [File, Other], Clauses, All),
    findall(Fault, ( member(F, All), atom_concat(File, ':', Front), atom_concat(Front, Fault, F) ), Faults).

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
test(a_file_that_is_not_there_is_named, F == ["no/such/tour.pl:1: there is no such file"]) :-
    unload_program(none), load_program(none, ['no/such/tour.pl'], [], F).
test(the_line_is_that_of_the_mistake, F == ['4: jump is neither an action nor a procedure']) :-
    faults("proc(main,\n     [ walk(hall),\n       if(wet,\n          (jump),\n          []) ]).\n", F).
test(the_line_of_a_variable, [F] == ['3: nothing introduces the variable R: it is no parameter, and no pi, interrupt or some names it']) :-
    faults("% ä\nproc(main,\n     [ walk(R),\n       walk(R) ]).\n", [F]).
test(a_misspelt_action, F == ['1: wakl(hall) is neither an action nor a procedure; did you mean walk?']) :-
    faults("proc(main, wakl(hall)).\n", F).
test(a_misspelt_construct, F == ['1: interupt(wet,[]) is neither an action nor a procedure; did you mean interrupt?']) :-
    faults("proc(main, interupt(wet, [])).\n", F).
test(a_construct_with_too_little, F == ['1: if(wet,[]) is neither an action nor a procedure; did you mean if/3?']) :-
    faults("proc(main, if(wet, [])).\n", F).
test(variables_have_their_names, F == ['2: walk(Room,_) is neither an action nor a procedure; did you mean walk/1?']) :-
    faults("proc(main, []).\nproc(go(Room), walk(Room, _)).\n", F).
test(a_misspelt_exhibit, F == ['1: walk(hal): there is no room(hal); did you mean hall?']) :- faults("proc(main, walk(hal)).\n", F).
test(an_exhibit_that_needs_quotes, F == ['1: walk(tv-sat): there is no room(tv-sat); write \'tv-sat\'']) :-
    faults("proc(main, walk(tv-sat)).\n", F).
test(an_exhibit_as_a_string, F == ['1: walk("hall"): there is no room("hall"); write hall']) :- faults("proc(main, walk(\"hall\")).\n", F).
test(the_first_of_two_expectations, F == ['3: at(hal): there is no room(hal); did you mean hall?']) :-
    faults("fluent(at(_)).\nexpects(at(X), (room(X) ; X == nowhere)).\nproc(main, [?(at(nowhere)), ?(at(hal))]).\n", F).
test(an_unknown_exhibit_behind_a_procedure, F == ['1: visit(hal): there is no room(hal); did you mean hall?']) :-
    faults("proc(main, [visit(hall), visit(hal)]).\nproc(visit(R), [greet, show(R)]).\nproc(show(R), pi(N, [?(n(N)), within(9, walk(R))])).\nproc(greet, []).\n", F).
test(a_procedure_that_may_do_without_is_no_fault, F == []) :-
    faults("proc(main, [visit(nothing), visit(hall), visit(s(hall))]).\nproc(visit(R), [if(R == nothing, [], walk(hall)), interrupt(n(R), walk(R))]).\n", F).
test(a_procedure_without_parameters_is_at_fault_itself, F == ['2: walk(hal): there is no room(hal); did you mean hall?']) :-
    faults("proc(main, go).\nproc(go, walk(hal)).\n", F).
test(procedures_that_call_themselves_are_read_once, F == []) :-
    faults("proc(main, more(hall)).\nproc(more(R), more(s(R))).\n", F).
test(a_misspelt_fluent, F == ['1: wte/0 is no fluent and no predicate; did you mean wet?']) :- faults("proc(main, ?(wte)).\n", F).
test(an_effect_of_nothing, F == ['1: wakl(X) is neither an action nor an event; did you mean walk?',
                                 '2: begin(wakl(hall)) is neither an action nor an event; did you mean walk?']) :-
    faults("causes_true(wakl(X), n(X), true).\ncauses_false(begin(wakl(hall)), wet, true).\nproc(main, []).\n", F).
test(effects_of_what_happens_are_none, F == []) :-
    faults("exogenous(rain(R)) :- room(R).\ncauses_true(rain(_), wet, true).\ncauses_false(failed(walk(_)), wet, true).\nproc(main, []).\n", F).
test(an_effect_with_too_little, F == ['1: causes_true/2 means nothing; did you mean causes_true/3?']) :-
    faults("causes_true(walk(hall), wet).\nproc(main, []).\n", F).
test(a_procedure_that_never_counts, F == ['3: the procedure go(hall) stands on line 2 already, and that one counts']) :-
    faults("proc(main, []).\nproc(go(R), walk(R)).\nproc(go(hall), []).\n", F).
test(a_procedure_by_cases, F == []) :- faults("proc(main, []).\nproc(go(hall), []).\nproc(go(R), walk(R)).\n", F).
test(a_number_that_nothing_uses, F == ['1: sped(2) is used nowhere; did you mean speed?']) :- faults_beside_speed("sped(2).\nproc(main, []).\n", F).
test(a_predicate_that_something_uses, F == []) :- faults_beside_speed("sped(2).\nproc(main, ?(sped(2))).\n", F).
test(a_comment_of_another_language) :-
    faults("proc(main, []).\n# a tour\nproc(go, []).\n", [F]),
    assertion(sub_atom(F, 0, _, _, '2: Syntax error')), assertion(sub_atom(F, _, _, 0, '; comments begin with %')).
test(a_bracket_too_few) :-
    faults("proc(main, [walk(hall)).\n", [F]),
    assertion(sub_atom(F, _, _, 0, '; is a bracket, a comma or a full stop missing before this?')).
test(a_main_of_the_caller, F == ["1: visti is neither an action nor a procedure; did you mean visit?"]) :-
    setup_call_cleanup(tmp_file_stream(text, File, S), write(S, "proc(visit, []).\n"), close(S)),
    unload_program(called), load_program(called, [File], [proc(main, visti)], [Fault]),
    atom_concat(File, ':', Front), string_concat(Front, Text, Fault), F = [Text].
test(places_of_actions, Places == ["2"]) :-
    setup_call_cleanup(tmp_file_stream(text, File, S), write(S, "proc(main, []).\naction(hello).\naction(hello(_)).\nposs(hello, true).\nposs(hello(_), true).\n"), close(S)),
    unload_program(placed), load_program(placed, [File], [], []), atom_concat(File, ':', Front),
    findall(Line, ( action_place(placed, "hello", Place), string_concat(Front, Line, Place) ), Places).
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
