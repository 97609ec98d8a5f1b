:- module(agent_tests, []).
:- use_module(testing).
:- use_module('../agent', except([step/5])).
:- use_module('../program').
:- use_module('../situation').
:- use_module(library(plunit)).
:- use_module(library(lists)).

office([ fluent(open(_)), fluent(alarm), fluent(seen(_)), functional(answer(_)), functional(n(_)), initially(n(0)),
         action(walk(_)), action(look), action(ring), action(sing), action(count),
         poss(walk(_), true), poss(look, true), poss(ring, true), poss(sing, true), poss(count, true),
         exogenous(alarm), exogenous(quiet), exogenous(opened(_)),
         causes_true(alarm, alarm, true), causes_false(quiet, alarm, true), causes_true(opened(X), open(X), true),
         causes_true(walk(X), seen(X), true), causes_true(failed(walk(X)), seen(failed(X)), true),
         causes_true(stopped(walk(X)), seen(stopped(X)), true),
         causes_true(sensed(look, X), answer(X), true), causes_true(count, n(N), (n(M), N is M + 1)),
         causes_false(ring, alarm, true) ]).

agent(Main, Agent) :-
    unload_program(office), office(Clauses), domain(office, [proc(main, Main) | Clauses], _), start(office, Agent).

step(A0, Now, Events, Result, A) :- agent:step(A0, Now, Events, 100000, Result, A).

:- begin_tests(online).

test(an_action_begins) :- agent([walk(x), ring], A0), step(A0, 1.0, [], R, _), assertion(R == begin(walk(x))).
test(and_takes_its_time) :-
    agent([walk(x), ring], A0), step(A0, 1.0, [], _, A1), step(A1, 2.0, [], R, A2), assertion(R == waits),
    assertion(\+ agent_holds(A2, seen(x))).
test(then_the_next_one_follows) :-
    agent([walk(x), ring], A0), step(A0, 1.0, [], _, A1), outcome(A1, walk(x), done, A2),
    assertion(agent_holds(A2, seen(x))),
    step(A2, 2.0, [], R, _), assertion(R == begin(ring)).
test(a_program_finishes) :-
    agent([ring], A0), step(A0, 1.0, [], _, A1), outcome(A1, ring, done, A2), step(A2, 1.0, [], R, A3),
    assertion(R == finished),
    step(A3, 2.0, [], R2, _), assertion(R2 == finished).
test(impossible_actions_are_waited_for, A == [swim, fly(x)]) :-
    unload_program(office), office(Clauses),
    domain(office, [action(fly(_)), poss(fly(_), alarm), action(swim), poss(swim, alarm), proc(up(X), [[], fly(X)]),
                    proc(main, conc(prioritized([interrupt(alarm, swim), interrupt(\+ alarm, swim), sing]),
                                    while(\+ alarm, if(alarm, swim, within(9, up(x)))))) | Clauses], _),
    start(office, A0), step(A0, 1.0, [], R, A1), assertion(R == begin(sing)), impossible_actions(A1, A).
test(a_failed_action_has_no_effect_of_its_own) :-
    agent([walk(x), ring], A0), step(A0, 1.0, [], _, A1), outcome(A1, walk(x), failed, A2),
    assertion(\+ agent_holds(A2, seen(x))), assertion(agent_holds(A2, seen(failed(x)))),
    step(A2, 2.0, [], R, _), assertion(R == begin(ring)).
test(what_was_sensed_decides) :-
    agent([look, if(answer(red), ring, sing)], A0),
    step(A0, 1.0, [], _, A1),
    forall(member(V-Wanted, [red-ring, green-sing]),
           ( outcome(A1, look, value(V), A2), step(A2, 1.0, [], R, _), assertion(R == begin(Wanted)) )).
test(an_outcome_of_nothing_under_way_changes_nothing, A1 == A0) :- agent([ring], A0), outcome(A0, walk(x), done, A1).
test(an_outcome_must_be_one, error(domain_error(outcome, maybe))) :-
    agent([ring], A0), step(A0, 1.0, [], _, A1), outcome(A1, ring, maybe, _).
test(an_event_wakes_a_test) :-
    agent([?(open(door)), ring], A0), step(A0, 1.0, [], R1, A1), assertion(R1 == waits),
    step(A1, 2.0, [opened(door)], R2, _), assertion(R2 == begin(ring)).
test(events_take_effect_in_their_order) :-
    agent([?(alarm), ring], A0), step(A0, 1.0, [alarm, quiet], R, _), assertion(R == waits).
test(an_unknown_event_is_named, error(golog(unknown_event(earthquake)))) :-
    agent([ring], A0), step(A0, 1.0, [earthquake], _, _).
test(two_actions_run_at_once) :-
    agent(conc([walk(x), ring], [sing, look]), A0), step(A0, 1.0, [], R1, A1), step(A1, 1.0, [], R2, A2),
    step(A2, 1.0, [], R3, _),
    assertion([R1, R2, R3] == [begin(walk(x)), begin(sing), waits]).
test(lower_priority_waits_for_an_action_above) :-
    agent(prioritized([[walk(x), ring], sing]), A0), step(A0, 1.0, [], _, A1), step(A1, 1.0, [], R, A2),
    assertion(R == waits),
    outcome(A2, walk(x), done, A3), step(A3, 2.0, [], R3, A4), outcome(A4, ring, done, A5), step(A5, 3.0, [], R5, _),
    assertion([R3, R5] == [begin(ring), begin(sing)]).
