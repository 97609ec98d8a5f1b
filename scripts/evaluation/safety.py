"""Nothing touched: busy and packed crowds in three museums, many seeds.

Bonn, the Smithsonian, and a museum that `docent museum` makes of a recorded map with recorded pedestrians, who react to
nothing. Every cell of museum and crowd needs its exposure: the rates below are for an hour of simulated time. The
crippled robots run in the same museums and must fail the same bounds.
"""
import concurrent.futures
import os
import re
import subprocess
from pathlib import Path

from evaluation.keys import key_of
from evaluation.tables import Verdict, print_table

MUSEUMS = ["bonn", "smithsonian", "collection"]
CROWDS = ["busy", "packed"]
KM_AN_HOUR = 0.25
PASSES_AN_HOUR = 30
KINDS = ["people", "furniture", "walls", "hazards"]
RECORDINGS = {"eth": 0.60, "students01": 0.40}  # share of the tracks that the museum must keep
MUSEUM_SEED = 1
CRIPPLED_SEEDS = 3
HEADER = ["museum", "crowd", "seed", "km", "passes", *KINDS, "bumped", "area", "m/s", "lost s", "speedup"]


def data_folder(root):
    return Path(os.environ.get("DOCENT_DATA", root.parent / "shared" / "data"))


def made_museum(docent, root, cache, verdict):
    """The museum made from the recorded map; None where there is no recorded data."""
    data = data_folder(root)
    plan = data / "maps" / "collection.yaml"
    people = [data / "pedestrians" / name for name in RECORDINGS]
    if not plan.exists() or not all(folder.exists() for folder in people):
        print(f"skipped: no recorded data in {data} (DOCENT_DATA): no museum made from a map")
        return None
    key = key_of(docent, plan, plan.with_suffix(".pgm"), *people)
    folder = cache / "safety" / f"museum-{key}" / "collection"
    said = folder.parent / "said.txt"
    if not said.exists():
        folder.parent.mkdir(parents=True, exist_ok=True)
        done = subprocess.run([docent, "museum", plan, "--out", folder, "--seed", str(MUSEUM_SEED),
                               "--picture", folder.parent / "collection.png", "--pedestrians", *people],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"docent museum exited {done.returncode}: {done.stderr.strip()[-500:]}")
        subprocess.run([docent, "check", folder], check=True, stdout=subprocess.DEVNULL)
        said.write_text(done.stdout)
    print(said.read_text())
    kept = {name: (int(some), int(of)) for name, some, of
            in re.findall(r"^(\S+): (\d+) of (\d+) tracks kept", said.read_text(), re.MULTILINE)}
    for name, least in RECORDINGS.items():
        some, of = kept.get(name, (0, 1))
        verdict.want(f"tracks of {name} kept ({100 * least:.0f} %)", f"{some} of {of}", some >= least * of)
    return folder


def row_of(museum, crowd, seed, report):
    return [museum, crowd, seed, f"{report['distance_m'] / 1000:.3f}", report["passes_within_1m"],
            *(report["contacts"][kind] for kind in KINDS), report["bumped_by_people"], report["area_violations"],
            f"{report['mean_speed_mps']:.2f}", f"{report['localization']['lost_s']:.0f}", f"{report['speedup']:.1f}"]


def sum_of(reports, minutes):
    """The cell's row: sums, and mean speed over the way."""
    km = sum(r["distance_m"] for r in reports) / 1000
    seconds = sum(r["travel_seconds"] for r in reports)
    progress = sum(r["mean_speed_mps"] * r["travel_seconds"] for r in reports)
    return {"km": km, "passes": sum(r["passes_within_1m"] for r in reports),
            "contacts": {kind: sum(r["contacts"][kind] for r in reports) for kind in KINDS},
            "bumped": sum(r["bumped_by_people"] for r in reports),
            "area": sum(r["area_violations"] for r in reports),
            "speed": progress / seconds if seconds else 0.0, "hours": len(reports) * minutes / 60}


