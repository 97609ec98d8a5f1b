"""Things that no laser sees, on the ways of a museum: 5 to 30 cm low, the edge of a table at 0.9 m, stairs that nobody has marked. A robot
with a depth camera and neither sonars nor infrared sensors goes round them; the same robot with its eye shut does not."""
import csv
import random
import shutil
from pathlib import Path

from evaluation import low_things, ways
from evaluation.low_things import upper
from evaluation.tables import print_table

SEEDS, MINUTES, SLICE_MINUTES = 20, 10.0, 5.0
LOW, HIGH = 0.05, 0.30  # [m] of height
NEAR_EDGE = 0.6  # [m] of the robot's middle from the marked edge: so near it came
TABLE = (0.86, 0.90)  # [m] its top's lower and upper side
EYE = ["body.sonars=0", "body.infrareds=0", "sight.enabled=true"]
SHUT = ["body.sonars=0", "body.infrareds=0", "sight.enabled=false"]
CROWDS = ["empty", "quiet", "busy"]  # they take turns
# Of the staircase: a place on it where a robot that sees none would go, and the corners of the area that keep others out.
STAIRS = {"bonn": ((22.8, 4.2, -90), (22.8, 6.3), [(20.4, 5.65), (25.1, 5.65)]),
          "smithsonian": ((44.9, 7.2, -90), (44.7, 10.0), [(43.0, 8.65), (46.8, 8.65)])}
MARKED = ("stairs", "plate", "other")  # hazards that an eye must find by itself; glass it cannot


def with_tables(scenario):
    """Every third thing hangs at a table's height."""
    lines, things = scenario.split("\n"), 0
    for i, line in enumerate(lines):
        if "stool:" not in line:
            continue
        if things % 3 == 2:
            lines[i] = line[:line.index("height")] + f"height: {TABLE[1]}, bottom: {TABLE[0]}}}}}"
        things += 1
    return "\n".join(lines)


def unmarked(museum, folder):
    """A copy of a museum whose people have marked nothing but glass, with an exhibit on the stairs."""
    target = folder / f"{museum.name}-unmarked"
    (x, y, heading), _, corners = STAIRS[museum.name]
    if target.exists():
        shutil.rmtree(target)
    shutil.copytree(museum, target)
    text = (museum / "museum.yaml").read_text(encoding="utf-8")
    for corner in corners:
        text = text.replace(f"[{corner[0]}, {corner[1]}], ", "", 1)
    lines = [line for line in text.split("\n") if not any(f"kind: {kind}," in line for kind in MARKED)]
    at = lines.index("exhibits:") + 1
    first = next(line for line in lines[at:] if "short:" in line)
    second = next(line for line in lines[at:] if "long:" in line)
    lines[at:at] = ["  - id: over-the-edge", '    title: {en: "Over the edge", de: "Ueber die Kante"}',
                    f"    pose: {{x: {x}, y: {y}, heading: {heading}}}", f"    look_at: {{x: {x}, y: {y - 1.0}}}", first, second]
    (target / "museum.yaml").write_text("\n".join(lines), encoding="utf-8")
    return target


def logs(simulations, name, museum, seed, minutes, arguments, scenario):
    kept, report = simulations.run_logged(name, museum, seed, minutes / 60, arguments,
                                          {"--event-log": "events.csv", "--drive-log": "drive.csv"}, scenario)
    rows = []
    for kind in ("events.csv", "drive.csv"):
        with open(kept[kind], newline="", encoding="utf-8") as file:
            rows.append(list(csv.DictReader(file)))
    return *rows, report


def things(simulations, museum, seed, minutes, settings):
    low_things.LOW, low_things.HIGH = LOW, HIGH
    scenario, drawn = low_things.drawn(ways.Museum(museum), seed, minutes)
    arguments = ["--crowd", CROWDS[seed % len(CROWDS)], "--requests-per-hour", "0"] + [word for setting in settings for word in ("--set", setting)]
    events, drive, report = logs(simulations, "eyes-things", museum, seed, minutes, arguments, with_tables(scenario))
    return low_things.Run(drawn, events, drive, report)


