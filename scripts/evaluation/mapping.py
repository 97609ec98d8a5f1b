"""Maps from raw logs of real robots, scored by how places truly lie to each other (relations), and the peer beside it.

intel: raw odometry, 2,984 relations that people have checked; ours, expectation maximization alone, odometry alone, and
MRPT's rbpf-slam as it is shipped. odometry: corrected logs with odometry of our making, seeded, that errs by up to a
third of the way and turns right round. honesty: the same with odometry so bad that maps fail: does the map say so?
loops: logs without a truth, that end where they began. museum: a simulated museum, whose walls are known, from a drive with odometry
as bad as the paper's.
"""
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from evaluation.programs import laboratory
from evaluation.tables import Verdict, print_table

PARTS = ["intel", "peer", "odometry", "honesty", "loops", "museum"]
SLICE = ["odometry", "loops"]  # the tutorial that maps a building runs intel, and its figures are compared
FAILED = 0.5  # [m], mean error of relations: such a map is of no use
INTEL_BOUND = 0.10  # [m]
MOST_MEMORY = 1e6  # [kB]
CLOSED = 0.10  # [m], mean distance of a museum's learned walls from true ones: the map closes
BAD = ["--odometry-turn", "0.15", "--odometry-veer", "0.03"]  # [Minerva2000] 4: 70 m and 180 degrees off after 110 m
FOUND = 0.7  # of the surfaces beside free floor, by a map that closes
HARD = ["--odometry-turn", "0.2", "--odometry-veer", "0.05"]


