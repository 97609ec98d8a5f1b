"""How fast the robot drives: among people, at night, and between the things of an office.

people: Bonn at a limit of 0.8 m/s; mean speed is the way made while a drive goal is active over that time, blocked time
included. night: the Smithsonian, closed and empty, up to 1.63 m/s; trips of at least 20 m, held against the least time that
the base needs for the way driven (speeding up at 0.5, braking at 1.0 m/s2: a trapezoid). office: drawn office buildings at a
limit of 1.2 m/s; the way driven at 0.9 m/s and more with something solid within 1 m of the robot's outline, by the truth: in an
empty hall there is none.
"""
import concurrent.futures
import csv
import hashlib
import json
import math
import os
import statistics
import subprocess
import sys
import time

from evaluation import crippled, figures
from evaluation.keys import key_of
from evaluation.reports import contacts_of, mean_speed, touched
from evaluation.tables import Verdict, print_table

PARTS = ["people", "night", "office"]
PEOPLE_LIMIT = 0.8  # [m/s]
PEOPLE_BOUNDS = {"busy": 0.45, "packed": 0.30}  # [m/s]
PASSES = {"busy": 1.5, "packed": 6.0}  # within 1 m, a minute: a fifth to a quarter of what was seen
TOP_SPEED, ACCELERATION, BRAKING = 1.63, 0.5, 1.0
TRIP = 20.0  # [m]
NIGHT_SPEED, NIGHT_SHARE = 1.2, 0.8
NIGHT_TRIPS = 0.9  # of the trips by themselves
OFFICE_LIMIT, OFFICE_SPEED, OFFICE_NEAR = 1.2, 0.9, 1.0  # [m/s], [m/s], [m]
OFFICE_WAY = 8.0  # [m a minute] at that speed that near
CRIPPLED_SEEDS = 2


def least_time(way):
    """Of the base for a straight way [m] from rest to rest."""
    ramp = 0.5 * TOP_SPEED**2 * (1 / ACCELERATION + 1 / BRAKING)
    if way >= ramp:
        return way / TOP_SPEED + 0.5 * TOP_SPEED * (1 / ACCELERATION + 1 / BRAKING)
    return (2 * way * (1 / ACCELERATION + 1 / BRAKING)) ** 0.5


def people(simulations, seeds, minutes, verdict, has_crippled):
    header = ["seed", "km", "m/s", "with a goal s", "blocked s", "contacts", "bumped", "area", "passes", "lost"]
    museum = simulations.museums / "bonn"
    for crowd, bound in PEOPLE_BOUNDS.items():
        print(f"\n## bonn, {crowd}, limit {PEOPLE_LIMIT} m/s, {len(seeds)} seeds x {minutes:g} minutes\n")
        arguments = ["--crowd", crowd, "--max-speed", str(PEOPLE_LIMIT)]
        reports = simulations.of_seeds("speed", museum, seeds, minutes, arguments)
        print_table(header, [[seed, f"{r['distance_m'] / 1000:.2f}", f"{r['mean_speed_mps']:.2f}",
                              f"{r['travel_seconds']:.0f}", f"{r['blocked']['seconds']:.0f}", contacts_of(r),
                              r["bumped_by_people"], r["area_violations"], r["passes_within_1m"],
                              r["localization"]["lost_events"]] for seed, r in zip(seeds, reports)])
        speed = mean_speed(reports)
        speeds = [r["mean_speed_mps"] for r in reports]
        seconds = sum(r["travel_seconds"] for r in reports)
        count, seen = touched(reports)
        verdict.want(f"{crowd}, mean speed ({bound} m/s)", f"{speed:.3f} m/s over {seconds:.0f} s, seeds "
                     f"{min(speeds):.2f} to {max(speeds):.2f}", speed >= bound and seconds >= 0.3 * 60 * minutes * len(seeds))
        verdict.want(f"{crowd}, contacts and area violations", seen, count == 0)
        passes = sum(r["passes_within_1m"] for r in reports) / (minutes * len(seeds))
        verdict.want(f"{crowd}, passes within 1 m a minute ({PASSES[crowd]:g})", f"{passes:.1f}", passes >= PASSES[crowd])
        verdict.hashes |= {r["config_hash"] for r in reports}
    if not has_crippled:
        return
    some = seeds[:CRIPPLED_SEEDS]
    reports = simulations.of_seeds("speed", museum, some, minutes, ["--crowd", "packed", "--max-speed", str(PEOPLE_LIMIT),
                                                                    *crippled.CRIPPLED["blind to people"]])
    crippled.want_touches("blind to people", "bonn, packed", reports, verdict)


