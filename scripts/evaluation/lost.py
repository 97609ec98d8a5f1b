"""Robots that do not know where they are, where that is hard: carried off to beside hazards, in packed halls, in narrow corridors, inside a zone
that was drawn round them, and with eight faults at once."""
import csv
import math
import random

from evaluation.bounds import bounded
from evaluation import lost_stages
from evaluation.claims import is_lost, read_claims
from evaluation.reports import contacts_of
from evaluation.tables import Verdict, print_table

PARTS = ["hazards", "rolling", "packed", "corridors", "zones", "faults"]
MUSEUMS = ["bonn", "smithsonian"]
CARRIED_UNSEEN = ["--set", "evaluation.misses_carrying=true"]
LOGS = {"--claims": "claims.csv", "--event-log": "events.csv", "--health-log": "health.csv", "--drive-log": "drive.csv"}
SURE = 0.01  # P(lost)
SCAN_S, LATENCY_S, BRAKES = 0.1, 0.18, 1.0  # [s], [s], [m/s2] of the simulated base: from a scan to the wheels, and their braking


def most_likely(failures, trials):
    """The share that 95 % of all such protocols would not have exceeded with so few failures (Clopper and Pearson)."""
    if trials == 0 or failures >= trials:
        return 1.0
    low, high = 0.0, 1.0
    for _ in range(60):
        p = 0.5 * (low + high)
        seen = sum(math.comb(trials, k) * p**k * (1 - p) ** (trials - k) for k in range(failures + 1))
        low, high = (p, high) if seen > 0.05 else (low, p)
    return high


def rate(failures, trials):
    return f"{failures} of {trials} (at most {100 * most_likely(failures, trials):.1f} % at 95 %)"


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def run(simulations, museum, seed, minutes, arguments, scenario=""):
    """(logs by their names, report) of a whole robot."""
    paths, report = simulations.run_logged("lost", museum, seed, minutes / 60.0, arguments, LOGS, scenario)
    return {kind: read_claims(path) if kind == "claims.csv" else rows_of(path) for kind, path in paths.items() if kind != "json"}, report


def found_at(claims, after=0.0):
    """[s] when it said where it is, and was right; None: never."""
    return next((row["time"] for row in claims if row["time"] >= after and row["localized"] and not is_lost(row)), None)


def sure_and_wrong(claims, after=0.0):
    """[s] altogether."""
    return sum(b["time"] - a["time"] for a, b in zip(claims, claims[1:]) if a["time"] >= after and a["p_lost"] < SURE and is_lost(a))


# --- carried off to beside hazards ---

def reached(events, begin, end):
    """Seconds after which it reached a hazard, and which; None: none."""
    for row in events:
        is_hazard = row["source"] == "scenario" and row["kind"] == "fall" or row["source"] == "contact" and row["kind"] == "hazards"
        if begin < float(row["time"]) < end and is_hazard:
            return float(row["time"]) - begin, row["subject"]
    return None


def stood_after(drive, begin, end):
    """Seconds until its wheels stood; None: they never did."""
    return next((float(row["time"]) - begin for row in drive if begin < float(row["time"]) < end and abs(float(row["speed"])) < 0.02), None)


def is_in_time(kidnap):
    """Whether it could have stood before: a base that brakes from the first scan on rolls so far, and no program changes that. Judged by the
    way, so that a robot that drives on is not excused."""
    return kidnap["rolled"] > kidnap["speed"] * (SCAN_S + LATENCY_S) + kidnap["speed"] ** 2 / (2.0 * BRAKES) + 0.02


def way_at(drive, time):
    """[m] driven until then, between two rows of the log in proportion."""
    for before, after in zip(drive, drive[1:]):
        a, b = float(before["time"]), float(after["time"])
        if a <= time <= b:
            share = (time - a) / (b - a) if b > a else 0.0
            return float(before["distance"]) + share * (float(after["distance"]) - float(before["distance"]))
    return float(drive[-1]["distance"]) if drive else 0.0


def kidnaps_of(logs):
    """One dictionary a kidnap."""
    times = [float(row["time"]) for row in logs["events.csv"] if row["source"] == "scenario" and row["kind"] == "kidnap"]
    kidnaps = []
    for begin, end in zip(times, times[1:] + [math.inf]):
        before = [abs(float(row["speed"])) for row in logs["drive.csv"] if begin - 0.3 <= float(row["time"]) <= begin]
        found = found_at(logs["claims.csv"], begin + 0.5)
        hit = reached(logs["events.csv"], begin, end)
        rolled = way_at(logs["drive.csv"], begin + hit[0]) - way_at(logs["drive.csv"], begin) if hit else 0.0
        kidnaps.append({"speed": before[-1] if before else 0.0, "stood": stood_after(logs["drive.csv"], begin, end),
                        "reached": hit, "rolled": rolled,
                        "found": found - begin if found is not None and found < end else None, "at": begin})
    return kidnaps