class Mapper:
    """Runs docent map; keeps maps and pictures where they are wanted."""

    def __init__(self, program, data, pictures, jobs):
        self.program = program
        self.logs = data / "logs"
        self.pictures = Path(pictures) if pictures else None
        self.scratch = tempfile.TemporaryDirectory(prefix="docent-mapping-")
        self.jobs = jobs

    def folder(self, name):
        return (self.pictures or Path(self.scratch.name)) / name

    def start(self, name, log, arguments):
        folder = self.folder(name)
        folder.mkdir(parents=True, exist_ok=True)
        return subprocess.Popen([self.program, "map", "--log", self.logs / log, "--out", folder, "--report", folder / "report.json",
                                 *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def end(self, name, process):
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            raise RuntimeError(f"{name}: docent map exited {process.returncode}: {process.stderr.read()[-500:]}")
        run = json.loads((self.folder(name) / "report.json").read_text())
        run["cpu_s"], run["kB"] = usage.ru_utime + usage.ru_stime, usage.ru_maxrss
        error = f", {run['relations']['metres']:.3f} m" if "relations" in run else ""
        print(f"   {name}: {run['cpu_s']:.0f} s{error}", file=sys.stderr, flush=True)
        return run

    def run(self, name, log, arguments):
        return self.end(name, self.start(name, log, arguments))

    def run_all(self, jobs):
        """`jobs`: (name, log, arguments); so many at a time as there are processors."""
        runs, waiting = [], []
        for name, log, arguments in jobs:
            if len(waiting) == self.jobs:
                runs.append(self.end(*waiting.pop(0)))
            waiting.append((name, self.start(name, log, arguments)))
        return runs + [self.end(*entry) for entry in waiting]


HEADER = ["log", "method", "scans", "relations", "mean m", "spread", "worst", "deg", "loops", "CPU s", "MB", "trusted"]


def row_of(log, method, run):
    score = run.get("relations", {})
    cells = [f"{score[key]:.3f}" if key in score else "-" for key in ("metres", "metres_spread", "metres_worst", "degrees")]
    trusted = {True: "yes", False: "no", None: "-"}[run.get("judgement", {}).get("is_trusted")]
    return [log, method, run.get("scans", "-"), score.get("relations", "-"), *cells, run.get("loops", "-"), f"{run['cpu_s']:.1f}",
            f"{run['kB'] / 1000:.0f}", trusted]


def intel(mapper, verdict, only_graph, crippled):
    print("\n## Intel Research Lab, raw odometry\n")
    common = ["--relations", mapper.logs / "intel.relations"]
    methods = ["graph"] + ([] if only_graph else ["em"]) + (["odometry"] if crippled else [])
    runs = {method: mapper.run(f"intel-{method}", "intel-raw.clf.gz", [*common, "--method", method]) for method in methods}
    print_table(HEADER, [row_of("intel", method, run) for method, run in runs.items()])
    graph = runs["graph"]
    verdict.want("intel: mean error of relations (0.10 m)", f"{graph['relations']['metres']:.3f} m over {graph['relations']['relations']}",
                 graph["relations"]["relations"] >= 2900 and graph["relations"]["metres"] <= INTEL_BOUND)
    verdict.want("intel: memory (1 GB)", f"{graph['kB'] / 1000:.0f} MB", graph["kB"] <= MOST_MEMORY)
    verdict.want("intel: the map trusts itself", graph["judgement"]["reason"] or "yes", graph["judgement"]["is_trusted"])
    if "em" in runs:
        verdict.note("intel: expectation maximization alone", f"{runs['em']['relations']['metres']:.3f} m")
    if crippled:
        error = runs["odometry"]["relations"]["metres"]
        verdict.want("intel, odometry alone (must exceed 0.5 m)", f"{error:.2f} m", error > FAILED)
    return graph


def peer_of(root):
    """MRPT's converter of ours, where MRPT is installed."""
    found = root / "build/dev/tests/mapping_peer/docent_mrpt_rawlog"
    return found if found.exists() and Path(SHIPPED).exists() else None


SHIPPED = "/usr/share/mrpt/config_files/rbpf-slam/gridmapping_RBPF_ICPbased_intel.ini"
# No windows and no pictures, which would cost it time; everything that decides the map stays as it is shipped.
QUIET = {"SHOW_PROGRESS_IN_WINDOW": "0", "SAVE_MAP_IMAGES": "0", "SAVE_3D_SCENE": "0", "LOG_FREQUENCY": "1000000", "verbosity_level": "ERROR"}


def peer(mapper, root, graph, verdict):
    print("\n## MRPT's rbpf-slam as it is shipped for this log, beside it\n")
    converter = peer_of(root)
    if not converter:
        raise RuntimeError("part peer needs mrpt-apps, libmrpt-slam-dev and a build with tests: cmake --build --preset dev")
    folder = mapper.folder("peer").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run([converter, mapper.logs / "intel-raw.clf.gz", folder / "log.rawlog"], check=True)
    text = Path(SHIPPED).read_text()
    for key, value in QUIET.items():
        text = re.sub(rf"^{key}\s*=\s*\S+", f"{key}={value}", text, flags=re.MULTILINE)
    (folder / "peer.ini").write_text(text)
    before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    with open(folder / "peer.log", "w") as log:
        subprocess.run(["rbpf-slam", "peer.ini", "log.rawlog"], cwd=folder, stdout=log, stderr=log, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    print(f"   rbpf-slam: {time.monotonic() - started:.0f} s, {cpu:.0f} s of CPU", file=sys.stderr, flush=True)
    verdict.want("intel: CPU time, ours over rbpf-slam's (half)", f"{graph['cpu_s']:.1f} / {cpu:.1f} s", graph["cpu_s"] <= 0.5 * cpu)


def corrected_logs(mapper):
    return sorted(path.name.split("-corrected")[0] for path in mapper.logs.glob("*-corrected.log.gz"))


def perturbed(mapper, names, seeds, method, more):
    jobs = [(f"{name}-{method}-{seed}{'-hard' if more else ''}", f"{name}-corrected.log.gz",
             ["--reference", "logged", "--odometry", "perturbed", "--odometry-seed", seed, "--method", method, *more])
            for name in names for seed in seeds]
    runs = mapper.run_all(jobs)
    return {name: runs[k * len(seeds):(k + 1) * len(seeds)] for k, name in enumerate(names)}


def print_perturbed(by_log):
    rows = []
    for name, runs in by_log.items():
        errors = sorted(run["relations"]["metres"] for run in runs)
        ends = [run["odometry"]["end_error_m"] / run["odometry"]["way_m"] for run in runs]
        turns = [run["odometry"]["end_error_deg"] for run in runs]
        distrusted = sum(not run["judgement"]["is_trusted"] for run in runs) if "judgement" in runs[0] else "-"
        rows.append([name, len(runs), f"{max(ends):.2f}", f"{max(turns):.0f}", f"{errors[len(errors) // 2]:.3f}", f"{errors[-1]:.3f}",
                     sum(error > FAILED for error in errors), distrusted])
    print_table(["log", "runs", "odometry off, of the way", "deg", "median m", "worst m", "failed", "distrusted"], rows)


def failed(run):
    return run["relations"]["metres"] > FAILED


def judge_honesty(runs, verdict, fewest):
    """Of all runs together: maps that failed and say so, maps that did not and say that they did."""
    bad = [run for run in runs if failed(run)]
    good = [run for run in runs if not failed(run)]
    reported = sum(not run["judgement"]["is_trusted"] for run in bad)
    alarms = sum(not run["judgement"]["is_trusted"] for run in good)
    verdict.want("failed maps that say so (90 %)", f"{reported} of {len(bad)}", len(bad) >= fewest and reported >= 0.9 * len(bad))
    verdict.want("false alarms (5 %)", f"{alarms} of {len(good)}", len(good) >= fewest and alarms <= 0.05 * len(good))


def odometry(mapper, names, seeds, verdict, crippled):
    print(f"\n## Corrected logs with made-up odometry, {len(seeds)} seeds each\n")
    by_log = perturbed(mapper, names, seeds, "graph", [])
    print_perturbed(by_log)
    for name, runs in by_log.items():
        count = sum(map(failed, runs))
        verdict.want(f"{name}: failed maps (1 of 10)", f"{count} of {len(runs)}", count <= 0.1 * len(runs))
    if crippled:
        blind = perturbed(mapper, names[:1], seeds, "odometry", [])[names[0]]
        count = sum(map(failed, blind))
        verdict.want(f"{names[0]}, odometry alone (must fail)", f"{count} of {len(blind)}", count >= 0.9 * len(blind))
    return [run for runs in by_log.values() for run in runs]


def honesty(mapper, names, seeds, ordinary, verdict):
    print(f"\n## The same with odometry so bad that maps fail, {len(seeds)} seeds each\n")
    by_log = perturbed(mapper, names, seeds, "graph", HARD)
    print_perturbed(by_log)
    judge_honesty(ordinary + [run for runs in by_log.values() for run in runs], verdict, 10)


def loops(mapper, verdict):
    print("\n## Logs that end where they began\n")
    rows = []
    for name in ("duke-loop5", "sena-loop"):
        run = mapper.run(name, f"{name}.clf.gz", ["--method", "graph"])
        rows.append(row_of(name, "graph", run) + [run["revisits"], f"{run['revisit_error_m']:.3f}"])
        verdict.want(f"{name}: places seen twice match (0.2 m)", f"{run['revisit_error_m']:.3f} m over {run['revisits']} pairs of scans, {run['loops']} loops",
                     run["loops"] >= 1 and run["revisits"] >= 20 and run["revisit_error_m"] <= 0.2)
    print_table([*HEADER, "pairs", "apart m"], rows)


def museum(mapper, root, seeds, verdict):
    """As [Minerva2000] Figs. 3 and 4: what odometry alone makes of a drive, and what was learned; --pictures keeps both."""
    print(f"\n## Bonn, simulated, with odometry as bad as the paper's, {len(seeds)} seeds\n")
    drive, world = mapper.folder("museum-drive") / "drive.mcap", root / "museums" / "bonn" / "simulation.yaml"
    drive.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run([mapper.program, "simulate", "--museum", root / "museums" / "bonn", "--crowd", "empty", "--hours", "0.13", "--seed", "5",
                    "--requests-per-hour", "60", "--record", drive, "--quiet"], check=True, capture_output=True)
    rows, closed, told, off = [], 0, 0, []
    runs = {method: mapper.run_all([(f"museum-{method}-{seed}", drive, ["--reference", "logged", "--odometry", "perturbed", "--odometry-seed", seed,
                                                                       "--method", method, *BAD]) for seed in seeds]) for method in ("graph", "odometry")}
    for i, seed in enumerate(seeds):
        for method, made in runs.items():
            run, folder = made[i], mapper.folder(f"museum-{method}-{seed}")
            done = subprocess.run([laboratory(mapper.program), "score-map", "--map", folder / "map.yaml", "--world", world, "--report", folder / "score.json"],
                                  check=False, capture_output=True)
            score = json.loads((folder / "score.json").read_text()) if done.returncode == 0 else {"wall_error_m": float("inf"), "found": 0.0}  # fits nowhere
            ends = run["odometry"]
            trusted = run.get("judgement", {}).get("is_trusted")
            rows.append([seed, method, f"{ends['way_m']:.0f}", f"{ends['end_error_m']:.0f}", f"{ends['end_error_deg']:.0f}", f"{score['wall_error_m']:.3f}",
                         f"{100 * score['found']:.0f}", run.get("loops", "-"), {True: "yes", False: "no", None: "-"}[trusted]])
            if method == "graph":
                is_closed = score["wall_error_m"] <= CLOSED and score["found"] >= FOUND
                closed += is_closed
                told += not is_closed and not trusted
                off.append(ends["end_error_deg"])
            else:
                verdict.want(f"museum, seed {seed}, odometry alone (must not close)", f"{100 * score['found']:.0f} % of the surfaces found",
                             score["found"] < FOUND)
    print_table(["seed", "method", "way m", "odometry off m", "deg", "walls m", "found %", "loops", "trusted"], rows)
    verdict.want("museum: the map closes (walls within 10 cm), in 9 of 10", f"{closed} of {len(seeds)}; {told} of the others say that they cannot be trusted",
                 closed >= 0.9 * len(seeds))
    verdict.want("museum: odometry turns right round, the worst seed (150 degrees)", f"{max(off):.0f} degrees", max(off) >= 150 or len(seeds) < 5)


def protocol(program, root, options):
    data = Path(os.environ.get("DOCENT_DATA", root.parent / "shared" / "data"))
    if not (data / "logs" / "intel.relations").exists():
        raise RuntimeError(f"no recorded data in {data}; DOCENT_DATA says where they are")
    mapper = Mapper(program, data, options.pictures, options.jobs)
    parts = [options.part] if options.part else SLICE if options.slice else PARTS
    if options.part == "honesty":
        parts = ["odometry", "honesty"]  # maps that failed and maps that did not are judged together
    names = corrected_logs(mapper)
    names = [name for name in names if name == "seattle"] if options.slice else names
    seeds = range(options.first_seed, options.first_seed + (options.seeds or (2 if options.slice else 10)))
    crippled = not options.no_crippled
    verdict = Verdict()
    if "intel" in parts or "peer" in parts:
        graph = intel(mapper, verdict, options.part == "peer", crippled)
    if "peer" in parts:
        peer(mapper, root, graph, verdict)
    ordinary = odometry(mapper, names, seeds, verdict, crippled) if "odometry" in parts else []
    if "honesty" in parts:
        honesty(mapper, names, seeds, ordinary, verdict)
    if "loops" in parts:
        loops(mapper, verdict)
    if "museum" in parts:
        museum(mapper, root, seeds, verdict)
    print()
    verdict.print()
    return verdict
