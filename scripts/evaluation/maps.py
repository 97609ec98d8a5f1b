"""Museums that `docent museum` makes, untouched, of every recorded or drawn map in $DOCENT_DATA/maps that it accepts.

Empty and busy, the same seeds in each. In an empty museum nothing but the robot itself holds it up, so it must hardly ever stand
blocked; in both it serves what is asked for and touches nothing. A map that is refused is shown with the reason.
"""
import subprocess

from evaluation.bounds import bounded
from evaluation.keys import key_of
from evaluation.reports import KINDS, contacts_of
from evaluation.safety import data_folder
from evaluation.tables import Verdict, print_table

CROWDS = ["empty", "busy"]
MOST_BLOCKED = 0.05  # of the driving time, in an empty museum
LEAST_SERVED = 0.95  # of the counted requests, in each museum and in all with one crowd
LEAST_KM_AN_HOUR = 0.25
MUSEUM_SEED = 1
SLICE = ["longwood", "nsh_level_3"]
HEADER = ["museum", "crowd", "km", *KINDS, "area", "travel s", "blocked s", "tours", "served", "lost s"]


def made_museum(simulations, plan):
    """Its folder, or None and why the map was refused."""
    key = key_of(simulations.docent, plan, plan.with_suffix(".pgm"))
    folder = simulations.cache / "maps" / f"museum-{key}" / plan.stem
    said = folder.parent / "said.txt"
    if not said.exists():
        folder.parent.mkdir(parents=True, exist_ok=True)
        done = subprocess.run([simulations.docent, "museum", plan, "--out", folder, "--seed", str(MUSEUM_SEED)],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            return None, done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f"exit {done.returncode}"
        said.write_text(done.stdout)
    return folder, ""


def sum_of(reports):
    requests = [report["requests"] for report in reports]
    return {"km": sum(r["distance_m"] for r in reports) / 1000, "contacts": sum(map(contacts_of, reports)),
            "area": sum(r["area_violations"] for r in reports), "travel": sum(r["travel_seconds"] for r in reports),
            "blocked": sum(r["blocked"]["seconds"] for r in reports), "counted": sum(r["counted"] for r in requests),
            "served": sum(r["counted_served"] for r in requests), "hours": sum(r["virtual_seconds"] for r in reports) / 3600}


def row_of(museum, crowd, reports):
    total = sum_of(reports)
    return [museum, crowd, f"{total['km']:.2f}", *(sum(r["contacts"][kind] for r in reports) for kind in KINDS), total["area"],
            f"{total['travel']:.0f}", f"{total['blocked']:.0f}", sum(r["tours"]["given"] for r in reports),
            f"{total['served']} of {total['counted']}", f"{sum(r['localization']['lost_s'] for r in reports):.0f}"]


def judge(museum, crowd, reports, verdict):
    total = sum_of(reports)
    cell = f"{museum}, {crowd}"
    driven = f"{total['km']:.2f} km in {total['hours']:.2f} h"
    verdict.want(f"{cell}: contacts", bounded(total["contacts"], total["km"], total["hours"]), total["contacts"] == 0)
    verdict.want(f"{cell}: area violations", f"{total['area']} in {driven}", total["area"] == 0)
    share = total["blocked"] / max(1e-9, total["travel"])
    seen = f"{100 * share:.1f} % of {total['travel']:.0f} s"
    if crowd == "empty":
        verdict.want(f"{cell}: blocked while driving ({100 * MOST_BLOCKED:.0f} %)", seen, share <= MOST_BLOCKED)
        verdict.want(f"{cell}: driven in an hour ({LEAST_KM_AN_HOUR} km)", driven, total["km"] >= LEAST_KM_AN_HOUR * total["hours"])
    else:
        verdict.note(f"{cell}: blocked while driving", seen)
    if total["counted"] > 0:
        verdict.want(f"{cell}: counted requests served ({100 * LEAST_SERVED:.0f} %)", f"{total['served']} of {total['counted']}",
                     total["served"] >= LEAST_SERVED * total["counted"])
    else:
        verdict.note(f"{cell}: counted requests", "none: the run is too short")


def protocol(simulations, options):
    minutes = options.minutes or (6 if options.slice else 20)
    count = options.seeds or (1 if options.slice else 3)
    seeds = list(range(options.first_seed, options.first_seed + count))
    crowds = options.crowds.split(",") if options.crowds else CROWDS[:1] if options.slice else CROWDS
    verdict = Verdict()
    plans = sorted((data_folder(simulations.root) / "maps").glob("*.yaml"))
    names = options.museums.split(",") if options.museums else SLICE if options.slice else [plan.stem for plan in plans]
    plans = [plan for plan in plans if plan.stem in names]
    verdict.want("maps", ", ".join(plan.stem for plan in plans) or f"none in {data_folder(simulations.root)} (DOCENT_DATA)", bool(plans))
    museums = []
    for plan in plans:
        folder, why_not = made_museum(simulations, plan)
        if folder is None:
            verdict.note(f"{plan.stem}: refused", why_not)
        else:
            museums.append(folder)
    verdict.want("maps that become a museum", f"{len(museums)} of {len(plans)}", bool(museums))
    print(f"\n## {count} seeds x {minutes:g} minutes, unknown start\n")
    cells = [(museum, crowd) for museum in museums for crowd in crowds]
    reports = simulations.all([("maps", museum, seed, minutes, ["--crowd", crowd]) for museum, crowd in cells for seed in seeds])
    by_cell = [(museum.name, crowd, reports[i * count:(i + 1) * count]) for i, (museum, crowd) in enumerate(cells)]
    print_table(HEADER, [row_of(*cell) for cell in by_cell])
    print()
    for cell in by_cell:
        judge(*cell, verdict)
    for crowd in crowds:
        total = sum_of([report for _, of, some in by_cell if of == crowd for report in some])
        if total["counted"] > 0:
            verdict.want(f"all museums, {crowd}: counted requests served ({100 * LEAST_SERVED:.0f} %)",
                         f"{total['served']} of {total['counted']}", total["served"] >= LEAST_SERVED * total["counted"])
    verdict.want_one_configuration(report["config_hash"] for report in reports)
    verdict.print()
    return verdict
