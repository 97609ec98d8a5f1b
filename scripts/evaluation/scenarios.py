"""Blocked ways, ten seeds each: what the robot must do and by when, in a small annex that is drawn for it; and crippled robots, which
must fail. A seed draws where the robot starts, what its sensors and wheels do, and what people make of it."""
import concurrent.futures
import csv
import hashlib
import json
import os
import random
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass, field

from evaluation import reports
from evaluation.keys import key_of
from evaluation.programs import program_for, programs_of
from evaluation.tables import Verdict, print_table

REQUEST = 60.0  # [s] when the first wish is made, in every scenario
AGAIN = 240.0  # [s] when it is made again, of a blocked way
POSES = {  # as in museum.head.yaml of each world
    "annex": {"clock": (2.8, 10.1), "globe": (15.3, 9.4), "lantern": (17.0, 2.2)},
    "two-ways": {"clock": (2.8, 10.1), "globe": (10.05, 3.7)},
}
SEEDS, CRIPPLED_SEEDS = 10, 3


class Run:
    """One run: its report, its events in order of time, and when the first thing put up was seen and mapped."""

    def __init__(self, report, events, things, poses):
        self.report, self.poses = report, poses
        self.thing = {row["what"]: float(row["time"]) for row in things if row["thing"] == "0"}
        self.events = [dict(row, time=float(row["time"]), x=float(row["x"]), y=float(row["y"])) for row in events]

    def first(self, source, kind, after=0.0, about=""):
        """Time of the first such event; None where there is none. `about`: in its subject."""
        return next((row["time"] for row in self.events if row["source"] == source and row["kind"] == kind
                     and row["time"] >= after and about in row["subject"]), None)

    def arrived(self, exhibit, begin=0.0):
        """When it said to be there and truly was, within 1 m."""
        x, y = self.poses[exhibit]
        return next((row["time"] for row in self.events if row["source"] == "event" and row["kind"] == "arrived" and row["time"] >= begin
                     and row["subject"] == exhibit and (row["x"] - x) ** 2 + (row["y"] - y) ** 2 <= 1.0), None)

    def blocked(self):
        """When its way was blocked first on the way to what was asked for."""
        times = [t for t in (self.first("reaction", kind, REQUEST) for kind in ("slow", "wait")) if t is not None]
        return min(times) if times else None

    def mapped(self, sensor):
        """[s] from when a sensor saw the thing to when the live map had it."""
        return after(self.thing.get("mapped"), self.thing.get(sensor))

    def unmapped(self, sensor):
        """[s] from when a sensor looked where the thing had stood to when the live map had it no more; 0: it had forgotten it before."""
        seen, gone = self.thing.get(sensor), self.thing.get("unmapped")
        return None if seen is None or gone is None else max(0.0, gone - seen)

    def kept_until_seen_gone(self):
        gone = [time for what, time in self.thing.items() if what.endswith("_gone")]
        return 1 if gone and self.thing.get("unmapped", 0.0) >= min(gone) else 0

    def goes_round(self):
        """When it first planned a detour by another way because of what the live map has."""
        return self.first("way", "global", REQUEST)

    def looks_along_the_way(self):
        """Reactions to a blocked way, and those of them at which the head showed where the robot wants to go."""
        rows = [row for row in self.events if row["source"] == "reaction" and row["kind"] in ("horn", "wait", "ask")]
        return len(rows), sum(row["gaze"] == "way" for row in rows)


def after(later, earlier):
    return None if later is None or earlier is None else later - earlier


@dataclass
class Duty:
    """What must happen, and by when."""
    what: str
    bound: float  # [s]
    seconds: object  # of a Run; None: it did not happen


@dataclass
class Scenario:
    minutes: float
    duties: list
    crippled: dict = field(default_factory=dict)  # name: settings
    floors: dict = field(default_factory=dict)  # what its crowd must do to the robot, a seed on average; without the crowd it fails
    crowd: str = ""  # the event that brings this crowd
    world: str = "annex"
    people: tuple = ("quiet", 2)


SLICE_FLOORS = 0.5  # of the floors, which are of a mean over seeds, is asked of a single one
KEPT = "things in the live map until seen gone"
FEWEST_OF_SOME = 4  # seeds, also in a slice
LOOKS = 0.95  # of the reactions show the wanted direction

BLIND = {"blind to people": ["evaluation.blind_to_people=true"]}
BLIND_TO_ALL = {"blind to whatever stands there": ["evaluation.blind_to_people=true", "evaluation.ignores_live_map=true"]}
NO_LADDER = {"without the ladder": ["evaluation.without_ladder=true"]}

