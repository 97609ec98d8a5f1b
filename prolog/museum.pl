/*  The domain of a tour guide: what is true in a museum, what the robot can do there and what may happen to it. Read
    into the module of each program (program.pl), behind the museum's own tour.pl: whatever predicate that file
    defines itself is taken from there, and what it says of actions, events and fluents is added to this.

    The caller says what is where: exhibit(E), has_charger, and distance(From, To, Metres) between exhibits, `home`,
    `charger` and `somewhere`, the robot's place on its way. */
:- dynamic exhibit/1, distance/3, has_charger/0.

place(home).
place(charger).
place(E) :- exhibit(E).

/*  What an integrator may change, by saying it in tour.pl. */
low_charge(0.2).        % 0..1: the robot charges when it has served the present exhibit
critical_charge(0.1).   % 0..1: it breaks off and goes
retry_after(45).        % [s] after which it tries again to reach a place; visitors whose exhibit comes after it wait meanwhile
answer_within(5).       % [s] for "more" or "next"; the fast version follows [Rhino1999] 5.1
speed(0.35).            % [m/s] expected on the way, for the times of `docent golog trace`
talk(30).               % [s] expected of an explanation, likewise

/*  Fluents. */
fluent(request(_)).              % somebody waits for the exhibit
fluent(explained(_)).            % it was explained since it was last asked for
fluent(lost).                    % the robot does not know where it is
fluent(blocked).                 % people stand in its way
fluent(closing).                 % the museum closes: no more visits
functional(robot_location(_)).   % a place, or somewhere
functional(charge(_)).           % 0..1; unknown until the battery speaks
functional(choice(_)).           % more or next, what the visitor has answered to the last question
functional(failed_at(_, _)).     % the time [s] when the place could last not be reached or explained
functional(travelled(_)).        % [m] in all

initially(robot_location(home)).
initially(travelled(0.0)).

derived(due(E), (request(E), may_try(E))).
derived(may_try(L), \+ (failed_at(L, T), time(Now), retry_after(S), Now < T + S)).
derived(next(E), (set(X, due(X), Xs), Xs = [_ | _], robot_location(Here), schedule(Here, Xs, [E | _]))).
derived(further(L, M), (travelled(M0), robot_location(Here), way(Here, L, W), M is M0 + W)).
derived(low_battery, (charge(C), low_charge(Low), C < Low)).
derived(critical_battery, (charge(C), critical_charge(Low), C < Low)).
derived(must_charge, (has_charger, low_battery, may_try(charger))).

/*  Actions. What takes time has begun with begin(A), and ends as A, failed(A) or stopped(A). */
action(drive(_)).          % to a place
action(explain(_)).        % the exhibit before it, the short text
action(explain_more(_)).   % the long text
action(ask_more(_)).       % "more or next?"; senses the choice
action(wait_for_request).  % invites visitors
action(ask_for_way).       % says that people block it
action(relocalize).        % looks for its place
action(charge_battery).    % until it is charged

poss(drive(L), (place(L), \+ lost)).
poss(explain(E), (exhibit(E), robot_location(E))).
poss(explain_more(E), (exhibit(E), robot_location(E))).
poss(ask_more(E), (exhibit(E), robot_location(E))).
poss(wait_for_request, true).
poss(ask_for_way, blocked).
poss(relocalize, lost).
poss(charge_battery, robot_location(charger)).

expects(drive(L), place(L)).
expects(goto(L), place(L)).
expects(serve(E), exhibit(E)).
expects(explain(E), exhibit(E)).
expects(request(E), exhibit(E)).
expects(due(E), exhibit(E)).
expects(robot_location(L), (place(L) ; L == somewhere)).

causes_true(begin(drive(_)), robot_location(somewhere), true).
causes_true(drive(L), robot_location(L), true).
causes_true(begin(drive(L)), travelled(M), further(L, M)).
causes_true(drive(L), travelled(M), (\+ robot_location(somewhere), further(L, M))).
causes_false(drive(L), failed_at(L, T), failed_at(L, T)).
causes_true(failed(drive(L)), failed_at(L, Now), time(Now)).
causes_true(explain(E), explained(E), true).
causes_false(explain(E), request(E), true).
causes_true(failed(explain(E)), failed_at(E, Now), time(Now)).
causes_false(begin(ask_more(_)), choice(C), choice(C)).
causes_true(sensed(ask_more(_), C), choice(C), true).
causes_false(relocalize, lost, true).
causes_true(charge_battery, charge(1.0), true).
causes_true(failed(charge_battery), robot_location(somewhere), true).  % it does not stand where it is charged

duration(drive(L), T, (robot_location(Here), way(Here, L, W), speed(V), T is W / V)).
duration(explain(_), T, talk(T)).
duration(explain_more(_), T, talk(T)).
duration(ask_more(_), 10, true).
duration(wait_for_request, 60, true).
duration(ask_for_way, 3, true).
duration(relocalize, 20, true).
duration(charge_battery, 3600, true).

way(L, L, 0.0) :- !.
way(From, To, Metres) :- distance(From, To, Metres), !.
way(_, _, 0.0).

/*  Events. */
exogenous(requested(E)) :- exhibit(E).
exogenous(cancelled(_)).
exogenous(battery(_)).          % charge 0..1
exogenous(lost).
exogenous(localized).
exogenous(way_blocked).
exogenous(way_free).
exogenous(closing).
exogenous(opening).

causes_true(requested(E), request(E), true).
causes_false(requested(E), explained(E), true).
causes_false(cancelled(E), request(E), true).
causes_true(battery(C), charge(C), true).
causes_true(lost, lost, true).
causes_true(lost, robot_location(somewhere), true).
causes_false(localized, lost, true).
causes_true(way_blocked, blocked, true).
causes_false(way_free, blocked, true).
causes_true(closing, closing, true).
causes_false(opening, closing, true).

/*  Procedures that tours share. */

% [Rhino1999] Table 4; a drive under way to another place is stopped.
proc(goto(Loc),
     [ stop_driving(Loc),
       if(some(Here, (robot_location(Here), Here \= Loc)), drive(Loc), []) ]).

proc(stop_driving(Loc),
     while(some(L, (under_way(drive(L)), L \= Loc)),
           pi(L, [?((under_way(drive(L)), L \= Loc)), stop(drive(L))]))).

proc(stop_all, while(some(A, under_way(A)), pi(A, [?(under_way(A)), stop(A)]))).

/*  An action is impossible where the robot is not, so that what comes after a drive or a question looks whether it still
    is there: a program that waits for something impossible waits for ever. The else is ?(true), a step: with [] the
    choice would not be made yet, and would fall on the other side as soon as the robot came there by another way. */

% Explains the exhibit, if the robot got there, and offers more.
proc(serve(E), [goto(E), if(robot_location(E), [explain(E), offer_more(E)], ?(true))]).

% Nobody is asked while others wait.
proc(offer_more(E),
     if((robot_location(E), explained(E), \+ due(_)),
        [ pi(T, [?(answer_within(T)), within(T, ask_more(E))]),
          if((robot_location(E), choice(more)), explain_more(E), ?(true)) ],
        ?(true))).

proc(recharge, [goto(charger), if(robot_location(charger), charge_battery, ?(true))]).
proc(find_oneself, [stop_all, relocalize]).
