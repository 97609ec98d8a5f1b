/*  The constructs of programs and what they mean: GOLOG [Rhino1999] 4.3 with concurrency and interrupts (ConGolog),
    search and time-outs (IndiGolog). Programs are terms:

        []                      nothing
        [P, Q, ...]             one after the other
        drive(e1)               an action of the domain, or
        goto(e1)                a procedure: the first clause proc(Head, P) that fits
        ?(C)                    test: waits until C holds. Of all conditions only this one binds variables, those of pi
        ndet(P, Q)              one of the two
        pi(X, P)                P for some X; a list of variables is allowed
        if(C, P, Q), while(C, P)
        star(P)                 P any number of times
        conc(P, Q)              both, interleaved
        iconc(P)                any number of P at once
        prioritized([P, Q, ..]) Q goes on only where P waits, and has no action under way, and so on
        interrupt(C, P)         P whenever C holds, as long as something runs beside it; ends when that ends
        interrupt(X, C, P)      P for an X for which C holds
        within(T, P, Q)         P; where it has not ended after T seconds its actions are stopped and Q follows
        within(T, P)            the same with nothing to follow
        stop(A)                 ends the action A that is under way; nothing where it is not
        search(P)               the first way through P that reaches its end
        search(P, least(F))     the way through P at whose end the functional fluent F, such as travelled(M), is least.
                                F must never fall on the way

    trans(P, S, P1, S1, D) makes one step of P in the situation S of the domain D and leaves P1; final(P, S, D) says that P
    may end there. In an imagined situation an action is done at once: S1 = do(A, S). In now(State) it begins,
    S1 = do(begin(A), S), and P1 waits until the situation says that it is no longer under way; agent.pl is told so.

    A procedure's body stands as in(Name, P), so that faults name it.
*/
:- module(golog, [trans/5, final/3, do/4, plan/4, plan/5, actions_under_way/4, wanted_action/4]).
:- use_module(library(apply)).
:- use_module(library(lists)).
:- use_module(situation).

%!  trans(+P, +S, -P1, -S1, +D) is nondet.
trans(P, _, _, _, _) :- var(P), !, throw(error(instantiation_error, _)).
trans([P | Ps], S, R, S1, D) :- trans(P, S, P1, S1, D), sequence(P1, Ps, R).
trans([P | Ps], S, R, S1, D) :- !, Ps \== [], final(P, S, D), trans(Ps, S, R, S1, D).
trans([], _, _, _, _) :- !, fail.
trans(?(C), S, R, S1, D) :- !, holds(C, S, D), R = [], S1 = S.
trans(ndet(P, Q), S, R, S1, D) :- !, ( trans(P, S, R, S1, D) ; trans(Q, S, R, S1, D) ).
trans(pi(X, P), S, R, S1, D) :- !, fresh(X, P, _, P1), trans(P1, S, R, S1, D).
trans(if(C, P, Q), S, R, S1, D) :- !,
    ( \+ \+ holds(C, S, D) -> trans(P, S, R, S1, D) ; trans(Q, S, R, S1, D) ).
trans(while(C, P), S, R, S1, D) :- !,
    \+ \+ holds(C, S, D),
    trans(P, S, P1, S1, D),
    sequence(P1, [while(C, P)], R).
trans(star(P), S, R, S1, D) :- !, trans(P, S, P1, S1, D), sequence(P1, [star(P)], R).
trans(conc(P, Q), S, R, S1, D) :- !,
    (   trans(P, S, P1, S1, D), R = conc(P1, Q)
    ;   trans(Q, S, Q1, S1, D), R = conc(P, Q1)
    ).
trans(iconc(P), S, R, S1, D) :- !, trans(P, S, P1, S1, D), R = conc(P1, iconc(P)).
trans(prioritized([P]), S, R, S1, D) :- !, trans(P, S, R, S1, D).
trans(prioritized([P | Ps]), S, R, S1, D) :- !,
    (   trans(P, S, P1, S1, D)
    *-> R = prioritized([P1 | Ps])
    ;   \+ actions_under_way(P, S, D, [_ | _]),
        trans(prioritized(Ps), S, Rest, S1, D),
        ( Rest = prioritized(Qs) -> R = prioritized([P | Qs]) ; R = prioritized([P, Rest]) )
    ).
