"""What lines, drivers and networks do to messages and stamps, in two museums: each fault alone and all together.

Whole robots on tours among people, unknown start. The robot is told nothing: it sees stamps, and the times at which messages
come. Nothing may be touched, visitors are served as ever, P(lost) is honest, and no reading of the odometry is taken for a
jump; a real jump, in the middle of it all, is one. A robot that takes for a jump what its base does every day must fail.
"""
import csv
import math

from evaluation.bounds import bounded
from evaluation import claims as claims_of
from evaluation.reports import contacts_of
from evaluation.tables import Verdict, print_table

MUSEUMS = ["bonn", "smithsonian"]
SEEDS = 10
MINUTES, SLICE_MINUTES = 20, 16
SERVED = 0.97  # of the requests, over all seeds of a fault
SURE = 0.01  # P(lost) of who is sure
WRONG = 0.005  # of those that are sure, at most
LARGEST_SHARE = 0.1  # of the time that a base's messages are called missing, late or none at all
ALL = "all together"
FAULTS = {
    "none": [],
    "jitter of 50 ms": [("all", "jitter: 0.05")],
    "jitter of 50 ms, stamped on receipt": [("all", "jitter: 0.05, stamps: receipt")],
    "hiccups of 20 to 100 ms": [("all", "hiccups: 20, hold: 0.1")],
    "hiccups, stamped on receipt": [("all", "hiccups: 20, hold: 0.1, stamps: receipt")],
    "one in ten lost": [("all", "drop: 0.1")],
    "overtaken and doubled": [("all", "reorder: 0.05, twice: 0.05")],
    "clocks 30 ms apart": [("odom", "clock: 0.03"), ("laser_front", "clock: -0.03")],
    "clocks 5 s apart": [("odom", "clock: 5"), ("sonar", "clock: -5")],
    "clocks that drift": [("odom", "drift: 0.0001"), ("laser_front", "drift: -0.0001"), ("laser_rear", "drift: 0.0002")],
    "clocks that are set back": [("odom", "set_back: 0.2, every: 60"), ("laser_front", "set_back: 0.15, every: 90")],
    "scanners late by 30 and 200 ms, then by 150 and 80": [],
    "late by 100 ms, stamped on receipt, then none of them": [],
    "odometry of 10 Hz that repeats itself while it stands": [("odom", "stamps: moving")],
    "odometry of 100 Hz without stamps": [("odom", "stamps: zero, jitter: 0.01")],
    "bursts of a network, on receipt, from the future": [("odom", "stamps: receipt, hiccups: 60, hold: 0.2, clock: 40")],
    ALL: [("all", "jitter: 0.05, hiccups: 6, hold: 0.1, reorder: 0.02, twice: 0.02, drop: 0.1"),
          ("odom", "jitter: 0.05, hiccups: 6, hold: 0.1, reorder: 0.02, twice: 0.02, drop: 0.1, clock: 0.03, drift: 0.00005, "
           "set_back: 0.1, every: 300")],
}
SLICE = [ALL]
# What is built otherwise, and what happens later, by fault.
BUILDS = {
    "odometry of 10 Hz that repeats itself while it stands": "odometry: {rate: 10}",
    "odometry of 100 Hz without stamps": "odometry: {rate: 100}",
}
LATE = "stamps: receipt, delay:"
LATER = {
    "scanners late by 30 and 200 ms, then by 150 and 80": [(0, "laser_front", f"{LATE} 0.03"), (0, "laser_rear", f"{LATE} 0.2"),
                                                           (0.4, "laser_front", f"{LATE} 0.15"), (0.4, "laser_rear", f"{LATE} 0.08")],
    "late by 100 ms, stamped on receipt, then none of them": [(0, "laser_front", f"{LATE} 0.1"), (0, "laser_rear", f"{LATE} 0.1"),
                                                              (0.5, "laser_front", "jitter: 0"), (0.5, "laser_rear", "jitter: 0")],
}
# A real one comes a minute before the end: the wheels' odometry begins anew far from where it was.
JUMP = "odometry_jump: {x: 3, y: -2, heading: 140}"
JUMP_BEFORE_END = 60.0  # [s]
SAID_WITHIN = 3.0  # [s]
CRIPPLED = ["--set", "evaluation.doubts_odometry=true"]
CRIPPLED_MINUTES = 4
LOGS = {"--drive-log": "drive.csv", "--claims": "claims.csv"}
HEADER = ["fault", "runs", "km", "contacts", "served", "worst seed", "localized s", "error cm", "sure and wrong", "false jumps", "real jumps",
          "called missing, late or silent"]


def scenario_of(fault, minutes):
    events = [f"  - {{at: 0, transport: {{sensor: {sensor}, {what}}}}}" for sensor, what in FAULTS[fault]]
    events += [f"  - {{at: {60 * minutes * share:g}, transport: {{sensor: {sensor}, {what}}}}}" for share, sensor, what in LATER.get(fault, [])]
    build = [f"build: {{{BUILDS[fault]}}}"] if fault in BUILDS else []
    return "\n".join([*build, "events:", *events, f"  - {{at: {60 * minutes - JUMP_BEFORE_END:g}, {JUMP}}}"]) + "\n"


def read_drive(path):
    with open(path, newline="", encoding="utf-8") as file:
        return [(float(row["time"]), row["reason"]) for row in csv.DictReader(file)]


