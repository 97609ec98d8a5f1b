"""Scanners that work and say what is not so: other units, nothing at all, a blind sector, nothing where something is too near,
an offset, a factor, old sweeps. Each on the front scanner, the rear one and both, beginning while the robot drives, and from
the first sweep on at a place that it does not know. It must touch nothing, and name the scanner within SAID_S: of a lie that
begins in a drive from then on; of one from the start from when it can be known: the first movement; for old sweeps, which show nothing
of a turn before it is as old as they are, TURNED_DEG of turn or MOVED_M of way; for robots without a ring, factors and offsets MOVED_M of
way; of what is too near from when it is, if it stays for SAID_S.

The same from the start with other robots (part `bare`): one laser or two and nothing else that hears walls. Runs without a lie, in two museums and two crowds, and runs in which the robot is carried off every CARRIED_EVERY_S, count false
alarms. A robot without watches must fail.
"""
import random
import statistics

from evaluation.bounds import bounded
from evaluation.faults import CRIPPLED, Bench as FaultBench, count_passes, moments, seconds
from evaluation.tables import Verdict, print_table

SAID_S = 1.0  # [s]
MINUTES = 2.0  # of an unharmed run, in which lies begin
ALARM_MINUTES = 15.0
CARRIED_EVERY_S = 45.0
CARRIED_MINUTES = 4.0  # of such a run in a slice
WATCHED_S = 12.0  # [s] after a lie has begun
NEAR_WATCHED_S = 60.0  # [s]: until something comes near
STARTS_S = 45.0  # [s] of a run that begins with a lie
MOVES = 0.02  # [m/s]
TURNED_DEG = 20.0
MOVED_M = 0.3
BARE = {  # robots without sonars and infrared sensors, and the lasers that lie
    "one laser": (["--robot", "turtlebot.yaml"], ["front"]),
    "two lasers": (["--set", "body.sonars=0", "--set", "body.infrareds=0"], ["front", "both"]),
}
BARE_KINDS = ["units", "silent", "sector", "offset", "scaled", "stale"]
SENSORS = {"front": ["laser_front"], "rear": ["laser_rear"], "both": ["laser_front", "laser_rear"]}
SAYS = {  # kind: what the reason must hold beside the scanner's name
    "units": ["wrong units"],
    "silent": ["no beam"],
    "sector": ["sees nothing", "no beam"],
    "too_near": ["too near"],
    "blind_near": ["too near"],
    "offset": ["too long", "fit the motion"],
    "scaled": ["too long", "fit the motion"],
    "stale": ["old sweeps", "frozen"],
    "looped": ["old sweeps", "frozen"],
}
NEAR_KINDS = {"too_near", "blind_near"}
ALARMS = sorted({word for words in SAYS.values() for word in words} | {"too short", "covers the"})
MUSEUMS = ["bonn", "smithsonian"]
CROWDS = ["busy", "packed"]
LOOP_S = 3.0  # [s] that a loop takes: from the start, it must have been said once
SLICE_KINDS = ["units", "silent", "sector", "offset", "scaled", "stale"]
SLICE_STARTS = ["units", "silent", "sector", "offset", "scaled"]  # of these also from the start
PARTS = [*SAYS, "bare", "alarms"]
CRIPPLED_KINDS = ["units", "silent"]


class Bench(FaultBench):
    """The runs of faults, in any museum and crowd."""

    def __init__(self, docent, cache, run_key, museums, jobs):
        super().__init__(docent, cache, run_key, museums, jobs)
        self.museums, self.run_key = museums, run_key

    def of(self, museum, crowd):
        """Another museum's or crowd's runs, beside this one's."""
        other = FaultBench(self.docent, self.cache.parent, self.run_key, self.museums, self.jobs)
        other.crowd, other.museum, other.key, other.hashes = crowd, self.museums / museum, self.run_key(self.museums / museum), self.hashes
        return other


def events(kind, which, at):
    return [f"  - {{at: {at:.2f}, lie: {{sensor: {sensor}, kind: {kind}}}}}" for sensor in SENSORS[which]]