SCENARIOS = {
    "u-shape": Scenario(5, [
        Duty("at the clock, after the request", 120, lambda run: after(run.arrived("clock"), REQUEST)),
    ], {"without the live map": ["evaluation.ignores_live_map=true"]}),
    "people-wall": Scenario(6, [
        Duty("blows the horn, after the way was blocked", 8, lambda run: after(run.first("reaction", "horn", REQUEST), run.blocked())),
        Duty("at the globe, after the way was blocked", 150, lambda run: after(run.arrived("globe"), run.blocked())),
    ], NO_LADDER, {"passes within 1 m": 1, "horns": 1}),
    "stool": Scenario(4, [
        Duty("at the globe, after the request", 100, lambda run: after(run.arrived("globe"), REQUEST)),
    ], BLIND_TO_ALL),
    "low-stool": Scenario(4, [
        Duty("at the globe, after the request", 100, lambda run: after(run.arrived("globe"), REQUEST)),
    ]),
    **{name: Scenario(8, [
        Duty(f"in the live map, after a {sensor} saw it", in_map, lambda run, sensor=sensor: run.mapped(sensor)),
        Duty("plans to go round, after it was in the live map", 30, lambda run: after(run.goes_round(), run.thing.get("mapped"))),
        Duty("at the globe by the other way, after the request", 150, lambda run: after(run.arrived("globe"), REQUEST)),
        Duty(f"out of the live map, after a {sensor} saw it gone", out_of_map, lambda run, sensor=sensor: run.unmapped(f"{sensor}_gone")),
        Duty("at the globe again, after the second request", 150, lambda run: after(run.arrived("globe", AGAIN), AGAIN)),
    ], {"without the live map": ["evaluation.ignores_live_map=true"]}, {"passes within 1 m": 1, KEPT: 0.5}, world="two-ways", people=("busy", 8))
       for name, sensor, in_map, out_of_map in (("blocked-way", "laser", 2, 10), ("blocked-way-low", "cone", 5, 30))},
    "closed-passage": Scenario(17, [
        Duty("asks, after the way was blocked", 25, lambda run: after(run.first("reaction", "ask", REQUEST), run.blocked())),
        Duty("gives up for now, after the way was blocked", 130,
             lambda run: after(run.first("reaction", "give_up", REQUEST), run.blocked())),
        Duty("shows the clock meanwhile, after its request", 240, lambda run: after(run.arrived("clock"), 80.0)),
        Duty("at the globe, after the passage was opened", 320, lambda run: after(run.arrived("globe"), 650.0)),
    ], NO_LADDER, {"s blocked": 60, "horns": 8}),
    "staircase": Scenario(7, [
        Duty("at the lantern, after the request", 280, lambda run: after(run.arrived("lantern"), REQUEST)),
    ], {"hazards ignored": ["evaluation.ignores_hazards=true"]}, {"s blocked": 40, "bumps": 1}, "pushers"),
    "children": Scenario(7, [
        Duty("at the clock, after the request", 150, lambda run: after(run.arrived("clock"), REQUEST)),
        Duty("at the globe, after its request", 250, lambda run: after(run.arrived("globe"), 100.0)),
    ], BLIND, {"passes within 1 m": 20}, "runners"),
}


