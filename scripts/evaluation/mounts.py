"""Scanners that are mounted otherwise, or are later, than robot.yaml says, and robots that are set down to explore elsewhere than they are
told.

Part `mounts`: tours in both museums. What is wrong must be named within WAY_M of way, truly, and no marked hazard be touched; robots of which
nothing is wrong must name nothing. The simulator screws each scanner on with up to half a degree and 7 mm of error of its own, which is in the
figures. Parts `right` and `logs`: see right_mounts.py. Part `starts`: explorations of both museums. A robot that believes robot.yaml, and one that believes the start, must fail.
"""
import csv
import json
import math
import re
import subprocess
import tempfile
from pathlib import Path

from evaluation.bounds import bounded
from evaluation import right_mounts
from evaluation.programs import laboratory, program_for
from evaluation.simulations import side_by_side
from evaluation.tables import Verdict, print_table

PARTS = ["mounts", "right", "logs", "starts"]
WAY_M = 20.0  # [m] within which it is named
HEADING = 1.0 + 0.5  # [deg] of the truth, and what the simulator adds
PLACE = 0.03 + 0.01  # [m] likewise
DELAY = 0.03  # [s]
POSE_M = 0.05  # [m] mean error of the pose over the run
FALSE_KM = 0.3  # of exposure that is owed to say that nothing is named falsely
MINUTES = 8.0
BOTH = ("front", "rear")


def wrong(name, scanners, heading=0.0, x=0.0, y=0.0, late=0.0):
    return {"name": name, "scanners": scanners, "heading": heading, "x": x, "y": y, "late": late}


CASES = [
    wrong("nothing", ()),
    wrong("front 2 deg", ("front",), heading=2),
    wrong("both 3 deg", BOTH, heading=3),
    wrong("front -5 deg", ("front",), heading=-5),
    wrong("both 10 deg", BOTH, heading=10),
    wrong("rear -20 deg", ("rear",), heading=-20),
    wrong("front 45 deg", ("front",), heading=45),
    wrong("both -45 deg", BOTH, heading=-45),
    wrong("front 5 cm", ("front",), x=0.05),
    wrong("both 5 cm aside", BOTH, y=-0.05),
    wrong("both 10 cm", BOTH, x=0.1),
    wrong("rear 20 cm", ("rear",), x=0.2),
    wrong("both 30 cm", BOTH, x=-0.2, y=0.22),
    wrong("front 60 ms", ("front",), late=0.06),
    wrong("both 150 ms", BOTH, late=0.15),
]
SLICE = ["nothing", "both 10 deg", "rear 20 cm", "both 150 ms"]
OWED_HEADING, OWED_PLACE = 3.0, 0.05  # from here on it must be named
CRIPPLED = ["--set", "calibrate.corrects=false", "--set", "calibrate.named_heading=90", "--set", "calibrate.named_position=2",
            "--set", "calibrate.named_delay=2", "--set", "calibrate.doubt_heading=0", "--set", "calibrate.doubt_position=0"]
STARTS = [(0.0, 0.0, 1.0), (0.0, 0.0, -5.0), (0.0, 0.0, 10.0), (0.0, 0.0, -10.0), (0.5, 0.0, 0.0), (0.0, -0.5, 0.0), (0.35, 0.35, 5.0)]
START_POSES = {"bonn": [], "smithsonian": ["--start", "12,15,0"]}  # see exploration.py
BELIEVES_THE_START = ["--set", "explore.alignment.start_position=0", "--set", "explore.alignment.start_heading=0"]


TOURS = {"bonn": "highlights", "smithsonian": "things-that-move"}  # long ones