def night(simulations, seeds, minutes, verdict):
    print(f"\n## smithsonian, closed and empty, up to {TOP_SPEED} m/s, {len(seeds)} seeds x {minutes:g} minutes\n")
    reports = simulations.of_seeds("speed", simulations.museums / "smithsonian", seeds, minutes,
                                   ["--crowd", "empty", "--mode", "closed", "--requests-per-hour", "60"])
    rows, trips = [], []
    for seed, report in zip(seeds, reports):
        long = [trip for trip in report["trips"] if trip["distance_m"] >= TRIP]
        trips += long
        speeds = [trip["distance_m"] / trip["seconds"] for trip in long]
        shares = [least_time(trip["distance_m"]) / trip["seconds"] for trip in long]
        rows.append([seed, f"{report['distance_m'] / 1000:.2f}", len(long),
                     f"{statistics.mean(speeds):.2f}" if long else "-", f"{min(speeds):.2f}" if long else "-",
                     f"{100 * statistics.mean(shares):.0f}" if long else "-", f"{report['max_speed_mps']:.2f}",
                     contacts_of(report), report["area_violations"]])
    print_table(["seed", "km", f"trips of {TRIP:g} m", "m/s", "least", "of the bound %", "top m/s", "contacts", "area"], rows)
    seconds = sum(trip["seconds"] for trip in trips)
    way = sum(trip["distance_m"] for trip in trips)
    count, seen = touched(reports)
    share = sum(least_time(trip["distance_m"]) for trip in trips) / seconds if trips else 0.0
    enough = len(trips) >= 0.1 * minutes * len(seeds)
    verdict.want(f"night, mean speed of trips of {TRIP:g} m and more ({NIGHT_SPEED} m/s)",
                 f"{way / seconds if trips else 0:.2f} m/s over {len(trips)} trips, {way / 1000:.2f} km",
                 enough and way / seconds >= NIGHT_SPEED)
    verdict.want(f"night, of the trapezoid bound ({100 * NIGHT_SHARE:.0f} %)", f"{100 * share:.0f} %",
                 share >= NIGHT_SHARE)
    swift = [trip for trip in trips if trip["distance_m"] / trip["seconds"] >= NIGHT_SPEED
             and least_time(trip["distance_m"]) / trip["seconds"] >= NIGHT_SHARE]
    verdict.want(f"night, trips that hold both by themselves ({100 * NIGHT_TRIPS:.0f} %)", f"{len(swift)} of {len(trips)}",
                 enough and len(swift) >= NIGHT_TRIPS * len(trips))
    verdict.want("night, contacts and area violations", seen, count == 0)
    verdict.hashes |= {r["config_hash"] for r in reports}


