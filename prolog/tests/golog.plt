:- module(golog_tests, []).
:- use_module(testing).
:- use_module('../situation').
:- use_module('../golog').
:- use_module(library(plunit)).
:- use_module(library(lists)).
:- use_module(library(random)).

letters([ action(a), action(b), action(c), action(d), action(put(_)), action(count), action(pay(_)),
          poss(a, true), poss(b, true), poss(c, true), poss(d, true), poss(put(X), (box(X), \+ full(X))), poss(count, true), poss(pay(_), true),
          fluent(full(_)), fluent(done_a), functional(n(_)), functional(paid(_)), initially(n(0)), initially(paid(0)),
          causes_true(put(X), full(X), true), causes_true(a, done_a, true),
          causes_true(count, n(N), (n(M), N is M + 1)), causes_true(pay(X), paid(N), (paid(M), N is M + X)),
          box(1), box(2), box(3),
          proc(twice(P), [P, P]), proc(down(0), []), proc(down(N), [?(N > 0), count, pi(M, [?(M is N - 1), down(M)])]),
          derived(some_of(X, Y), (full(X), paid(P), P < X, Y is X - P)),
          proc(fill, pi(X, put(X))) ]).

% Any program of so much depth.
any_program(0, P) :- !, random_member(P, [a, b, c, [], ?(done_a), ?(\+ done_a), count, ?(n(0)), fill]).
any_program(Depth, P) :-
    Less is Depth - 1,
    any_program(Less, Q),
    any_program(Less, R),
    random_member(P, [[Q, R], ndet(Q, R), if(done_a, Q, R), pi(_, Q), conc(Q, R), [Q], prioritized([Q, R])]).

same(P, Q) :- results(P, letters, Ps), results(Q, letters, Qs), assertion(Ps == Qs).

seeded(Seed, Programs) :- set_random(seed(Seed)), maplist(any_program(1), Programs).

:- begin_tests(laws, [setup(( letters(Clauses), domain(letters, Clauses, _) ))]).

test(nothing, R == [[]]) :- results([], letters, R).
test(an_action, R == [[a]]) :- results(a, letters, R).
test(a_sequence, R == [[a, b, c]]) :- results([a, b, c], letters, R).
test(an_impossible_action, R == []) :- results([put(1), put(1)], letters, R).
test(an_unknown_action, error(golog(unknown(z)))) :- results(z, letters, _).
test(an_action_with_a_variable, error(golog(open_action(pay(_))))) :- results(pi(X, pay(X)), letters, _).
test(a_test_that_holds, R == [[a, b]]) :- results([a, ?(done_a), b], letters, R).
test(a_test_that_does_not_hold, R == []) :- results([b, ?(done_a)], letters, R).
test(choice, R == [[a], [b]]) :- results(ndet(a, b), letters, R).
test(pi_takes_each_instance, R == [[put(1)], [put(2)], [put(3)]]) :- results(pi(X, put(X)), letters, R).
test(pi_takes_each_that_passes, R == [[put(2)], [put(3)]]) :- results(pi(X, [?((box(X), X > 1)), put(X)]), letters, R).
test(pi_keeps_outer_variables, R == [[put(1), put(2)], [put(1), put(3)]]) :-
    results(pi(X, [?(X = 1), put(X), pi(Y, [?((box(Y), Y > X)), put(Y)])]), letters, R).
test(pi_of_two, R == [[put(1), put(3)], [put(3), put(1)]]) :-
    results(pi([X, Y], [?((box(X), box(Y), X + Y =:= 4, X =\= Y)), put(X), put(Y)]), letters, R).
test(if_then, R == [[a, b]]) :- results([a, if(done_a, b, c)], letters, R).
test(if_else, R == [[c]]) :- results(if(done_a, b, c), letters, R).
test(while, R == [[count, count, count]]) :- results(while(some(N, (n(N), N < 3)), count), letters, R).
test(a_loop_binds_nothing, R == [[put(1), count], [put(2), count], [put(3), count]]) :-
    results([pi(X, put(X)), while((full(_), n(0)), count)], letters, R).
test(while_false_is_nothing, R == [[]]) :- results(while(done_a, b), letters, R).
test(star, R == [[], [count], [count, count]]) :- results(star([?(some(N, (n(N), N < 2))), count]), letters, R).
test(procedures, R == [[b, b]]) :- results(twice(b), letters, R).
test(recursion, R == [[count, count, count]]) :- results(down(3), letters, R).
test(conc_is_all_interleavings, R == [[a, b, c], [a, c, b], [c, a, b]]) :- results(conc([a, b], c), letters, R).
test(conc_synchronizes, R == [[b, a, c]]) :- results(conc([?(done_a), c], [b, a]), letters, R).
test(conc_deadlock, R == []) :- results(conc([?(full(1)), put(2)], [?(full(2)), put(1)]), letters, R).
test(prioritized_takes_the_first, R == [[a, b, c, d]]) :- results(prioritized([[a, b], [c, d]]), letters, R).
test(prioritized_goes_on_below_a_wait, R == [[b, a, c, d]]) :-
    results(prioritized([[?(done_a), c], [b, a, d]]), letters, R).
test(prioritized_of_three, R == [[b, d, a, c]]) :-
    results(prioritized([[?(done_a), c], [?(n(1)), b], [b, d, a]]), letters, R0), assertion(R0 == []),
    results(prioritized([[?(done_a), c], ?(n(0)), [b, d, a]]), letters, R).