class Outcome:
    """What one lie did to one run."""

    def __init__(self, kind, which, at, rows, has_ring=True):
        self.has_ring = has_ring
        after = [row for row in rows if row["time"] >= at]
        self.due = self.due_of(kind, at, after)
        names = ["front laser", "rear laser"] if which == "both" else [f"{which} laser"]
        said = [row for row in after if any(name in row["reason"] for name in names) and any(word in row["reason"] for word in SAYS[kind])]
        self.said_s = float("inf") if not said else max(0.0, said[0]["time"] - self.due) if self.due is not None else 0.0
        self.reason = statistics.mode(row["reason"] for row in said) if said else ""
        self.touched = rows[-1]["contacts"] + rows[-1]["violations"]
        self.bumps = rows[-1]["bumps"]
        self.driven = rows[-1]["distance"] - after[0]["distance"] if after else 0.0
        self.km, self.hours, self.passes = rows[-1]["distance"] / 1000, rows[-1]["time"] / 3600, count_passes(rows)

    def due_of(self, kind, at, after):
        """[s] from when on it can be known; None: it never could."""
        if kind in NEAR_KINDS:
            return first_stay(after)
        if at > 0.0:
            return at
        told_once = LOOP_S if kind == "looped" else 0.0
        by_way = not self.has_ring and kind in ("offset", "scaled")
        turned = 0.0
        for before, row in zip(after, after[1:]):
            turned += abs((row["heading"] - before["heading"] + 180.0) % 360.0 - 180.0)
            way = row["distance"] - after[0]["distance"]
            moves = abs(row["speed"]) > MOVES  # in a turn on the spot it finds out, and hits nothing
            if kind == "stale" and (turned >= TURNED_DEG or way >= MOVED_M) or by_way and way >= MOVED_M:
                return row["time"]
            if kind != "stale" and not by_way and moves and row["time"] >= told_once:
                return row["time"]
        return None


def first_stay(rows):
    """[s] when something is left out that stays for SAID_S."""
    began = None
    for row in rows:
        if not row["left_out"]:
            began = None
        elif began is None:
            began = row["time"]
        if began is not None and row["time"] - began >= SAID_S:
            return began
    return None


def strike(bench, kind, which, seed, rows):
    draw = random.Random(f"{kind} {which} {seed}")
    places = moments(rows)
    if not places:
        return None
    at = draw.choice(places)["time"]
    watched = NEAR_WATCHED_S if kind in NEAR_KINDS else WATCHED_S
    struck, _ = bench.run(seed, at + watched, events(kind, which, at), [])
    return Outcome(kind, which, at, struck)


def begin(bench, kind, which, seed, extra=()):
    has_ring = "--robot" not in extra and "body.sonars=0" not in extra
    rows, _ = bench.run(seed, STARTS_S, events(kind, which, 0.0), list(extra))
    return Outcome(kind, which, 0.0, rows, has_ring)


HEADER = ["lie", "of", "begins", "runs", "could be known", "said s: median", "worst", "reason", "touched", "driven after m"]


def row_of(kind, which, when, outcomes):
    due = [outcome for outcome in outcomes if outcome.due is not None]
    said = sorted(outcome.said_s for outcome in due) or [float("nan")]
    reasons = [outcome.reason for outcome in outcomes if outcome.reason]
    return [kind, which, when, len(outcomes), len(due), seconds(statistics.median(said)), seconds(said[-1]),
            statistics.mode(reasons) if reasons else "nothing", f"{sum(o.touched for o in outcomes):.0f}",
            f"{statistics.median(o.driven for o in outcomes):.1f}" if outcomes else "-"]


def alarms_of(rows):
    found, last = [], ""
    for row in rows:
        is_alarm = any(word in row["reason"] for word in ALARMS)
        if is_alarm and row["reason"] != last:
            found.append(row["reason"])
        last = row["reason"] if is_alarm else ""
    return found


def protocol(bench, options):
    seeds = list(range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else 5))))
    kinds = SLICE_KINDS if options.slice else list(SAYS)
    places = ["front"] if options.slice else list(SENSORS)
    verdict = Verdict()
    if options.part in ("alarms", "bare"):
        (false_alarms if options.part == "alarms" else bare)(bench, options, seeds, verdict)
        verdict.print()
        return verdict
    if options.part:
        kinds = [options.part]
    unharmed = dict(zip(seeds, bench.each([lambda s=s: bench.run(s, 60.0 * MINUTES, [], [])[0] for s in seeds])))
    print(f"\n## lies, {bench.museum.name}, busy, {len(seeds)} seeds; named within {SAID_S:g} s\n")
    plan = [(kind, which, when, seed) for kind in kinds for which in places for when in ("in a drive", "at the start") for seed in seeds
            if not options.slice or when == "in a drive" or kind in SLICE_STARTS]
    made = bench.each([lambda k=k, w=w, s=s, at=at: strike(bench, k, w, s, unharmed[s]) if at == "in a drive" else begin(bench, k, w, s)
                       for k, w, at, s in plan])
    table, everything = [], []
    for key in dict.fromkeys(part[:3] for part in plan):
        outcomes = [o for part, o in zip(plan, made) if part[:3] == key and o]
        everything += outcomes
        table.append(row_of(*key, outcomes))
        late = [o for o in outcomes if o.due is not None and o.said_s > SAID_S]
        touched = sum(o.touched for o in outcomes)
        verdict.want(" ".join(key), f"{touched:.0f} touched, {len(late)} of {sum(o.due is not None for o in outcomes)} named late or never",
                     bool(outcomes) and touched == 0 and not late)
    print_table(HEADER, table)
    print()
    verdict.want("touched in all runs with a lie", f"{bounded(int(sum(o.touched for o in everything)), sum(o.km for o in everything))}, "
                 f"{sum(o.hours for o in everything):.1f} h, {sum(o.passes for o in everything)} passes within 1 m; people bumped into it "
                 f"{sum(o.bumps for o in everything):.0f} times", not any(o.touched for o in everything))
    if not options.part:
        if not options.slice:
            bare(bench, options, seeds, verdict)
        false_alarms(bench, options, seeds, verdict)
    verdict.want_one_configuration(bench.hashes)
    if not options.no_crippled:
        cripple(bench, seeds[:1] if options.slice else seeds[:3], verdict)
    verdict.print()
    return verdict