def rolling(simulations, options, verdict):
    hazards(simulations, options, verdict, keeps_speed=1.0)


def hazards(simulations, options, verdict, keeps_speed=0.0):
    seeds = range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else 3)))
    runs_a_seed = 1 if options.slice else 3
    robots = [("robot", [])] + ([] if options.no_crippled else [("crippled: misses that it is carried off", CARRIED_UNSEEN)])
    rows = []
    for name, settings in robots:
        for museum in MUSEUMS[:1] if options.slice else MUSEUMS:
            calls = [(simulations, simulations.museums / museum, 1000 * seed + i, lost_stages.KIDNAP_MINUTES,
                      ["--crowd", "busy" if i == 2 else "quiet", "--requests-per-hour", "60", *settings],
                      lost_stages.kidnaps_beside_hazards(1000 * seed + i, keeps_speed)) for seed in seeds for i in range(runs_a_seed)]
            kidnaps = [kidnap for logs, _ in simulations.each(run, calls) for kidnap in kidnaps_of(logs)]
            moving = [kidnap for kidnap in kidnaps if kidnap["speed"] > 0.1]
            stood = sorted(kidnap["stood"] if kidnap["stood"] is not None else math.inf for kidnap in moving)
            found = sorted(kidnap["found"] for kidnap in kidnaps if kidnap["found"] is not None)
            rolled = sum(keeps_speed > 0.0 and bool(kidnap["reached"]) and not is_in_time(kidnap) for kidnap in kidnaps)
            hit = [kidnap["reached"] for kidnap in kidnaps if kidnap["reached"] and (keeps_speed == 0.0 or is_in_time(kidnap))]
            rows.append([name, museum, len(kidnaps), len(moving), f"{stood[len(stood) // 2]:.2f}" if stood else "-",
                         f"{stood[int(0.95 * len(stood))]:.2f}" if stood else "-", rolled, len(hit),
                         " ".join(f"{what}@{after:.1f}" for after, what in hit) or "-", len(found),
                         f"{found[len(found) // 2]:.1f}" if found else "-"])
            if settings:
                verdict.want(f"{name}, {museum}: fails as it must", rate(len(hit), len(kidnaps)), len(hit) > 0)
            else:
                if keeps_speed > 0.0:
                    verdict.note(f"{museum}: set down at speed, nearer than it can brake", f"{rolled} of {len(kidnaps)}")
                verdict.want(f"{museum}: carried off to beside hazards, at most 1 % reach one", rate(len(hit), len(kidnaps)),
                             len(kidnaps) >= 5 * len(calls) and len(hit) <= 0.01 * len(kidnaps))
    print_table(["robot", "museum", "kidnaps", "while it drove", "stood after s", "95 % s", "rolled on to one", "reached one", "which, after s", "found itself",
                 "median s"], rows)


# --- packed halls, narrow corridors ---

def starts(simulations, verdict, name, calls, within, least):
    runs = simulations.each(run, calls)
    times, wrong, touched, blocked = [], 0, 0, []
    for logs, report in runs:
        claims = logs["claims.csv"]
        found = found_at(claims)
        times.append(found if found is not None else math.inf)
        wrong += sure_and_wrong(claims) > 0.0
        touched += contacts_of(report)
        blocked += [row["blocked"] for row in claims]
    good = sum(time <= within for time in times)
    ordered = sorted(times)
    verdict.want(f"{name}: find themselves within {within / 60:.0f} minutes, at least {least} of {len(times)}",
                 f"{good} of {len(times)}, {wrong} ever sure and wrong, contacts: "
                 f"{bounded(touched, sum(report['distance_m'] for _, report in runs) / 1000)}", good >= least and touched == 0)
    return [name, len(times), good, f"{ordered[len(ordered) // 2]:.0f}", f"{ordered[int(0.9 * len(ordered))]:.0f}",
            f"{100 * sum(blocked) / max(1, len(blocked)):.0f}", wrong, touched,
            " ".join(str(call[2]) for call, time in zip(calls, times) if time > within) or "-"]


START_COLUMNS = ["stage", "starts", "in time", "median s", "90 % s", "beams on people %", "sure and wrong", "contacts", "seeds that were late"]


