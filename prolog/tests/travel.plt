:- module(travel_tests, []).
:- use_module(testing).
:- use_module('../travel').
:- use_module('../program').
:- use_module(library(plunit)).
:- use_module(library(lists)).
:- use_module(library(aggregate)).

grid(Seed) :- grid_museum(Seed, Facts), museum(grid, Facts, []).
some_exhibits(Count, Exhibits) :- numlist(1, Count, Ns), maplist([N, E]>>atom_concat(e, N, E), Ns, Exhibits).

:- begin_tests(travel).

test(nothing, Order == []) :- grid(1), schedule(grid:home, [], Order).
test(one, Order == [e7]) :- grid(1), schedule(grid:home, [e7], Order).
test(ties_go_to_the_first, Order == [e1, e2]) :-
    unload_program(tie), load_program(tie, [], [distance(_, _, 1.0), proc(main, [])], []),
    schedule(tie:home, [e1, e2], Order).
test(what_has_no_way_comes_last, Order == [e2, e1]) :-
    unload_program(far), load_program(far, [], [distance(home, e2, 5.0), proc(main, [])], []),
    schedule(far:home, [e1, e2], Order).
test(up_to_six_the_least_of_all, [forall(between(1, 25, Seed))]) :-
    grid(Seed),
    Count is 2 + Seed mod 5,
    some_exhibits(Count, Es),
    schedule(grid:home, Es, Order),
    order_length(grid:home, Order, Metres),
    aggregate_all(min(M), ( permutation(Es, Other), order_length(grid:home, Other, M) ), Least),
    assertion(abs(Metres - Least) < 1.0e-9).
test(an_order_has_all_exhibits_once, [forall(between(1, 20, Seed))]) :-
    grid(Seed), some_exhibits(13, Es), schedule(grid:home, Es, Order), msort(Order, Sorted), msort(Es, Sorted2),
    assertion(Sorted == Sorted2).
test(improved_is_never_better_than_exact, [forall(between(1, 20, Seed))]) :-
    grid(Seed), some_exhibits(6, Es),
    exact_order(grid:home, Es, Exact), order_length(grid:home, Exact, Least),
    improved_order(grid:home, Es, Order), order_length(grid:home, Order, Metres),
    assertion(Metres >= Least - 1.0e-9), assertion(Metres =< 1.35 * Least).

% No change of one stretch makes it shorter.
test(improved_cannot_be_improved_by_one_change, [forall(between(1, 10, Seed))]) :-
    grid(Seed), some_exhibits(13, Es),
    improved_order(grid:home, Es, Order), order_length(grid:home, Order, Metres),
    forall(travel:changed(Order, Other), ( order_length(grid:home, Other, M), assertion(M >= Metres - 1.0e-9) )).

:- end_tests(travel).