trans(interrupt(C, P), S, R, S1, D) :- !,
    \+ \+ holds(C, S, D),
    trans(P, S, P1, S1, D),
    sequence(P1, [interrupt(C, P)], R).
trans(interrupt(X, C, P), S, R, S1, D) :- !,
    fresh(X, C-P, _, C1-P1),
    holds(C1, S, D),
    trans(P1, S, P2, S1, D),
    sequence(P2, [interrupt(X, C, P)], R).
trans(within(T, P), S, R, S1, D) :- !, trans(within(T, P, []), S, R, S1, D).
trans(within(T, P, Q), S, R, S1, D) :- !, holds(time(Now), S, D), Deadline is Now + T, R = until(Deadline, P, Q), S1 = S.
trans(until(Deadline, P, Q), S, R, S1, D) :- !,
    (   is_over(Deadline, S, D), \+ final(P, S, D)
    ->  given_up(P, Q, S, D, Q1), trans(Q1, S, R, S1, D)
    ;   trans(P, S, P1, S1, D), R = until(Deadline, P1, Q)
    ).
trans(under_way(_), _, _, _, _) :- !, fail.
trans(stop(A), S, R, S1, D) :- !, holds(under_way(A), S, D), R = [], S1 = do(stop(A), S).
trans(search(P), S, R, S1, D) :- !, search_step(P, any, S, R, S1, D).
trans(search(P, least(F)), S, R, S1, D) :- !, search_step(P, least(F), S, R, S1, D).
trans(following(Path, News, P, Aim), S, R, S1, D) :- !, follow(Path, News, P, Aim, S, R, S1, D).
trans(in(Name, P), S, R, S1, D) :- !,
    nb_setval(golog_procedure, Name),
    catch(trans(P, S, P1, S1, D), error(E, Context), throw_in(Name, E, Context)),
    inside(Name, P1, R).
trans(A, S, R, S1, D) :- \+ \+ D:action(A), !,
    possible(A, S, D),
    begin(S, A, R, S1, D).
trans(Call, S, R, S1, D) :- body(Call, Name, Body, D), trans(in(Name, Body), S, R, S1, D).

begin(S, A, R, S1, D) :-
    ( ground(A) -> true ; throw(error(golog(open_action(A)), _)) ),
    (   S = now(_)
    ->  \+ holds(under_way(A), S, D), R = under_way(A), S1 = do(begin(A), S)
    ;   R = [], S1 = do(A, S)
    ).

%!  final(+P, +S, +D) is semidet.
final(P, S, D) :- final_(P, S, D), !.

final_(P, _, _) :- var(P), !, throw(error(instantiation_error, _)).
final_([], _, _) :- !.
final_([P | Ps], S, D) :- !, final_(P, S, D), final_(Ps, S, D).
final_(?(_), _, _) :- !, fail.
final_(ndet(P, Q), S, D) :- !, ( final_(P, S, D) ; final_(Q, S, D) ).
final_(pi(X, P), S, D) :- !, fresh(X, P, _, P1), final_(P1, S, D).
final_(if(C, P, Q), S, D) :- !, ( \+ \+ holds(C, S, D) -> final_(P, S, D) ; final_(Q, S, D) ).
final_(while(C, P), S, D) :- !, ( \+ \+ holds(C, S, D) -> final_(P, S, D) ; true ).
final_(star(_), _, _) :- !.
final_(conc(P, Q), S, D) :- !, final_(P, S, D), final_(Q, S, D).
final_(iconc(_), _, _) :- !.
final_(prioritized(Ps), S, D) :- !, final_(Ps, S, D).
final_(interrupt(_, _), _, _) :- !.
final_(interrupt(_, _, _), _, _) :- !.
final_(within(_, P), S, D) :- !, final_(P, S, D).
final_(within(_, P, _), S, D) :- !, final_(P, S, D).
final_(until(Deadline, P, Q), S, D) :- !,
    (   final_(P, S, D)
    ->  true
    ;   is_over(Deadline, S, D), given_up(P, Q, S, D, Q1), final_(Q1, S, D)
    ).