test(an_interrupt_acts_beside_an_action_under_way) :-
    agent(prioritized([interrupt(alarm, ring), walk(x)]), A0), step(A0, 1.0, [], _, A1),
    step(A1, 2.0, [alarm], R, A2), assertion(R == begin(ring)),
    outcome(A2, walk(x), done, A3), outcome(A3, ring, done, A4), step(A4, 3.0, [], R4, _), assertion(R4 == finished).
test(an_interrupt_comes_again) :-
    agent(prioritized([interrupt(alarm, ring), ?(open(door))]), A0),
    play(A0, 1.0, [alarm], R1, waits-A1), play(A1, 2.0, [], R2, waits-A2), play(A2, 3.0, [alarm], R3, waits-A3),
    play(A3, 4.0, [opened(door)], R4, End-_),
    assertion([R1, R2, R3, R4, End] == [[begin(ring)], [], [begin(ring)], [], finished]).
test(a_stopped_action_is_over) :-
    agent(prioritized([interrupt((alarm, under_way(walk(x))), stop(walk(x))), [walk(x), sing]]), A0),
    step(A0, 1.0, [], _, A1), step(A1, 2.0, [alarm], R, A2), assertion(R == stop(walk(x))),
    assertion(agent_holds(A2, seen(stopped(x)))),
    step(A2, 3.0, [], R3, _), assertion(R3 == begin(sing)).
test(nothing_to_stop_is_nothing, R == begin(ring)) :- agent([stop(walk(x)), ring], A0), step(A0, 1.0, [], R, _).
test(a_time_out_stops_the_action) :-
    agent([within(20, walk(x), sing), ring], A0), step(A0, 100.0, [], R1, A1), step(A1, 119.0, [], R2, A2),
    step(A2, 120.0, [], R3, A3), step(A3, 120.0, [], R4, _),
    assertion([R1, R2, R3, R4] == [begin(walk(x)), waits, stop(walk(x)), begin(sing)]).
test(a_time_out_ends_a_wait) :-
    agent([within(20, ?(alarm)), ring], A0), step(A0, 5.0, [], R1, A1), step(A1, 24.9, [], R2, A2),
    step(A2, 25.0, [], R3, _), assertion([R1, R2, R3] == [waits, waits, begin(ring)]).
test(what_ends_in_time_is_not_timed_out) :-
    agent([within(20, walk(x), sing), ring], A0), step(A0, 0.0, [], _, A1), outcome(A1, walk(x), done, A2),
    step(A2, 50.0, [], R, _), assertion(R == begin(ring)).
test(a_plan_is_followed) :-
    agent(search([ndet(ring, walk(x)), sing, ?(seen(x))]), A0), play(A0, 0.0, [], Rs, End-_),
    assertion(Rs-End == [begin(walk(x)), begin(sing)]-finished).
test(a_plan_is_made_anew_when_something_happens) :-
    agent(search([walk(x), ndet([?(\+ alarm), sing], [?(alarm), ring])]), A0), step(A0, 0.0, [], _, A1),
    step(A1, 1.0, [alarm], _, A2), outcome(A2, walk(x), done, A3),
    step(A3, 2.0, [], R, _), assertion(R == begin(ring)).
test(foreseen, As-End == [walk(x), ring]-waits) :-
    agent([walk(x), ring, ?(alarm)], A0), foresee(A0, 10, 100000, As, End).
test(foreseen_no_further_than_asked, As-End == [ring, ring, ring]-more) :-
    agent(while(true, ring), A0), foresee(A0, 3, 100000, As, End).
test(a_runaway_program_is_cut, error(golog(timeout(100000)))) :-
    agent(while(true, ?(true)), A0), step(A0, 0.0, [], _, _).
test(a_runaway_condition_is_cut, error(golog(timeout(100000)))) :-
    agent(?((repeat, fail)), A0), step(A0, 0.0, [], _, _).

% The past costs nothing: a step after 10,000 actions takes at most 1.5 times the inferences of one after 100.
test(long_histories_stay_fast) :-
    agent(while(true, [count, walk(x), look]), A0),
    cost_after(100, A0, A1, Early),
    cost_after(9900, A1, _, Late),
    format(user_error, "~ninferences of a step with its outcome: ~d after 100 actions, ~d after 10,000~n", [Early, Late]),
    assertion(Late =< 1.5 * Early).

test(a_snapshot_goes_on_where_it_was) :-
    Main = prioritized([interrupt(X, open(X), [walk(X), ?(alarm)]), within(7.5, [walk(a), pi(Y, [?(open(Y)), walk(Y)])], ring)]),
    agent(Main, A0), step(A0, 1.25, [], R, A1), assertion(R == begin(walk(a))),
    snapshot(A1, Text), restore(office, Text, A2),
    assertion(A1 =@= A2),
    step(A2, 9.0, [opened(door)], R2, _), assertion(R2 == begin(walk(door))).
test(no_snapshot, [forall(member(Text, ["", "nonsense(", "agent(1)", "golog_agent(1,X,[])", "golog_agent(1,[],[n(X)])", "golog_agent(2,[],[])"])), error(golog(no_snapshot))]) :-
    agent([ring], _), restore(office, Text, _).
test(the_snapshot_of_another_program, error(golog(foreign_snapshot(unknown(dance))))) :-
    agent([ring], _), restore(office, "golog_agent(1,[ring,dance],[n(0)])", _).

:- end_tests(online).

cost_after(Actions, A0, A, Inferences) :-
    acted(Actions, A0, A1),
    statistics(inferences, I0), acted(3, A1, A), statistics(inferences, I1),
    Inferences is I1 - I0.

acted(0, A, A) :- !.
acted(N, A0, A) :- agent:step(A0, 0.0, [], begin(Act), A1), outcome(A1, Act, done, A2), M is N - 1, acted(M, A2, A).