def packed(simulations, options, verdict):
    count = options.seeds or (2 if options.slice else 30)
    rows = []
    for museum in MUSEUMS:
        calls = [(simulations, simulations.museums / museum, 4700 + options.first_seed + i, 5.0,
                  ["--crowd", "packed", "--requests-per-hour", "0"]) for i in range(count)]
        rows.append(starts(simulations, verdict, f"packed, {museum}", calls, 300.0, math.ceil(55 / 60 * count)))
    print_table(START_COLUMNS, rows)


def corridors(simulations, options, verdict):
    count = options.seeds or (2 if options.slice else 20)
    calls = []
    for seed in range(options.first_seed, options.first_seed + count):
        folder, begin = lost_stages.draw_corridors(simulations.cache / "lost" / f"corridors-{seed}", seed, simulations.docent)
        calls.append((simulations, folder, seed, 3.0, ["--crowd", "empty", "--requests-per-hour", "0", "--start", begin]))
    print_table(START_COLUMNS, [starts(simulations, verdict, "narrow corridors", calls, 180.0, count)])


# --- inside a zone ---

def zones(simulations, options, verdict):
    count = options.seeds or (1 if options.slice else 5)
    rows = []
    for museum in MUSEUMS[:1] if options.slice else MUSEUMS:
        for how in ("drawn round it", "carried into it"):
            found, named, stood = [], 0, 0
            for seed in range(options.first_seed, options.first_seed + count):
                stage = lost_stages.draw_zone(simulations.cache / "lost" / f"zone-{museum}-{seed}", simulations.museums / museum, seed)
                is_round = how == "drawn round it"
                arguments = ["--crowd", "quiet", *(["--start", stage.begin] if is_round else [])]
                logs, _ = run(simulations, stage.folder, seed, 2.5, arguments, "" if is_round else stage.carried_in(60.0))
                began = next((float(row["time"]) for row in logs["events.csv"] if row["kind"] == "kidnap"), 0.0)
                when = found_at(logs["claims.csv"], began + (0.0 if is_round else 0.5))
                found.append(when - began if when is not None else math.inf)
                named += any(float(row["time"]) >= began and "'drawn'" in row.get("reason", "") for row in logs["health.csv"])
                last = logs["claims.csv"][-1]
                stood += stage.holds(last["true_x"], last["true_y"])
            rows.append([museum, how, count, " ".join(f"{time:.1f}" for time in found), named, stood])
            verdict.want(f"{museum}, a zone {how}: found within 10 s, named, stands in it", f"{sum(t <= 10.0 for t in found)} found, {named} named, "
                         f"{stood} stand, of {count}", all(t <= 10.0 for t in found) and named == stood == count)
    print_table(["museum", "a zone", "seeds", "found after s", "named", "stands"], rows)


# --- eight faults at once ---

def faults(simulations, options, verdict):
    count = options.seeds or (1 if options.slice else 5)
    rows = []
    served = wished = touched = bad = 0
    km = 0.0
    worst = 0.0
    for seed in range(options.first_seed, options.first_seed + count):
        logs, report = run(simulations, simulations.museums / "bonn", seed, lost_stages.FAULT_MINUTES,
                           ["--crowd", "busy", "--requests-per-hour", "0"], lost_stages.eight_faults(seed))
        ends = lost_stages.ends_of(logs["events.csv"])
        wrong = sure_and_wrong(logs["claims.csv"])
        rows.append([seed, len(ends), sum(end == "fulfilled" for end in ends), report["contacts"]["people"], contacts_of(report), f"{wrong:.1f}",
                     f"{report['distance_m']:.0f}"])
        served += sum(end == "fulfilled" for end in ends)
        wished += len(ends)
        bad += sum(end == "fulfilled" for end in ends) < 0.5 * len(ends)
        touched += report["contacts"]["people"]
        km += report["distance_m"] / 1000
        worst = max(worst, wrong)
    print_table(["seed", "wishes", "served", "people touched", "contacts", "sure and wrong s", "m"], rows)
    verdict.want("eight faults at once: nobody touched", f"{bounded(touched, km)}; {count} runs", touched == 0)
    verdict.want("eight faults at once: sure and wrong under 10 s", f"{worst:.1f} s in the worst", worst < 10.0)
    verdict.want("eight faults at once: at least half of the wishes served in each run", f"{served} of {wished}, {bad} runs with fewer", wished > 0 and bad == 0)


def protocol(simulations, options):
    verdict = Verdict()
    parts = {"hazards": hazards, "rolling": rolling, "packed": packed, "corridors": corridors, "zones": zones, "faults": faults}
    for name in [options.part] if options.part else PARTS:
        print(f"\n## lost: {name}\n")
        parts[name](simulations, options, verdict)
    print()
    verdict.print()
    return verdict
