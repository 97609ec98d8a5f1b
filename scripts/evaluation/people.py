"""Tracked people held against the true ones: the whole robot on its tours in both museums, busy.

Every half second the tracks that the robot publishes are compared with the persons who are truly there. A person counts
when their middle is within 5 m of the robot's and at least three beams of that sweep (of 360, a degree apart) ended on
them; who is hidden more than that is counted apart. A person and a track match within 0.5 m, one to one, nearest pairs
first; a track that is nobody's within 5 m is wrong, a track on somebody who is hidden just then is right. The robot
drives above 0.05 m/s or 0.1 rad/s; a person moves above 0.2 m/s, by the truth for recall, by the track's own velocity
for precision.
"""
import concurrent.futures
import csv
import hashlib
import json
import os
import statistics
import subprocess
import sys
import time

from evaluation.tables import Verdict, print_table

MUSEUMS = ["bonn", "smithsonian"]
VISIBLE_BEAMS = 3
MOVING = 0.2  # [m/s]
EVERY = 0.5  # [s] between two rows of a person
BOUND = 0.9
LEAST_SECONDS = 60.0  # person-seconds below which a rate says nothing
CASES = [("driving", "moving"), ("driving", "standing"), ("standing", "moving"), ("standing", "standing")]
BANDS = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5)]
CRIPPLED = {  # each must fall below a bound
    "no reading counts as a person's": ["--set", "localize.people.filter=none"],
    "no track is ever forgotten, no thing is told from a person": ["--set", "evaluation.keeps_all_people=true"],
}
CRIPPLED_SEEDS = 1
OTHER_FILTERS = {"entropy filter": ["--set", "localize.people.filter=entropy"]}


class Tally:
    """Visible persons and those found; claims and those right."""

    def __init__(self):
        self.visible = self.found = self.claims = self.right = 0

    def add(self, other):
        self.visible += other.visible
        self.found += other.found
        self.claims += other.claims
        self.right += other.right
        return self

    @property
    def recall(self):
        return self.found / self.visible if self.visible else float("nan")

    @property
    def precision(self):
        return self.right / self.claims if self.claims else float("nan")

    @property
    def seconds(self):
        return self.visible * EVERY


def percent(value):
    return "-" if value != value else f"{100 * value:.1f}"


def is_driving(row):
    return abs(row["robot_speed"]) > 0.05 or abs(row["robot_turn"]) > 0.1


def tally(rows, keep=lambda row: True, of_truth=lambda row: True, of_claim=lambda row: True, least_beams=VISIBLE_BEAMS):
    result = Tally()
    for row in filter(keep, rows):
        is_person = row["kind"] == "person"
        found = row["track"] > 0
        if is_person and row["beams"] >= least_beams and of_truth(row):
            result.visible += 1
            result.found += found
        if found and of_claim(row):
            result.claims += 1
            result.right += is_person
    return result


class Run:
    """One museum, one seed: its rows in the map's frame while the robot said where it is, and in odometry's frame."""

    def __init__(self, path):
        self.in_map, self.unplaced, self.in_odom = [], [], []
        with open(path, newline="", encoding="ascii") as file:
            for raw in csv.DictReader(file):
                row = {key: value if key in ("frame", "kind") else float(value) for key, value in raw.items()}
                if row["frame"] == "odom":
                    (self.in_odom if row["localized"] else self.unplaced).append(row)
                elif row["localized"]:
                    self.in_map.append(row)

    def case(self, robot, people):
        moving = people == "moving"
        return tally(self.in_map, lambda row: is_driving(row) == (robot == "driving"),
                     lambda row: (row["speed"] > MOVING) == moving, lambda row: (row["track_speed"] > MOVING) == moving)


class Bench:
    def __init__(self, docent, cache, run_key, museums, jobs):
        self.docent, self.cache, self.museums, self.jobs = docent, cache / "people", museums, jobs
        self.keys = {museum: run_key(museums / museum) for museum in MUSEUMS}
        self.cache.mkdir(parents=True, exist_ok=True)

    def run(self, museum, seed, minutes, arguments):
        key = hashlib.sha256(json.dumps([self.keys[museum], seed, minutes, arguments]).encode()).hexdigest()[:16]
        path = self.cache / f"{museum}-seed{seed}-{key}.csv"
        if not path.exists():
            part = path.with_suffix(f".part{os.getpid()}")
            started = time.monotonic()
            done = subprocess.run([self.docent, "simulate", "--museum", self.museums / museum, "--hours",
                                   f"{minutes / 60:.6f}", "--seed", str(seed), "--crowd", "busy", "--people-log", part,
                                   "--quiet", *arguments], capture_output=True, text=True, check=False)
            if done.returncode != 0 or not part.exists():
                raise RuntimeError(f"seed {seed}: docent simulate exited {done.returncode}: {done.stderr.strip()[-400:]}")
            part.rename(path)
            print(f"   {museum} seed {seed}: {time.monotonic() - started:.0f} s", file=sys.stderr)
        return Run(path)

    def all(self, museum, seeds, minutes, arguments=()):
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            return list(pool.map(lambda seed: self.run(museum, seed, minutes, list(arguments)), seeds))


