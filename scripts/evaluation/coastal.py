"""Coastal against shortest ways [Minerva2000] 5.2 and Fig. 12: the same start and goal, the same crowd, the real localizer.

For each pair of places, drawn evenly over the Smithsonian's floor, and each reach of the lasers, `docent-lab plan` makes both
ways. The robot is walked along each of them amid an escort that hides about 60 % of the beams; what its sensors measured
is replayed through `localize`, which is told the start. What counts is the belief when the robot arrives.
"""
import json
import math
import os
import random
import statistics
import threading

from evaluation.claims import error_m, is_lost, mean, read_claims
from evaluation.programs import laboratory

MUSEUM = "smithsonian"
LOW, HIGH = (0.9, 0.9), (64.1, 39.1)  # [m] the museum's area lies inside
LEAST_WAY = 15.0  # [m] as the crow flies
REACHES = [10.0, 4.0, 2.5]  # [m] of today's laser, and of what a dense crowd or a sensor of 1998 leaves of it
ESCORT = "{count: 13, near: 0.4, far: 1.4}"
BLOCKED, BLOCKED_WITHIN = 0.60, 0.08
WEIGHT = 0.2  # [1/nat]
SPEED = 0.5  # [m/s]
ARRIVED = 0.5  # [m]
KINDS = ["shortest", "coastal"]
# "Not higher": the upper end of the 95 % interval of the difference lies below this. An interval that only reaches down to
# nought would be kept by any noise.
ENTROPY_MARGIN, ERROR_MARGIN, LOST_MARGIN = 0.25, 0.10, 0.05  # [nat], [m], share of the runs


class Runs:
    """Ways and claims, kept under a key of everything that decides them."""

    def __init__(self, bench, weight):
        self.bench, self.weight = bench, weight
        self.museum = bench.museums / MUSEUM
        self.hashes = {}  # configuration, by reach

    def kept(self, kind, what, make):
        path = self.bench.path(MUSEUM, kind, what)
        if not path.exists():
            part = path.with_suffix(f".part{os.getpid()}-{threading.get_ident()}")
            make(part)
            part.rename(path)
        return path

    def ways(self, start, goal, reach=None):
        """The shortest way, and with a reach the coastal one, as `docent-lab plan` writes them; None where the robot cannot be."""
        coast = [] if reach is None else ["--coastal", str(self.weight), "--range", str(reach), "--blocked", str(BLOCKED)]

        def make(part):
            try:
                self.bench.run([laboratory(self.bench.docent), "plan", "--museum", self.museum, "--from", "%.2f,%.2f" % start, "--to",
                                "%.2f,%.2f" % goal, "--ways", part, *coast])
            except RuntimeError as error:
                if "no room for the robot" not in str(error) and "no way from" not in str(error):
                    raise
                part.write_text("null")
        return json.loads(self.kept("ways.json", ["ways", start, goal, coast], make).read_text())

    def pair(self, number):
        """Two places that the robot can drive between; the same for every reach."""
        draw = random.Random(7000 + number)
        while True:
            start, goal = (tuple(round(draw.uniform(LOW[i], HIGH[i]), 2) for i in (0, 1)) for _ in range(2))
            if math.dist(start, goal) >= LEAST_WAY and self.ways(start, goal):
                return start, goal

    def claims(self, number, reach, way):
        """What the robot said on its way, from the start's heading on."""
        points = way["points"]
        towards = points[min(3, len(points) - 1)]
        start = "%.3f,%.3f,%.1f" % (*points[0], math.degrees(math.atan2(towards[1] - points[0][1], towards[0] - points[0][0])))
        seconds = 20.0 + way["length_m"] / (0.7 * SPEED)
        events = ["events:", f"  - {{at: 0, escort: {ESCORT}}}"]
        if reach < 10.0:
            events.append(f"  - {{at: 0, lasers: {{reach: {reach}}}}}")
        events.append(f"  - {{at: 4, steering: {{speed: {SPEED}, way: {json.dumps(points[1:])}}}}}")

        settings = [word for setting in [f"localize.sensor.max_range={reach}", *self.bench.settings] for word in ("--set", setting)]
        what = [number, events, start, seconds, settings]

        def make(part):
            scenario, record, report = (part.with_suffix(part.suffix + end) for end in (".yaml", ".mcap", ".json"))
            scenario.write_text("\n".join(events) + "\n")
            self.bench.run([self.bench.docent, "simulate", "--museum", self.museum, "--hours", f"{seconds / 3600:.6f}", "--seed",
                            str(9000 + number), "--crowd", "empty", "--start", start, "--scenario", scenario, "--world-only",
                            "--record", record, "--report", report, "--quiet", *settings])
            self.bench.run([self.bench.docent, "replay", record, "--museum", self.museum, "--modules", "localize", "--start",
                            start, "--claims", part, *settings])
            report.rename(self.bench.path(MUSEUM, "coast.json", what))
            scenario.unlink()
            record.unlink()
        claims = self.kept("coast.csv", what, make)
        with open(self.bench.path(MUSEUM, "coast.json", what), encoding="utf-8") as file:
            self.hashes.setdefault(reach, set()).add(json.load(file)["config_hash"])
        return read_claims(claims)

    def run(self, number, reach, kind):
        way = self.ways(*self.pair(number), reach)[kind]
        rows = self.claims(number, reach, way)
        goal = way["points"][-1]
        arrival = next((i for i, row in enumerate(rows) if math.dist((row["true_x"], row["true_y"]), goal) < ARRIVED), None)
        driven = rows[:len(rows) if arrival is None else arrival + 1]
        last = driven[-1]
        return {"arrived": arrival is not None, "entropy": last["entropy"], "error": error_m(last), "lost": is_lost(last),
                "was_lost": mean(map(is_lost, driven)), "blocked": mean(row["blocked"] for row in driven),
                "metres": last["distance"], "planned": way["length_m"], "foretold": way["entropy_at_goal"],
                "way_entropy": mean(row["entropy"] for row in driven)}


