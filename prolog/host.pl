/*  What the robot calls (src/docent/task_control/golog): the agents of its programs by the names of their modules.
    The last argument of each predicate says what was wrong, "" for nothing; then nothing has changed. C++ defines
    travel/3 and order/3 here, the lengths of ways and the least-travel order of the program that is being asked. */
:- module(golog_host, [host_load/7, host_unload/1, host_step/7, host_outcome/4, host_snapshot/3, host_restore/3,
                       host_foresee/6, host_duration/3]).
:- use_module(library(apply)).
:- use_module(library(lists)).
:- use_module(situation).
:- use_module(golog).
:- use_module(agent).
:- use_module(program).
:- use_module(travel).

:- dynamic current_agent/2.
:- set_prolog_gc_thread(false).  % everything happens in the caller's thread

%!  host_load(+Domain, +Files, +Exhibits, +HasCharger, +Main, -Faults, -Fault) is det.
%   Main: the procedure to run instead of the files' own; '' for that one.
host_load(D, Files, Exhibits, HasCharger, Main, Faults, Fault) :-
    guarded(D, load(D, Files, Exhibits, HasCharger, Main, Faults), Fault).

load(D, Files, Exhibits, HasCharger, Main, Faults) :-
    Distances = (distance(From, To, Metres) :- golog_host:travel(From, To, Metres)),
    findall(Fact, ( Fact = Distances
                  ; member(E, Exhibits), Fact = exhibit(E)
                  ; HasCharger == true, Fact = has_charger
                  ; Main \== '', Fact = proc(main, Main) ), Facts),
    load_program(D, Files, Facts, Faults),
    ( Faults == [] -> start(D, Agent), set_agent(D, Agent) ; true ).

host_unload(D) :- retractall(current_agent(D, _)), unload_program(D).

%!  host_step(+Domain, +Now, +Events, +MostInferences, -Kind, -Action, -Fault) is det.
%   Kind: begin, stop, waits or finished; Action: [] for the last two.
host_step(D, Now, Events, Most, Kind, Action, Fault) :-
    guarded(D, next_step(D, Now, Events, Most, Result), Fault),
    ( nonvar(Result), Result =.. [Kind, Action] -> true ; Result = Kind, Action = [] ).

next_step(D, Now, Events, Most, Result) :-
    current_agent(D, Agent0),
    step(Agent0, Now, Events, Most, Result, Agent),
    set_agent(D, Agent).

%!  host_outcome(+Domain, +Action, +Outcome, -Fault) is det.
host_outcome(D, Action, Outcome, Fault) :-
    guarded(D, ( current_agent(D, Agent0), outcome(Agent0, Action, Outcome, Agent), set_agent(D, Agent) ), Fault).

%!  host_snapshot(+Domain, -Text, -Fault) is det.
host_snapshot(D, Text, Fault) :- guarded(D, ( current_agent(D, Agent), snapshot(Agent, Text) ), Fault).

%!  host_restore(+Domain, +Text, -Fault) is det.
host_restore(D, Text, Fault) :- guarded(D, ( restore(D, Text, Agent), set_agent(D, Agent) ), Fault).

%!  host_foresee(+Domain, +Most, +MostInferences, -Actions, -End, -Fault) is det.
host_foresee(D, Most, MostInferences, Actions, End, Fault) :-
    guarded(D, ( current_agent(D, Agent), foresee(Agent, Most, MostInferences, Actions, End) ), Fault).

%!  host_duration(+Domain, +Action, -Seconds) is semidet.
host_duration(D, Action, Seconds) :- current_agent(D, Agent), expected_duration(Agent, Action, Seconds).

set_agent(D, Agent) :- retractall(current_agent(D, _)), assertz(current_agent(D, Agent)).

guarded(D, Goal, Fault) :-
    catch(( Goal -> Fault = "" ; Fault = "there is no such program" ), E, fault_text(E, D, Fault)).
