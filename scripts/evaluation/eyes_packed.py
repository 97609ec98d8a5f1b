"""Robots that begin at an unknown place of a packed hall, amid people who hide every wall: with a ceiling that was mapped while the hall was empty, and by
lasers alone."""
from evaluation import lost
from evaluation.low_things import upper
from evaluation.tables import print_table

HALL, PICTURES = "smithsonian", 2400
FIRST_SEED = 4723
RUNS, MINUTES = 60, 3.0
WITHIN = 60.0  # [s]
CROWD = ["--crowd", "packed", "--requests-per-hour", "60"]


def mapped(bench):
    """The ceiling as a drive through the empty hall showed it."""
    made = bench.folder / f"{HALL}-whole.yaml"
    if not made.exists():
        drive = bench.drive(HALL, "whole", 1, PICTURES, [])
        bench.run(bench.docent, "map-ceiling", drive, "--out", made)
    return made


def part(bench, simulations, options, verdict):
    count = options.seeds or (1 if options.slice else RUNS)
    minutes = options.minutes or MINUTES
    seeds = range(FIRST_SEED + options.first_seed - 1, FIRST_SEED + options.first_seed - 1 + count)
    robots = {"with the ceiling": ["--set", "ceiling.enabled=true", "--set", f"ceiling.mosaic={mapped(bench)}"], "lasers alone": []}
    rows = []
    for robot, more in robots.items():
        found, never, in_time, wrong, served, offered = [], 0, 0, 0.0, 0, 0
        for seed in seeds:
            logs, report = lost.run(simulations, simulations.museums / HALL, seed, minutes, [*CROWD, *more])
            claims = logs["claims.csv"]
            at = lost.found_at(claims)
            never += at is None
            in_time += at is not None and at <= WITHIN
            found += [] if at is None else [at]
            wrong += lost.sure_and_wrong(claims)
            served += report["requests"]["fulfilled"]
            offered += report["requests"]["offered"]
        middle = sorted(found)[len(found) // 2] if found else float("nan")
        rows.append([robot, count, in_time, never, f"{middle:.1f}", f"{max(found, default=float('nan')):.1f}", f"{wrong:.1f}", f"{served} of {offered}"])
        if more:
            verdict.want("packed hall, unknown start, with the ceiling: found within 60 s (all)", f"{in_time} of {count}, the others {upper(count - in_time, count)}",
                         in_time == count)
            verdict.want("packed hall, with the ceiling: sure and wrong (0.1 % of the time)", f"{wrong:.1f} s of {count * minutes * 60:.0f} s",
                         wrong <= 0.001 * count * minutes * 60)
    print("\n## In a packed hall, from an unknown place\n")
    print_table(["robot", "runs", "found within 60 s", "never", "found after [s], median", "last", "sure and wrong [s]", "wishes fulfilled"], rows)
    print()
