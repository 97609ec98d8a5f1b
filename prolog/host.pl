/*  A program in a process of its own, which the robot asks (src/docent/task_control/golog). Questions come in as terms
    on the standard input; answers go out on the standard output, as `say/1` writes them:

        [found, What]           the answer, see answer/4
        [fault, Text]           the program is faulty; nothing has changed
        [travel, From, To]      asked back: some(Metres) or none
        [order, From, Places]   asked back: some(Order), that with the least travel, or none */
:- module(golog_host, [serve/0]).
:- use_module(library(apply)).
:- use_module(library(lists)).
:- use_module(library(pairs)).
:- use_module(situation).
:- use_module(golog).
:- use_module(agent).
:- use_module(program).
:- use_module(travel).

:- dynamic way/3.  % place, place, metres or none; those from and to the robot's place last as long as one question

:- set_prolog_gc_thread(false).  % a program's steps depend on nothing but what they are given

%!  serve is det.
%   Answers until the line is closed.
serve :-
    take_line(In),
    nb_setval(golog_agent, none),
    repeat,
    hear(In, Question),
    (   Question == end_of_file
    ->  !, halt
    ;   reply(Question), fail
    ).

%   What a program itself reads is empty, and what it writes goes where errors go.
take_line(In) :-
    stream_property(In, file_no(0)),
    stream_property(Out, file_no(1)), !,
    forall(member(S, [In, Out]), ( set_stream(S, encoding(utf8)), set_stream(S, newline(posix)), set_stream(S, tty(false)) )),
    set_stream(Out, buffer(full)),
    nb_setval(golog_line, line(In, Out)),
    open('/dev/null', read, Empty),
    set_stream(Empty, alias(user_input)),
    set_stream(user_error, alias(user_output)),
    set_input(Empty),
    set_output(user_error).

hear(In, Term) :- read_term(In, Term, [module(golog_host), double_quotes(string)]).

reply(Question) :-
    retractall(way(somewhere, _, _)),
    retractall(way(_, somewhere, _)),
    nb_getval(golog_agent, Agent),
    catch(( answer(Question, Agent, NewAgent, Found)
          -> Said = [found, Found]
          ;  Said = [fault, "Prolog: a step fails"] ),
          E,
          ( fault_text(E, tour, Text), Said = [fault, Text] )),
    ( Said = [found, _] -> nb_setval(golog_agent, NewAgent) ; true ),
    say(Said).

%!  answer(+Question, +Agent, -NewAgent, -Found) is semidet.
%   Main: the procedure to run instead of the files' own; '' for that one. Found: the faults of the program; where there
%   are some, there is no agent.
answer(load(Files, Exhibits, HasCharger, Main), _, Agent, Faults) :-
    Distances = (distance(From, To, Metres) :- golog_host:travel(From, To, Metres)),
    findall(Fact, ( Fact = Distances
                  ; member(E, Exhibits), Fact = exhibit(E)
                  ; HasCharger == true, Fact = has_charger
                  ; Main \== '', Fact = proc(main, Main) ), Facts),
    load_program(tour, Files, Facts, Faults),
    ( Faults == [] -> start(tour, Agent) ; Agent = none ).
%   Found: begin or stop, and which action; waits or finished, and [].
answer(step(Now, Events, Most), Agent0, Agent, [Kind, Action]) :-
    step(Agent0, Now, Events, Most, Result, Agent),
    ( compound(Result) -> Result =.. [Kind, A], spoken(A, Action) ; Kind = Result, Action = [] ).
answer(outcome(Action, Outcome), Agent0, Agent, []) :- outcome(Agent0, Action, Outcome, Agent).
answer(begin_again, Agent0, Agent, []) :- begin_again(Agent0, Agent).
%   Of all actions of the domain, each name once, with the file and line of its first declaration.
answer(actions, Agent, Agent, [Names, Places]) :-
    findall(Name-Place, action_place(tour, Name, Place), Pairs),
    pairs_keys_values(Pairs, Names, Places).
answer(check_event(Event), Agent, Agent, []) :- check_event(Agent, Event).
answer(impossible, Agent, Agent, Actions) :-
    impossible_actions(Agent, Found),
    maplist(spoken, Found, Actions).
answer(snapshot, Agent, Agent, Text) :- snapshot(Agent, Text).
answer(restore(Text), _, Agent, []) :- restore(tour, Text, Agent).
answer(foresee(MostActions, Most), Agent, Agent, [Actions, End]) :-
    foresee(Agent, MostActions, Most, Found, End),
    maplist(spoken, Found, Actions).
%   [] where the domain says nothing.
answer(duration(Action), Agent, Agent, Found) :-
    ( expected_duration(Agent, Action, Seconds) -> Found = [Seconds] ; Found = [] ).

%   An action as the list of its name and its arguments; [] for an argument that is neither a name nor a number.
spoken(Action, [Name | Arguments]) :-
    Action =.. [Name | Given],
    maplist(spoken_argument, Given, Arguments).

spoken_argument(Given, Said) :- ( Given == [] -> Said = "[]" ; atomic(Given) -> Said = Given ; Said = [] ).

%!  travel(+From, +To, -Metres) is semidet.
%   Asked once: a search for the best order comes back to the same ways thousands of times.
travel(From, To, Metres) :-
    atomic(From), atomic(To),
    (   way(From, To, Known)
    ->  true
    ;   ( ask([travel, From, To], Known) -> true ; Known = none ),
        assertz(way(From, To, Known))
    ),
    number(Known),
    Metres = Known.

%!  order(+From, +Places, -Order) is semidet.
order(From, Places, Order) :-
    atomic(From), is_list(Places), maplist(atomic, Places),
    ask([order, From, Places], Order).

ask(Question, Answer) :-
    say(Question),
    nb_getval(golog_line, line(In, _)),
    hear(In, Heard),
    Heard = some(Answer).

%!  say(+Value) is det.
%   A text, a number, or a list of such: s5:hello n2.5; l2:s1:an3;
say(Value) :-
    nb_getval(golog_line, line(_, Out)),
    say(Value, Out),
    flush_output(Out).

say(Value, Out) :- is_list(Value), !, length(Value, N), format(Out, "l~d:", [N]), forall(member(V, Value), say(V, Out)).
say(Value, Out) :- number(Value), !, F is float(Value), format(Out, "n~w;", [F]).
say(Value, Out) :- format(string(Text), "~w", [Value]), string_length(Text, N), format(Out, "s~d:~w", [N, Text]).