class Annex:
    """Runs in one of the worlds beside the scenarios, kept under a key of the program, the museum and the scenario."""

    def __init__(self, docent, root, cache, jobs, world):
        self.docent, self.scenarios, self.jobs = docent, root / "scripts" / "scenarios", jobs
        self.cache = cache / "scenarios"
        self.world = world
        self.key = key_of(*programs_of(docent), self.scenarios / world)
        self.museum = self.cache / f"{world}-{self.key}"
        if not (self.museum / "museum.yaml").exists():
            self.draw()

    def draw(self):
        """Surveys the world: the robot gets a map and hazards with the small errors that a survey has."""
        (self.museum / "content").mkdir(parents=True, exist_ok=True)
        world = (self.scenarios / self.world / "simulation.yaml").read_text()
        (self.museum / "simulation.yaml").write_text(world)
        subprocess.run([self.docent, "survey", "--world", self.museum / "simulation.yaml", "--seed", "7", "--out", self.museum],
                       check=True, stdout=subprocess.DEVNULL)
        for exhibit in POSES[self.world]:
            (self.museum / "content" / f"{exhibit}.short.en.md").write_text(f"This is the {exhibit} of the museum.\n")
        head = (self.scenarios / self.world / "museum.head.yaml").read_text()
        (self.museum / "museum.yaml").write_text(head + (self.museum / "hazards.yaml").read_text())

    def run(self, name, seed, settings, without=""):
        """@param without  the kind of event that is left out"""
        text = (self.scenarios / f"{name}.yaml").read_text()
        if without:
            text = "".join(line for line in text.splitlines(keepends=True) if f" {without}:" not in line)
        what = [self.key, text, SCENARIOS[name].minutes, seed, settings]
        path = self.cache / f"{name}-seed{seed}-{hashlib.sha256(json.dumps(what).encode()).hexdigest()[:16]}.json"
        log, things = path.with_suffix(".csv"), path.with_suffix(".things.csv")
        if not path.exists() or not log.exists() or not things.exists():
            crowd, people = SCENARIOS[name].people
            draw = random.Random(f"annex {seed}")
            start = f"{draw.uniform(1.3, 5.0):.2f},{draw.uniform(1.5, 4.0):.2f},{draw.uniform(-180, 180):.0f}"
            part, part_log = path.with_suffix(f".part{os.getpid()}"), path.with_suffix(f".part{os.getpid()}.csv")
            part_things = path.with_suffix(f".part{os.getpid()}.things.csv")
            scenario = path.with_suffix(f".part{os.getpid()}.yaml")
            scenario.write_text(text)
            began = time.monotonic()
            done = subprocess.run([program_for(self.docent, settings), "simulate", "--museum", self.museum, "--scenario", scenario, "--hours",
                                   f"{SCENARIOS[name].minutes / 60:.6f}", "--seed", str(seed), "--crowd", crowd, "--people", str(people),
                                   "--requests-per-hour", "0", f"--start={start}", "--report", part, "--event-log", part_log, "--thing-log", part_things,
                                   "--quiet", *(word for setting in settings for word in ("--set", setting))],
                                  capture_output=True, text=True, check=False)
            scenario.unlink()
            if done.returncode != 0:
                raise RuntimeError(f"{name}, seed {seed}: docent simulate exited {done.returncode}: {done.stderr.strip()[-400:]}")
            part_log.rename(log)
            part_things.rename(things)
            part.rename(path)
            print(f"   {name} seed {seed}: {time.monotonic() - began:.0f} s", file=sys.stderr)
        with open(log, newline="", encoding="utf-8") as events, open(things, newline="", encoding="utf-8") as seen:
            return Run(json.loads(path.read_text()), list(csv.DictReader(events)), list(csv.DictReader(seen)), POSES[self.world])

    def runs(self, name, seeds, settings=(), without=""):
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            return list(pool.map(lambda seed: self.run(name, seed, list(settings), without), seeds))


def contacts_of(run):
    return reports.contacts_of(run.report)


EXPOSURES = {  # of a run
    "passes within 1 m": lambda run: run.report["passes_within_1m"],
    "s blocked": lambda run: run.report["blocked"]["seconds"],
    "horns": lambda run: run.report["blocked"]["horn"],
    "bumps": lambda run: run.report["bumped_by_people"],
    KEPT: lambda run: run.kept_until_seen_gone(),
}


def exposures_of(name, runs, share):
    """What its crowd did to the robot, a seed on average, and whether that was enough: this share of the floors."""
    floors = {what: share * floor for what, floor in SCENARIOS[name].floors.items()}
    seen = {what: statistics.mean(EXPOSURES[what](run) for run in runs) for what in floors}
    words = ", ".join(f"{seen[what]:.1f} {what} ({floor:g})" for what, floor in floors.items())
    return words, all(seen[what] >= floor for what, floor in floors.items())


def faults_of(name, run):
    """What a run did not do in time, or did and must not."""
    faults = [f"touched {contacts_of(run)}"] if contacts_of(run) else []
    if run.report["area_violations"]:
        faults.append("left its area")
    for duty in SCENARIOS[name].duties:
        seconds = duty.seconds(run)
        if seconds is None or seconds > duty.bound:
            faults.append(f"{duty.what}: {'never' if seconds is None else f'{seconds:.0f} s'}")
    return faults


