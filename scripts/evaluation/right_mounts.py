"""Of scripts/evaluate mounts: how often something is named that is right, and whether the errors that are told are true.

Part `right`: a robot of which nothing is wrong but what the simulator's screws leave (half a degree, 7 mm), in both museums, begun anew again and
again, for it is the first metres that may mislead it, and for hours. Part `logs`: recordings of real robots with their own odometry, in pieces:
a mount is the same all along a log, so the pieces' estimates may differ by no more than the errors that they tell, and what one piece names the
whole log must not deny. How the scanners really were mounted nobody knows."""
import json
import math
import os
import subprocess
import tempfile
from pathlib import Path

from evaluation.simulations import side_by_side
from evaluation.tables import print_table

STARTS, START_MINUTES = 20, 2.0  # of each museum
HOURS = 0.5  # of a seed
REQUESTS = 40  # an hour, after the tour
LOGS = {"intel-raw": 12, "wean-1": 3, "wean-2": 6, "duke-loop5": 3, "sena-loop": 3}  # pieces of each
NAMED_HEADING, NAMED_PLACE = 1.5, 0.03  # [deg], [m]: calibrate.named_heading and its like
TRUE_ERRORS = 1.5  # root mean square of (piece - whole) / error told; 1 where they are true
ONE_SIGMA = {"heading_deg": "sigma_heading_deg", "x_m": "sigma_x_m", "y_m": "sigma_y_m"}


def evaluate_right(simulations, verdict, options, run_case, right):
    museums = options.museums.split(",") if options.museums else ["bonn"] if options.slice else ["bonn", "smithsonian"]
    count = options.seeds or (3 if options.slice else STARTS)
    first = options.first_seed + 100
    jobs = [(museum, seed, START_MINUTES) for museum in museums for seed in range(first, first + count)]
    jobs += [(museum, seed, 60 * HOURS) for museum in museums for seed in range(first, first + (0 if options.slice else max(1, count // 5)))]
    runs = side_by_side([lambda job=job: run_case(simulations, right, *job, requests=REQUESTS) for job in jobs], simulations.jobs)
    rows = []
    for museum in museums:
        for minutes in sorted({job[2] for job in jobs}):
            mine = [run for job, run in zip(jobs, runs) if job[0] == museum and job[2] == minutes]
            rows.append([museum, f"{minutes:g}", len(mine), f"{sum(run.km for run in mine):.2f}", sum(bool(run.reasons) for run in mine),
                         f"{max(run.slow_m for run in mine):.1f}", sum(run.hazards for run in mine)])
    print_table(["museum", "minutes", "runs", "km", "named", "slow for m, at most", "hazards"], rows)
    for job, run in zip(jobs, runs):
        for time, reason in run.reasons[:1]:
            print(f"   {job[0]} seed {job[1]}, {time:.0f} s: {reason}")
    false = sum(bool(run.reasons) for run in runs)
    km = sum(run.km for run in runs)
    verdict.want("right mounts: runs in which something is named (0)", f"{false} of {len(runs)}, {km:.2f} km", false == 0 and km > 0)


def estimate(simulations, log, begin, end):
    """What `docent calibrate` says of the one scanner of a piece."""
    with tempfile.TemporaryDirectory(prefix="docent-mounts-") as scratch:
        report = Path(scratch) / "report.json"
        subprocess.run([simulations.docent, "calibrate", "--log", log, "--from", f"{begin:.6f}", "--to", f"{end:.6f}", "--report", report],
                       capture_output=True, check=True)
        return json.loads(report.read_text())["scanners"][0]


def evaluate_logs(simulations, verdict):
    data = Path(os.environ.get("DOCENT_DATA", simulations.root.parent / "shared" / "data")) / "logs"
    rows, squares, false, pieces = [], {key: [] for key in ONE_SIGMA}, 0, 0
    for name, count in LOGS.items():
        log = data / f"{name}.clf.gz"
        if not log.exists():
            print(f"skipped: {name}, no recorded data")
            continue
        whole = estimate(simulations, log, 0.0, 1.0)
        own = {key: [] for key in ONE_SIGMA}
        named = 0
        for piece in (estimate(simulations, log, k / count, (k + 1) / count) for k in range(count)):
            for key, sigma in ONE_SIGMA.items():
                own[key].append(((piece[key] - whole[key]) / piece[sigma]) ** 2)
            apart = math.hypot(piece["x_m"] - whole["x_m"], piece["y_m"] - whole["y_m"])
            named += ("turned" in piece["finding"] and abs(piece["heading_deg"] - whole["heading_deg"]) > NAMED_HEADING / 2) or \
                     ("displaced" in piece["finding"] and apart > NAMED_PLACE)
        rows.append([name, count, whole["pairs"], f"{whole['heading_deg']:+.2f} ± {whole['sigma_heading_deg']:.2f}", f"{whole['x_m']:.3f}",
                     *[f"{root_mean(own[key]):.2f}" for key in ONE_SIGMA], named])
        for key, some in own.items():
            squares[key] += some
        false += named
        pieces += count
    print_table(["log", "pieces", "pairs", "heading, whole", "x m", "heading sigmas", "x sigmas", "y sigmas", "named, denied"], rows)
    if not pieces:
        return
    worst = max(root_mean(some) for some in squares.values())
    verdict.want(f"real logs: pieces from the whole, in the errors told, root mean square (at most {TRUE_ERRORS:g})",
                 ", ".join(f"{key.split('_')[0]} {root_mean(some):.2f}" for key, some in squares.items()) + f" of {pieces} pieces", worst <= TRUE_ERRORS)
    verdict.want("real logs: named by a piece and denied by the whole (0)", f"{false} of {pieces} pieces", false == 0)


def root_mean(squares):
    return math.sqrt(sum(squares) / len(squares)) if squares else math.nan
