/*  A program under way in the real world, step by step (on-line execution, IndiGolog): events come in, actions go
    out and take their time, nothing is taken back.

    An agent is agent(Domain, Program, State): what is left of the program, and all that is true now. The past is not
    kept: every step rolls the state forward. Time is what the caller says it is [s]. */
:- module(agent, [start/2, begin_again/2, step/5, step/6, outcome/4, foresee/5, check_event/2,
                  impossible_actions/2, expected_duration/3,
                  agent_holds/2, snapshot/2, restore/3]).
:- use_module(library(apply)).
:- use_module(library(lists)).
:- use_module(library(error)).
:- use_module(situation).
:- use_module(golog).
:- use_module(program).

%!  start(+Domain, -Agent) is det.
%   The domain's procedure `main` in its initial state.
start(D, agent(D, main, State)) :- initial_state(D, State).

%!  begin_again(+Agent, -NewAgent) is det.
%   `main` from its beginning, where what is true now is true.
begin_again(agent(D, _, State), agent(D, main, State)).

%!  step(+Agent, +Now, +Events, -Result, -NewAgent) is det.
%   Takes the events in and goes on to the next thing that the robot must be told:
%
%       begin(A)    it takes the action A; outcome/4 tells how that went, and steps may be made meanwhile
%       stop(A)     it stops A, which is over then
%       waits       there is nothing to do now
%       finished    the program has ended
%
%   Throws error(E, _) where the program is faulty; fault_text/3 says it with file and line.
step(agent(D, P, State0), Now, Events, Result, agent(D, P1, State)) :-
    put_fluent(time(Now), State0, State1),
    foldl(take_event(D), Events, State1, State2),
    go_on(P, State2, D, Result, P1, State).

%!  step(+Agent, +Now, +Events, +MostInferences, -Result, -NewAgent) is det.
%   The same for a program that may run away: throws error(golog(timeout(MostInferences)), _) then.
step(Agent, Now, Events, Most, Result, NewAgent) :-
    nb_setval(golog_procedure, main/0),
    call_with_inference_limit(step(Agent, Now, Events, Result, NewAgent), Most, Limit),
    (   Limit == inference_limit_exceeded
    ->  nb_getval(golog_procedure, Name),
        throw(error(golog(timeout(Most)), in(Name, _)))
    ;   true
    ).

%!  check_event(+Agent, +Event) is det.
%   Throws where the domain knows no such event.
check_event(agent(D, _, _), Event) :- known_event(D, Event).

known_event(D, Event) :-
    must_be(ground, Event),
    ( \+ \+ D:exogenous(Event) -> true ; throw(error(golog(unknown_event(Event)), _)) ).

take_event(D, Event, State0, State) :-
    known_event(D, Event),
    progress(Event, State0, D, State1),
    count_news(State1, D, State).

count_news(State0, D, State) :-
    holds(news(N0), now(State0), D), !,
    N is N0 + 1,
    put_fluent(news(N), State0, State).

go_on(P, State, D, Result, P1, NewState) :-
    S = now(State),
    (   final(P, S, D)
    ->  Result = finished, P1 = P, NewState = State
    ;   once(trans(P, S, P2, S1, D))
    ->  arrive(S1, State, P2, D, Result, P1, NewState)
    ;   Result = waits, P1 = P, NewState = State
    ).

arrive(now(State), _, P, D, Result, P1, NewState) :- go_on(P, State, D, Result, P1, NewState).
arrive(do(begin(A), _), State, P, D, begin(A), P, NewState) :- progress(begin(A), State, D, NewState).
arrive(do(stop(A), _), State, P, D, stop(A), P, NewState) :-
    progress(ended(A), State, D, State1),
    progress(stopped(A), State1, D, NewState).

