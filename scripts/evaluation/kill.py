"""Every module killed, stopped and slowed to a tenth where it hurts, in a robot of processes over DDS."""
import hashlib
import json
import os
import subprocess

from evaluation.bounds import bounded
from evaluation.reports import contacts_of
from evaluation.tables import Verdict, print_table

TARGET = "docent_kill_protocol"
KIOSK = ["--modules", "web,buttons", "--signals", "kill", "--situations", "asking"]  # what serves the visitor at the robot's screen


def trials_of(simulations, seed, is_slice, which=()):
    """What the program of the trials reports, from the cache when it ran before. `which`: modules, signals and situations."""
    if not os.environ.get("DOCENT_BINARY"):
        subprocess.run(["cmake", "--build", "--preset", "dev", "--target", TARGET], cwd=simulations.root, check=True,
                       stdout=subprocess.DEVNULL)
    program = simulations.root / "build/dev/tests/end_to_end" / TARGET
    key = hashlib.sha256(json.dumps([simulations.key(simulations.museums / "bonn", program), seed, is_slice, *which]).encode())
    folder = simulations.cache / "kill"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"bonn-seed{seed}-{key.hexdigest()[:16]}.json"
    if not path.exists():
        print("\n## every module, killed and stopped\n", flush=True)
        subprocess.run([program, "--report", path, "--seed", str(seed), *which, *(["--slice"] if is_slice else [])],
                       check=False)
        if not path.exists():
            raise RuntimeError("the kill protocol made no report")
    return json.loads(path.read_text())


def protocol(simulations, options):
    result = trials_of(simulations, options.first_seed, options.slice)
    header = ["module", "kills", "back s: median", "worst", "stops", "stood s: worst", "slowed", "contacts", "faults"]
    rows = []
    for module in dict.fromkeys(trial["module"] for trial in result["trials"]):
        trials = [trial for trial in result["trials"] if trial["module"] == module]
        kills = sorted(99.0 if t["back_s"] is None else t["back_s"] for t in trials if t["signal"] == "kill")
        stood = [t["stood_s"] for t in trials if t["stood_s"] is not None]
        rows.append([module, len(kills), kills[len(kills) // 2] if kills else "-", kills[-1] if kills else "-",
                     sum(t["signal"] == "stop" for t in trials), max(stood) if stood else "-", sum(t["signal"] == "slow" for t in trials),
                     sum(t["contacts"] for t in trials), "; ".join(t["fault"] for t in trials if t["fault"]) or "none"])
    print("\n## by module\n")
    print_table(header, rows)
    print()
    verdict = Verdict()
    report = result["report"]
    verdict.want("contacts", bounded(contacts_of(report), report["distance_m"] / 1000), contacts_of(report) == 0)
    verdict.want("area violations", f"{report['area_violations']}", report["area_violations"] == 0)
    verdict.want("back after a kill, worst median (2 s)", f"{max(row[2] for row in rows if row[1])} s",
                 all(row[2] <= 2.0 for row in rows if row[1]))
    verdict.want("back after a kill, worst (6 s)", f"{max(row[3] for row in rows if row[1])} s",
                 all(row[3] <= 6.0 for row in rows if row[1]))
    verdict.want("faults", f"{sum(bool(t['fault']) for t in result['trials'])} of {len(result['trials'])} trials",
                 result["good"])
    verdict.print()
    return verdict