def scenario_of(case, museum):
    mounts = ", ".join(f"{name}: {{x: {case['x']}, y: {case['y']}, heading: {case['heading']}}}" for name in case["scanners"])
    late = ", ".join(f"{name}: {case['late']}" for name in case["scanners"])
    return (f"build: {{mounts: {{{mounts}}}, late: {{{late}}}}}\n"
            f"events:\n  - {{at: 5, request: {{kind: tour, target: {TOURS[museum]}, language: en}}}}\n")


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def told_of(reason, scanner):
    """What of a scanner is said: (degrees, x, y [m], late [s]); 0 where nothing is."""
    found = re.search(rf"scanner {scanner}: (.*?)(?=; scanner|; base|$)", reason)
    text = found.group(1) if found else ""
    turned = re.search(r"turned by ([+-][\d.]+)", text)
    moved = re.search(r"displaced by x ([+-]\d+) y ([+-]\d+)", text)
    late = re.search(r"stamps ([+-]\d+)", text)
    return (float(turned.group(1)) if turned else 0.0, *((float(moved.group(1)) / 100, float(moved.group(2)) / 100) if moved else (0.0, 0.0)),
            float(late.group(1)) / 1000 if late else 0.0)


class Outcome:
    """What a robot made of it."""

    def __init__(self, case, paths, report):
        claims, health = rows_of(paths["claims.csv"]), rows_of(paths["health.csv"])
        ways = [(float(row["time"]), float(row["distance"])) for row in claims]
        self.km = report["distance_m"] / 1000
        self.hazards, self.contacts = report["contacts"]["hazards"], sum(report["contacts"].values())
        self.pose_m = report["localization"]["mean_error_m"]
        self.reasons = [(float(row["time"]), row["reason"]) for row in health if row["module"] == "calibrate" and row["state"] == "degraded"]
        told = [(float(row["time"]), row["reason"]) for row in health if row["module"] == "calibrate"]
        known = [time for time, reason in told if time > 0 and "slow until" not in reason]
        self.slow_m = way_at(ways, known[0]) if known else math.inf
        self.named_m = max((self.way_named(scanner, ways) for scanner in case["scanners"]), default=0.0)
        # As it is said when it has driven so far; later where it was named later.
        by_then = [reason for time, reason in self.reasons if way_at(ways, time) <= max(WAY_M, self.named_m)]
        said = [told_of(by_then[-1] if by_then else "", scanner) for scanner in case["scanners"]]
        self.turn_off = max((abs(one[0] - case["heading"]) for one in said if case["heading"]), default=0.0)
        self.place_off = max((math.hypot(one[1] - case["x"], one[2] - case["y"]) for one in said if case["x"] or case["y"]), default=0.0)
        self.late_off = max((abs(one[3] - case["late"]) for one in said if case["late"]), default=0.0)
        self.is_false = self.names_falsely(case)

    def way_named(self, scanner, ways):
        times = [time for time, reason in self.reasons if f"scanner {scanner}:" in reason]
        return way_at(ways, times[0]) if times else math.inf

    def names_falsely(self, case):
        for _, reason in self.reasons:
            if "base:" in reason or any(f"scanner {name}:" in reason for name in BOTH if name not in case["scanners"]):
                return True
            if any(told[0] and not case["heading"] or told[3] and not case["late"] for told in (told_of(reason, name) for name in case["scanners"])):
                return True
        return False


def way_at(ways, time):
    return max((way for at, way in ways if at <= time), default=0.0)


def museums_of(options):
    return options.museums.split(",") if options.museums else ["bonn"] if options.slice else ["bonn", "smithsonian"]


def chosen(named, options):
    """Those of {name: case} that are asked for."""
    wanted = options.cases.split(";") if options.cases else list(named)
    unknown = [name for name in wanted if name not in named]
    if unknown:
        raise RuntimeError(f"--cases: no {', '.join(unknown)} among {'; '.join(named)}")
    return [named[name] for name in wanted]


def is_owed(case):
    return abs(case["heading"]) >= OWED_HEADING or math.hypot(case["x"], case["y"]) >= OWED_PLACE or case["late"] >= 0.06