final_(under_way(A), S, D) :- !, \+ holds(under_way(A), S, D).
final_(stop(A), S, D) :- !, \+ holds(under_way(A), S, D).
final_(search(P), S, D) :- !, final_(P, S, D).
final_(search(P, _), S, D) :- !, final_(P, S, D).
final_(following(_, _, P, _), S, D) :- !, final_(P, S, D).
final_(in(_, P), S, D) :- !, final_(P, S, D).
final_(A, _, D) :- \+ \+ D:action(A), !, fail.
final_(Call, S, D) :- body(Call, _, Body, D), final_(Body, S, D).

%!  do(+P, +S, -S1, +D) is nondet.
%   The whole of P leads from S to S1 [Rhino1999] Table 4. By regression alone: S1 = do(An, ... do(A1, S)).
do(P, S, S, D) :- final(P, S, D).
do(P, S, S2, D) :- trans(P, S, P1, S1, D), do(P1, S1, S2, D).

% What is left of a sequence after a step of its first program.
sequence([], Ps, R) :- !, ( Ps = [P] -> R = P ; R = Ps ).
sequence(P, [], P) :- !.
sequence(P, Ps, [P | Ps]).

% A procedure that ends with a call does not grow.
inside(_, [], []) :- !.
inside(_, in(Name, P), in(Name, P)) :- !.
inside(Name, P, in(Name, P)).

body(Call, Name/Arity, Body, D) :-
    (   D:proc(Call, Found)
    ->  Body = Found, functor(Call, Name, Arity)
    ;   throw(error(golog(unknown(Call)), _))
    ).

% The innermost procedure names the fault.
throw_in(Name, E, Context) :-
    ( nonvar(Context), Context = in(_, _) -> throw(error(E, Context)) ; throw(error(E, in(Name, Context))) ).

is_over(Deadline, S, D) :- holds(time(Now), S, D), Now >= Deadline.

given_up(P, Q, S, D, Q1) :-
    actions_under_way(P, S, D, Actions),
    findall(stop(A), member(A, Actions), Stops),
    append(Stops, [Q], Q1).

%!  actions_under_way(+P, +S, +D, -Actions) is det.
%   The actions of P that have begun and not ended.
actions_under_way(P, S, D, Actions) :-
    (   S = now(_), holds(under_way(_), S, D)
    ->  findall(A, ( awaited(P, A), holds(under_way(A), S, D) ), Found), sort(Found, Actions)
    ;   Actions = []
    ).

awaited(P, _) :- var(P), !, fail.
awaited(under_way(A), A) :- !.
awaited([P | Ps], A) :- !, ( awaited(P, A) ; member(Q, Ps), awaited(Q, A) ).
awaited(conc(P, Q), A) :- !, ( awaited(P, A) ; awaited(Q, A) ).
awaited(prioritized(Ps), A) :- !, member(P, Ps), awaited(P, A).
awaited(until(_, P, _), A) :- !, awaited(P, A).
awaited(in(_, P), A) :- !, awaited(P, A).
awaited(following(_, _, P, _), A) :- awaited(P, A).

%!  wanted_action(+P, +S, +D, -A) is nondet.
%   The actions without variables that P begins with in S, possible or not.
wanted_action(P, _, _, _) :- var(P), !, fail.
wanted_action([P | Ps], S, D, A) :- !, ( wanted_action(P, S, D, A) ; final(P, S, D), wanted_action(Ps, S, D, A) ).
wanted_action(ndet(P, Q), S, D, A) :- !, ( wanted_action(P, S, D, A) ; wanted_action(Q, S, D, A) ).
wanted_action(conc(P, Q), S, D, A) :- !, ( wanted_action(P, S, D, A) ; wanted_action(Q, S, D, A) ).
wanted_action(prioritized(Ps), S, D, A) :- !, member(P, Ps), wanted_action(P, S, D, A).
wanted_action(if(C, P, Q), S, D, A) :- !,
    ( \+ \+ holds(C, S, D) -> wanted_action(P, S, D, A) ; wanted_action(Q, S, D, A) ).
wanted_action(while(C, P), S, D, A) :- !, \+ \+ holds(C, S, D), wanted_action(P, S, D, A).
wanted_action(interrupt(C, P), S, D, A) :- !, \+ \+ holds(C, S, D), wanted_action(P, S, D, A).
wanted_action(interrupt(X, C, P), S, D, A) :- !,
    fresh(X, C-P, _, C1-P1),
    holds(C1, S, D),
    wanted_action(P1, S, D, A).
