"""`scripts/evaluate exploration --part plans`: a robot without a map maps buildings that others drew, with the area that `docent museum`
draws of them, which narrows in the doors.

All floor that is wide enough must be seen, nothing touched, and no place tried twice in vain: by the log of how it truly drove, not by
what it says of itself."""
import concurrent.futures
import csv
import math
import shutil
from pathlib import Path

from evaluation.bounds import bounded
from evaluation.safety import data_folder
from evaluation.tables import Verdict, print_table

PLANS = ["office_a", "NLB", "lab_intel", "lab_ipa", "Freiburg101_scan"]
SLICE = ["office_a"]
COVERED = 0.98  # of the floor that lasers can see from where the robot can drive
STANDS = 1.5  # [s] before something on end, with a speed below SLOW: it was tried
SLOW = 0.03  # [m/s]
ONE_PLACE = 1.0  # [m]
APART = 20.0  # [s] between two tries of one place
IN_THE_WAY = ("border_in_way", "hazard_in_way", "obstacle_in_way")
YAML = "image: {}\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"


def tries(drive_log):
    """(time, x, y, reason) of each stand before something in the way."""
    stands, since, row = [], None, None
    with open(drive_log, encoding="utf-8") as log:
        for row in csv.DictReader(log):
            time = float(row["time"])
            is_held = abs(float(row["speed"])) < SLOW and row["reason"].startswith(IN_THE_WAY)
            if not is_held:
                since = None
            elif since is None:
                since = time
            elif since > 0.0 and time - since >= STANDS:
                stands.append((time, float(row["x"]), float(row["y"]), row["reason"]))
                since = math.inf  # this stand is counted
    return stands


def tried_twice(stands):
    """Places at which it stood again after it had been elsewhere, with their times."""
    again = []
    for i, (time, x, y, _) in enumerate(stands):
        if any(time - then > APART and math.hypot(x - at_x, y - at_y) < ONE_PLACE for then, at_x, at_y, _ in stands[:i]):
            again.append((round(time), round(x, 1), round(y, 1)))
    return again


def museum_of(explorations, plan, seed):
    """A museum made of the drawn plan, its area as it is drawn."""
    folder = Path(explorations.scratch.name) / f"{plan.stem}-{seed}"
    if not folder.exists():
        shutil.copy(plan, explorations.scratch.name)
        yaml = Path(explorations.scratch.name) / f"{plan.stem}.yaml"
        yaml.write_text(YAML.format(plan.name), encoding="utf-8")
        explorations.call("museum", yaml, "--out", folder, "--seed", seed)
    return folder


def protocol(explorations, root, options):
    data, verdict = data_folder(root) / "rooms", Verdict()
    if not data.is_dir():
        print(f"skipped: no recorded data in {data} (DOCENT_DATA)")
        verdict.want("floor plans", "no data", options.slice)
        return verdict
    names = SLICE if options.slice else PLANS
    count = options.seeds or (1 if options.slice else 2)
    trials = [(name, seed) for name in names for seed in range(options.first_seed, options.first_seed + count)]

    def explore(name, seed, *more):
        museum = museum_of(explorations, data / f"{name}.png", seed)
        log = Path(explorations.scratch.name) / f"{name}-{seed}{'-crippled' if more else ''}.csv"
        run = explorations.run_in(museum, f"{name}-{seed}", 0, seed, "--drive-log", log, *more)
        return run, tries(log) if log.exists() else []

    rows = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        runs = list(pool.map(lambda trial: explore(*trial), trials))
    for (name, seed), (run, stands) in zip(trials, runs):
        told, again = run["exploration"], tried_twice(stands)
        contacts = sum(run["contacts"].values())
        rows.append([name, seed, f"{told['minutes']:.1f}", f"{told['way_m']:.0f}", f"{100 * run['covered']:.2f}", f"{run['floor_m2']:.0f}", len(stands),
                     len(again), contacts, run["area_violations"]])
        exposure = f"{told['way_m']:.0f} m, {told['minutes']:.1f} min"
        verdict.want(f"{name}, seed {seed}: covered ({100 * COVERED:g} %)", f"{100 * run['covered']:.2f} % of {run['floor_m2']:.0f} m2; {exposure}",
                     run["covered"] >= COVERED)
        verdict.want(f"{name}, seed {seed}: ends at home", told["warning"] or "yes", not told["warning"])
        verdict.want(f"{name}, seed {seed}: touches (0)", f"{bounded(contacts, told['way_m'] / 1000)}; {told['minutes']:.1f} min", contacts == 0 and told["way_m"] > 20.0)
        verdict.want(f"{name}, seed {seed}: places tried twice in vain (0)", f"{len(again)} of {len(stands)} stands {again or ''}; {exposure}", not again)
    print_table(["plan", "seed", "min", "m", "covered %", "floor m2", "stands", "twice", "contacts", "outside"], rows)
    print()
    verdict.print()
    return verdict
