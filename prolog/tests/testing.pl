%   What the tests share.
:- module(testing, [prolog_file/2, domain/3, museum/3, results/3, run_online/4, play/5, line_museum/1, grid_museum/2]).
:- use_module(library(lists)).
:- use_module(library(apply)).
:- use_module(library(readutil)).
:- use_module('../situation').
:- use_module('../golog').
:- use_module('../agent').
:- use_module('../program').

:- dynamic here/1.
:- prolog_load_context(directory, Here), assertz(here(Here)).

%!  prolog_file(+Name, -File) is det.
prolog_file(Name, File) :- here(Here), format(atom(File), "~w/../~w", [Here, Name]).

%!  domain(+Domain, +Clauses, -State) is det.
%   A domain of its own with its initial state.
domain(D, Clauses, State) :-
    unload_program(D),
    load_program(D, [], Clauses, Faults),
    Faults == [],
    initial_state(D, State).

%!  museum(+Domain, +Facts, +Main) is det.
%   The shipped museum with the tour guide's programs, of which Main runs.
museum(D, Facts, Main) :-
    unload_program(D),
    prolog_file('tour_guide.pl', Guide),
    prolog_file('museum.pl', Museum),
    load_program(D, [Guide, Museum], [proc(main, Main) | Facts], Faults),
    ( Faults == [] -> true ; print_message(error, format("~w", [Faults])), fail ).

%!  line_museum(-Facts) is det.
%   As in [Rhino1999] Figs. 21 and 22: exhibit 5 lies between 1 and 12.
line_museum(Facts) :-
    places_on([home-(0, 0), e1-(4, 0), e5-(9, 1), e12-(20, 0), charger-(-2, 0)], [e1, e5, e12], Facts).

%!  grid_museum(+Seed, -Facts) is det.
%   13 exhibits anywhere in 30 by 30 m.
grid_museum(Seed, Facts) :-
    set_random(seed(Seed)),
    numlist(1, 13, Numbers),
    findall(Name-(X, Y), ( member(N, Numbers), atom_concat(e, N, Name), random_between(0, 300, X0), random_between(0, 300, Y0),
                           X is X0 / 10.0, Y is Y0 / 10.0 ), Places),
    pairs_keys(Places, Exhibits),
    places_on([home-(0, 0), charger-(1, 0) | Places], Exhibits, Facts).

places_on(Places, Exhibits, Facts) :-
    findall(exhibit(E), member(E, Exhibits), Facts1),
    findall(distance(A, B, M),
            ( member(A-(X1, Y1), Places), member(B-(X2, Y2), Places), A \== B, M is sqrt((X1 - X2) ** 2 + (Y1 - Y2) ** 2) ),
            Facts2),
    append([[has_charger], Facts1, Facts2], Facts).

%!  results(+P, +Domain, -Set) is det.
%   The sorted set of all sequences of actions that P can be executed with off-line.
results(P, D, Set) :-
    initial_state(D, State),
    findall(Actions, ( do(P, imagined(State), S, D), actions_of(S, [], Actions) ), List),
    sort(List, Set).

actions_of(do(A, S), Later, Actions) :- !, actions_of(S, [A | Later], Actions).
actions_of(_, Actions, Actions).

%!  run_online(+Domain, +Events, -Actions, -End) is det.
%   All actions succeed at once.
run_online(D, Events, Actions, End) :-
    start(D, Agent0),
    play(Agent0, 0.0, Events, All, End-_),
    findall(A, member(begin(A), All), Actions).

%!  play(+Agent, +Now, +Events, -Results, -EndAndAgent) is det.
%   Steps until the agent waits or has finished; each action succeeds at once. Results: what the steps said before that.
play(Agent0, Now, Events, Results, End) :-
    step(Agent0, Now, Events, 1000000, Result, Agent1),
    (   memberchk(Result, [waits, finished])
    ->  Results = [], End = Result-Agent1
    ;   Results = [Result | More],
        ( Result = begin(A) -> outcome(Agent1, A, done, Agent2) ; Agent2 = Agent1 ),
        play(Agent2, Now, [], More, End)
    ).
