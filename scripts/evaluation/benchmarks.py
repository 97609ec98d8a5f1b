#!/usr/bin/env python3
"""Judges what one benchmark program left: benchmarks.py NAME EXIT_CODE RESULTS.json PRINTED.txt

Fails when the program failed, when a benchmark reported an error, when a bound that the program prints itself says FAIL, and
when a ratio of BOUNDS is too small or missing."""
import json
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from evaluation.tables import Verdict  # noqa: E402

# Of a program: benchmarks of these names, the counter, the least that the best of them must reach; best because the robot
# takes the best instruction set that the processor has.
BOUNDS = {
    "collision_avoidance_dynamic_window": [
        ("velocity selection / closed form", r"velocity_selection/\d+", "times_faster", 100.0),
    ],
    "collision_avoidance_virtual_measurements": [
        ("virtual measurements, jointly as the robot takes them / plain histogram, one cloud", r"virtual_measurements/5000/0",
         "jointly_times_faster", 3.0),
        ("virtual measurements, jointly as the robot takes them / plain histogram, all over the museum",
         r"virtual_measurements/5000/1", "jointly_times_faster", 3.0),
    ],
}
# Of a program: a slow benchmark, fast ones, and how many times faster than it the best of those must be.
RATIOS = {
    "localization_monte_carlo": [
        ("likelihood field, best instructions / scalar loop", r"field/tracking/scalar_loop", r"field/tracking/(?!scalar).*", 2.0),
        ("likelihood field without AVX / scalar loop", r"field/tracking/scalar_loop", r"field/tracking/plain", 1.0),
        ("likelihood field without AVX / scalar loop, anywhere", r"field/anywhere/scalar_loop", r"field/anywhere/plain", 1.0),
    ],
    "localization_monte_carlo_mrpt": [
        ("a step of MRPT's particle filter, its caches warm / ours", r"step/mrpt", r"step/docent/.*", 30.0),
    ],
}
PRINTED = {"planning_value_iteration": 8, "localization_markov": 2}  # bounds that the program prints itself, at least
NO_MATTER = "this processor has no such instructions"


def judge(name, code, results, printed):
    verdict = Verdict()
    verdict.want("the program ended well", f"exit {code}", code == 0)
    rows = results.get("benchmarks", [])
    errors = [f"{row['name']}: {row.get('error_message', '')}" for row in rows
              if row.get("error_occurred") and row.get("error_message") != NO_MATTER]
    verdict.want("benchmarks without an error", "; ".join(errors) or f"{len(rows)}", bool(rows) and not errors)
    said = [line.strip() for line in printed.splitlines() if re.search(r"\s(pass|FAIL)\s*$", line)]
    failed = [line for line in said if line.endswith("FAIL")]
    least = PRINTED.get(name, 0)
    if said or least:
        verdict.want("bounds printed above", "; ".join(failed) or f"{len(said)} hold", not failed and len(said) >= least)
    for what, pattern, counter, bound in BOUNDS.get(name, []):
        found = [row[counter] for row in rows if re.fullmatch(pattern, row["name"]) and counter in row]
        verdict.want(f"{what} ({bound:g} times faster)", f"{max(found):.1f}" if found else "not run", bool(found) and max(found) >= bound)
    for what, slow, fast, bound in RATIOS.get(name, []):
        of_slow = [row["cpu_time"] for row in rows if re.fullmatch(slow, row["name"]) and not row.get("error_occurred")]
        of_fast = [row["cpu_time"] for row in rows if re.fullmatch(fast, row["name"]) and not row.get("error_occurred")]
        ratio = min(of_slow) / min(of_fast) if of_slow and of_fast else 0.0
        verdict.want(f"{what} ({bound:g} times faster)", f"{ratio:.1f}" if ratio else "not run", ratio >= bound)
    return verdict


def main():
    name, code, results, printed = sys.argv[1:]
    try:
        read = json.loads(Path(results).read_text(encoding="utf-8"))
    except ValueError:
        read = {}
    verdict = judge(name, int(code), read, Path(printed).read_text(encoding="utf-8", errors="replace"))
    verdict.print()
    return 0 if verdict.good else 1


if __name__ == "__main__":
    sys.exit(main())
