/*  The tour guide's program. A museum that wants another one has a copy of this file as tour.pl in its folder, with
    whatever it changes; museum.pl says what it can speak of, docs/golog.md how to write, check and try it. */

proc(main, tour_guide).

% Serves whoever waits, the nearest first, and chooses anew after each exhibit; charges when the battery is low, finds
% itself when it is lost, and goes home when nobody wants anything. Ends at home when the museum closes.
proc(tour_guide,
     [ prioritized([ interrupt(lost, find_oneself),
                     interrupt((critical_battery, must_charge), [stop_all, recharge]),
                     interrupt((must_charge ; some(E, due(E))), next_task),
                     interrupt((\+ robot_location(home), may_try(home)), goto(home)),
                     ?(closing) ]),
       goto(home) ]).

proc(next_task, if(must_charge, recharge, pi(E, [?(next(E)), serve(E)]))).

% [Rhino1999] Table 4: serves all pending requests and returns home.
proc(internet_tourguide,
     [ while(some(Exhibit, (request(Exhibit), next(Exhibit))),
             pi(Exhibit, [?((request(Exhibit), next(Exhibit))), goto(Exhibit), explain(Exhibit)])),
       goto(home) ]).

% The same order of visits by the prover alone: the way through all requests with the least travel.
proc(planned_tourguide,
     [ search(while(some(E, request(E)), pi(E, [?(request(E)), goto(E), explain(E)])), least(travelled(_))),
       goto(home) ]).
