"""Low things on the ways of a museum: stools, baskets, boxes from 0.08 to 0.35 m high, all below the lasers. What sonars or infrared
sensors can see must not be touched at all, and what only touch finds must be touched once at most, however often the robot comes by."""
import collections
import csv
import heapq
import math
import random

import numpy

from evaluation import ways
from evaluation.tables import Verdict, print_table

SEEDS, THINGS, MINUTES = 5, 12, 40.0  # things of each run
SLICE_MINUTES = 14.0
LOW, HIGH = 0.08, 0.35  # [m] of height
RADIUS = (0.08, 0.28)  # [m]
SEEN_FROM = 0.2  # [m] of height: at which the lowest of the simulated rings looks
ROOM = 1.0  # [m] from walls and hazards to a thing's middle at least: the robot gets past
APART = 2.2  # [m] between two things
FROM_PLACES = 1.5  # [m] from where the robot stands
PASSED = 1.0  # [m] between outlines: so near it has come by
MUSEUMS = ["bonn", "smithsonian"]
CROWDS = ["quiet", "busy"]  # they take turns
FORGETS = {"forgets what it touched": ["evaluation.forgets_touch=true"]}
LEAST_FELT = 0.5  # touched things a run on average: without them nothing is shown


def way_between(floor, start, goal):
    """Points [m] of a shortest way, one a cell."""
    field = floor.lengths_from(*goal[:2])
    row, column = floor.cell_of(*start[:2])
    points = []
    while field[row, column] > 0.0 and len(points) < 5000:
        points.append((floor.x0 + column * floor.cell, floor.y0 + row * floor.cell))
        steps = [(field[row + i, column + j], row + i, column + j) for i, j in ways.STEPS
                 if 0 <= row + i < field.shape[0] and 0 <= column + j < field.shape[1]]
        best = min(steps)
        if best[0] >= field[row, column]:
            break
        row, column = best[1:]
    return points


def clearances(floor):
    """[rows, columns] of the way to the nearest cell that the robot's centre may not enter [m]."""
    far = numpy.full(floor.free.shape, numpy.inf)
    heap = [(0.0, int(row), int(column)) for row, column in numpy.argwhere(~floor.free)]
    for _, row, column in heap:
        far[row, column] = 0.0
    heapq.heapify(heap)
    while heap:
        away, row, column = heapq.heappop(heap)
        if away > far[row, column]:
            continue
        for i, j in ways.STEPS:
            to = row + i, column + j
            if 0 <= to[0] < far.shape[0] and 0 <= to[1] < far.shape[1] and away + math.hypot(i, j) * floor.cell < far[to]:
                far[to] = away + math.hypot(i, j) * floor.cell
                heapq.heappush(heap, (float(far[to]), *to))
    return far


def drawn(museum, seed, minutes):
    """The wishes of a run and the things on the ways between them: the exhibits in turn, again and again."""
    draw = random.Random(f"low things {museum.folder.name} {seed}")
    floor = ways.Floor(museum)
    room = clearances(floor)
    shown = [name for name, exhibit in museum.exhibits.items() if not exhibit.web_only]
    stops = draw.sample(shown, min(5, len(shown)))
    places = [museum.home, *(museum.exhibits[name].pose for name in stops)]
    lines = [way_between(floor, a, b) for a, b in zip(places, places[1:] + places[:1])]
    things = []
    for attempt in range(4000):
        if len(things) == THINGS:
            break
        x, y = draw.choice(draw.choice([line for line in lines if line]))
        x, y = x + draw.uniform(-0.25, 0.25), y + draw.uniform(-0.25, 0.25)
        row, column = floor.cell_of(x, y)
        radius, height = draw.uniform(*RADIUS), LOW + (HIGH - LOW) * (len(things) + draw.random()) / THINGS
        is_free = room[row, column] + ways.REACH >= ROOM and all(math.dist((x, y), place[:2]) >= FROM_PLACES for place in places) and \
            all(math.dist((x, y), thing[:2]) >= APART for thing in things)
        if is_free:
            things.append((x, y, radius, height))
    events = [f"  - {{at: 1, stool: {{at: [{x:.2f}, {y:.2f}], radius: {radius:.2f}, height: {height:.3f}}}}}" for x, y, radius, height in things]
    at = 20.0
    while at < 60.0 * minutes - 120.0:
        for name in stops:
            events.append(f"  - {{at: {at:.0f}, request: {{kind: exhibit, target: {name}, language: en}}}}")
            at += 75.0
    return "events:\n" + "\n".join(events) + "\n", things