def run_case(simulations, case, museum, seed, minutes, more=(), requests=0):
    logs = {"--health-log": "health.csv", "--claims": "claims.csv"}
    paths, report = simulations.run_logged("mounts", simulations.museums / museum, seed, minutes / 60,
                                           ["--crowd", "busy", "--requests-per-hour", requests, *more], logs, scenario_of(case, museum))
    return Outcome(case, paths, report)


def evaluate_mounts(simulations, verdict, options):
    museums = museums_of(options)
    cases = chosen({case["name"]: case for case in CASES if not options.slice or case["name"] in SLICE}, options)
    minutes = options.minutes or (4.0 if options.slice else MINUTES)
    seeds = range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else 5)))
    jobs = [(case, museum, seed) for case in cases for museum in museums for seed in seeds]
    outcomes = side_by_side([lambda job=job: run_case(simulations, *job, minutes) for job in jobs], simulations.jobs)
    rows = []
    for case in cases:
        mine = [outcome for job, outcome in zip(jobs, outcomes) if job[0] is case]
        late_named = sum(outcome.named_m > WAY_M for outcome in mine)
        rows.append([case["name"], len(mine), f"{sum(o.km for o in mine):.2f}", sum(o.hazards for o in mine), sum(o.contacts for o in mine),
                     f"{max(o.named_m for o in mine):.1f}" if case["scanners"] else "", late_named if case["scanners"] else "",
                     f"{max(o.turn_off for o in mine):.1f}", f"{100 * max(o.place_off for o in mine):.1f}", f"{1000 * max(o.late_off for o in mine):.0f}",
                     f"{100 * max(o.pose_m for o in mine):.1f}", sum(o.is_false for o in mine)])
    print_table(["wrong", "runs", "km", "hazards", "contacts", "named after m", "later", "off deg", "off cm", "off ms", "pose cm", "false"], rows)
    km = sum(outcome.km for outcome in outcomes)
    exposure = f"{len(outcomes)} runs, {km:.2f} km"
    hazards = sum(outcome.hazards for outcome in outcomes)
    verdict.want("contacts with marked hazards (0)", f"{bounded(hazards, km)}; {len(outcomes)} runs", hazards == 0 and km > 0)
    idle = sum(1000 * outcome.km < WAY_M for outcome in outcomes)
    verdict.want(f"runs that drove less than {WAY_M:g} m (0)", f"{idle} of {len(outcomes)}", idle == 0)
    owed = [(job, outcome) for job, outcome in zip(jobs, outcomes) if is_owed(job[0])]
    late = [f"{job[0]['name']} {job[1]} {job[2]}" for job, outcome in owed if outcome.named_m > WAY_M]
    verdict.want(f"named within {WAY_M:g} m", f"{len(owed) - len(late)} of {len(owed)}{': not ' + ', '.join(late) if late else ''}", not late)
    off = [outcome for _, outcome in owed if outcome.turn_off > HEADING or outcome.place_off > PLACE or outcome.late_off > DELAY]
    verdict.want("said within 1 degree, 3 cm, 30 ms and what the simulator adds", f"{len(owed) - len(off)} of {len(owed)}", not off)
    false = sum(outcome.is_false for outcome in outcomes)
    verdict.want("named falsely (0)", f"{false} of {exposure}", false == 0 and (options.slice or km >= FALSE_KM))
    pose = max(outcome.pose_m for outcome in outcomes)
    verdict.want(f"mean error of the pose, worst run ({100 * POSE_M:g} cm)", f"{100 * pose:.1f} cm", pose <= POSE_M)
    if not options.no_crippled:
        case = next(case for case in CASES if case["name"] == "rear 20 cm") | {"scanners": BOTH, "name": "both 20 cm"}
        crippled = run_case(simulations, case, "bonn", options.first_seed, minutes, CRIPPLED)
        verdict.want("crippled, believes robot.yaml: says nothing and is off", f"{'named' if crippled.reasons else 'said nothing'}, pose off by "
                     f"{100 * crippled.pose_m:.1f} cm", not crippled.reasons and crippled.pose_m > POSE_M)