def judge(cell, total, share, verdict):
    """@param share  of the exposure that is asked for"""
    touched = sum(total["contacts"].values())
    hours = total["hours"]
    verdict.want(f"{cell}: contacts", f"{touched} in {total['km']:.2f} km, {total['passes']} passes within 1 m, "
                 f"{total['bumped']} times bumped", touched == 0)
    verdict.want(f"{cell}: area violations", total["area"], total["area"] == 0)
    verdict.want(f"{cell}: driven in an hour ({KM_AN_HOUR} km)", f"{total['km'] / hours:.2f} km at {total['speed']:.2f} m/s",
                 total["km"] / hours >= share * KM_AN_HOUR)
    verdict.want(f"{cell}: passes within 1 m in an hour ({PASSES_AN_HOUR})", f"{total['passes'] / hours:.0f}",
                 total["passes"] / hours >= share * PASSES_AN_HOUR)


def run_cells(simulate, name, museums, crowds, seeds, minutes, extra, jobs, verdict, share):
    """Every museum x crowd x seed in one pool; one table."""
    cells = [(museum, crowd) for museum in museums for crowd in crowds]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        futures = {(cell, seed): pool.submit(simulate, name, cell[0], seed, minutes, ["--crowd", cell[1], *extra])
                   for cell in cells for seed in seeds}
        reports = {cell: [futures[cell, seed].result() for seed in seeds] for cell in cells}
    rows = []
    hashes = set()
    for (museum, crowd), of_cell in reports.items():
        rows += [row_of(museum.name, crowd, seed, report) for seed, report in zip(seeds, of_cell)]
        hashes |= {report["config_hash"] for report in of_cell}
        total = sum_of(of_cell, minutes)
        rows.append([museum.name, crowd, "all", f"{total['km']:.2f}", total["passes"], *total["contacts"].values(),
                     total["bumped"], total["area"], f"{total['speed']:.2f}", "", ""])
        judge(f"{museum.name}, {crowd}", total, share, verdict)
    print_table(HEADER, rows)
    print()
    verdict.want("one configuration", ", ".join(sorted(hashes)), len(hashes) == 1)


def protocol(docent, root, cache, simulate, crippled, hazards, options):
    """@param simulate  (name, museum, seed, minutes, arguments) -> report
    @param crippled  arguments by name of the way; each must fail
    @param hazards  () -> True when hazards from the best pose alone fail where those of the whole belief hold"""
    minutes = options.minutes or (4 if options.slice else 20)
    count = options.seeds or (1 if options.slice else 20)
    seeds = list(range(options.first_seed, options.first_seed + count))
    names = options.museums.split(",") if options.museums else MUSEUMS
    crowds = options.crowds.split(",") if options.crowds else CROWDS
    verdict = Verdict()
    museums = []
    for name in names:
        if name not in MUSEUMS:
            raise RuntimeError(f"--museums {name}: known are {', '.join(MUSEUMS)}")
        museum = made_museum(docent, root, cache, verdict) if name == "collection" else root / "museums" / name
        if museum is not None:
            museums.append(museum)
    share = 0.2 if count * minutes < 60 else 1.0  # a single short run must only not be idle
    print(f"\n## {count} seeds x {minutes:g} minutes, unknown start\n")
    run_cells(simulate, "safety", museums, crowds, seeds, minutes, [], options.jobs, verdict, share)
    verdict.print()
    good = verdict.good
    if options.slice or options.no_crippled:
        return good
    for name, extra in crippled.items():
        some = seeds[:CRIPPLED_SEEDS]
        print(f"\n## crippled: {name}, {len(some)} seeds (must fail)\n")
        fails = Verdict()
        run_cells(simulate, "safety", museums[:1], ["packed"], some, minutes, extra, options.jobs, fails, 1.0)
        fails.print()
        print("pass  fails as it must" if not fails.good else "FAIL  a crippled robot passed: the protocol sees nothing")
        good = good and not fails.good
    return hazards() and good