%!  outcome(+Agent, +Action, +Outcome, -NewAgent) is det.
%   How an action went that was begun: done; value(V), done and V was sensed; failed. An action that is not under way,
%   such as one that was stopped meanwhile, changes nothing. For the domain's axioms, an action that fails is the event
%   failed(A), one that was stopped stopped(A), and a value sensed(A, V).
outcome(agent(D, P, State0), A, Outcome, agent(D, P, State)) :-
    must_be(ground, A-Outcome),
    (   holds(under_way(A), now(State0), D)
    ->  progress(ended(A), State0, D, State1),
        ended_as(Outcome, A, D, State1, State)
    ;   State = State0
    ).

ended_as(done, A, D, State0, State) :- !, progress(A, State0, D, State).
ended_as(value(V), A, D, State0, State) :- !,
    progress(A, State0, D, State1),
    progress(sensed(A, V), State1, D, State2),
    count_news(State2, D, State).
ended_as(failed, A, D, State0, State) :- !,
    progress(failed(A), State0, D, State1),
    count_news(State1, D, State).
ended_as(Outcome, _, _, _, _) :- domain_error(outcome, Outcome).

%!  foresee(+Agent, +MostActions, +MostInferences, -Actions, -End) is det.
%   What the agent would do from here if every action succeeded and nothing else happened. End: finished, waits, or
%   `more` after MostActions. Throws as step/6.
foresee(Agent, Most, MostInferences, Actions, End) :-
    agent_holds(Agent, time(Now)), !,
    foresee(Most, Agent, Now, MostInferences, Actions, End).

foresee(0, _, _, _, [], more) :- !.
foresee(Most, Agent0, Now, MostInferences, Actions, End) :-
    step(Agent0, Now, [], MostInferences, Result, Agent1),
    (   Result = begin(A)
    ->  outcome(Agent1, A, done, Agent2),
        Actions = [A | Rest],
        Fewer is Most - 1,
        foresee(Fewer, Agent2, Now, MostInferences, Rest, End)
    ;   Result = stop(_)
    ->  foresee(Most, Agent1, Now, MostInferences, Actions, End)
    ;   Actions = [], End = Result
    ).

%!  impossible_actions(+Agent, -Actions) is det.
%   Those that the program would begin now if they were possible.
impossible_actions(agent(D, P, State), Actions) :-
    findall(A, wanted_action(P, now(State), D, A), Wanted),
    sort(Wanted, Sorted),
    exclude(is_possible(State, D), Sorted, Actions).

is_possible(State, D, A) :- possible(A, now(State), D).

%!  expected_duration(+Agent, +Action, -Seconds) is semidet.
%   As the domain's duration/3 says; fails where it says nothing.
expected_duration(agent(D, _, State), A, Seconds) :-
    D:duration(A, Seconds, C),
    holds(C, now(State), D), !.

%!  agent_holds(+Agent, ?Condition) is nondet.
agent_holds(agent(D, _, State), Condition) :- holds(Condition, now(State), D).

%!  snapshot(+Agent, -Text) is det.
%   One line from which restore/3 makes the same agent again.
snapshot(agent(_, P, State), Text) :-
    state_fluents(State, Fluents),
    copy_term(P, Named),
    numbervars(Named, 0, _, [singletons(true)]),
    with_output_to(string(Text),
                   write_term(golog_agent(1, Named, Fluents), [quoted(true), ignore_ops(true), numbervars(true)])).

%!  restore(+Domain, +Text, -Agent) is det.
%   Throws where the text is no snapshot, or one of a program with procedures and actions that the domain has not.
restore(D, Text, agent(D, P, State)) :-
    catch(term_string(Term, Text), error(_, _), throw(error(golog(no_snapshot), _))),
    (   Term = golog_agent(1, P, Fluents), nonvar(P), is_list(Fluents), ground(Fluents)
    ->  true
    ;   throw(error(golog(no_snapshot), _))
    ),
    program_faults(P, D, Faults),
    ( Faults = [Fault | _] -> throw(error(golog(foreign_snapshot(Fault)), _)) ; true ),
    fluents_state(Fluents, State).
