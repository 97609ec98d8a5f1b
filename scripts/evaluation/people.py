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

from evaluation import figures
from evaluation.programs import program_for
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
BODIES = "legs"
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
        arguments = ["--bodies", BODIES, *arguments]
        key = hashlib.sha256(json.dumps([self.keys[museum], seed, minutes, arguments]).encode()).hexdigest()[:16]
        path = self.cache / f"{museum}-seed{seed}-{key}.csv"
        if not path.exists():
            part = path.with_suffix(f".part{os.getpid()}")
            started = time.monotonic()
            done = subprocess.run([program_for(self.docent, arguments), "simulate", "--museum", self.museums / museum, "--hours",
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


def bars(axes, title, data):
    """Recall and precision of each row of data, with the seeds' spread."""
    from matplotlib.patches import Patch

    thickness = 0.38
    for kind, color, side in (("recall", figures.BLUE, -1), ("precision", figures.ORANGE, 1)):
        for i, (_, total, tallies) in enumerate(data):
            value = getattr(total, kind)
            if value != value:  # nobody was there
                continue
            seeds = [seed for seed in (getattr(tally, kind) for tally in tallies) if seed == seed]
            at = i + 0.5 * side * thickness
            axes.barh(at, 100 * value, thickness, color=color)
            axes.plot([100 * min(seeds), 100 * max(seeds)], [at, at], color=figures.INK, linewidth=1.2)
            axes.text(100.5, at, f"{100 * value:.1f} %", fontsize=6.5, verticalalignment="center")
    axes.axvline(100 * BOUND, color=figures.RED, linewidth=0.9, linestyle=figures.DASHED)
    axes.set(xlim=(50.0, 100.0), ylim=(len(data) - 0.5, -0.5), yticks=range(len(data)), yticklabels=[name for name, _, _ in data],
             xlabel="share of the seconds [%]")
    axes.set_title(title, loc="left")
    axes.grid(axis="x")
    return [Patch(color=figures.BLUE, label="recall"), Patch(color=figures.ORANGE, label="precision")]


def plot(path, panels, subtitle):
    def fill(figure):
        from matplotlib.lines import Line2D

        heights = [len(data) + 1.0 for _, data in panels]
        every = figures.under_legend(figure).subplots(len(panels), 1, squeeze=False, gridspec_kw={"height_ratios": heights})
        for axes, (title, data) in zip(every.flat, panels):
            samples = bars(axes, title, data)
        samples.append(Line2D([], [], color=figures.INK, linewidth=1.2, label="from the worst to the best seed"))
        samples.append(Line2D([], [], color=figures.RED, linewidth=0.9, linestyle=figures.DASHED, label=f"bound, {100 * BOUND:.0f} %"))
        figures.legend(figure, f"People found within 5 m, busy; {subtitle}", samples)

    figures.draw(path, (figures.WIDTH, 0.6 + sum(0.75 + 0.3 * len(data) for _, data in panels)), fill)


def protocol(bench, options):
    count = options.seeds or (1 if options.slice else 8)
    minutes = 6 if options.slice else options.minutes or 15
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