class Run:
    """What one run was like: its report, its false and its real jumps, and what it said of the odometry."""

    def __init__(self, kept, report, minutes):
        self.report, self.hours = report, minutes / 60
        rows = read_drive(kept["drive.csv"])
        at = 60 * minutes - JUMP_BEFORE_END
        starts = [time for (time, reason), (_, before) in zip(rows[1:], rows) if "jumped" in reason and "jumped" not in before]
        self.false_jumps = sum(not at <= time <= at + SAID_WITHIN for time in starts)
        self.real_jumps = sum(at <= time <= at + SAID_WITHIN for time in starts)
        called = [reason for time, reason in rows if time > 10 and "odometry" in reason and any(word in reason for word in ("missing", "late", "no fresh"))]
        self.called_share = len(called) / max(1, len(rows))
        claims = [row for row in claims_of.since_known(claims_of.read_claims(kept["claims.csv"])) if row["time"] < at]
        self.sure = [claims_of.is_lost(row) for row in claims if row["p_lost"] < SURE]
        errors = [claims_of.error_m(row) for row in claims if not math.isnan(row["x"])]
        self.error = claims_of.mean(errors)
        self.served, self.counted = report["requests"]["counted_served"], report["requests"]["counted"]


def runs_of(simulations, plan, minutes, extra):
    calls = [("transport", simulations.museums / museum, seed, minutes / 60, ["--crowd", "busy", "--requests-per-hour", "30", *extra], LOGS,
              scenario_of(fault, minutes)) for fault, museum, seed in plan]
    return [Run(kept, report, minutes) for kept, report in simulations.each(simulations.run_logged, calls)]


def row_of(fault, runs):
    served, counted = sum(run.served for run in runs), sum(run.counted for run in runs)
    sure = [lost for run in runs for lost in run.sure]
    localized = [run.report["localization"]["localized_after_s"] for run in runs]
    rates = [run.served / run.counted for run in runs if run.counted]
    return [fault, len(runs), f"{sum(run.report['distance_m'] for run in runs) / 1000:.2f}", sum(contacts_of(run.report) for run in runs),
            f"{served}/{counted}", f"{100 * min(rates):.0f} %" if rates else "-",
            "never" if None in localized else f"{max(localized):.0f}", f"{100 * claims_of.mean(run.error for run in runs):.1f}",
            f"{sum(sure)} of {len(sure)}", sum(run.false_jumps for run in runs), f"{sum(run.real_jumps for run in runs)} of {len(runs)}",
            f"{100 * claims_of.mean(run.called_share for run in runs):.1f} %"]


def judge(fault, runs, verdict):
    """Bounds of one fault into the verdict, each with the exposure that it rests on."""
    hours = sum(run.hours for run in runs)
    km = sum(run.report["distance_m"] for run in runs) / 1000
    served, counted = sum(run.served for run in runs), sum(run.counted for run in runs)
    sure = [lost for run in runs for lost in run.sure]
    contacts, jumps = sum(contacts_of(run.report) for run in runs), sum(run.false_jumps for run in runs)
    localized = [run.report["localization"]["localized_after_s"] for run in runs]
    verdict.want(f"{fault}: contacts", f"{bounded(contacts, km)}; {sum(run.report['passes_within_1m'] for run in runs)} passes within 1 m",
                 contacts == 0 and km > 0)
    share = served / counted if counted else 0.0
    verdict.want(f"{fault}: requests served, at least {100 * SERVED:.0f} %", f"{100 * share:.1f} % of {counted}", share >= SERVED)
    verdict.want(f"{fault}: localized, all", f"{sum(time is not None for time in localized)} of {len(localized)}", None not in localized)
    wrong = sum(sure) / len(sure) if sure else 1.0
    verdict.want(f"{fault}: of the sure beliefs (P(lost) < {SURE:g}) at most {100 * WRONG:g} % wrong", f"{100 * wrong:.2f} % of {len(sure)}", wrong <= WRONG)
    verdict.want(f"{fault}: jumps of the odometry that were none", f"{jumps} in {hours:.1f} h", jumps == 0)
    verdict.want(f"{fault}: real jumps that were one", f"{sum(run.real_jumps for run in runs)} of {len(runs)}",
                 all(run.real_jumps == 1 for run in runs))
    called = claims_of.mean(run.called_share for run in runs)
    verdict.want(f"{fault}: of the time the odometry is called missing, late or silent", f"{100 * called:.1f} %", called <= LARGEST_SHARE)


def protocol(simulations, options):
    museums = options.museums.split(",") if options.museums else MUSEUMS[:1] if options.slice else MUSEUMS
    seeds = range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else SEEDS)))
    minutes = options.minutes or (SLICE_MINUTES if options.slice else MINUTES)
    faults = [options.part] if options.part else SLICE if options.slice else list(FAULTS)
    print(f"\n## transport, {', '.join(museums)}, busy, {len(seeds)} seeds x {minutes:g} minutes a fault, a real jump {JUMP_BEFORE_END:g} s before the end\n")
    by_fault = {}
    for fault in faults:
        by_fault[fault] = runs_of(simulations, [(fault, museum, seed) for museum in museums for seed in seeds], minutes, [])
        print("   " + "; ".join(f"{what}: {value}" for what, value in zip(HEADER, row_of(fault, by_fault[fault]))), flush=True)
    print()
    print_table(HEADER, [row_of(fault, runs) for fault, runs in by_fault.items()])
    print()
    verdict = Verdict()
    for fault, runs in by_fault.items():
        judge(fault, runs, verdict)
    verdict.want_one_configuration(run.report["config_hash"] for runs in by_fault.values() for run in runs)
    if not options.no_crippled:
        crippled = runs_of(simulations, [(faults[-1], museums[0], seeds[0])], CRIPPLED_MINUTES, CRIPPLED)
        print_table(HEADER, [row_of("crippled: doubts its odometry", crippled)])
        print()
        jumps = sum(run.false_jumps for run in crippled)
        verdict.want("crippled: who doubts its odometry must find jumps that are none", f"{jumps} in {sum(run.hours for run in crippled):.1f} h", jumps > 0)
    verdict.print()
    return verdict
