/*  scripts/evaluate exceptions puts this in the place of `main` of the shipped program: once an exhibit was explained, a condition
    never comes to an end. */
proc(main, prioritized([interrupt(some(E, (exhibit(E), explained(E), endless)), []), tour_guide])).
endless :- endless.
