"""What a museum is told of its days, held against what happened: parts of days in both museums, busy, with people who wish for tours.

The web module counts as in a museum, into its own database. Its sums must be those of the run's event log and request log, and its rows
of stops those of the log, one by one. How many people it saw at a stop is held against the truth: the persons who truly were within 3 m
of the robot for at least eight of the last ten seconds of what it told there. Whoever walks past is none of them, whoever stands hidden
behind others is one. What came in the last seconds of a run is not yet stored.
"""
import collections
import csv
import os
import shutil
import socket
import sqlite3
import statistics
import subprocess
import sys
import time

from evaluation.programs import program_for
from evaluation.tables import Verdict, print_table

MUSEUMS = ["bonn", "smithsonian"]
SEEDS, SLICE_SEEDS = 4, 1
MINUTES, SLICE_MINUTES = 60.0, 20.0
TOURS_EVERY = 300.0  # [s] somebody wishes for one
STORED_EVERY = 11.0  # [s] at the most: what came later may be missing
ROUND, WINDOW, STAYS = 3.0, 10.0, 0.8  # [m, s, share of the window]
LEAST_TOURS, RIGHT = 10, 0.8
SUMS = {"tours": ("tour_completed",), "tours_failed": ("tour_failed",), "tours_broken": ("tour_broken_off",), "exhibits": ("explained",),
        "points": ("point_reached",), "plan_revisions": ("plan_inserted", "plan_removed", "plan_rescheduled", "plan_shortened")}
SOURCES = ("web", "kiosk", "visitor", "staff", "vote")
ENDS = ("fulfilled", "failed")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Run:
    """One run: its logs, what is in its database, and its report."""

    def __init__(self, folder):
        self.events = [dict(row, time=float(row["time"])) for row in rows_of(folder / "events.csv")]
        self.requests = rows_of(folder / "requests.csv")
        self.people = collections.defaultdict(list)  # time of a sample: (person, m away)
        for row in rows_of(folder / "people.csv"):
            if row["frame"] == "map":
                sample = self.people[float(row["time"])]
                if row["kind"] == "person":
                    sample.append((row["id"], float(row["away"])))
        with sqlite3.connect(folder / "web.sqlite") as database:
            self.sums = dict(database.execute("SELECT what, SUM(amount) FROM day_counts GROUP BY what"))
            self.stops = list(database.execute("SELECT tour_began, stop, tour, exhibit, people FROM attendance ORDER BY tour_began, stop"))
        self.end = max(row["time"] for row in self.events)

    def happened(self, *kinds):
        return [row for row in self.events if row["source"] == "event" and row["kind"] in kinds]

    def between(self, rows):
        """How many must have been counted, and how many may."""
        times = [float(row["time"]) for row in rows]
        return sum(time <= self.end - STORED_EVERY for time in times), len(times)

    def asked(self, source):
        return [row for row in self.requests if row["what"] == "asked" and row["source"] == source]

    def ended(self, how):
        return [row for row in self.requests if row["what"] == "board" and row["state"] == how]

    def expected(self):
        """By name of a sum: (least, most)."""
        limits = {name: self.between(self.happened(*kinds)) for name, kinds in SUMS.items()}
        limits |= {source: self.between(self.asked(source)) for source in SOURCES}
        return limits | {how: self.between(self.ended(how)) for how in ENDS}

    def told(self):
        """Stops of tours that were told to their end: (time, number of the tour, stop from 1, tour, exhibit)."""
        found, number, stop = [], 0, 0
        for row in self.happened("tour_started", "explained"):
            if row["kind"] == "tour_started":
                number, stop = number + 1, 0
            elif row["detail"]:
                stop += 1
                found.append((row["time"], number, stop, row["detail"], row["subject"]))
        return found

    def truth_at(self, at):
        """How many truly stood round it; None where nobody was looked at."""
        samples = [people for when, people in self.people.items() if at - WINDOW <= when <= at]
        if not samples:
            return None
        near = collections.Counter(person for people in samples for person, away in people if away <= ROUND)
        return sum(count >= STAYS * len(samples) for count in near.values())


def run(simulations, museum, seed, minutes):
    """Kept under a key of all that decides it."""
    folder = simulations.cache / "counts" / f"{museum.name}-seed{seed}-{minutes:g}-{simulations.key(museum)[:16]}"
    if not (folder / "web.sqlite").exists():
        part = folder.with_suffix(f".part{os.getpid()}")
        shutil.rmtree(part, ignore_errors=True)
        part.mkdir(parents=True)
        known = [line.split("id:")[1].split(",")[0].strip() for line in tours_in(museum)]
        events = "".join(f"  - {{at: {30 + i * TOURS_EVERY:.0f}, request: {{kind: tour, target: {known[i % len(known)]}, source: kiosk, language: en}}}}\n"
                         for i in range(int(minutes * 60 / TOURS_EVERY)))
        (part / "scenario.yaml").write_text("events:\n" + events, encoding="utf-8")
        started = time.monotonic()
        # As fast as it goes, with the page's server, which nobody visits.
        command = [program_for(simulations.docent, []), "simulate", "--museum", museum, "--hours", f"{minutes / 60:.6f}", "--seed", str(seed),
                   "--crowd", "busy", "--time-of-day", "10:00", "--scenario", part / "scenario.yaml", "--port", str(free_port()), "--pace", "1000",
                   "--state", part, "--event-log", part / "events.csv", "--request-log", part / "requests.csv",
                   "--people-log", part / "people.csv", "--report", part / "report.json", "--quiet"]
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{museum.name} seed {seed}: docent simulate exited {done.returncode}: {done.stderr.strip()[-400:]}")
        part.rename(folder)
        print(f"   {museum.name} seed {seed}, {minutes:g} min: {time.monotonic() - started:.0f} s", file=sys.stderr)
    return Run(folder)


