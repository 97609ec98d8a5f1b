:- module(situation_tests, []).
:- use_module(testing).
:- use_module('../situation').
:- use_module(library(plunit)).
:- use_module(library(random)).
:- use_module(library(lists)).

lamps([ fluent(on(_)), functional(level(_)), functional(at(_, _)), derived(dark, \+ on(_)), derived(bright(X), (on(X), level(L), L > 1)),
        initially(level(0)), initially(at(cat, mat)), initially(at(dog, yard)), initially(on(hall)),
        action(light(_)), action(quench(_)), action(quench_all), action(raise), action(carry(_, _)), action(toggle(_)),
        poss(light(X), \+ on(X)), poss(quench(X), on(X)), poss(quench_all, true), poss(raise, true), poss(carry(_, _), true),
        poss(toggle(_), true),
        causes_true(light(X), on(X), true), causes_false(quench(X), on(X), true), causes_false(quench_all, on(_), true),
        causes_true(raise, level(N), (level(M), N is M + 1)), causes_true(carry(X, P), at(X, P), true),
        causes_true(toggle(X), on(X), \+ on(X)), causes_false(toggle(X), on(X), on(X)) ]).

any_action(A) :-
    random_member(X, [hall, attic, cellar]),
    random_member(P, [mat, yard, roof]),
    random_member(Pet, [cat, dog]),
    random_member(A, [light(X), quench(X), toggle(X), quench_all, raise, carry(Pet, P)]).

all_true(S, D, Sorted) :- findall(F, ( member(F, [on(_), level(_), at(_, _)]), holds(F, S, D) ), Fs), msort(Fs, Sorted).

after([], S, S).
after([A | As], S0, S) :- after(As, do(A, S0), S).

:- begin_tests(situation, [setup(( lamps(Clauses), domain(lamps, Clauses, _) ))]).

state(State) :- initial_state(lamps, State).

test(initially, Fs == [level(0), on(hall), at(cat, mat), at(dog, yard)]) :-
    state(St), all_true(imagined(St), lamps, Fs).
test(an_effect_holds) :- state(St), holds(on(attic), do(light(attic), imagined(St)), lamps).
test(an_ended_fluent_does_not_hold, fail) :- state(St), holds(on(hall), do(quench(hall), imagined(St)), lamps).
test(what_is_not_touched_persists) :- state(St), holds(on(hall), do(light(attic), imagined(St)), lamps).
test(a_value_is_unique, all(P == [roof])) :- state(St), holds(at(cat, P), do(carry(cat, roof), imagined(St)), lamps).
test(other_values_persist, all(P == [yard])) :- state(St), holds(at(dog, P), do(carry(cat, roof), imagined(St)), lamps).
test(an_effect_by_its_condition, fail) :- state(St), holds(on(hall), do(toggle(hall), imagined(St)), lamps).
test(a_value_that_follows_from_the_last, all(N == [3])) :-
    state(St), after([raise, raise, raise], imagined(St), S), holds(level(N), S, lamps).
test(open_questions_find_each_instance_once, all(X == [attic, hall])) :-
    state(St), after([light(attic), light(hall)], imagined(St), S), holds(on(X), S, lamps).
test(one_action_may_end_many) :- state(St), after([light(attic), quench_all], imagined(St), S), holds(dark, S, lamps).
test(derived, all(X == [hall])) :- state(St), after([raise, raise], imagined(St), S), holds(bright(X), S, lamps).
test(some_binds_nothing, X-1 == Y-1) :- state(St), X = Y, holds(some(Z, on(Z)), imagined(St), lamps), assertion(var(Z)).
test(all) :- state(St), holds(all(X, on(X), X \== attic), imagined(St), lamps).
test(not_all, fail) :- state(St), holds(all(X, on(X), X \== attic), do(light(attic), imagined(St)), lamps).
test(set, Xs == [attic, hall]) :- state(St), holds(set(X, on(X), Xs), do(light(attic), imagined(St)), lamps).
test(the_empty_set, Xs == []) :- state(St), holds(set(X, on(X), Xs), do(quench_all, imagined(St)), lamps).
test(a_condition_must_be_known, error(instantiation_error)) :- state(St), holds(_, imagined(St), lamps).
test(possible) :- state(St), possible(light(attic), imagined(St), lamps).
test(impossible, fail) :- state(St), possible(light(hall), imagined(St), lamps).
test(fluents_make_the_state, Fs == Gs) :-
    state(St), state_fluents(St, Fs), fluents_state(Fs, St2), state_fluents(St2, Gs).
test(an_effect_must_be_known, error(instantiation_error)) :- state(St), progress(light(_), St, lamps, _).

% Regression and progression say the same of 200 random histories of 12 actions.
test(regression_is_progression, [forall(between(1, 200, Seed))]) :-
    set_random(seed(Seed)),
    length(Actions, 12),
    maplist(any_action, Actions),
    state(St),
    after(Actions, imagined(St), S),
    foldl([A, S0, S1]>>progress(A, S0, lamps, S1), Actions, St, End),
    all_true(S, lamps, Regressed),
    all_true(imagined(End), lamps, Progressed),
    assertion(Regressed == Progressed).

:- end_tests(situation).