def rows_of(name, runs):
    rows = []
    for duty in SCENARIOS[name].duties:
        seen = [duty.seconds(run) for run in runs]
        times = sorted(float("inf") if s is None else s for s in seen)
        text = lambda s: "never" if s == float("inf") else f"{s:.0f}"
        rows.append([name, duty.what, f"{duty.bound:g}", text(statistics.median_low(times)), text(times[-1]),
                     f"{sum(s <= duty.bound for s in times)}/{len(times)}"])
    return rows


def exposure_of(name, runs):
    blocked = [run.report["blocked"] for run in runs]
    return [name, f"{sum(run.report['distance_m'] for run in runs) / 1000:.2f}",
            sum(run.report["passes_within_1m"] for run in runs), sum(map(contacts_of, runs)),
            sum(run.report["area_violations"] for run in runs), sum(run.report["bumped_by_people"] for run in runs),
            sum(b["horn"] for b in blocked), sum(b["local_detours"] for b in blocked), sum(b["global_detours"] for b in blocked),
            f"{sum(b['seconds'] for b in blocked):.0f}"]


def protocol(simulations, options):
    worlds = {world: Annex(simulations.docent, simulations.root, simulations.cache, options.jobs, world) for world in POSES}
    runs_of = lambda name, *arguments, **keywords: worlds[SCENARIOS[name].world].runs(name, *arguments, **keywords)
    names = [options.part] if options.part else list(SCENARIOS)
    count = options.seeds or (1 if options.slice else SEEDS)
    seeds = list(range(options.first_seed, options.first_seed + count))
    # In half of the runs the live map loses the thing before its place is seen: one seed would tell nothing of the other half.
    seeds_of = {name: list(range(options.first_seed, options.first_seed + max(count, FEWEST_OF_SOME if KEPT in SCENARIOS[name].floors else 1)))
                for name in names}
    share = SLICE_FLOORS if options.slice else 1.0
    verdict = Verdict()
    runs = {name: runs_of(name, seeds_of[name]) for name in names}
    print(f"\n## what the robot must do, {count} seed{'s' if count > 1 else ''} each\n")
    print_table(["scenario", "what", "by s", "median", "worst", "in time"], [row for name in names for row in rows_of(name, runs[name])])
    print("\n## exposure\n")
    print_table(["scenario", "km", "passes", "contacts", "area", "bumped", "horn", "local", "global", "blocked s"],
                [exposure_of(name, runs[name]) for name in names])
    print()
    for name in names:
        bad = {seed: faults for seed, run in zip(seeds_of[name], runs[name]) if (faults := faults_of(name, run))}
        km = sum(run.report["distance_m"] for run in runs[name]) / 1000
        verdict.want(f"{name}: all it must, nothing touched, never outside", f"{len(runs[name]) - len(bad)} of {len(runs[name])} seeds, {km:.2f} km"
                     + "".join(f"; seed {seed}: {', '.join(faults)}" for seed, faults in bad.items()), not bad)
        if SCENARIOS[name].floors:
            words, enough = exposures_of(name, runs[name], share)
            verdict.want(f"{name}: what was in the way, a seed on average", words, enough)
    looks = [run.looks_along_the_way() for name in names for run in runs[name]]
    shown, total = sum(good for _, good in looks), sum(n for n, _ in looks)
    least = count * sum(SCENARIOS[name].floors.get("horns", 0) for name in names)
    if least > 0:
        verdict.want(f"the head shows the wanted direction at horn, wait and ask ({100 * LOOKS:.0f} %, of at least {least})",
                     f"{shown} of {total}", total >= least and shown >= LOOKS * total)
    verdict.want_one_configuration(run.report["config_hash"] for name in names for run in runs[name])
    if not options.no_crippled:
        judge_crippled(runs_of, names, seeds[:CRIPPLED_SEEDS], share, verdict)
    verdict.print()
    return verdict


def judge_crippled(runs_of, names, seeds, share, verdict):
    """Each must fail what the whole robot passes, with most of the seeds."""
    for name in names:
        for how, settings in SCENARIOS[name].crippled.items():
            failed = [faults_of(name, run) for run in runs_of(name, seeds, settings)]
            first = next((", ".join(faults) for faults in failed if faults), "nothing")
            verdict.want(f"{name}, crippled: {how} (must fail)", f"fails {sum(map(bool, failed))} of {len(seeds)}: {first}",
                         2 * sum(map(bool, failed)) > len(seeds))
        if SCENARIOS[name].crowd:
            words, enough = exposures_of(name, runs_of(name, seeds, without=SCENARIOS[name].crowd), share)
            verdict.want(f"{name}, without its {SCENARIOS[name].crowd} (must fall short)", words, not enough)
