/*  The order of exhibits with the least travel [Rhino1999] 4.3. Up to six the prover finds it alone, by branch and
    bound. Of more it comes from the scheduler of the robot where Prolog is part of it (golog_host:order/3, which C++
    defines), else from the nearest neighbour, improved by reversing and moving stretches until nothing gets shorter.
    The domain says distance(From, To, Metres); what has no distance is as good as out of reach. */
:- module(travel, [schedule/3, order_length/3, exact_order/3, improved_order/3]).
:- use_module(library(apply)).
:- use_module(library(lists)).

:- meta_predicate schedule(:, +, -), order_length(:, +, -), exact_order(:, +, -), improved_order(:, +, -).

most_proved(6).
no_way(1.0e6).      % [m]; this and the next are those of the scheduler (route.cpp: kNoWay, kGain)
least_gain(1.0e-9). % [m]

%!  schedule(+From, +Exhibits, -Order) is det.
%   The way back is not counted.
schedule(D:From, Exhibits, Order) :-
    length(Exhibits, Count),
    most_proved(Most),
    (   Count =< Most
    ->  exact_order(D:From, Exhibits, Order)
    ;   current_predicate(golog_host:order/3)
    ->  golog_host:order(From, Exhibits, Order)
    ;   improved_order(D:From, Exhibits, Order)
    ).

%!  order_length(+From, +Order, -Metres) is det.
order_length(D:From, Order, Metres) :- way_length(Order, From, D, 0.0, Metres).

way_length([], _, _, Metres, Metres).
way_length([To | More], From, D, Metres0, Metres) :-
    step_length(D, From, To, Step),
    Metres1 is Metres0 + Step,
    way_length(More, To, D, Metres1, Metres).

step_length(D, From, To, Metres) :-
    no_way(NoWay),
    (   From == To
    ->  Metres = 0.0
    ;   catch(D:distance(From, To, Known), error(existence_error(_, _), _), fail)
    ->  Metres is min(Known, NoWay)
    ;   Metres = NoWay
    ).

%!  exact_order(+From, +Exhibits, -Order) is det.
%   The first of the shortest orders, as the list has them. O(n!) without the bound.
exact_order(D:From, Exhibits, Order) :-
    Best = best(1.0e100, Exhibits),
    forall(bounded_order(Exhibits, From, D, 0.0, Best, Found, Metres),
           ( nb_setarg(1, Best, Metres), nb_setarg(2, Best, Found) )),
    arg(2, Best, Order).

bounded_order([], _, _, Metres, _, [], Metres).
bounded_order(Left, From, D, Metres0, Best, [To | Order], Metres) :-
    select(To, Left, Rest),
    step_length(D, From, To, Step),
    Metres1 is Metres0 + Step,
    least_gain(Gain),
    arg(1, Best, Least),
    Metres1 < Least - Gain,
    bounded_order(Rest, To, D, Metres1, Best, Order, Metres).

%!  improved_order(+From, +Exhibits, -Order) is det.
improved_order(D:From, Exhibits, Order) :-
    nearest_first(Exhibits, From, D, First),
    order_length(D:From, First, Metres),
    improve(First, Metres, From, D, Order).

nearest_first([], _, _, []).
nearest_first(Left, From, D, [Nearest | Order]) :-
    Left = [First | Others],
    step_length(D, From, First, Metres),
    foldl(nearer(D, From), Others, Metres-First, _-Nearest),
    selectchk(Nearest, Left, Rest),
    nearest_first(Rest, Nearest, D, Order).

nearer(D, From, To, Metres-Best, Least) :-
    step_length(D, From, To, Step),
    ( Step < Metres -> Least = Step-To ; Least = Metres-Best ).

improve(Order0, Metres0, From, D, Order) :-
    least_gain(Gain),
    (   changed(Order0, Order1),
        order_length(D:From, Order1, Metres1),
        Metres1 < Metres0 - Gain
    ->  improve(Order1, Metres1, From, D, Order)
    ;   Order = Order0
    ).

% One stretch reversed, or its first moved behind it.
changed(Order, Changed) :-
    append(Front, Rest, Order),
    append(Stretch, Back, Rest),
    Stretch = [First | More],
    More = [_ | _],
    (   reverse(Stretch, New)
    ;   append(More, [First], New)
    ),
    append([Front, New, Back], Changed).