class Run:
    """What became of each thing of a run: [(x, y, radius, height, how often it came by, how often it was touched)]."""

    def __init__(self, things, events, drive, report):
        self.report = report
        touched = collections.Counter(row["subject"] for row in events if row["source"] == "contact")
        self.other = sum(count for what, count in touched.items() if not what.startswith("stool-") and not what.startswith("person"))
        near = [False] * len(things)
        passes = [0] * len(things)
        for row in drive:
            for i, (x, y, radius, _) in enumerate(things):
                gap = math.dist((float(row["x"]), float(row["y"])), (x, y)) - radius - 0.265
                if gap <= PASSED and not near[i]:
                    passes[i] += 1
                near[i] = gap <= (PASSED + 0.5 if near[i] else PASSED)
        self.things = [(*thing, passes[i], touched[f"stool-{i}"]) for i, thing in enumerate(things)]


def run(simulations, museum, seed, minutes, crowd, settings):
    scenario, things = drawn(ways.Museum(museum), seed, minutes)
    arguments = ["--crowd", crowd, "--requests-per-hour", "0"] + [word for setting in settings for word in ("--set", setting)]
    kept, report = simulations.run_logged("low-things", museum, seed, minutes / 60, arguments,
                                          {"--event-log": "events.csv", "--drive-log": "drive.csv"}, scenario)
    rows = []
    for kind in ("events.csv", "drive.csv"):
        with open(kept[kind], newline="", encoding="utf-8") as file:
            rows.append(list(csv.DictReader(file)))
    return Run(things, *rows, report)


def counts(runs):
    """Of things that the robot came by: (things, passes, seen ones, seen ones touched, felt ones, touched once, touched again)."""
    met = [thing for one in runs for thing in one.things if thing[4] > 0]
    seen = [thing for thing in met if thing[3] > SEEN_FROM]
    felt = [thing for thing in met if thing[3] <= SEEN_FROM]
    return (len(met), sum(thing[4] for thing in met), len(seen), sum(thing[5] > 0 for thing in seen), len(felt),
            sum(thing[5] > 0 for thing in felt), sum(thing[5] > 1 for thing in met))


def upper(bad, of):
    """The bound of a rate, 95 %: the rule of three where nothing was seen."""
    return f"{bad} of {of}" + (f", below {100 * (3.0 if bad == 0 else bad + 2.0 * math.sqrt(bad) + 2.0) / of:.1f} % with 95 %" if of else "")


def protocol(simulations, options):
    minutes = SLICE_MINUTES if options.slice else options.minutes or MINUTES
    seeds = list(range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else SEEDS))))
    names = options.museums.split(",") if options.museums else MUSEUMS[:1] if options.slice else MUSEUMS
    kinds = {"whole": [], **({} if options.no_crippled else FORGETS)}
    calls = [(simulations, simulations.museums / name, seed, minutes, CROWDS[(seed + i) % 2], settings)
             for settings in kinds.values() for i, name in enumerate(names) for seed in seeds]
    made = simulations.each(run, calls)
    of = {how: made[i * len(names) * len(seeds):(i + 1) * len(names) * len(seeds)] for i, how in enumerate(kinds)}
    print("\n## Low things on the ways\n")
    print_table(["robot", "km", "things met", "passes", "seen", "touched", "felt only", "touched once or more", "touched again", "others touched"],
                [[how, f"{sum(one.report['distance_m'] for one in runs) / 1000:.2f}", *counts(runs), sum(one.other for one in runs)]
                 for how, runs in of.items()])
    print()
    verdict = Verdict()
    met, passes, seen, seen_touched, felt, felt_touched, again = counts(of["whole"])
    verdict.want("things met, and passes", f"{met} things, {passes} passes", met >= 4 * len(of["whole"]) and passes >= 2 * met)
    verdict.want("what a ring can see, touched (none)", upper(seen_touched, seen), seen > 0 and seen_touched == 0)
    verdict.want("what only touch finds was found, a run on average", f"{felt_touched} in {len(of['whole'])} runs, of {felt} met",
                 felt_touched >= LEAST_FELT * len(of["whole"]))
    verdict.want("touched a second time (none)", upper(again, felt_touched + seen_touched), again == 0)
    for one, call in zip(of["whole"], calls):
        for x, y, radius, height, passed, touched in one.things:
            if touched > 1 or (touched and height > SEEN_FROM):
                verdict.note(f"{call[1].name}, seed {call[2]}", f"({x:.2f}, {y:.2f}) {radius:.2f} m wide, {height:.3f} m high: {touched} times in {passed}")
    for how in list(kinds)[1:]:
        again = counts(of[how])[6]
        verdict.want(f"crippled: {how} (must touch some again)", f"{again} of {counts(of[how])[5]} touched", again > 0)
    verdict.want_one_configuration(one.report["config_hash"] for one in of["whole"])
    verdict.print()
    return verdict
