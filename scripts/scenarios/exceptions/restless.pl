/*  scripts/evaluate exceptions puts this in the place of `main` of the shipped program: once an exhibit was explained, it begins and
    stops a drive without end. */
proc(main, prioritized([interrupt(some(E, (exhibit(E), explained(E))), turn_round), tour_guide])).
proc(turn_round, while(true, conc(drive(home), stop(drive(home))))).