def read_profile(path):
    with open(path, newline="", encoding="utf-8") as file:
        text = ("state", "reason")
        return [{key: value if key in text else float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def fast_and_near(rows):
    """[m] driven at OFFICE_SPEED and more, with something solid within OFFICE_NEAR of the outline."""
    return sum(max(0.0, b["distance"] - a["distance"]) for a, b in zip(rows, rows[1:])
               if a["speed"] >= OFFICE_SPEED and a["nearest_solid"] <= OFFICE_NEAR)


def drive_office(docent, folder, key, seed, minutes):
    """One building; its report and profile, from the cache when it was driven before."""
    name = hashlib.sha256(json.dumps([key, seed, minutes, OFFICE_LIMIT]).encode()).hexdigest()[:16]
    report, profile = folder / f"seed{seed}-{name}.json", folder / f"seed{seed}-{name}.csv"
    if not (report.exists() and profile.exists()):
        started = time.monotonic()
        building = folder / f"building-{seed}-{name}"
        commands = [[docent, "office", "--seed", str(seed), "--out", building],
                    [docent, "simulate", "--museum", building, "--hours", f"{minutes / 60:.6f}", "--seed", str(seed),
                     "--crowd", "empty", "--max-speed", str(OFFICE_LIMIT), "--requests-per-hour", "60", "--quiet",
                     "--report", f"{report}.part{os.getpid()}", "--drive-log", f"{profile}.part{os.getpid()}"]]
        for command in commands:
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode != 0:
                raise RuntimeError(f"office {seed}: exited {done.returncode}: {done.stderr.strip()[-400:]}")
        os.rename(f"{profile}.part{os.getpid()}", profile)
        os.rename(f"{report}.part{os.getpid()}", report)
        print(f"   office {seed}: {time.monotonic() - started:.0f} s", file=sys.stderr)
    return json.loads(report.read_text()), read_profile(profile)


def office(simulations, seeds, minutes, verdict):
    print(f"\n## {len(seeds)} drawn offices, empty, limit {OFFICE_LIMIT} m/s, {minutes:g} minutes each\n")
    folder, key = simulations.cache / "office", key_of(simulations.docent)
    folder.mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(simulations.jobs) as pool:
        runs = list(pool.map(lambda seed: drive_office(simulations.docent, folder, key, seed, minutes), seeds))
    ways = [fast_and_near(rows) for _, rows in runs]
    print_table(["seed", "km", "m/s", "top m/s", f"m at {OFFICE_SPEED} within {OFFICE_NEAR} m", "contacts", "area"],
                [[seed, f"{r['distance_m'] / 1000:.2f}", f"{r['mean_speed_mps']:.2f}", f"{r['max_speed_mps']:.2f}",
                  f"{way:.0f}", contacts_of(r), r["area_violations"]] for seed, (r, _), way in zip(seeds, runs, ways)])
    count, seen = touched([report for report, _ in runs])
    verdict.want(f"office, way at {OFFICE_SPEED} m/s and more within {OFFICE_NEAR} m of things ({OFFICE_WAY:g} m a minute, "
                 "in every building)", f"{min(ways):.0f} to {max(ways):.0f} m in {minutes:g} minutes",
                 min(ways) >= OFFICE_WAY * minutes)
    verdict.want("office, contacts and area violations", seen, count == 0)
    verdict.hashes |= {r["config_hash"] for r, _ in runs}
    path = folder / "velocity-profile.svg"
    plot(path, [(f"office {seed}", rows) for seed, (_, rows) in zip(seeds, runs)])
    print(f"\n      drawn: {path}")


def plot(path, profiles, seconds=240.0):
    """Speed over time since it first drove, a panel a building; dark where something solid is within OFFICE_NEAR."""
    columns = min(2, len(profiles))
    rows = (len(profiles) + columns - 1) // columns

    def fill(figure):
        panels = figures.under_legend(figure).subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
        for panel, (name, profile) in zip(panels.flat, profiles):
            begin = next((row["time"] for row in profile if row["speed"] > 0.3), 0.0)
            shown = [row for row in profile if begin <= row["time"] <= begin + seconds]
            times = [row["time"] - begin for row in shown]
            speeds = [row["speed"] for row in shown]
            near = [row["nearest_solid"] <= OFFICE_NEAR for row in shown]
            # A piece between two rows is what the first of them says.
            dark = [speed if near[i] or (i > 0 and near[i - 1]) else math.nan for i, speed in enumerate(speeds)]
            panel.plot(times, speeds, color=figures.LIGHT_BLUE, linewidth=0.8, label="speed")
            panel.plot(times, dark, color=figures.BLUE, linewidth=1.0,
                       label=f"speed with something solid within {OFFICE_NEAR:g} m of the outline")
            panel.axhline(OFFICE_SPEED, color=figures.RED, linewidth=0.8, linestyle=figures.DASHED, label=f"{OFFICE_SPEED} m/s")
            panel.set_title(name, loc="left")
            panel.grid(axis="y")
        for panel in list(panels.flat)[len(profiles):]:
            panel.set_axis_off()
        panels[0][0].set(xlim=(0.0, seconds), ylim=(0.0, 1.05 * OFFICE_LIMIT), yticks=[0.0, 0.3, 0.6, 0.9, 1.2])
        for panel in panels[:, 0]:
            panel.set_ylabel("speed [m/s]")
        for panel in panels[-1]:
            panel.set_xlabel("time since it first drove [s]")
        figures.legend(figure, f"Speed in drawn offices, limit {OFFICE_LIMIT} m/s", panels[0][0].get_legend_handles_labels()[0])

    figures.draw(path, (figures.WIDTH, 1.0 + 0.95 * rows), fill)


def protocol(simulations, options):
    parts = [options.part] if options.part else PARTS
    verdict = Verdict()

    def seeds_of(default, in_slice=1):
        return list(range(options.first_seed, options.first_seed + (options.seeds or (in_slice if options.slice else default))))

    if "people" in parts:  # ten minutes among people tell their mean speed to 0.07 m/s
        people(simulations, seeds_of(20, 2), options.minutes or (10 if options.slice else 20), verdict,
               not options.no_crippled and not options.slice)
    if "night" in parts:
        night(simulations, seeds_of(10), options.minutes or (16 if options.slice else 20), verdict)
    if "office" in parts:
        office(simulations, seeds_of(20), options.minutes or (4 if options.slice else 10), verdict)
    verdict.want_one_configuration(verdict.hashes)
    print("\n## bounds\n")
    verdict.print()
    return verdict
