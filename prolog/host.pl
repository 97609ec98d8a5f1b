/*  What the robot calls (src/docent/task_control/golog), which keeps the agents. The last argument of each predicate
    says what was wrong, "" for nothing; otherwise the new agent stays unbound. C++ defines travel/3 and order/3 here,
    the lengths of ways and the least-travel order of the program that is being asked. */
:- module(golog_host, [host_load/8, host_unload/1, host_step/8, host_outcome/5, host_snapshot/3, host_restore/4,
                       host_begin_again/3, host_actions/4, host_check_event/3,
                       host_impossible/3, host_foresee/6, host_duration/3]).
:- use_module(library(lists)).
:- use_module(library(pairs)).
:- use_module(situation).
:- use_module(golog).
:- use_module(agent).
:- use_module(program).
:- use_module(travel).

:- set_prolog_gc_thread(false).  % everything happens in the caller's thread

%!  host_load(+Domain, +Files, +Exhibits, +HasCharger, +Main, -Agent, -Faults, -Fault) is det.
%   Main: the procedure to run instead of the files' own; '' for that one. Faults: of the program; then there is no agent.
host_load(D, Files, Exhibits, HasCharger, Main, Agent, Faults, Fault) :-
    guarded(D, load(D, Files, Exhibits, HasCharger, Main, Agent, Faults), Fault).

load(D, Files, Exhibits, HasCharger, Main, Agent, Faults) :-
    Distances = (distance(From, To, Metres) :- golog_host:travel(From, To, Metres)),
    findall(Fact, ( Fact = Distances
                  ; member(E, Exhibits), Fact = exhibit(E)
                  ; HasCharger == true, Fact = has_charger
                  ; Main \== '', Fact = proc(main, Main) ), Facts),
    load_program(D, Files, Facts, Faults),
    ( Faults == [] -> start(D, Agent) ; true ).

host_unload(D) :- unload_program(D).

%!  host_step(+Agent, +Now, +Events, +MostInferences, -Kind, -Action, -NewAgent, -Fault) is det.
%   Kind: begin, stop, waits or finished; Action: [] for the last two.
host_step(Agent, Now, Events, Most, Kind, Action, NewAgent, Fault) :-
    guarded(Agent, step(Agent, Now, Events, Most, Result, NewAgent), Fault),
    ( compound(Result) -> Result =.. [Kind, Action] ; Kind = Result, Action = [] ).

%!  host_outcome(+Agent, +Action, +Outcome, -NewAgent, -Fault) is det.
host_outcome(Agent, Action, Outcome, NewAgent, Fault) :-
    guarded(Agent, outcome(Agent, Action, Outcome, NewAgent), Fault).

%!  host_begin_again(+Agent, -NewAgent, -Fault) is det.
host_begin_again(Agent, NewAgent, Fault) :- guarded(Agent, begin_again(Agent, NewAgent), Fault).

%!  host_actions(+Agent, -Names, -Places, -Fault) is det.
%   Of all actions of the domain, as strings, each name once, with the file and line of its first declaration.
host_actions(Agent, Names, Places, Fault) :- guarded(Agent, actions(Agent, Names, Places), Fault).

actions(agent(D, _, _), Names, Places) :-
    findall(Name-Place, action_place(D, Name, Place), Pairs),
    pairs_keys_values(Pairs, Names, Places).

%!  host_check_event(+Agent, +Event, -Fault) is det.
host_check_event(Agent, Event, Fault) :- guarded(Agent, check_event(Agent, Event), Fault).

%!  host_impossible(+Agent, -Actions, -Fault) is det.
host_impossible(Agent, Actions, Fault) :- guarded(Agent, impossible_actions(Agent, Actions), Fault).

%!  host_snapshot(+Agent, -Text, -Fault) is det.
host_snapshot(Agent, Text, Fault) :- guarded(Agent, snapshot(Agent, Text), Fault).

%!  host_restore(+Agent, +Text, -NewAgent, -Fault) is det.
host_restore(Agent, Text, NewAgent, Fault) :-
    Agent = agent(D, _, _),
    guarded(Agent, restore(D, Text, NewAgent), Fault).

%!  host_foresee(+Agent, +Most, +MostInferences, -Actions, -End, -Fault) is det.
host_foresee(Agent, Most, MostInferences, Actions, End, Fault) :-
    guarded(Agent, foresee(Agent, Most, MostInferences, Actions, End), Fault).

%!  host_duration(+Agent, +Action, -Seconds) is semidet.
host_duration(Agent, Action, Seconds) :- expected_duration(Agent, Action, Seconds).

guarded(Whose, Goal, Fault) :-
    ( Whose = agent(D, _, _) -> true ; D = Whose ),
    catch(( Goal -> Fault = "" ; Fault = "Prolog: a step fails" ), E, fault_text(E, D, Fault)).
