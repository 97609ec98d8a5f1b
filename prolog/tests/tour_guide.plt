:- module(tour_guide_tests, []).
:- use_module(testing).
:- use_module('../agent', except([step/5])).
:- use_module('../golog').
:- use_module('../program').
:- use_module('../situation').
:- use_module('../travel').
:- use_module(library(plunit)).
:- use_module(library(lists)).

line(Main, Agent) :- line_museum(Facts), museum(line, Facts, Main), start(line, Agent).
grid(Seed, Main, Agent) :- grid_museum(Seed, Facts), museum(grid, Facts, Main), start(grid, Agent).

step(A0, Now, Events, Result, A) :- agent:step(A0, Now, Events, 1000000, Result, A).
began(Results, Actions) :- findall(A, member(begin(A), Results), Actions).

% Plays all, each action done at once; what the agent began.
actions(A0, Now, Events, Actions, End) :- play(A0, Now, Events, Results, End), began(Results, Actions).

:- begin_tests(paper).

% [Rhino1999] 4.3, Fig. 21: parking, requests for 1 and 12.
test(figure_21, [forall(member(Main, [internet_tourguide, planned_tourguide])), Actions-End == [drive(e1), explain(e1), drive(e12), explain(e12), drive(home)]-finished]) :-
    line(Main, A0), actions(A0, 0.0, [requested(e1), requested(e12)], Actions, End-_).
test(the_order_of_the_requests_does_not_matter, Actions == [drive(e1), explain(e1), drive(e12), explain(e12), drive(home)]) :-
    line(internet_tourguide, A0), actions(A0, 0.0, [requested(e12), requested(e1)], Actions, _).

% Fig. 22: a request for 5, which is nearer than 12, while 1 is explained.
test(figure_22, [forall(member(Main, [internet_tourguide, planned_tourguide])), Rest == [drive(e5), explain(e5), drive(e12), explain(e12), drive(home)]]) :-
    line(Main, A0),
    step(A0, 0.0, [requested(e1), requested(e12)], R1, A1), assertion(R1 == begin(drive(e1))),
    outcome(A1, drive(e1), done, A2),
    step(A2, 11.0, [], R2, A3), assertion(R2 == begin(explain(e1))),
    step(A3, 20.0, [requested(e5)], R3, A4), assertion(R3 == waits), outcome(A4, explain(e1), done, A5),
    actions(A5, 41.0, [], Rest, _).

% The plan as the paper writes it, by do/3 alone.
test(the_plan_is_a_situation) :-
    line(internet_tourguide, agent(D, P, State0)),
    progress(requested(e1), State0, D, State1), progress(requested(e12), State1, D, State),
    once(do(P, imagined(State), S, D)),
    assertion(S = do(drive(home), do(explain(e12), do(drive(e12), do(explain(e1), do(drive(e1), imagined(State))))))).

test(nothing_to_do_is_nothing, Actions-End == []-finished) :-
    line(internet_tourguide, A0), actions(A0, 0.0, [], Actions, End-_).
test(goto_is_guarded, Actions == []) :- line(goto(home), A0), actions(A0, 0.0, [], Actions, _).
test(homing_at_the_end, Last == drive(home)) :-
    line(internet_tourguide, A0), actions(A0, 0.0, [requested(e5)], Actions, _), last(Actions, Last).
test(wishes_for_one_exhibit_are_one_visit, Actions == [drive(e5), explain(e5), drive(home)]) :-
    line(internet_tourguide, A0), actions(A0, 0.0, [requested(e5), requested(e5), requested(e5)], Actions, _).

% Up to six exhibits the prover finds alone the way with the least travel, as the scheduler does.
test(the_prover_finds_the_least_travel, [forall(between(1, 6, Seed))]) :-
    grid(Seed, planned_tourguide, A0),
    Count is min(6, 2 + Seed), numlist(1, Count, Ns),
    findall(requested(E), ( member(N, Ns), atom_concat(e, N, E) ), Events),
    A0 = agent(D, P, S0), foldl([Ev, X, Y]>>progress(Ev, X, D, Y), Events, S0, S1),
    foresee(agent(D, P, S1), 100, 20000000, Actions, End), assertion(End == finished),
    findall(E, member(explain(E), Actions), Proved),
    findall(E, member(requested(E), Events), Es), schedule(D:home, Es, Scheduled),
    order_length(D:home, Proved, M1), order_length(D:home, Scheduled, M2), assertion(abs(M1 - M2) < 1.0e-9).

