"""Nothing touched: busy and packed crowds in three museums, many seeds.

Bonn, the Smithsonian, and a museum that `docent museum` makes of a recorded map with recorded pedestrians, who react to
nothing. Every cell of museum and crowd needs its exposure: the rates below are for an hour of simulated time, and runs
thirty times faster than real time. The crippled robots run in every museum, packed, and must touch something; who reckons dead
may be lost instead. The slice has them in Bonn alone.
"""
import os
import re
import subprocess
from pathlib import Path

from evaluation import crippled
from evaluation.bounds import bounded
from evaluation.keys import key_of
from evaluation.reports import KINDS, computed_of, mean_speed, speedup_of, want_speedup
from evaluation.tables import Verdict, print_table

MUSEUMS = ["bonn", "smithsonian", "collection"]
CROWDS = ["busy", "packed"]
HEEDLESS = 0.1  # share of people who do not evade. Where everybody evades, a robot that is blind to people touches nobody either
KM_AN_HOUR = 0.25
PASSES_AN_HOUR = 30
RECORDINGS = {"eth": 0.60, "students01": 0.40}  # share of the tracks that the museum must keep
MUSEUM_SEED = 1
HEADER = ["museum", "crowd", "seed", "km", "passes", *KINDS, "bumped", "area", "m/s", "lost s", "speedup"]


def data_folder(root):
    return Path(os.environ.get("DOCENT_DATA", root.parent / "shared" / "data"))


def made_museum(simulations, verdict, is_slice):
    """The museum made from the recorded map; None where there is no recorded data: only a slice may do without."""
    data = data_folder(simulations.root)
    plan = data / "maps" / "collection.yaml"
    people = [data / "pedestrians" / name for name in RECORDINGS]
    if not plan.exists() or not all(folder.exists() for folder in people):
        print(f"skipped: no recorded data in {data} (DOCENT_DATA): no museum made from a map")
        if not is_slice:
            verdict.want("a museum made from a recorded map", f"no recorded data in {data} (DOCENT_DATA)", False)
        return None
    key = key_of(simulations.docent, plan, plan.with_suffix(".pgm"), *people)
    folder = simulations.cache / "safety" / f"museum-{key}" / "collection"
    said = folder.parent / "said.txt"
    if not said.exists():
        folder.parent.mkdir(parents=True, exist_ok=True)
        done = subprocess.run([simulations.docent, "museum", plan, "--out", folder, "--seed", str(MUSEUM_SEED),
                               "--picture", folder.parent / "collection.png", "--pedestrians", *people],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"docent museum exited {done.returncode}: {done.stderr.strip()[-500:]}")
        subprocess.run([simulations.docent, "check", folder], check=True, stdout=subprocess.DEVNULL)
        said.write_text(done.stdout)
    print(said.read_text())
    kept = {name: (int(some), int(of)) for name, some, of
            in re.findall(r"^(\S+): (\d+) of (\d+) tracks kept", said.read_text(), re.MULTILINE)}
    for name, least in RECORDINGS.items():
        some, of = kept.get(name, (0, 1))
        verdict.want(f"tracks of {name} kept ({100 * least:.0f} %), and all of these walk", f"{some} of {of}", some >= least * of)
    return folder


def row_of(museum, crowd, seed, report):
    return [museum, crowd, seed, f"{report['distance_m'] / 1000:.3f}", report["passes_within_1m"],
            *(report["contacts"][kind] for kind in KINDS), report["bumped_by_people"], report["area_violations"],
            f"{report['mean_speed_mps']:.2f}", f"{report['localization']['lost_s']:.0f}",
            f"{report['virtual_seconds'] / computed_of(report):.1f}"]


def sum_of(reports, minutes):
    """The cell's row: sums, and mean speed over the way."""
    return {"km": sum(r["distance_m"] for r in reports) / 1000, "passes": sum(r["passes_within_1m"] for r in reports),
            "contacts": {kind: sum(r["contacts"][kind] for r in reports) for kind in KINDS},
            "bumped": sum(r["bumped_by_people"] for r in reports),
            "area": sum(r["area_violations"] for r in reports),
            "speed": mean_speed(reports), "hours": len(reports) * minutes / 60}