def explore(simulations, museum, seed, off, more=()):
    with tempfile.TemporaryDirectory(prefix="docent-starts-") as scratch:
        folder = Path(scratch)
        scenario = folder / "scenario.yaml"
        scenario.write_text(f"build: {{start: {{x: {off[0]}, y: {off[1]}, heading: {off[2]}}}}}\nevents: []\n")
        arguments = ["explore", "--museum", simulations.museums / museum, "--seed", seed, "--people", 0, "--hours", 1.0, "--out", folder / "out",
                     "--scenario", scenario, "--quiet", *START_POSES[museum], *more]
        subprocess.run([program_for(simulations.docent, list(map(str, arguments))), *map(str, arguments)], capture_output=True, text=True, check=False)
        report = folder / "out" / "report.json"
        if not report.exists():
            return None
        run = json.loads(report.read_text())
        score = folder / "score.json"
        subprocess.run([laboratory(simulations.docent), "score-map", "--map", folder / "out" / "map.yaml", "--world",
                        simulations.museums / museum / "simulation.yaml", "--report", score], capture_output=True, text=True, check=False)
        run["covered"] = json.loads(score.read_text())["covered"] if score.exists() else math.nan
        return run


def evaluate_starts(simulations, verdict, options):
    museums = museums_of(options)
    starts = chosen({" ".join(f"{value:g}" for value in off): off for off in (STARTS[2:3] if options.slice else STARTS)}, options)
    seeds = range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else 5)))
    jobs = [(museum, seed, off) for off in starts for museum in museums for seed in seeds]
    runs = side_by_side([lambda job=job: explore(simulations, *job) for job in jobs], simulations.jobs)
    rows = []
    for off in starts:
        for museum in museums:
            mine = [run for job, run in zip(jobs, runs) if job[0] == museum and job[2] == off]
            made = [run for run in mine if run]
            rows.append([f"{off[0]:+.2f} m, {off[1]:+.2f} m, {off[2]:+.0f} deg", museum, len(mine), len(made),
                         f"{sum(run['distance_m'] for run in made) / 1000:.2f}", sum(run["contacts"]["hazards"] for run in made),
                         sum(sum(run["contacts"].values()) for run in made),
                         f"{100 * min((run['covered'] for run in made), default=math.nan):.1f}", sum(run["exploration"]["state"] == "done" for run in made)])
    print_table(["set down off by", "museum", "runs", "maps", "km", "hazards", "contacts", "covered %", "done at home"], rows)
    made = [run for run in runs if run]
    km = sum(run["distance_m"] for run in made) / 1000
    hazards = sum(run["contacts"]["hazards"] for run in made)
    verdict.want("starts: contacts with marked hazards (0)", f"{bounded(hazards, km)}; {len(runs)} explorations", hazards == 0 and km > 0)
    verdict.want("starts: explorations that ended with a map", f"{len(made)} of {len(runs)}", len(made) == len(runs))
    if not options.no_crippled:
        crippled = [explore(simulations, "bonn", seed, (0.0, 0.0, 10.0), BELIEVES_THE_START) for seed in seeds]
        touched = sum(run["contacts"]["hazards"] if run else 1 for run in crippled)
        verdict.want("crippled, believes its start: touches a hazard", f"{touched} in {len(crippled)} explorations", touched > 0)


def protocol(simulations, options):
    verdict = Verdict()
    parts = [options.part] if options.part else (["mounts"] if options.slice else PARTS)
    if "mounts" in parts:
        evaluate_mounts(simulations, verdict, options)
    if "right" in parts:
        right_mounts.evaluate_right(simulations, verdict, options, run_case, CASES[0])
    if "logs" in parts:
        right_mounts.evaluate_logs(simulations, verdict)
    if "starts" in parts:
        evaluate_starts(simulations, verdict, options)
    print()
    verdict.print()
    return verdict