% 13 exhibits, each wished for three times, planned in under 100 ms.
test(thirteen_exhibits) :-
    grid(3, internet_tourguide, agent(D, P, S0)),
    findall(requested(E), ( between(1, 3, _), D:exhibit(E) ), Events),
    foldl([Ev, X, Y]>>progress(Ev, X, D, Y), Events, S0, S1),
    statistics(inferences, I0), statistics(cputime, T0),
    step(agent(D, P, S1), 0.0, [], R, _),
    statistics(cputime, T1), statistics(inferences, I1),
    assertion(R = begin(drive(_))),
    Inferences is I1 - I0, Milliseconds is 1000 * (T1 - T0),
    foresee(agent(D, P, S1), 100, 20000000, Actions, End), assertion(End == finished),
    findall(E, member(explain(E), Actions), Served), length(Served, Count), assertion(Count == 13),
    format(user_error, "~n13 exhibits, 39 requests: the next action after ~D inferences, ~1f ms~n", [Inferences, Milliseconds]),
    assertion(Inferences < 1000000).

:- end_tests(paper).

:- begin_tests(tour_guide).

test(waits_at_home, Actions-End == []-waits) :- line(tour_guide, A0), actions(A0, 0.0, [], Actions, End-_).
test(serves_the_nearest_first_and_goes_home, Actions == [drive(e1), explain(e1), drive(e5), explain(e5), ask_more(e5), drive(home)]) :-
    line(tour_guide, A0), actions(A0, 0.0, [requested(e5), requested(e1)], Actions, waits-_).
test(tells_more_when_asked, Rest == [explain_more(e5), drive(home)]) :-
    line(tour_guide, A0), step(A0, 0.0, [requested(e5)], _, A1), outcome(A1, drive(e5), done, A2),
    step(A2, 0.0, [], _, A3), outcome(A3, explain(e5), done, A4),
    step(A4, 0.0, [], R, A5), assertion(R == begin(ask_more(e5))), outcome(A5, ask_more(e5), value(more), A6),
    actions(A6, 0.0, [], Rest, _).
test(no_answer_is_next, Rest == [stop(ask_more(e5)), begin(drive(home))]) :-
    line(tour_guide, A0), step(A0, 0.0, [requested(e5)], _, A1), outcome(A1, drive(e5), done, A2),
    step(A2, 0.0, [], _, A3), outcome(A3, explain(e5), done, A4),
    step(A4, 60.0, [], _, A5), step(A5, 64.0, [], R, A6), assertion(R == waits), play(A6, 65.0, [], Rest, _).
test(turns_round_on_the_way_home, Results == [stop(drive(home)), begin(drive(e1)), begin(explain(e1)), begin(ask_more(e1)), begin(drive(home))]) :-
    line(tour_guide, agent(D, P, S0)), put_fluent(robot_location(e12), S0, S1),
    step(agent(D, P, S1), 0.0, [], R, A1), assertion(R == begin(drive(home))),
    play(A1, 5.0, [requested(e1)], Results, waits-_).
test(tries_a_place_that_it_did_not_reach_later) :-
    line(tour_guide, A0), step(A0, 0.0, [requested(e1)], _, A1), outcome(A1, drive(e1), failed, A2),
    actions(A2, 10.0, [], Then, waits-A3), assertion(Then == [drive(home)]), assertion(agent_holds(A3, request(e1))),
    actions(A3, 44.0, [], Before, waits-A4), assertion(Before == []),
    actions(A4, 46.0, [], After, _), assertion(After = [drive(e1), explain(e1) | _]).
% What could not be shown is over: should the robot come there by another way, nothing of it is left.
test(what_was_not_reached_is_not_explained_later, After == [drive(e1), explain(e1), ask_more(e1)]) :-
    line(prioritized([serve(e1), interrupt(E, due(E), serve(E)), ?(closing)]), A0),
    step(A0, 0.0, [], R, A1), assertion(R == begin(drive(e1))), outcome(A1, drive(e1), failed, A2),
    actions(A2, 1.0, [], Nothing, waits-A3), assertion(Nothing == []),
    actions(A3, 60.0, [requested(e1)], After, waits-_).
test(takes_another_exhibit_meanwhile, [true(Then = [drive(e5), explain(e5) | _])]) :-
    line(tour_guide, A0), step(A0, 0.0, [requested(e1), requested(e5)], _, A1), outcome(A1, drive(e1), failed, A2),
    actions(A2, 10.0, [], Then, _).
test(charges_after_the_visit, Rest == [begin(ask_more(e1)), begin(drive(charger)), begin(charge_battery), begin(drive(home))]) :-
    line(tour_guide, A0), step(A0, 0.0, [requested(e1)], _, A1), outcome(A1, drive(e1), done, A2),
    step(A2, 1.0, [battery(0.15)], R, A3), assertion(R == begin(explain(e1))),
    outcome(A3, explain(e1), done, A4), play(A4, 2.0, [], Rest, waits-_).
test(waiting_requests_are_served_after_the_charge, [true(Rest = [begin(drive(charger)), begin(charge_battery), begin(drive(e12)) | _])]) :-
    line(tour_guide, A0), play(A0, 0.0, [requested(e12), battery(0.15)], Rest, waits-_).