def stairs(simulations, museum, seed, minutes, settings):
    draw = random.Random(f"stairs {museum.name} {seed}")
    (_, _, _), (x, y), ((_, edge), _) = STAIRS[museum.name.removesuffix("-unmarked")]
    floor = ways.Floor(ways.Museum(simulations.museums / museum.name.removesuffix("-unmarked")))  # where nothing stands
    places = [(x + draw.uniform(-1.5, 1.5), y + draw.uniform(-0.4, 0.4)) for _ in range(200)]
    at = next(place for place in places if floor.free[floor.cell_of(*place)])
    start = f"{at[0]:.2f},{at[1]:.2f},{draw.uniform(-180, 180):.0f}"
    scenario = "events:\n" + "\n".join(f"  - {{at: {at}, request: {{kind: exhibit, target: over-the-edge, language: en}}}}" for at in (15, 100)) + "\n"
    arguments = ["--crowd", "empty", "--requests-per-hour", "0", "--start", start] + [word for setting in settings for word in ("--set", setting)]
    events, drive, report = logs(simulations, "eyes-stairs", museum, seed, minutes, arguments, scenario)
    falls = sum(row["source"] == "scenario" and row["kind"] == "fall" or row["kind"] == "stairs" for row in events)
    near = any(abs(float(row["x"]) - x) < 2.0 and float(row["y"]) < edge + NEAR_EDGE for row in drive)
    return falls, near, report


def part_things(simulations, options, verdict):
    minutes = SLICE_MINUTES if options.slice else options.minutes or MINUTES
    seeds = range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else SEEDS)))
    names = options.museums.split(",") if options.museums else ["bonn"] if options.slice else ["bonn", "smithsonian"]
    kinds = {"with its eye": EYE, **({} if options.no_crippled else {"the eye shut": SHUT})}
    calls = [(simulations, simulations.museums / name, seed, minutes, settings) for settings in kinds.values() for name in names for seed in seeds]
    made = simulations.each(things, calls)
    size = len(names) * len(seeds)
    of = {how: made[i * size:(i + 1) * size] for i, how in enumerate(kinds)}
    print("\n## Things that no laser sees\n")
    rows = []
    for how, runs in of.items():
        met = [thing for one in runs for thing in one.things if thing[4] > 0]
        touched = sum(thing[5] for one in runs for thing in one.things)
        served = sum(one.report["requests"]["fulfilled"] for one in runs)
        rows.append([how, f"{sum(one.report['distance_m'] for one in runs) / 1000:.2f}", len(met), sum(thing[4] for thing in met), touched,
                     sum(one.report["contacts"]["people"] for one in runs), sum(one.other for one in runs), served,
                     sum(one.report["requests"]["offered"] for one in runs),
                     f"{sum(one.report['standing_seconds'] for one in runs):.0f} of {sum(one.report['travel_seconds'] for one in runs):.0f}"])
    print_table(["robot", "km", "things met", "passes", "touches", "people touched", "others", "served", "asked", "standing of travelling [s]"], rows)
    print()
    _, km, met, passes, touches, *_ = rows[0]
    verdict.want("things that no laser sees: touched by the robot with its eye (none)", f"{upper(touches, passes)} passes, {met} things, {km} km",
                 passes > 0 and touches == 0)
    for one, call in zip(of["with its eye"], calls):
        for x, y, radius, height, passed, touched in one.things:
            if touched:
                verdict.note(f"{call[1].name}, seed {call[2]}", f"({x:.2f}, {y:.2f}) {radius:.2f} m wide, drawn {height:.3f} m high: {touched} times in {passed}")
    if len(rows) > 1:
        verdict.want("the same with the eye shut (must touch some)", f"{rows[1][4]} in {rows[1][3]} passes", rows[1][4] > 0)


def part_stairs(simulations, options, verdict, cache):
    minutes = 3.0
    seeds = range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else SEEDS)))
    names = options.museums.split(",") if options.museums else ["bonn"] if options.slice else ["bonn", "smithsonian"]
    folders = [unmarked(simulations.museums / name, Path(cache)) for name in names]
    kinds = {"with its eye": EYE, **({} if options.no_crippled else {"the eye shut": SHUT})}
    made = simulations.each(stairs, [(simulations, folder, seed, minutes, settings) for settings in kinds.values() for folder in folders for seed in seeds])
    size = len(names) * len(seeds)
    of = {how: made[i * size:(i + 1) * size] for i, how in enumerate(kinds)}
    print("\n## Stairs that nobody has marked, and the robot is sent there\n")
    print_table(["robot", "runs", "came near", "fell"], [[how, len(runs), sum(near for _, near, _ in runs), sum(fell > 0 for fell, _, _ in runs)]
                                                          for how, runs in of.items()])
    print()
    fell, near = (sum(run[0] > 0 for run in of["with its eye"]), sum(run[1] for run in of["with its eye"]))
    verdict.want("stairs: falls of the robot with its eye (none)", f"{upper(fell, near)} that came near", near > 0 and fell == 0)
    if "the eye shut" in of:
        shut = sum(run[0] > 0 for run in of["the eye shut"])
        verdict.want("stairs: the same with the eye shut (must fall)", f"{shut} of {size}", shut > 0)