def pooled(tallies):
    total = Tally()
    for one in tallies:
        total.add(one)
    return total


def spread(values):
    values = [value for value in values if value == value]
    return f"{100 * min(values):.1f}-{100 * max(values):.1f}" if values else "-"


def cells(name, tallies):
    total = pooled(tallies)
    return [name, f"{total.seconds:.0f}", percent(total.recall), spread(one.recall for one in tallies),
            f"{total.claims * EVERY:.0f}", percent(total.precision), spread(one.precision for one in tallies)]


HEADER = ["people-s", "recall %", "seeds", "claims-s", "precision %", "seeds "]


def museum_tables(museum, runs, verdict):
    rows, points = [], []
    for robot, people in CASES:
        tallies = [run.case(robot, people) for run in runs]
        total = pooled(tallies)
        rows.append(cells(f"robot {robot}, people {people}", tallies))
        points.append((f"robot {robot}, people {people}", total, tallies))
        verdict.want(f"{museum}, robot {robot}, people {people}: recall and precision at least {100 * BOUND:.0f} %",
                     f"{percent(total.recall)} % of {total.seconds:.0f} person-s, {percent(total.precision)} % of "
                     f"{total.claims * EVERY:.0f} s claimed",
                     total.recall >= BOUND and total.precision >= BOUND and total.seconds >= LEAST_SECONDS)
    rows.append(cells("all", [tally(run.in_map) for run in runs]))
    print_table([museum, *HEADER], rows)
    print()
    bands = []
    for low, high in BANDS:
        tallies = [tally(run.in_map, lambda row, a=low, b=high: a <= row["away"] < b) for run in runs]
        bands.append((f"{low}-{high} m", pooled(tallies), tallies))
        rows = cells(f"{low} to {high} m", tallies)
        bands[-1] = (*bands[-1], rows)
    print_table([museum + " by distance", *HEADER], [band[3] for band in bands])
    print()
    everybody = pooled(tally(run.in_map, least_beams=0) for run in runs)
    met = pooled(tally(run.in_map, least_beams=1) for run in runs)
    seen = pooled(tally(run.in_map) for run in runs)
    hidden = everybody.visible - seen.visible
    print(f"within 5 m {everybody.seconds:.0f} person-s; left out for fewer than {VISIBLE_BEAMS} beams {hidden * EVERY:.0f} "
          f"({100 * hidden / max(1, everybody.visible):.0f} %). Recall of all who met a beam {percent(met.recall)} %, of "
          f"all, hidden behind walls or not, {percent(everybody.recall)} %")
    errors = sorted(row["off"] for run in runs for row in run.in_map if row["kind"] == "person" and row["track"] > 0)
    if errors:
        print(f"found ones are off by {100 * statistics.mean(errors):.0f} cm in the mean, "
              f"95 % by less than {100 * errors[int(0.95 * len(errors))]:.0f} cm")
    rows = [cells("map, knows its place", [tally(run.in_map) for run in runs]),
            cells("odometry, knows its place", [tally(run.in_odom) for run in runs]),
            cells("odometry, does not", [tally(run.unplaced) for run in runs])]
    print()
    print_table([museum + " by frame", *HEADER], rows)
    return points, [(name, total, tallies) for name, total, tallies, _ in bands]