def judge(cell, total, share, verdict):
    """@param share  of the exposure that is asked for"""
    contacts = sum(total["contacts"].values())
    hours = total["hours"]
    verdict.want(f"{cell}: contacts", f"{bounded(contacts, total['km'], hours)}; {total['passes']} passes within 1 m, "
                 f"{total['bumped']} times bumped", contacts == 0)
    verdict.want(f"{cell}: area violations", total["area"], total["area"] == 0)
    verdict.want(f"{cell}: driven in an hour ({KM_AN_HOUR} km)", f"{total['km'] / hours:.2f} km at {total['speed']:.2f} m/s",
                 total["km"] / hours >= share * KM_AN_HOUR)
    verdict.want(f"{cell}: passes within 1 m in an hour ({PASSES_AN_HOUR})", f"{total['passes'] / hours:.0f}",
                 total["passes"] / hours >= share * PASSES_AN_HOUR)


def run_cells(simulations, museums, crowds, seeds, minutes, arguments):
    """Reports by museum x crowd, all in one pool, shown in one table."""
    cells = [(museum, crowd) for museum in museums for crowd in crowds]
    reports = simulations.all([("safety", museum, seed, minutes, ["--crowd", crowd, "--heedless", HEEDLESS, *arguments])
                               for museum, crowd in cells for seed in seeds])
    by_cell = {cell: reports[i * len(seeds):(i + 1) * len(seeds)] for i, cell in enumerate(cells)}
    rows = []
    for (museum, crowd), some in by_cell.items():
        rows += [row_of(museum.name, crowd, seed, report) for seed, report in zip(seeds, some)]
        total = sum_of(some, minutes)
        rows.append([museum.name, crowd, "all", f"{total['km']:.2f}", total["passes"], *total["contacts"].values(),
                     total["bumped"], total["area"], f"{total['speed']:.2f}", "", f"{speedup_of(some):.1f}"])
    print_table(HEADER, rows)
    print()
    return by_cell


def protocol(simulations, options):
    minutes = options.minutes or (3 if options.slice else 20)
    count = options.seeds or (2 if options.slice else 20)  # packed, one may look for itself all the time
    seeds = list(range(options.first_seed, options.first_seed + count))
    names = options.museums.split(",") if options.museums else MUSEUMS
    # The tests of tours, bases and faults drive in busy museums.
    crowds = options.crowds.split(",") if options.crowds else CROWDS[-1:] if options.slice else CROWDS
    verdict = Verdict()
    museums = []
    for name in names:
        if name not in MUSEUMS:
            raise RuntimeError(f"--museums {name}: known are {', '.join(MUSEUMS)}")
        museum = made_museum(simulations, verdict, options.slice) if name == "collection" else simulations.museums / name
        if museum is not None:
            museums.append(museum)
    share = 0.2 if count * minutes < 60 else 1.0  # a single short run must only not be idle
    print(f"\n## {count} seeds x {minutes:g} minutes, unknown start\n")
    by_cell = run_cells(simulations, museums, crowds, seeds, minutes, [])
    for (museum, crowd), reports in by_cell.items():
        judge(f"{museum.name}, {crowd}", sum_of(reports, minutes), share, verdict)
        want_speedup(verdict, f"{museum.name}, {crowd}", reports, not options.slice)
    verdict.want_one_configuration(report["config_hash"] for reports in by_cell.values() for report in reports)
    verdict.print()
    if options.no_crippled:
        return verdict
    if options.slice:
        museums = museums[:1]
    for name, arguments in crippled.CRIPPLED.items():
        some = seeds[:crippled.CRIPPLED_SEEDS]
        print(f"\n## crippled: {name}, packed, seeds {some[0]} to {some[-1]} (must touch)\n")
        fails = Verdict()
        long = 2 * minutes if options.slice and name == crippled.MAY_BE_LOST else minutes  # its error grows with the way
        for (museum, _), reports in run_cells(simulations, museums, ["packed"], some, long, arguments).items():
            crippled.want_touches(name, f"{museum.name}, packed", reports, fails)
        fails.print()
        verdict.add(fails)
    if not options.slice:
        verdict.add(crippled.hazards(simulations))
    return verdict