wanted_action(within(_, P), S, D, A) :- !, wanted_action(P, S, D, A).
wanted_action(within(_, P, _), S, D, A) :- !, wanted_action(P, S, D, A).
wanted_action(until(_, P, _), S, D, A) :- !, wanted_action(P, S, D, A).
wanted_action(in(_, P), S, D, A) :- !, wanted_action(P, S, D, A).
wanted_action(A, _, D, A) :- ground(A), \+ \+ D:action(A), !.
wanted_action(Call, S, D, A) :- \+ \+ D:proc(Call, _), !, body(Call, _, P, D), wanted_action(P, S, D, A).

/*  Search. Actions under way are imagined done. The way found is followed as long as nothing happens that it did not
    foresee (the fluent news(N), which agent.pl counts up); then it is searched again from what is left of the program. */
search_step(P, Aim, S, R, S1, D) :-
    imagine(P, S, D, State),
    way(Aim, P, State, Path, D),
    news(S, D, News),
    first_step(Path, News, Aim, S, R, S1, D).

follow(Path, News, P, Aim, S, R, S1, D) :-
    (   \+ \+ news(S, D, News), first_step(Path, News, Aim, S, R0, S0, D)
    ->  R = R0, S1 = S0
    ;   search_step(P, Aim, S, R, S1, D)
    ).

first_step([step(P1, silent) | Path], News, Aim, S, following(Path, News, P1, Aim), S, _).
first_step([step(P1, action(A)) | Path], News, Aim, S, R, S1, D) :-
    trans(A, S, Rest, S1, D),
    sequence(Rest, [following(Path, News, P1, Aim)], R).

news(S, D, N) :- ( S = now(_) -> holds(news(N), S, D) ; N = 0 ).

imagine(P, S, D, State) :-
    base(S, D, Base),
    actions_under_way(P, S, D, Actions),
    foldl(finish(D), Actions, Base, State).

finish(D, A, State0, State) :- progress(ended(A), State0, D, State1), progress(A, State1, D, State).

base(do(A, S), D, State) :- !, base(S, D, State0), progress(A, State0, D, State).
base(S, _, State) :- base_state(S, State).

way(any, P, State, Path, D) :- path(P, State, D, Path).
way(least(F), P, State, Path, D) :- least_path(P, F, State, D, Path).

path(P, State, D, []) :- final(P, imagined(State), D).
path(P, State, D, [step(P1, Step) | Path]) :-
    step(P, State, P1, Step, State1, D),
    path(P1, State1, D, Path).

step(P, State, P1, Step, State1, D) :-
    trans(P, imagined(State), P1, S1, D),
    (   S1 = do(A, _)
    ->  Step = action(A), progress(A, State, D, State1)
    ;   Step = silent, State1 = State
    ).

% Branch and bound: a way that costs no less than the best so far is left.
least_path(P, F, State, D, Path) :-
    Best = best(1.0e100, none),
    forall(bounded_path(P, F, State, D, Best, Found), nb_setarg(2, Best, Found)),
    arg(2, Best, Path),
    Path \== none.

bounded_path(P, F, State, D, Best, []) :-
    final(P, imagined(State), D),
    is_better(F, State, D, Best, Cost),
    nb_setarg(1, Best, Cost).
bounded_path(P, F, State, D, Best, [step(P1, Step) | Path]) :-
    step(P, State, P1, Step, State1, D),
    is_better(F, State1, D, Best, _),
    bounded_path(P1, F, State1, D, Best, Path).

is_better(F, State, D, best(Least, _), Cost) :-
    copy_term(F, F1),
    holds(F1, imagined(State), D), !,
    functor(F1, _, Arity),
    arg(Arity, F1, Cost),
    Cost < Least.

%!  plan(+P, +State, -Actions, +D) is nondet.
%   The actions of a way through P, as search/1 finds them.
plan(P, State, Actions, D) :- path(P, State, D, Path), path_actions(Path, Actions).

%!  plan(+P, +LeastFluent, +State, -Actions, +D) is semidet.
%   The actions of the best way, as search/2 finds it.
plan(P, F, State, Actions, D) :- least_path(P, F, State, D, Path), path_actions(Path, Actions).

path_actions(Path, Actions) :- findall(A, member(step(_, action(A)), Path), Actions).
