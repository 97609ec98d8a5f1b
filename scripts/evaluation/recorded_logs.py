"""Localization on logs that real robots recorded, where nobody simulated anything.

wean: a drawn map of the building, no truth: forward and time-reversed runs must agree. intel: a map made from the scans
that have a reference pose of their own, then the whole log with its raw odometry. corrected: logs without odometry, of other buildings and
lasers; the odd scans make the map, the even ones are localized, with odometry that is the reference's way with seeded errors.
"""
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from evaluation import drawn_logs, starts
from evaluation.tables import Verdict, print_table

METHODS = ["grid", "particles"]
PARTS = ["wean", "intel", "corrected", "starts"]
ON_DEMAND = ["peer", "drawn"]  # with --part only: the first needs MRPT's programs
BEGINNINGS = 24  # of each log, in the part "starts"
SURFACES = "0"  # [m]: maps made here have their walls where the readings ended
MEAN_BOUND = 0.10  # [m]
LEAST_KNOWN = 0.8  # of all scans of the corrected logs, in which the robot says that it knows where it is
MOST_WRONG = 0.005  # of those, where it is not there
# What the perturbed odometry's wheels are known for, one setting for all logs: 10 % of a way, 10 % of a turn and about two
# degrees a metre, over steps of two metres.
MOTION = "motion={translation_per_metre: 0.03, rotation_per_metre: 0.004, rotation_per_radian: 0.02}"


class Logs:
    """Runs docent on the recorded data; pictures go where they are wanted."""

    def __init__(self, program, data, pictures):
        self.program = program
        self.data = data
        self.pictures = Path(pictures) if pictures else None
        self.scratch = tempfile.TemporaryDirectory(prefix="docent-logs-")

    def log(self, name):
        return self.data / "logs" / name

    def scratch_file(self, name):
        return Path(self.scratch.name) / name

    def _call(self, what, arguments):
        done = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{what}: docent {arguments[0]} exited {done.returncode}: {done.stderr.strip()[-500:]}")

    def map(self, name, log, arguments):
        folder = (self.pictures or Path(self.scratch.name)) / name
        self._call(name, ["map", "--log", log, "--out", folder, *arguments])
        return folder / "map.yaml"

    def localize(self, name, arguments):
        started = time.monotonic()
        report = Path(self.scratch.name) / "report.json"
        drawn = ["--picture", self.pictures / name] if self.pictures else []
        self._call(name, ["localize", "--report", report, *drawn, *arguments])
        run = json.loads(report.read_text())
        error = f", mean error {100 * run['mean_error_m']:.1f} cm, lost {run['lost_scans']}" if "mean_error_m" in run else ""
        print(f"   {name}: {time.monotonic() - started:.0f} s{error}", file=sys.stderr, flush=True)
        return run


def near(run):
    """Share of the readings near walls; 0 where the robot never knew its place."""
    return run["endpoints_near_walls"] or 0.0


LEAST_COMMON = {"wean-1": 100, "wean-2": 1200}  # scans that both ways know


WEAN_WALLS = 0.2  # [m] deep, as the search finds them; a slice need not search


def wean(logs, methods, verdict, is_slice):
    known = ["--wall-depth", WEAN_WALLS] if is_slice else []
    print("\n## Wean Hall: drawn map, unknown start, forward and time-reversed\n")
    rows = []
    for log in ["wean-2"] if is_slice else ["wean-1", "wean-2"]:  # the tutorial that localizes a log runs wean-1, and its figures are compared
        for method in methods:
            forward = logs.localize(f"{log}-{method}", ["--map", logs.data / "maps" / "wean.yaml", "--log",
                                                        logs.log(f"{log}.clf.gz"), "--both-ways", "--method", method, *known])
            agreement = forward["agreement"]
            for way, run in (("forward", forward), ("reversed", forward["other_way"])):
                rows.append([log, method, way, run["scans"], run["localized_after_scans"],
                             f"{100 * run['localized_fraction']:.0f}", f"{100 * near(run):.1f}",
                             f"{1000 * run['seconds_per_scan']['median']:.1f}"])
                verdict.want(f"{log} {method} {way}: endpoints within 0.2 m of a wall (80 %)",
                             f"{100 * near(run):.1f} %", near(run) >= 0.8)
            then = agreement["there_and_then"]
            verdict.want(f"{log} {method}: both ways within 0.5 m and 10 degrees in hindsight (95 % of at least {LEAST_COMMON[log]} scans)",
                         f"{100 * (agreement['within_half_a_metre_and_10_degrees'] or 0.0):.1f} % of {agreement['both_know']} scans, of {agreement['scans']} after both ways had become sure",
                         agreement["both_know"] >= LEAST_COMMON[log] and agreement["within_half_a_metre_and_10_degrees"] >= 0.95)
            verdict.note(f"{log} {method}: the same there and then", f"{100 * (then['within_half_a_metre_and_10_degrees'] or 0.0):.1f} % of {then['both_know']} scans")
    print_table(["log", "method", "way", "scans", "sure after", "sure %", "endpoints %", "ms a scan"], rows)


HEADER = ["log", "method", "start", "odometry", "scans", "after", "mean cm", "median", "p95", "max", "deg", "lost", "wrong",
          "sure %"]


def row_of(log, method, start, odometry, run):
    if run["reference_scans"] == 0:
        return [log, method, start, odometry, 0, "never", *["-"] * 7, 0]
    sure = 1 - run["unsure_scans"] / run["reference_scans"]
    after = run["localized_after_scans"] if start == "unknown" else "-"
    return [log, method, start, odometry, run["reference_scans"], after,
            *[f"{100 * run[key]:.1f}" for key in ("mean_error_m", "median_error_m", "p95_error_m", "max_error_m")],
            f"{run['mean_heading_error_deg']:.2f}", run["lost_scans"], run["sure_and_wrong_scans"], f"{100 * sure:.0f}"]


