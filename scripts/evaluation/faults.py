"""What breaks while the robot drives through a busy museum: every sensor dead, frozen, half of its readings invalid,
stamped late; a best pose that is off by 30 cm and 10 degrees while the belief is true; a belief of two modes; jumps of
the odometry. The robot must slow down or stand within the bound, say why, and touch nothing. Wheels that slip for a second
make no step that a watch could see; that the localizer must find.

A run is made twice. Without a fault it shows when the robot drives, and that it would have gone on: a fault strikes only
where the unharmed robot drives at DRIVES m/s and more from one second before to three after. As a seed gives the same run
bit for bit, everything until then is the same, and slowing down is the fault's doing. The unharmed runs go on
for longer and count false alarms. Speeds are the truth's; slow is at most SLOW m/s, from then to the end of the watch.
"""
import csv
import hashlib
import json
import os
import random
import statistics
import subprocess

from evaluation.bounds import bounded
from evaluation.programs import program_for
from evaluation.simulations import side_by_side
from evaluation.tables import Verdict, print_table

MUSEUM = "bonn"
CROWD = "busy"
MINUTES = 4.0  # of an unharmed run, in which faults strike
ALARM_MINUTES = 15.0  # of one whose false alarms are counted: together some kilometres
DRIVES = 0.35  # [m/s]
# [m] from the outline to a solid: well within reach of the infrared ring, which reads 0.8 m in 24 directions. What it passes for a second
# at 0.7 m may lie between two of them; dark clothes it does not see.
NEAR = 0.6
SLOW = 0.28  # [m/s]: 0.25, and what the wheels are off
STANDS = 0.02  # [m/s]
REACTION_S = 2.0  # [s]: the bound of slowing and of saying why
NEAR_REACTION_S = 4.0  # [s]: where one of 24 sensors sees something, and all that can be noticed is that it repeats itself
WATCHED_S = 8.0  # [s] after the fault
JUMP_WATCHED_S = 25.0  # [s]: a jump is over at once, and the localizer must find its place
FOUND_M = 0.3  # [m]
FOUND_S = 10.0  # [s]
TOUR = "  - {at: 5, request: {kind: tour, target: highlights, language: en}}"

SENSORS = {  # name in a scenario: what the reason must name
    "laser_front": "front laser",
    "laser_rear": "rear laser",
    "sonar": "sonar",
    "odom": "odometry",
    "tactile": "tactile ring",
    "infrared": "infrared",
}
KINDS = {  # and one of these words
    "dead": ["no fresh", "silent", "late"],
    "frozen": ["frozen"],
    "half": ["too few", "missing"],
    "late": ["late", "no fresh"],
}
ALARMS = ["no fresh", "silent", "late", "frozen", "too few", "no readings", "missing", "jumped", "two places",
          "best pose", "doubtful"]
SLIPS = [(0.5, 0.0, 12), (-0.4, 0.0, -15), (0.3, 0.0, 20), (0.6, 0.0, -8)]  # within a second
JUMPS = [(1.0, 0.0, 40), (-0.5, 0.3, -25), (0.3, 0.0, 10), (4.0, -7.0, 170)]  # x, y [m], heading [deg]
CRIPPLED = ["--set", "evaluation.without_watches=true"]
CRIPPLED_SEEDS = 3
CRIPPLED_FAULTS = ["laser_front dead", "laser_front frozen", "odom late", "two modes", "odometry jump"]


class Fault:
    """One row of the table: how it strikes and what the robot must say of it."""

    def __init__(self, name, event, says, watched=WATCHED_S, passes=False, is_near=False):
        """`says`: groups of words, one of each; none: nothing can be said, and it need not slow down.
        `is_near`: strikes where something is within NEAR, for else nothing is to be noticed."""
        self.name, self.event, self.says, self.watched, self.passes, self.is_near = name, event, says, watched, passes, is_near

    @property
    def within(self):
        """[s] in which it is slow, and says why."""
        return NEAR_REACTION_S if self.is_near else REACTION_S

    def is_said(self, reason):
        return bool(self.says) and all(any(word in reason for word in words) for words in self.says)


