"""Crossing a crowded hall: this robot beside the plain dynamic window, scored after HuNavSim's definitions.

One trial is `docent-lab crowd --seed N`: a hall of 14 x 10 m with 0.8 persons a square metre of free floor, half of whom take no
notice of the robot; some look at cases, some stand round guides on the open floor, some walk from one to the other. The
robot crosses 11.4 m. It arrives when it comes within 0.6 m of the goal in three times the time that the empty hall takes,
and 60 s. The same seeds for every method. docs/decisions/0021 says why the hall is as it is.
"""
import concurrent.futures
import hashlib
import json
import os
import statistics
import subprocess
import sys

from evaluation.bounds import bounded
from evaluation.reports import contacts_of
from evaluation.tables import Verdict, print_table

DENSITY, IGNORING = 0.8, 0.5
# What docs/decisions/0021 calls plain: the textbook's window on a way that is planned once, with the map as surveyed.
PLAIN = ("dynamic_window", ["--set", "evaluation.ignores_live_map=true", "--set", "evaluation.without_ladder=true"])
METHODS = {"this robot": ("cautious_window", []), "plain window": PLAIN}
# Shown, not judged: the plain window with all the rest of this robot.
BESIDE = {"plain window, our ways": ("dynamic_window", [])}
ARRIVES, PLAIN_ARRIVES = 0.95, 0.80
INTIMATE_SHARE = 0.5
CRIPPLED = {"blind to people": ["--set", "evaluation.blind_to_people=true"]}
CRIPPLED_SEEDS = 10
LEAST_TRIALS = 100


class Bench:
    def __init__(self, program, cache, run_key, jobs):
        self.program, self.cache, self.jobs = program, cache / "crowd", jobs
        self.key = run_key
        self.cache.mkdir(parents=True, exist_ok=True)

    def trial(self, seed, method, arguments):
        key = hashlib.sha256(json.dumps([self.key, seed, method, DENSITY, IGNORING, arguments]).encode()).hexdigest()[:16]
        path = self.cache / f"{method}-seed{seed}-{key}.json"
        if not path.exists():
            part = path.with_suffix(f".part{os.getpid()}-{seed}")
            done = subprocess.run([self.program, "crowd", "--seed", str(seed), "--density", str(DENSITY), "--ignoring",
                                   str(IGNORING), "--method", method, "--report", part, "--quiet", *arguments],
                                  capture_output=True, text=True, check=False)
            if done.returncode != 0 or not part.exists():
                raise RuntimeError(f"seed {seed}: docent-lab crowd exited {done.returncode}: {done.stderr.strip()[-400:]}")
            part.rename(path)
        return json.loads(path.read_text())

    def all(self, seeds, method, arguments=()):
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            reports = list(pool.map(lambda seed: self.trial(seed, method, list(arguments)), seeds))
        print(f"   {method}: {len(reports)} trials", file=sys.stderr)
        return reports


def contacts(reports):
    return sum(map(contacts_of, reports))


def mean(reports, key):
    return statistics.mean(r[key] for r in reports)


def spread(values):
    """Median and the middle eight tenths."""
    ordered = sorted(values)
    at = lambda share: ordered[min(len(ordered) - 1, int(share * len(ordered)))]
    return f"{at(0.5):.1f} ({at(0.1):.1f}-{at(0.9):.1f})"


def share_of(reports, key):
    return 100 * sum(r[key] for r in reports) / sum(r["seconds"] for r in reports)


def row_of(name, reports):
    arrived = [r for r in reports if r["arrived"]]
    return [name, f"{len(arrived)}/{len(reports)}", spread([r["seconds"] for r in arrived]) if arrived else "-",
            f"{mean(reports, 'path_m'):.1f}", contacts(reports), sum(r["bumped_by_people"] for r in reports),
            f"{share_of(reports, 'intimate_s'):.0f}", f"{share_of(reports, 'personal_s'):.0f}",
            f"{share_of(reports, 'social_s'):.0f}", f"{mean(reports, 'intimate_closing_s'):.2f}",
            spread([r["intimate_closing_s"] for r in reports]), f"{mean(reports, 'near_closing_s'):.1f}",
            f"{mean(reports, 'not_moving_s'):.0f}", f"{mean(reports, 'heading_changes'):.0f}", f"{mean(reports, 'horns'):.1f}",
            f"{mean(reports, 'density_passed'):.2f}"]