test(iconc, R == 16) :-
    results(iconc(fill), letters, All), length(All, R),
    assertion(subset([[], [put(2)], [put(3), put(1), put(2)]], All)).
test(an_interrupt_runs_when_it_must, R == [[b, a, d, pay(1), c]]) :-
    results(prioritized([interrupt((done_a, paid(0)), [d, pay(1)]), [b, a, c]]), letters, R).
test(an_interrupt_names_its_reason, R == [[put(2), pay(2), put(3)], [put(2), pay(2), put(3), pay(1)]]) :-
    results(prioritized([interrupt([X, Y], some_of(X, Y), pay(Y)), [put(2), put(3)]]), letters, R).
test(an_interrupt_alone_is_over, R == [[]]) :- results(interrupt(done_a, b), letters, R).

% Laws over seeded programs: both sides can be executed in the same ways.
test(sequence_is_associative, [forall(between(1, 30, Seed))]) :-
    seeded(Seed, [P, Q, R]), same([[P, Q], R], [P, [Q, R]]).
test(nothing_is_the_unit, [forall(between(1, 30, Seed))]) :- seeded(Seed, [P]), same([[], P], P), same([P, []], P).
test(choice_commutes, [forall(between(1, 30, Seed))]) :- seeded(Seed, [P, Q]), same(ndet(P, Q), ndet(Q, P)).
test(choice_is_associative, [forall(between(1, 30, Seed))]) :-
    seeded(Seed, [P, Q, R]), same(ndet(P, ndet(Q, R)), ndet(ndet(P, Q), R)).
test(choice_is_idempotent, [forall(between(1, 30, Seed))]) :- seeded(Seed, [P]), same(ndet(P, P), P).
test(sequence_distributes_over_choice, [forall(between(1, 30, Seed))]) :-
    seeded(Seed, [P, Q, R]), same([ndet(P, Q), R], ndet([P, R], [Q, R])).
test(conc_commutes, [forall(between(1, 30, Seed))]) :- seeded(Seed, [P, Q]), same(conc(P, Q), conc(Q, P)).
test(nothing_beside_is_nothing, [forall(between(1, 30, Seed))]) :- seeded(Seed, [P]), same(conc(P, []), P).
test(a_sequence_is_one_interleaving, [forall(between(1, 30, Seed))]) :-
    seeded(Seed, [P, Q]), results([P, Q], letters, Some), results(conc(P, Q), letters, All),
    assertion(subset(Some, All)).
test(priority_is_some_interleaving, [forall(between(1, 30, Seed))]) :-
    seeded(Seed, [P, Q]), results(prioritized([P, Q]), letters, Some), results(conc(P, Q), letters, All),
    assertion(subset(Some, All)).
test(while_unfolds, [forall(between(1, 30, Seed))]) :-
    seeded(Seed, [P]), C = (n(N), N < 2), B = [P, count],
    same(while(C, B), if(C, [B, while(C, B)], [])).
test(if_is_a_choice_of_tests, [forall(between(1, 30, Seed))]) :-
    seeded(Seed, [P, Q]), same(if(done_a, P, Q), ndet([?(done_a), P], [?(\+ done_a), Q])).

:- end_tests(laws).

:- begin_tests(search, [setup(( letters(Clauses), domain(letters, Clauses, _) ))]).

% [Rhino1999] 4.3: do/3 and the search give the same plans.
test(search_is_do, [forall(between(1, 60, Seed))]) :-
    seeded(Seed, [P, Q]),
    results([P, Q], letters, Set),
    initial_state(letters, State),
    findall(Actions, plan([P, Q], State, Actions, letters), Plans),
    sort(Plans, Planned),
    assertion(Planned == Set).
test(search_takes_the_first_way_first, Actions == [b, a, c]) :-
    initial_state(letters, State), once(plan(search([ndet(b, a), a, ?(done_a), c]), State, Actions, letters)).
test(search_avoids_the_blind_alley, [true(Actions == [b])]) :-
    initial_state(letters, State), once(plan(search([ndet(a, b), ?(\+ done_a)]), State, Actions, letters)).
test(search_without_a_way_fails, fail) :-
    initial_state(letters, State), plan(search([a, ?(full(1))]), State, _, letters).
test(the_least_way, Actions == [pay(1), pay(2)]) :-
    initial_state(letters, State),
    plan([ndet(pay(5), ndet(pay(1), pay(3))), ndet(pay(4), pay(2))], paid(_), State, Actions, letters).
test(of_equal_ways_the_first, Actions == [pay(2), pay(1)]) :-
    initial_state(letters, State),
    plan(ndet([pay(2), pay(1)], ndet(pay(3), [pay(1), pay(2)])), paid(_), State, Actions, letters).
test(the_least_way_is_the_least_of_all, [forall(between(1, 30, Seed))]) :-
    set_random(seed(Seed)),
    findall(P, ( between(1, 4, _), random_between(1, 9, X), random_between(1, 9, Y), P = ndet(pay(X), [pay(Y), pay(1)]) ), Ps),
    initial_state(letters, State),
    plan(Ps, paid(_), State, Actions, letters),
    foldl([pay(X), S0, S1]>>( S1 is S0 + X ), Actions, 0, Cost),
    findall(Sum, ( plan(Ps, State, Other, letters), foldl([pay(X), S0, S1]>>( S1 is S0 + X ), Other, 0, Sum) ), Sums),
    assertion(min_list(Sums, Cost)).

:- end_tests(search).