test(nobody_is_asked_when_the_explanation_was_broken_off, Rest == [stop(explain(e1)), begin(drive(charger)), begin(charge_battery), begin(drive(e1)), begin(explain(e1)), begin(ask_more(e1)), begin(drive(home))]) :-
    line(tour_guide, A0), step(A0, 0.0, [requested(e1)], _, A1), outcome(A1, drive(e1), done, A2),
    step(A2, 1.0, [], _, A3),
    play(A3, 2.0, [battery(0.05)], Rest, waits-_).
test(breaks_off_when_the_battery_is_critical, Rest == [stop(drive(e12)), begin(drive(charger)), begin(charge_battery), begin(drive(e12)), begin(explain(e12)), begin(ask_more(e12)), begin(drive(home))]) :-
    line(tour_guide, A0), step(A0, 0.0, [requested(e12)], _, A1), play(A1, 5.0, [battery(0.05)], Rest, waits-_).
test(without_a_charger_it_goes_on, [true(Rest == [])]) :-
    line_museum(Facts0), exclude(==(has_charger), Facts0, Facts), museum(line, Facts, tour_guide), start(line, A0),
    step(A0, 0.0, [requested(e12)], _, A1), play(A1, 5.0, [battery(0.05)], Rest, waits-_).
test(finds_itself_and_takes_up_the_tour_again, Rest == [stop(drive(e12)), begin(relocalize), begin(drive(e12)), begin(explain(e12)), begin(ask_more(e12)), begin(drive(home))]) :-
    line(tour_guide, A0), step(A0, 0.0, [requested(e12)], _, A1), play(A1, 5.0, [lost], Rest, waits-_).
test(does_not_trust_its_place_after_it_was_lost, [true(Rest = [stop(explain(e1)), begin(relocalize), begin(drive(e1)) | _])]) :-
    line(tour_guide, A0), step(A0, 0.0, [requested(e1)], _, A1), outcome(A1, drive(e1), done, A2),
    step(A2, 1.0, [], R, A3), assertion(R == begin(explain(e1))),
    play(A3, 2.0, [lost], Rest, waits-_).
test(ends_at_home_when_the_museum_closes, Rest-End == [drive(e12), explain(e12), ask_more(e12), drive(home)]-finished) :-
    line(tour_guide, A0), actions(A0, 5.0, [requested(e12), closing], Rest, End-_).
test(a_cancelled_request_is_not_served, Actions == []) :-
    line(tour_guide, A0), actions(A0, 0.0, [requested(e1), cancelled(e1)], Actions, _).
test(an_unknown_exhibit_is_no_event, error(golog(unknown_event(requested(e99))))) :-
    line(tour_guide, A0), step(A0, 0.0, [requested(e99)], _, _).
test(expected_durations, D =:= 4 / 0.35) :- line(tour_guide, A0), expected_duration(A0, drive(e1), D).

% Whatever fails and comes in between, in the end every request is served and the robot is at home.
test(nothing_is_lost, [forall(between(1, 20, Seed))]) :-
    grid(Seed, tour_guide, A0), set_random(seed(Seed)),
    findall(E, grid:exhibit(E), Es), disturbed(300, 0.0, A0, Es, Requested, A1),
    settle(200, 10000.0, A1, A2),
    forall(member(E, Requested), assertion(\+ agent_holds(A2, request(E)))),
    forall(member(E, Requested), assertion(agent_holds(A2, explained(E)))),
    assertion(agent_holds(A2, robot_location(home))).

:- end_tests(tour_guide).

% Steps at random times with random events; an action in five fails. At most one action at a time is under way.
disturbed(0, _, A, _, [], A) :- !.
disturbed(N, Now, A0, Es, Requested, A) :-
    random(X), random_member(E, Es),
    ( X < 0.1 -> Events = [requested(E)], Requested = [E | More]
    ; X < 0.13 -> Events = [lost], Requested = More
    ; X < 0.16 -> Events = [localized], Requested = More
    ; X < 0.2 -> random(C), Events = [battery(C)], Requested = More
    ; Events = [], Requested = More ),
    agent:step(A0, Now, Events, 1000000, Result, A1),
    findall(Act, agent_holds(A1, under_way(Act)), Acts), length(Acts, Count), assertion(Count =< 1),
    ( Acts = [Act], random(Y), Y < 0.5 -> random(Z), ( Z < 0.2 -> Outcome = failed ; Outcome = done ), outcome(A1, Act, Outcome, A2) ; A2 = A1 ),
    assertion(memberchk(Result, [begin(_), stop(_), waits])),
    Later is Now + 3.0, Less is N - 1,
    disturbed(Less, Later, A2, Es, More, A).

settle(0, _, A, A) :- !.
settle(N, Now, A0, A) :-
    agent:step(A0, Now, [], 1000000, _, A1),
    ( agent_holds(A1, under_way(Act)) -> outcome(A1, Act, done, A2) ; A2 = A1 ),
    Less is N - 1, Later is Now + 1.0,
    settle(Less, Later, A2, A).