HEADER = ["method", "arrived", "s, median (80 %)", "way m", "contacts", "bumped", "intimate %", "personal %", "social %",
          "closing s", "median (80 %)", "closing 0.45 m s", "stands s", "turned rad", "horns", "met 1/m2"]


def judge(ours, plain, least_trials):
    verdict = Verdict()
    rate = lambda reports: sum(r["arrived"] for r in reports) / len(reports)
    arrived = lambda reports: f"{sum(r['arrived'] for r in reports)} of {len(reports)}"
    verdict.want(f"this robot arrives in at least {100 * ARRIVES:.0f} %", arrived(ours), rate(ours) >= ARRIVES)
    verdict.want(f"the plain dynamic window in under {100 * PLAIN_ARRIVES:.0f} %", arrived(plain), rate(plain) < PLAIN_ARRIVES)
    closing, theirs = mean(ours, "intimate_closing_s"), mean(plain, "intimate_closing_s")
    verdict.want(f"intimate while closing in, a trial, at most {100 * INTIMATE_SHARE:.0f} % of the plain one's",
                 f"{closing:.2f} s and {theirs:.2f} s", theirs > 0 and closing <= INTIMATE_SHARE * theirs)
    km = sum(r["path_m"] for r in ours) / 1000
    verdict.want("it pushes nobody and touches nothing",
                 f"contacts: {bounded(contacts(ours), km)}; {sum(r['density_passed'] * r['path_m'] for r in ours) / km / 1000:.2f} "
                 "persons a m2 on its way", contacts(ours) == 0)
    density = mean(ours + plain, "density")
    verdict.want("persons a m2 of free floor", f"{density:.2f}", abs(density - DENSITY) < 0.02)
    verdict.want("trials a method", f"{len(ours)}", len(ours) >= least_trials and len(plain) == len(ours))
    for method, some in (("avoid.method=cautious_window", ours), ("those of the plain window", plain)):
        verdict.want_one_configuration((r["config_hash"] for r in some), f"with {method} as arguments")
    return verdict


def slice_verdict(ours):
    """Few trials say nothing of a rate: nobody is pushed, and most arrive."""
    verdict = Verdict()
    arrived = sum(r["arrived"] for r in ours)
    verdict.want("this robot arrives in most trials", f"{arrived} of {len(ours)}", arrived >= 0.75 * len(ours))
    verdict.want("contacts", bounded(contacts(ours), sum(r["path_m"] for r in ours) / 1000), contacts(ours) == 0)
    return verdict


def protocol(bench, options):
    count = options.seeds or (4 if options.slice else 100)
    seeds = range(options.first_seed, options.first_seed + count)
    print(f"\n## crowd, {DENSITY} persons a m2, {100 * IGNORING:.0f} % ignore the robot, {count} trials a method\n")
    beside = {} if options.slice or options.no_crippled else BESIDE
    methods = {name: METHODS[name] for name in list(METHODS)[:1 if options.slice else 2]} | beside
    reports = {name: bench.all(seeds, *method) for name, method in methods.items()}
    print_table(HEADER, [row_of(name, some) for name, some in reports.items()])
    ours = reports["this robot"]
    print(f"\nempty hall {mean(ours, 'empty_s'):.1f} s, limit {mean(ours, 'limit_s'):.0f} s; {mean(ours, 'people'):.0f} people on "
          f"{mean(ours, 'free_area'):.0f} m2, {100 * mean(ours, 'walking'):.0f} % of them walk. intimate, personal, social: share of "
          "time by the nearest person, outline to middle (HuNavSim); closing: intimate and the robot's own velocity closes the "
          "gap; closing 0.45 m: the same with 0.45 m between the outlines")
    verdict = slice_verdict(ours) if options.slice else judge(ours, reports["plain window"], LEAST_TRIALS)
    for name, arguments in {} if options.no_crippled else CRIPPLED.items():
        some = list(seeds)[:2 if options.slice else CRIPPLED_SEEDS]
        print(f"\n## crowd, crippled: {name}, {len(some)} trials (must push)\n")
        crippled = bench.all(some, "cautious_window", arguments)
        print_table(HEADER, [row_of(name, crippled)])
        verdict.want(f"crippled, {name} (must push people)",
                     f"{contacts(crippled)} contacts in {sum(r['path_m'] for r in crippled):.0f} m", contacts(crippled) > 0)
    print("\n## bounds\n")
    verdict.print()
    return verdict