def pose_error(seed, _row, _rows):
    x, y = [(0.3, 0.0), (0.0, 0.3), (-0.3, 0.0), (0.0, -0.3)][seed % 4]
    return f"pose_error: {{x: {x}, y: {y}, heading: {10 if seed // 4 % 2 else -10}}}"


def second_mode(_seed, row, rows):
    """Where the robot was before, at least 4 m from here: surely a place where it can be."""
    far = [r for r in rows if r["time"] < row["time"] and abs(r["x"] - row["x"]) + abs(r["y"] - row["y"]) > 4.0]
    at = far[len(far) // 2] if far else {"x": row["x"], "y": row["y"], "heading": row["heading"] + 180.0}
    return f"second_mode: {{at: [{at['x']:.2f}, {at['y']:.2f}], heading: {at['heading']:.1f}}}"


def odometry_jump(seed, _row, _rows):
    x, y, heading = JUMPS[seed % len(JUMPS)]
    return f"odometry_jump: {{x: {x}, y: {y}, heading: {heading}}}"


def odometry_slip(seed, _row, _rows):
    x, y, heading = SLIPS[seed % len(SLIPS)]
    return f"odometry_jump: {{x: {x}, y: {y}, heading: {heading}, over: 1}}"


def all_faults():
    faults = [Fault(f"{sensor} {kind}", lambda _s, _r, _all, sensor=sensor, kind=kind: f"fault: {{sensor: {sensor}, kind: {kind}}}",
                    [[name], words], is_near=(sensor, kind) == ("infrared", "frozen"))
              for sensor, name in SENSORS.items() for kind, words in KINDS.items()]
    return faults + [Fault("best pose 30 cm and 10 degrees off", pose_error, [["best pose"]]),
                     Fault("two modes", second_mode, [["two places"]]),
                     Fault("odometry jump", odometry_jump, [["jumped"]], JUMP_WATCHED_S, passes=True),
                     Fault("odometry slips", odometry_slip, [], JUMP_WATCHED_S, passes=True)]


class Bench:
    """Makes runs and keeps them under a key of everything that decides them."""

    def __init__(self, docent, cache, run_key, museums, jobs):
        self.docent, self.cache, self.museum, self.crowd, self.jobs = docent, cache / "faults", museums / MUSEUM, CROWD, jobs
        self.key = run_key(self.museum)
        self.hashes = set()
        self.cache.mkdir(parents=True, exist_ok=True)

    def run(self, seed, duration, events, extra):
        """(rows of the drive log, rows of the claims) of one run."""
        key = hashlib.sha256(json.dumps([self.key, self.crowd, seed, duration, events, extra]).encode()).hexdigest()[:20]
        drive, claims, report = (self.cache / f"{key}.{what}" for what in ("drive.csv", "claims.csv", "report.json"))
        if not all(path.exists() for path in (drive, claims, report)):
            mark = f"part{os.getpid()}"
            scenario = self.cache / f"{key}.{mark}.yaml"
            scenario.write_text("\n".join(["events:", TOUR, *events]) + "\n")
            made, told, judged = (path.with_suffix(f".{mark}") for path in (drive, claims, report))
            command = [program_for(self.docent, extra), "simulate", "--museum", self.museum, "--hours", f"{duration / 3600:.8f}", "--seed", str(seed),
                       "--crowd", self.crowd, "--requests-per-hour", "40", "--scenario", scenario, "--drive-log", made, "--claims", told,
                       "--report", judged, "--quiet", *extra]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            scenario.unlink()
            if done.returncode != 0:
                raise RuntimeError(f"seed {seed}: docent simulate exited {done.returncode}: {done.stderr.strip()[-400:]}")
            judged.rename(report)
            told.rename(claims)
            made.rename(drive)
        if not extra:  # of the whole robot
            self.hashes.add(json.loads(report.read_text())["config_hash"])
        return read(drive), read(claims)

    def each(self, jobs):
        return side_by_side(jobs, self.jobs)


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return [{name: value if name in ("state", "reason") else float(value) for name, value in row.items()}
                for row in csv.DictReader(file)]


def moments(rows, is_near=False):
    """Rows at which a fault may strike; with `is_near` those at which a solid is within NEAR, for a second and more."""
    found = []
    for i in range(400, len(rows) - 40):
        if min(row["speed"] for row in rows[i - 10:i + 31]) < DRIVES:
            continue
        if not is_near or max(row["nearest_solid"] for row in rows[i:i + 11]) <= NEAR:
            found.append(rows[i])
    return found


def alarms_of(rows):
    """Reasons that name a fault, once for each time that they begin; not of the first moments, when all begins to speak."""
    found, last = [], ""
    for row in rows:
        is_alarm = row["time"] > 5.0 and any(word in row["reason"] for word in ALARMS) and "target" not in row["reason"]
        if is_alarm and row["reason"] != last:
            found.append(row["reason"])
        last = row["reason"] if is_alarm else ""
    return found


class Outcome:
    """What one fault did to one run."""

    def __init__(self, fault, at, rows, claims):
        after = [row for row in rows if row["time"] >= at]
        end = at + fault.watched
        fast = [row["time"] for row in after if row["speed"] > SLOW]
        if fault.passes:  # slow is enough once: it is over at once
            slow = [row["time"] for row in after if abs(row["speed"]) <= SLOW]
            self.slow_s = slow[0] - at if slow else float("inf")
        else:
            self.slow_s = max(0.0, fast[-1] + 0.1 - at) if fast else 0.0
            self.slow_s = float("inf") if self.slow_s > fault.watched - 1.0 else self.slow_s
        said = [row for row in after if fault.is_said(row["reason"])]
        self.said_s = said[0]["time"] - at if said else float("inf")
        self.reason = statistics.mode(row["reason"] for row in said) if said else ""
        late = [abs(row["speed"]) for row in after if row["time"] > end - 3.0]
        self.stands = bool(late) and statistics.median(late) <= STANDS
        self.touched = rows[-1]["contacts"] + rows[-1]["violations"]
        self.bumps = rows[-1]["bumps"]
        self.km = rows[-1]["distance"] / 1000
        self.driven_after = rows[-1]["distance"] - after[0]["distance"]
        self.passes = count_passes(rows)
        self.hours = rows[-1]["time"] / 3600
        known = [row for row in claims if row["time"] >= at + FOUND_S]
        errors = [((row["x"] - row["true_x"]) ** 2 + (row["y"] - row["true_y"]) ** 2) ** 0.5 for row in known]
        self.worst_error = max(errors, default=float("nan"))


def count_passes(rows):
    near = [row["nearest_person"] < 1.0 for row in rows]
    return sum(now and not before for before, now in zip([False, *near], near))


def strike(bench, fault, seed, rows, extra):
    draw = random.Random(f"{fault.name} {seed}")
    places = moments(rows, fault.is_near)
    if not places:
        return None
    row = draw.choice(places)
    event = f"  - {{at: {row['time']:.2f}, {fault.event(seed, row, rows)}}}"
    struck, claims = bench.run(seed, row["time"] + fault.watched, [event], extra)
    return Outcome(fault, row["time"], struck, claims)


def seconds(value):
    return f"{value:.1f}" if value < 1e6 else "never"


def judge(fault, outcomes, verdict, must_hold=True):
    """The table's row; bounds into the verdict. Returns whether all bounds held."""
    slow = sorted(outcome.slow_s for outcome in outcomes)
    said = sorted(outcome.said_s for outcome in outcomes)
    touched = sum(outcome.touched for outcome in outcomes)
    stood = sum(outcome.stands for outcome in outcomes)
    good = bool(outcomes) and touched == 0
    if fault.says and outcomes:
        good = good and slow[-1] <= fault.within and said[-1] <= fault.within
    words = (f"slow after {seconds(slow[-1])} s, said after {seconds(said[-1])} s, {touched:.0f} touched, in {len(outcomes)} runs"
             if outcomes else "no run")
    if fault.passes and outcomes:
        worst = max(outcome.worst_error for outcome in outcomes)
        good = good and worst <= FOUND_M
        words += f", at most {100 * worst:.0f} cm off from {FOUND_S:g} s after"
    if must_hold:
        verdict.want(f"{fault.name}: at worst", words, good)
    if not outcomes:
        return [fault.name, 0, *["-"] * 8], good
    reasons = [outcome.reason for outcome in outcomes if outcome.reason]
    return [fault.name, len(outcomes), f"stands {stood}, slow {len(outcomes) - stood}", seconds(statistics.median(slow)), seconds(slow[-1]),
            seconds(statistics.median(said)), seconds(said[-1]), statistics.mode(reasons) if reasons else "nothing",
            f"{touched:.0f}", f"{statistics.median(outcome.driven_after for outcome in outcomes):.1f}"], good


HEADER = ["fault", "runs", "reaction", "slow s: median", "worst", "said s: median", "worst", "reason", "touched", "driven after m"]


def protocol(bench, options):
    seeds = range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else 16)))
    minutes = options.minutes or MINUTES
    verdict = Verdict()
    alarm_minutes = minutes if options.slice else max(minutes, ALARM_MINUTES)
    watched = bench.each([lambda s=s: bench.run(s, 60.0 * alarm_minutes, [], [])[0] for s in seeds])
    unharmed = {seed: [row for row in rows if row["time"] <= 60.0 * minutes] for seed, rows in zip(seeds, watched)}
    faults = all_faults()
    if options.slice:
        names = ["laser_front frozen", "sonar half", "odom dead", "tactile frozen", "infrared dead", "infrared frozen", *[fault.name for fault in faults[-4:]]]
        faults = [fault for fault in faults if fault.name in names]
    print(f"\n## faults, {MUSEUM}, {CROWD}, {len(seeds)} seeds; slow or standing, and said why, within {REACTION_S:g} s ({NEAR_REACTION_S:g} s for what only a reading in reach can tell)\n")
    plan = [(fault, seed) for fault in faults for seed in seeds]
    made = bench.each([lambda f=f, s=s: strike(bench, f, s, unharmed[s], []) for f, s in plan])
    by_fault = {fault.name: [o for (f, _), o in zip(plan, made) if f is fault and o] for fault in faults}
    print_table(HEADER, [judge(fault, by_fault[fault.name], verdict)[0] for fault in faults])
    outcomes = [outcome for some in by_fault.values() for outcome in some]
    print()
    struck_share = len(outcomes) / len(plan)
    verdict.want("runs that drove when they were struck", f"{len(outcomes)} of {len(plan)}", struck_share >= 0.75)
    verdict.want("touched in all runs with a fault", f"{bounded(int(sum(o.touched for o in outcomes)), sum(o.km for o in outcomes), sum(o.hours for o in outcomes))}; "
                 f"{sum(o.hours for o in outcomes):.1f} h, {sum(o.passes for o in outcomes)} passes within 1 m; people bumped into it "
                 f"{sum(o.bumps for o in outcomes):.0f} times", not any(o.touched for o in outcomes))
    alarms = [alarm for rows in watched for alarm in alarms_of(rows)]
    km = sum(rows[-1]["distance"] for rows in watched) / 1000
    words = ", ".join(f"{alarms.count(alarm)} x {alarm}" for alarm in sorted(set(alarms))) or "none"
    verdict.want("false alarms without a fault, at most one a km", f"{words} in {alarm_minutes * len(seeds):.0f} minutes and {km:.2f} km",
                 km > 0 and len(alarms) <= km)
    verdict.want_one_configuration(bench.hashes)
    if not options.no_crippled:
        cripple(bench, verdict, [f for f in faults if f.name in CRIPPLED_FAULTS], list(seeds)[:CRIPPLED_SEEDS])
    verdict.print()
    return verdict


def cripple(bench, verdict, faults, seeds):
    print("\n## crippled: no watch over any sensor or belief (must fail)\n")
    rows = dict(zip(seeds, bench.each([lambda s=s: bench.run(s, 60.0 * MINUTES, [], CRIPPLED)[0] for s in seeds])))
    plan = [(fault, seed) for fault in faults for seed in seeds]
    made = bench.each([lambda f=f, s=s: strike(bench, f, s, rows[s], CRIPPLED) for f, s in plan])
    table = []
    for fault in faults:
        row, good = judge(fault, [o for (f, _), o in zip(plan, made) if f is fault and o], verdict, must_hold=False)
        table.append(row)
        verdict.want(f"crippled, {fault.name} (must fail)", f"slow after {row[4]} s, said after {row[6]} s", not good)
    print_table(HEADER, table)
    print()