def bare(bench, options, seeds, verdict):
    """From the start, on robots without a ring, in both museums."""
    kinds = options.cases.split(";") if options.cases else BARE_KINDS
    if set(kinds) - set(BARE_KINDS):
        raise RuntimeError(f"--cases: one of {'; '.join(BARE_KINDS)}")
    for museum in options.museums.split(",") if options.museums else MUSEUMS:
        of = bench.of(museum, "busy")
        print(f"\n## lies from the start without a ring, {museum}, busy, {len(seeds)} seeds\n")
        table = []
        for name, (robot, places) in BARE.items():
            robot = [str(bench.museums.parent / "robots" / part) if part.endswith(".yaml") else part for part in robot]
            for kind in kinds:
                for which in places:
                    outcomes = of.each([lambda s=s, k=kind, w=which: begin(of, k, w, s, robot) for s in seeds])
                    table.append(row_of(kind, f"{which} of {name}", "at the start", outcomes))
                    due = [o for o in outcomes if o.due is not None]
                    late, touched = [o for o in due if o.said_s > SAID_S], sum(o.touched for o in outcomes)
                    verdict.want(f"{museum}, {kind}, {which} of {name}", f"{touched:.0f} touched, {len(late)} of {len(due)} named late or never",
                                 touched == 0 and not late)
        print_table(HEADER, table)


def carried_off(minutes):
    return [f"  - {{at: {CARRIED_EVERY_S * k:.1f}, kidnap: {{}}}}" for k in range(1, int(60.0 * minutes / CARRIED_EVERY_S))]


def false_alarms(bench, options, seeds, verdict):
    minutes = options.minutes or (CARRIED_MINUTES if options.slice else ALARM_MINUTES)
    carries = carried_off(minutes)
    worlds = [(bench.museum.name, "busy", True)] if options.slice else [(m, c, carried) for m in MUSEUMS for c in CROWDS for carried in (False, True)]
    for museum, crowd, is_carried in worlds:
        of = bench.of(museum, crowd)
        some = bench.each([lambda s=s, b=of: b.run(s, 60.0 * minutes, carries if is_carried else [], [])[0] for s in seeds])
        alarms = [alarm for rows in some for alarm in alarms_of(rows)]
        hours, km = sum(rows[-1]["time"] for rows in some) / 3600, sum(rows[-1]["distance"] for rows in some) / 1000
        words = ", ".join(f"{alarms.count(alarm)} x {alarm}" for alarm in sorted(set(alarms))) or "none"
        how = f", carried off {len(carries) * len(some)} times" if is_carried else ""
        bound = f"at most {3.0 / hours:.1f} an hour with 95 %" if not alarms else f"{len(alarms) / hours:.1f} an hour"
        verdict.want(f"false alarms, {museum}, {crowd}{how}", f"{words} in {hours:.2f} h and {km:.2f} km: {bound}", km > 0 and not alarms)


def cripple(bench, seeds, verdict):
    for kind in CRIPPLED_KINDS:
        outcomes = bench.each([lambda s=s: begin(bench, kind, "both", s, CRIPPLED) for s in seeds])
        touched, named = sum(o.touched > 0 for o in outcomes), sum(bool(o.reason) for o in outcomes)
        verdict.want(f"crippled: no watches, {kind} of both (must fail)", f"touched in {touched}, named in {named} of {len(outcomes)} runs",
                     not named)
