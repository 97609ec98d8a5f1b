"""An acknowledged stop while any two processes of a robot of real processes die, in any order, twice, with one gateway and with two, on a disk that
takes something and on one that takes nothing: it moves 0 m until it is released, and released is released everywhere. A robot that nobody has
stopped is the crippled one: it must move. And a day of all that, in a quarter of an hour."""
import hashlib
import json
import os
import subprocess

from evaluation.bounds import bounded
from evaluation.tables import Verdict, print_table

TARGET = "docent_stop_protocol"
PARTS = ["keepers", "beside", "others", "day"]
CONFIGURATIONS = [(gateways, disk) for gateways in (1, 2) for disk in ("free", "full")]
TOGETHER = {"keepers": 1, "beside": 4, "others": 8}  # pairs between a press and its release
SLICE = "web,avoid;gateway 2,robot"
STILL = 0.005  # [m] that a base that stands may say
CONFIRMED = 2.0  # [s]: then it is refused
DAY = 864.0  # [s]: 24 h at a hundredth
MOVES = 0.5  # [m] of a robot that nobody has stopped, while two die


def report_of(simulations, seed, words):
    """What the program saw, from the cache when it ran before."""
    if not os.environ.get("DOCENT_BINARY"):
        subprocess.run(["cmake", "--build", "--preset", "dev", "--target", TARGET], cwd=simulations.root, check=True, stdout=subprocess.DEVNULL)
    program = simulations.root / "build/dev/tests/end_to_end" / TARGET
    key = hashlib.sha256(json.dumps([simulations.key(simulations.museums / "bonn", program), seed, *words]).encode()).hexdigest()[:16]
    folder = simulations.cache / "stop"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"bonn-seed{seed}-{key}.json"
    if not path.exists():
        print(f"\n## {' '.join(words)}\n", flush=True)
        subprocess.run([program, "--seed", str(seed), "--report", path, *words], check=False)
        if not path.exists():
            raise RuntimeError(f"{TARGET} made no report")
    return json.loads(path.read_text())


def judge_pairs(verdict, name, report, full):
    """Bounds of one configuration, each with its exposure."""
    trials = report["trials"]
    exposed = [trial for trial in trials if trial["would_drive"]]
    verdict.want(f"{name}: 0 m while two die, twice", f"{max(trial['way_m'] for trial in trials):.3f} m in the worst of {len(trials)}",
                 bool(trials) and all(abs(trial["way_m"]) <= STILL for trial in trials))
    verdict.want(f"{name}: it had somewhere to go (60 %)", f"{len(exposed)} of {len(trials)}", len(exposed) >= 0.6 * len(trials))
    pressed = [trial["acknowledged_s"] for trial in trials]
    verdict.want(f"{name}: acknowledged within {CONFIRMED:g} s", f"{max(pressed):.2f} s in the worst of {len(pressed)}", max(pressed) <= CONFIRMED)
    faults = [f"{trial['first']}, {trial['second']}: {trial['fault']}" for trial in trials if trial["fault"]]
    verdict.want(f"{name}: released everywhere, all back, on its way again", "; ".join(faults) or f"{len(trials)} of {len(trials)}", not faults)
    verdict.want(f"{name}: contacts", bounded(report["contacts"], report["distance_m"] / 1000), report["contacts"] == 0)
    if full:
        verdict.want(f"{name}: writes that the disk refused (20)", str(report["refused_writes"]), report["refused_writes"] >= 20)
    for control in report["controls"]:
        verdict.want(f"{name}: nobody has stopped it (must exceed {MOVES:g} m)", f"{control['way_m']:.2f} m", control["way_m"] > MOVES)


def table(reports):
    """Every pair, and what it drove in each configuration."""
    seen = {}
    for (gateways, disk), report in reports:
        for trial in report["trials"]:
            text = f"{trial['way_m']:.3f}" + (f" {trial['fault']}" if trial["fault"] else "")
            seen.setdefault((trial["first"], trial["second"]), {})[gateways, disk] = text
    columns = list(dict.fromkeys(configuration for configuration, _ in reports))
    header = ["first", "second", *(f"{gateways} gateway{'s' * (gateways > 1)}, disk {disk}" for gateways, disk in columns)]
    print_table(header, [[*pair, *(cells.get(column, "-") for column in columns)] for pair, cells in sorted(seen.items())])


def judge_day(verdict, report):
    hours = report["hours"]
    faults = [f"{hour['hour']}: {hour['fault']}" for hour in hours if hour["fault"]]
    verdict.want("a day: hours", f"{len(hours)} of 24, {sum(hour['driven_m'] > 1 for hour in hours)} of them driven", len(hours) == 24)
    verdict.want("a day: driven (100 m)", f"{sum(hour['driven_m'] for hour in hours):.0f} m", sum(hour["driven_m"] for hour in hours) >= 100)
    verdict.want("a day: 0 m while it was stopped", f"{max(hour['way_m'] for hour in hours):.3f} m in the worst", all(abs(hour["way_m"]) <= STILL for hour in hours))
    verdict.want("a day: acknowledged, everywhere, by the right hours, all back", "; ".join(faults) or "24 of 24", not faults)
    verdict.want("a day: full disks, clocks set back", f"{sum(hour['full'] for hour in hours)}, {sum(bool(hour['clock']) for hour in hours)}",
                 any(hour["full"] for hour in hours) and any(hour["clock"] for hour in hours))
    verdict.want("a day: contacts", bounded(report["contacts"], report["distance_m"] / 1000), report["contacts"] == 0)


def protocol(simulations, options):
    verdict = Verdict()
    seed = options.first_seed
    if options.slice:
        report = report_of(simulations, seed, ["--gateways", "2", "--disk", "full", "--pairs", SLICE])
        table([((2, "full"), report)])
        judge_pairs(verdict, "two gateways, full disk", report, True)
    else:
        parts = [options.part] if options.part else PARTS
        for part in (part for part in parts if part != "day"):
            reports = [((gateways, disk), report_of(simulations, seed, ["--gateways", str(gateways), "--disk", disk, "--pairs", part, "--together", str(TOGETHER[part])]))
                       for gateways, disk in CONFIGURATIONS]
            print(f"\n## {part}\n")
            table(reports)
            for (gateways, disk), report in reports:
                name = f"{part}, {gateways} gateway{'s' * (gateways > 1)}, disk {disk}"
                verdict.want(f"{name}: every pair", f"{len(report['trials'])} of {report['of']}", len(report["trials"]) == report["of"] > 0)
                judge_pairs(verdict, name, report, disk == "full")
        if "day" in parts:
            judge_day(verdict, report_of(simulations, seed, ["--day", str((options.minutes or DAY / 60) * 60)]))
    print()
    verdict.print()
    return verdict