def tours_in(museum):
    """The lines of museum.yaml that begin a tour."""
    lines = (museum / "museum.yaml").read_text(encoding="utf-8").splitlines()
    begin = lines.index("tours:")
    tours = []
    for line in lines[begin + 1:]:
        if not line.startswith("  "):
            break
        tours.append(line)
    return tours


def tours_of(runs):
    """Of each tour with stops: [(counted, true)]."""
    tours = []
    for one in runs:
        by_tour = collections.defaultdict(list)
        for (_, _, _, _, counted), (at, number, *_) in zip(one.stops, one.told()):
            truth = one.truth_at(at)
            if truth is not None:
                by_tour[number].append((counted, truth))
        tours += by_tour.values()
    return tours


def is_right(tour):
    """Within one person, in the mean of its stops."""
    return abs(statistics.mean(counted - truth for counted, truth in tour)) <= 1.0


def protocol(simulations, options):
    seeds = range(options.first_seed, options.first_seed + (options.seeds or (SLICE_SEEDS if options.slice else SEEDS)))
    minutes = options.minutes or (SLICE_MINUTES if options.slice else MINUTES)
    museums = options.museums.split(",") if options.museums else MUSEUMS[:1] if options.slice else MUSEUMS
    cells = [(museum, seed) for museum in museums for seed in seeds]
    runs = dict(zip(cells, simulations.each(run, [(simulations, simulations.museums / museum, seed, minutes) for museum, seed in cells])))
    verdict, table = Verdict(), []
    for museum in museums:
        ours = [runs[museum, seed] for seed in seeds]
        wrong = [f"{name} {one.sums.get(name, 0):g}, not {low} to {most}" for one in ours for name, (low, most) in one.expected().items()
                 if not low <= one.sums.get(name, 0) <= most]
        happened = sum(most for one in ours for _, most in one.expected().values())
        verdict.want(f"{museum}: sums that are not those of the log (none)", f"{'; '.join(wrong) or 0}, of {happened} things that happened",
                     not wrong and happened > 0)
        pairs, missed = 0, []
        for one in ours:
            told = one.told()
            least = sum(at <= one.end - STORED_EVERY for at, *_ in told)
            if not least <= len(one.stops) <= len(told):
                missed.append(f"{len(one.stops)} rows of {len(told)} stops")
            for (_, stop, tour, exhibit, _), (at, _, number, of_tour, shown) in zip(one.stops, told):
                pairs += 1
                if (stop, tour, exhibit) != (number, of_tour, shown):
                    missed.append(f"{stop} {tour} {exhibit} at {at:.0f} s is {number} {of_tour} {shown}")
        verdict.want(f"{museum}: rows of stops that are not those of the log (none)", f"{'; '.join(missed[:3]) or 0}, of {pairs}",
                     pairs > 0 and not missed)
        tours = tours_of(ours)
        stops = [pair for tour in tours for pair in tour]
        errors = [counted - truth for counted, truth in stops]
        table.append([museum, len(ours), f"{minutes:g}", len(tours), len(stops), f"{statistics.mean(t for _, t in stops):.1f}" if stops else "-",
                      f"{statistics.mean(errors):+.2f}" if stops else "-", f"{statistics.pstdev(errors):.2f}" if stops else "-",
                      f"{sum(abs(error) <= 1 for error in errors)} of {len(errors)}", f"{sum(map(is_right, tours))} of {len(tours)}",
                      f"{sum(all(abs(c - t) <= 1 for c, t in tour) for tour in tours)} of {len(tours)}"])
    print("\n## What is counted\n")
    print_table(["museum", "runs", "min", "tours", "stops", "people at a stop", "error", "spread", "stops within one", "tours within one",
                 "in all their stops"], table)
    print()
    tours = tours_of(runs.values())
    right = sum(map(is_right, tours))
    least = 3 if options.slice else LEAST_TOURS
    verdict.want(f"tours whose people are counted within one, at least {100 * RIGHT:g} % of at least {least}",
                 f"{right} of {len(tours)}, {100 * right / max(1, len(tours)):.0f} %", len(tours) >= least and right >= RIGHT * len(tours))
    verdict.print()
    return verdict