def bars(parts, x, y, width, title, data):
    """One panel: recall and precision of each row of data, with the seeds' spread, over 50 to 100 %."""
    row, label = 26, 210
    scale = (width - label - 70) / 50.0
    at = lambda value: x + label + scale * (max(50.0, 100 * value) - 50.0)
    parts.append(f'<text x="{x}" y="{y}" class="title">{title}</text>')
    bottom = y + 14 + row * len(data)
    for tick in (50, 60, 70, 80, 90, 100):
        tx = x + label + scale * (tick - 50)
        bound = tick == 100 * BOUND
        parts.append(f'<line x1="{tx:.1f}" y1="{y + 10}" x2="{tx:.1f}" y2="{bottom}" class="{"bound" if bound else "grid"}"/>')
        parts.append(f'<text x="{tx:.1f}" y="{bottom + 14}" class="tick">{tick} %</text>')
    for i, (name, total, tallies) in enumerate(data):
        top = y + 14 + row * i
        parts.append(f'<text x="{x + label - 8}" y="{top + 14}" class="name">{name}</text>')
        for k, (kind, values, value) in enumerate([("recall", [t.recall for t in tallies], total.recall),
                                                   ("precision", [t.precision for t in tallies], total.precision)]):
            values = [v for v in values if v == v]
            if value != value:
                continue
            ty = top + 2 + 10 * k
            parts.append(f'<rect x="{at(0.5):.1f}" y="{ty}" width="{max(0.0, at(value) - at(0.5)):.1f}" height="9" class="{kind}"/>')
            parts.append(f'<line x1="{at(min(values)):.1f}" y1="{ty + 4.5}" x2="{at(max(values)):.1f}" y2="{ty + 4.5}" class="seeds"/>')
            parts.append(f'<text x="{x + width - 62}" y="{ty + 8}" class="value">{100 * value:.1f} %</text>')
    return bottom + 40


STYLE = ("text{font:11px sans-serif;fill:#222}.title{font:bold 14px sans-serif}.name{text-anchor:end}.tick{text-anchor:middle;"
         "fill:#777}.value{font-size:9px}.grid{stroke:#ddd}.bound{stroke:#c33;stroke-dasharray:4 3}.recall{fill:#3d7dd8}"
         ".precision{fill:#e8a33d}.seeds{stroke:#222;stroke-width:1.5}")


def plot(path, panels, subtitle):
    parts, y, width = [], 64, 760
    for title, data in panels:
        y = bars(parts, 20, y, width, title, data)
    head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width + 40}" height="{y}" viewBox="0 0 {width + 40} {y}">'
            f'<style>{STYLE}</style><rect width="100%" height="100%" fill="#fff"/>'
            f'<text x="20" y="24" class="title">People found within 5 m, busy</text><text x="20" y="42">{subtitle}; '
            'black: from the worst to the best seed; dashed: the bound</text>'
            f'<rect x="560" y="14" width="12" height="9" class="recall"/><text x="576" y="23">recall</text>'
            f'<rect x="640" y="14" width="12" height="9" class="precision"/><text x="656" y="23">precision</text>')
    beside = path.with_suffix(f".part{os.getpid()}")
    beside.write_text(head + "".join(parts) + "</svg>\n", encoding="utf-8")
    beside.rename(path)


def protocol(bench, options):
    count = options.seeds or (1 if options.slice else 8)
    minutes = 12 if options.slice else options.minutes or 15
    seeds = list(range(options.first_seed, options.first_seed + count))
    verdict = Verdict()
    panels = []
    for museum in MUSEUMS:
        print(f"\n## people, {museum}, busy, {count} seeds x {minutes:g} minutes, unknown start\n")
        cases, bands = museum_tables(museum, bench.all(museum, seeds, minutes), verdict)
        panels += [(museum, cases), (f"{museum}, by distance from the robot", bands)]
    path = bench.cache / ("people-slice.svg" if options.slice else "people.svg")
    plot(path, panels, f"{count} seeds x {minutes:g} minutes a museum")
    some = seeds[:CRIPPLED_SEEDS]
    for name, arguments in {} if options.slice else OTHER_FILTERS.items():
        print(f"\n## people, by the {name}, for comparison, {len(some)} seeds\n")
        print_table(["museum", *HEADER],
                    [cells(museum, [tally(run.in_map) for run in bench.all(museum, some, minutes, arguments)])
                     for museum in MUSEUMS])
    for name, arguments in {} if options.no_crippled else CRIPPLED.items():
        print(f"\n## people, crippled: {name}, {len(some)} seeds (must fail)\n")
        crippled = Verdict()
        museum_tables("bonn", bench.all("bonn", some, minutes, arguments), crippled)
        print()
        crippled.print()
        failed = [what for result, what, _ in crippled.rows if result == "FAIL"]
        verdict.want(f"crippled, {name} (must fail)", f"fails {len(failed)} bounds: {'; '.join(failed)}", bool(failed))
    print("\n## bounds\n")
    verdict.print()
    print(f"      drawn: {path}")
    return verdict