def interval(values):
    """Mean and half the width of its 95 % interval."""
    half = 1.96 * statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else float("inf")
    return mean(values), half


def correlation(a, b):
    try:
        return statistics.correlation(a, b)
    except statistics.StatisticsError:
        return float("nan")


def want_not_lost(verdict, name, fewer, span):
    verdict.want(f"{name}: lost at the goal no more often by the coast (95 % below {100 * LOST_MARGIN:.0f} %)",
                 f"{100 * fewer:+.0f} ± {100 * span:.0f} %", fewer + span <= LOST_MARGIN)


def evaluate(bench, verdict, print_table, count, reaches, weight, is_slice=False):
    runs = Runs(bench, weight)
    print(f"\n## {MUSEUM}, {count} pairs of places, an escort of 13, weight {weight:g}\n")
    bench.each([lambda n=n: runs.pair(n) for n in range(count)])
    rows, paired = [], []
    for reach in reaches:
        jobs = [lambda n=n, k=kind: runs.run(n, reach, k) for n in range(count) for kind in KINDS]
        results = bench.each(jobs)
        of_kind = {kind: results[i::2] for i, kind in enumerate(KINDS)}
        both = [(s, c) for s, c in zip(of_kind["shortest"], of_kind["coastal"]) if s["arrived"] and c["arrived"]]
        ratio = mean(c["metres"] / s["metres"] for s, c in both)
        for i, kind in enumerate(KINDS):
            found = [pair[i] for pair in both]
            errors = sorted(run["error"] for run in found)
            rows.append([f"{reach:g}", kind, len(found), f"{100 * mean(run['blocked'] for run in found):.0f}",
                         f"{mean(run['entropy'] for run in found):.2f}",
                         f"{statistics.stdev(run['entropy'] for run in found):.2f}" if len(found) > 1 else "-",
                         f"{mean(run['foretold'] for run in found):.2f}", f"{100 * mean(errors):.1f}",
                         f"{100 * statistics.stdev(errors):.1f}" if len(errors) > 1 else "-",
                         f"{100 * errors[int(0.95 * len(errors))]:.0f}", f"{100 * mean(run['lost'] for run in found):.0f}",
                         f"{100 * mean(run['was_lost'] for run in found):.1f}",
                         f"{mean(run['metres'] for run in found):.1f}", f"{ratio:.2f}" if kind == "coastal" else "1"])
        fall, half = interval([c["entropy"] - s["entropy"] for s, c in both])
        nearer, width = interval([c["error"] - s["error"] for s, c in both])
        fewer, span = interval([float(c["lost"]) - float(s["lost"]) for s, c in both])
        seldom, spread = interval([c["was_lost"] - s["was_lost"] for s, c in both])
        lower = sum(c["entropy"] < s["entropy"] for s, c in both)
        said = correlation([c["foretold"] - s["foretold"] for s, c in both], [c["entropy"] - s["entropy"] for s, c in both])
        paired.append([f"{reach:g}", len(both), f"{fall:+.2f} ± {half:.2f}", f"{lower} of {len(both)}",
                       f"{100 * nearer:+.1f} ± {100 * width:.1f}", f"{100 * fewer:+.0f} ± {100 * span:.0f}",
                       f"{100 * seldom:+.1f} ± {100 * spread:.1f}", f"{said:.2f}"])
        name = f"lasers of {reach:g} m"
        arrived = [run["arrived"] for run in results]
        blocked = mean(run["blocked"] for run in results)
        verdict.want_one_configuration(runs.hashes[reach], f"{name}; localize.sensor.max_range says so")
        verdict.want(f"{name}: walked to the goal, at least 90 %", f"{100 * mean(arrived):.0f} % of {len(arrived)} runs",
                     mean(arrived) >= 0.9)
        verdict.want(f"{name}: {100 * BLOCKED:.0f} % of the beams blocked, within {100 * BLOCKED_WITHIN:.0f}",
                     f"{100 * blocked:.0f} %", abs(blocked - BLOCKED) <= BLOCKED_WITHIN)
        if is_slice:  # too few for intervals
            verdict.want(f"{name}: entropy at the goal lower by the coast, on average", f"{fall:+.2f} ± {half:.2f} nat", fall < 0.0)
        elif reach < 10.0:
            verdict.want(f"{name}: entropy at the goal lower by the coast (95 %)", f"{fall:+.2f} ± {half:.2f} nat",
                         fall + half < 0.0)
            # A robot that arrives beside a wall finds the last centimetres there, whichever way it came.
            verdict.want(f"{name}: error at the goal not higher by the coast (95 % below {100 * ERROR_MARGIN:.0f} cm)",
                         f"{100 * nearer:+.1f} ± {100 * width:.1f} cm", nearer + width <= ERROR_MARGIN)
            want_not_lost(verdict, name, fewer, span)
            verdict.want(f"{name}: lost on the way less often by the coast (95 %)",
                         f"{100 * seldom:+.1f} ± {100 * spread:.1f} % of the updates", seldom + spread < 0.0)
        else:
            # A laser that looks all round and far, in a museum full of walls: there is little to win, and nothing may be lost.
            verdict.want(f"{name}: entropy at the goal not higher by the coast (95 % below {ENTROPY_MARGIN} nat)",
                         f"{fall:+.2f} ± {half:.2f} nat", fall + half <= ENTROPY_MARGIN)
            want_not_lost(verdict, name, fewer, span)
    print_table(["reach m", "way", "runs", "blocked %", "entropy nat", "sd", "foretold", "error cm", "sd", "95 %", "lost %",
                 "lost on the way %", "driven m", "ratio"], rows)
    print("\nThe coast less the shortest way, pair by pair, with 95 % intervals:\n")
    print_table(["reach m", "pairs", "entropy nat", "lower in", "error cm", "lost %", "lost on the way %",
                 "correlation with what was foretold"], paired)