def intel(logs, methods, verdict, crippled):
    print("\n## Intel: map from the scans that have a reference pose, raw odometry\n")
    log = logs.log("intel-raw.clf.gz")
    reference = ["--log", log, "--reference", logs.log("intel-reference.txt")]
    themap = logs.map("intel", log, reference[2:])
    rows = []
    for start in ("reference", "unknown"):
        for method in methods:
            run = logs.localize(f"intel-{method}-{start}", ["--map", themap, *reference, "--start", start, "--method", method,
                                                            "--wall-depth", SURFACES])
            rows.append(row_of("intel", method, start, "raw", run))
            verdict.want(f"intel {method}, {start} start: lost scans (0)",
                         f"{run.get('lost_scans', '-')} of {run['reference_scans']}",
                         run["reference_scans"] >= 1000 and run["lost_scans"] == 0)
    if crippled:
        run = logs.localize("intel-dead-reckoning", ["--map", themap, *reference, "--start", "reference", "--wall-depth",
                                                     SURFACES, "--dead-reckoning"])
        rows.append(row_of("intel", "dead reckoning", "reference", "raw", run))
        verdict.want("intel, dead reckoning (must be lost)", f"{run['lost_scans']} of {run['reference_scans']}",
                     run["lost_scans"] > 0.5 * run["reference_scans"])
    print_table(HEADER, rows)


def corrected(logs, is_slice, methods, seeds, verdict, crippled):
    names = sorted(path.name.split("-corrected")[0] for path in (logs.data / "logs").glob("*-corrected.log.gz"))
    names = [name for name in names if name == "seattle"] if is_slice else names
    if not names:
        raise RuntimeError(f"no corrected log in {logs.data}")
    print(f"\n## Corrected logs: odd scans make the map, even ones are localized, odometry perturbed with {len(seeds)} seeds\n")
    rows = []
    runs = {method: [] for method in methods}
    for name in names:
        log = logs.log(f"{name}-corrected.log.gz")
        themap = logs.map(name, log, ["--reference", "logged", "--scans", "odd"])
        common = ["--map", themap, "--log", log, "--reference", "logged", "--scans", "even", "--odometry", "perturbed",
                  "--start", "reference", "--wall-depth", SURFACES, "--set", MOTION]
        for method in methods:
            means = []
            for seed in seeds:
                run = logs.localize(f"{name}-{method}-{seed}", [*common, "--method", method, "--odometry-seed", seed,
                                                                "--seed", seed])
                rows.append(row_of(name, method, "reference", f"seed {seed}", run))
                means.append(run["mean_error_m"])
                runs[method].append(run)
            verdict.want(f"{name} {method}: mean error, worst seed (10 cm)", f"{100 * max(means):.1f} cm",
                         max(means) <= MEAN_BOUND)
        if crippled:
            run = logs.localize(f"{name}-dead-reckoning", [*common, "--odometry-seed", seeds[0], "--dead-reckoning"])
            rows.append(row_of(name, "dead reckoning", "reference", f"seed {seeds[0]}", run))
            verdict.want(f"{name}, dead reckoning (must exceed 10 cm)", f"{100 * run['mean_error_m']:.0f} cm",
                         run["mean_error_m"] > MEAN_BOUND)
    for method in methods:
        scans = sum(run["reference_scans"] for run in runs[method])
        sure = scans - sum(run["unsure_scans"] for run in runs[method])
        wrong = sum(run["sure_and_wrong_scans"] for run in runs[method])
        verdict.want(f"{method}, given start: says that it knows (80 %)", f"{100 * sure / scans:.1f} % of {scans} scans",
                     scans >= 100 and sure >= LEAST_KNOWN * scans)
        verdict.want(f"{method}: sure and wrong (0.5 %)", f"{wrong} of {sure} scans", wrong <= MOST_WRONG * sure)
    print_table(HEADER, rows)


def protocol(program, root, options):
    data = Path(os.environ.get("DOCENT_DATA", root.parent / "shared" / "data"))
    if not (data / "maps" / "wean.yaml").exists():
        raise RuntimeError(f"no recorded data in {data}; DOCENT_DATA says where they are")
    logs = Logs(program, data, options.pictures)
    methods = [options.method] if options.method else ["grid"] if options.slice else METHODS
    parts = [options.part] if options.part else ["wean", "corrected", "starts"] if options.slice else PARTS
    seeds = range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else 5)))
    beginnings = 12 if options.slice else options.seeds or BEGINNINGS
    verdict = Verdict()
    if "wean" in parts:
        wean(logs, methods, verdict, options.slice)
    if "intel" in parts:
        intel(logs, methods, verdict, not options.no_crippled)
    if "corrected" in parts:
        corrected(logs, options.slice, methods, seeds, verdict, not options.no_crippled)
    if "starts" in parts:
        names = ["seattle"] if options.slice else [*starts.WEAN, "intel", *starts.CORRECTED]
        starts.starts(logs, methods, beginnings, options.first_seed, names, MOTION, SURFACES, verdict)
    if "drawn" in parts:
        drawn_logs.protocol(logs, methods, 1 if options.slice else options.seeds or 10, options.first_seed, verdict)
    if "peer" in parts:
        names = ["seattle"] if options.slice else [*starts.WEAN, "intel", *starts.CORRECTED]
        starts.peer(logs, methods, beginnings, options.first_seed, names, MOTION, SURFACES, verdict)
    print()
    verdict.print()
    return verdict
