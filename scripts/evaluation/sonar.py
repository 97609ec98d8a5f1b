"""Position control of a robot with sonars only.

A drawn office building a seed, its survey as the robot's map, a scripted drive through random places with the simulated
base and sonars; the tracker sees odometry and pings. Dead reckoning on the same drives must fail.
"""
import concurrent.futures
import hashlib
import json
import os
import subprocess
import sys
import time
from pathlib import Path

from evaluation.keys import key_of
from evaluation.tables import Verdict, print_table

P95_BOUND = 0.30  # [m]
MAX_BOUND = 0.60  # [m]
CRIPPLED_SEEDS = 3
TARGET = "docent_sonar_protocol"
HEADER = ["seed", "m2", "km", "moving %", "m/s max", "contacts", "no echo %", "bounced %", "cross talk %", "sweeps", "refused",
          "walls", "mean cm", "p95 cm", "max cm", "heading deg", "in 3 sd %"]


def binary(root):
    """The protocol's program, built unless somebody says where it is."""
    if os.environ.get("DOCENT_SONAR_PROTOCOL"):
        return Path(os.environ["DOCENT_SONAR_PROTOCOL"])
    built = root / "build/dev/tests/sonar_tracking" / TARGET
    if os.environ.get("DOCENT_BINARY") and built.exists():
        return built
    subprocess.run([root / "scripts/install-packages", "run", "evaluate"], check=True)
    if not (root / "build/dev/build.ninja").exists():
        subprocess.run(["cmake", "--preset", "dev"], cwd=root, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", "--preset", "dev", "--target", TARGET], cwd=root, check=True,
                   stdout=subprocess.DEVNULL)
    return built


def drive(program, folder, key, seed, minutes, arguments):
    """One building; its report, from the cache when it was made before."""
    name = hashlib.sha256(json.dumps([key, seed, minutes, arguments]).encode()).hexdigest()[:16]
    path = folder / f"seed{seed}-{name}.json"
    if not path.exists():
        part = path.with_suffix(f".part{os.getpid()}")
        started = time.monotonic()
        done = subprocess.run([program, "--seed", str(seed), "--minutes", str(minutes), "--report", part, *arguments],
                              capture_output=True, text=True, timeout=3600, check=False)
        if done.returncode != 0 or not part.exists():
            raise RuntimeError(f"seed {seed}: {TARGET} exited {done.returncode}: {done.stderr.strip()[-500:]}")
        part.rename(path)
        print(f"   seed {seed}: {time.monotonic() - started:.0f} s", file=sys.stderr)
    return json.loads(path.read_text())


def row_of(report):
    pings = report["pings"]
    total = sum(pings.values())
    sweeps = report["sweeps"]
    return [report["seed"], f"{report['floor_m2']:.0f}", f"{report['distance_m'] / 1000:.2f}",
            f"{100 * report['moving_share']:.0f}", f"{report['max_speed_mps']:.2f}", report["contacts"],
            f"{100 * pings['none'] / total:.0f}", f"{100 * pings['bounced'] / total:.1f}",
            f"{100 * pings['cross_talk'] / total:.1f}", sweeps["matched"], sum(sweeps.values()) - sweeps["matched"],
            report["walls"]["used"], f"{100 * report['mean_error_m']:.1f}", f"{100 * report['p95_error_m']:.1f}",
            f"{100 * report['max_error_m']:.1f}", f"{report['mean_heading_error_deg']:.2f}",
            f"{100 * report['within_three_deviations']:.1f}"]


def judge(reports, minutes):
    verdict = Verdict()
    share = len(reports) * minutes / 300  # floors are for ten seeds of thirty minutes
    km = sum(r["distance_m"] for r in reports) / 1000
    moving = sum(r["moving_share"] for r in reports) / len(reports)
    worst = max(reports, key=lambda r: r["p95_error_m"])
    farthest = max(reports, key=lambda r: r["max_error_m"])
    verdict.want("p95 error, worst seed (30 cm)", f"{100 * worst['p95_error_m']:.1f} cm, seed {worst['seed']}",
                 worst["p95_error_m"] <= P95_BOUND)
    verdict.want("largest error (60 cm)", f"{100 * farthest['max_error_m']:.1f} cm, seed {farthest['seed']}",
                 farthest["max_error_m"] <= MAX_BOUND)
    verdict.want("driven", f"{km:.2f} km in {len(reports)} buildings x {minutes:g} min", km >= 4.0 * share)
    verdict.want("moving", f"{100 * moving:.0f} % of the time", moving >= 0.7)
    fastest = min(r["max_speed_mps"] for r in reports)
    verdict.want("top speed reached, slowest seed (0.85 m/s)", f"{fastest:.2f} m/s", fastest >= 0.85)
    return verdict


def protocol(root, cache, options):
    program = binary(root)
    folder = cache / "sonar"
    folder.mkdir(parents=True, exist_ok=True)
    key = key_of(program)
    count = options.seeds or (2 if options.slice else 10)
    minutes = 8 if options.slice else options.minutes or 30
    seeds = list(range(options.first_seed, options.first_seed + count))

    def run_all(some, arguments):
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            futures = [pool.submit(drive, program, folder, key, seed, minutes, arguments) for seed in some]
            return [future.result() for future in futures]

    print(f"\n## sonar alone, {len(seeds)} drawn office buildings x {minutes:g} minutes, up to 0.9 m/s, known start\n")
    reports = run_all(seeds, [])
    print_table(HEADER, [row_of(report) for report in reports])
    print()
    verdict = judge(reports, minutes)
    verdict.print()
    if options.no_crippled:
        return verdict
    some = seeds[:CRIPPLED_SEEDS]
    variants = [] if options.slice else [("without wall angles, for comparison", ["--no-walls"]),
                                         ("wall angles alone, for comparison", ["--no-matches"])]
    for name, arguments in [*variants, ("dead reckoning, must fail", ["--dead-reckoning"])]:
        print(f"\n## sonar alone, crippled: {name}, {len(some)} seeds\n")
        crippled = run_all(some, arguments)
        print_table(HEADER, [row_of(report) for report in crippled])
    best = min(crippled, key=lambda r: r["max_error_m"])
    fails = all(r["p95_error_m"] > P95_BOUND and r["max_error_m"] > MAX_BOUND for r in crippled)
    fail = Verdict()
    fail.want("dead reckoning fails on every seed", f"least p95 {100 * min(r['p95_error_m'] for r in crippled):.0f} cm, "
                 f"least maximum {100 * best['max_error_m']:.0f} cm", fails)
    print()
    fail.print()
    verdict.add(fail)
    return verdict
