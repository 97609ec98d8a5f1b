"""Localization held against the truth: recordings of a robot that is walked by hand through the simulated museums,
replayed open-loop through every method and filter; and the whole robot, carried off in the middle of its tours.

What the robot knows while a recording is made decides nothing in it, so that every method sees the same.
"""
import math
import random

from evaluation import pressing, reliability, sonar_dies, twins
from evaluation.bench import scenario
from evaluation.claims import LOST_M, error_m, is_lost, mean, since_known

CROWDS = {  # name: crowd, people in the escort, beams blocked as wanted, bounds: lost share, mean error [m]
    "empty": ("empty", None, 0.0, 0.0, 0.03),
    "escort of 8": ("quiet", (8, 0.5, 1.4), 0.40, 0.0, 0.04),
    "escort of 20": ("quiet", (20, 0.4, 1.4), 0.65, 0.01, 0.06),
}
BLOCKED_WITHIN = 0.08
FILTERS = ["none", "entropy", "distance", "novelty"]
METHODS = ["grid", "particles"]
KIDNAPS = 40  # of a run of the honest protocol: so many that the robot is lost for a tenth of it and more
DEFAULT = ("grid", "distance")
CRIPPLED = ("crippled", "dead reckoning")  # odometry alone after the first "here": must fail where it has a way to drift


def filters_of(method, is_slice):
    """All for the default method; for the other, the default filter and none. A slice judges the default filter alone."""
    if is_slice:
        return [DEFAULT[1]]
    return FILTERS if method == DEFAULT[0] else ["none", DEFAULT[1]]


def settings_of(method, name=DEFAULT[1]):
    return [f"localize.method={method}", f"localize.filter={name}"]


def tracking(bench, verdict, print_table, seeds, minutes, museums, methods, is_slice):
    """Every method and filter over the same recordings, from the moment each first said that it knows."""
    print(f"\n## tracking in a crowd: {len(seeds)} seeds x {minutes:g} minutes x {len(CROWDS)} crowds in {', '.join(museums)}\n")
    rows = []
    for crowd_name, (crowd, escort, wanted, most_lost, most_error) in CROWDS.items():
        def one(museum, seed):
            found = {}
            ways = {(method, name): settings_of(method, name) for method in methods for name in filters_of(method, is_slice)}
            ways[CRIPPLED] = settings_of(*DEFAULT) + ["evaluation.dead_reckoning=true"]
            for way, settings in ways.items():
                claims = bench.claims(museum, seed, minutes, crowd, scenario(escort), settings)
                found[way] = claims, since_known(claims)
            bench.forget(museum, seed, minutes, crowd, scenario(escort))
            return found
        runs = bench.each([lambda m=museum, s=seed: one(m, s) for museum in museums for seed in seeds])
        claims = [row for run in runs for row in run[methods[0], DEFAULT[1]][0]]
        blocked = mean(row["blocked"] for row in claims)
        moving = mean(abs(row["speed"]) > 0.02 or abs(row["true_heading"] - before["true_heading"]) > 0.3
                      for before, row in zip(claims, claims[1:]))
        km = sum(run[methods[0], DEFAULT[1]][0][-1]["distance"] for run in runs) / 1000
        verdict.want(f"{crowd_name}: moving at least 70 % of the time", f"{100 * moving:.0f} % in {km:.2f} km, "
                     f"{100 * blocked:.0f} % of the beams blocked", moving >= 0.7)
        verdict.want(f"{crowd_name}: {100 * wanted:.0f} % of the beams blocked, within {100 * BLOCKED_WITHIN:.0f}",
                     f"{100 * blocked:.0f} %", is_slice or abs(blocked - wanted) <= BLOCKED_WITHIN)
        for way in runs[0]:
            method, name = way
            updates = [row for run in runs for row in run[way][1]]
            never = sum(not run[way][1] for run in runs)
            lost = mean(map(is_lost, updates))
            errors = sorted(error_m(row) for row in updates if not is_lost(row))
            of_runs = sorted(mean(error_m(row) for row in run[way][1] if not is_lost(row)) for run in runs if run[way][1])
            rows.append([crowd_name, f"{100 * blocked:.0f}", method, name, len(updates), never,
                         f"{100 * lost:.2f}", f"{100 * mean(errors):.1f}",
                         f"{100 * errors[int(0.95 * len(errors))]:.1f}" if errors else "-",
                         f"{100 * of_runs[0]:.1f}-{100 * of_runs[-1]:.1f}" if of_runs else "-"])
            if way == DEFAULT:
                verdict.want(f"{crowd_name}: lost, {method} with the {name} filter, at most {100 * most_lost:g} %",
                             f"{100 * lost:.2f} % of {len(updates)} updates, {never} never sure",
                             lost <= most_lost and never == 0)
                verdict.want(f"{crowd_name}: mean error at most {100 * most_error:g} cm",
                             f"{100 * mean(errors):.1f} cm", mean(errors) <= most_error)
            elif way == CRIPPLED:
                verdict.want(f"{crowd_name}: {name} fails as it must", f"{100 * lost:.2f} % lost, {100 * mean(errors):.1f} cm",
                             lost > most_lost or mean(errors) > most_error)
    print_table(["crowd", "blocked %", "method", "filter", "updates", "never sure", "lost %", "error cm", "95 % cm",
                 "runs cm"], rows)


def found_after(claims):
    """Metres driven until the robot said where it is, was right, and stayed so for 10 s; None when it did not."""
    since = None
    for row in claims:
        if row["localized"] and not is_lost(row):
            since = since or row
            if row["time"] - since["time"] >= 10.0:
                return since["distance"], since["time"]
        else:
            since = None
    return None


def unknown_start(bench, verdict, print_table, count, museums, methods):
    rows = []
    print(f"\n## unknown start, {count} a museum\n")
    for museum in museums:
        for name, crowd, escort, least in (("empty", "empty", None, 0.95), ("eight people", "empty", (8, 0.5, 2.5), 0.85)):
            for method in methods:
                def one(seed):
                    # Ten metres at half a metre a second, and what it takes to be sure that it lasts.
                    return bench.claims(museum, seed, 1.2, crowd, scenario(escort), settings_of(method))
                runs = bench.each([lambda s=1000 + seed: one(s) for seed in range(count)])
                found = [found_after(run) for run in runs]
                right = [f for f in found if f is not None and f[0] <= 10.0]
                wrong = sum(any(row["localized"] and is_lost(row) for row in run) for run in runs)
                share = len(right) / count
                metres = sorted(f[0] for f in right)
                seconds = sorted(f[1] for f in right)
                scans = sorted(next((i for i, row in enumerate(run) if not is_lost(row)), len(run)) + 1 for run in runs)
                rows.append([museum, name, method, count, f"{100 * share:.0f}",
                             f"{metres[len(metres) // 2]:.1f}" if metres else "-",
                             f"{seconds[len(seconds) // 2]:.0f}" if seconds else "-", scans[len(scans) // 2], wrong])
                if method == DEFAULT[0]:
                    verdict.want(f"{museum}, {name}: right within 10 m, at least {100 * least:.0f} %",
                                 f"{100 * share:.0f} % of {count}", share >= least)
            for seed in range(count):
                bench.forget(museum, 1000 + seed, 1.2, crowd, scenario(escort))
    print_table(["museum", "people", "method", "starts", "right %", "median m", "median s", "median updates to the place",
                 "sure and wrong"], rows)


def brier(pairs):
    return mean((p - lost) ** 2 for p, lost in pairs)


def honesty_claims(bench, museums, count, method, first_seed=2000, settings=()):
    """Unknown starts, kidnaps and dense escorts: data in which many updates are lost."""
    draw = random.Random(first_seed)

    def one(museum, seed, escort, kidnaps):
        what = (museum, seed, 5, "quiet" if escort else "empty", scenario(escort, kidnaps))
        found = bench.claims(*what, settings_of(method) + list(settings))
        bench.forget(*what)
        return found
    jobs = []
    for museum in museums:
        for i in range(count):
            escort = [None, (8, 0.5, 1.4), (20, 0.4, 1.4)][i % 3]
            kidnaps = [(at, "") for at in sorted(round(draw.uniform(20.0, 290.0), 1) for _ in range(KIDNAPS))]
            jobs.append(lambda m=museum, s=first_seed + i, e=escort, k=kidnaps: one(m, s, e, k))
    return bench.each(jobs)


def tour_claims(bench, museums, count, method, first_seed=2500, settings=()):
    """Whole robots on busy tours, which stand and talk for most of the time amid people; nobody carries them off."""
    jobs = [lambda m=m, s=first_seed + i: bench.of_tours(m, s, 15, "busy", settings=[f"localize.method={method}", *settings])[0]
            for m in museums for i in range(count)]
    return bench.each(jobs)


def honesty(bench, verdict, print_table, museums, count, method):
    print(f"\n## honest: P(lost) against what is true, {count} runs of 5 minutes with {KIDNAPS} kidnaps each a museum, {method}\n")
    runs = honesty_claims(bench, museums, count, method)
    rows = [row for run in runs for row in run]
    pairs = [(row["p_lost"], 1.0 if is_lost(row) else 0.0) for row in rows]
    lost = mean(truth for _, truth in pairs)
    sure = [truth for p, truth in pairs if p < 0.01]
    wrong = mean(sure) if sure else 1.0
    ordered = sorted(pairs)
    table, worst, curve = [], 0.0, []
    for i in range(10):
        part = ordered[len(ordered) * i // 10:len(ordered) * (i + 1) // 10]
        said, was = mean(p for p, _ in part), mean(t for _, t in part)
        worst = max(worst, abs(said - was))
        curve.append((said, was))
        table.append([i + 1, len(part), f"{part[0][0]:.4f}-{part[-1][0]:.4f}", f"{said:.4f}", f"{was:.4f}",
                      f"{abs(said - was):.3f}"])
    print_table(["bin", "updates", "P(lost)", "mean P(lost)", "lost", "off"], table)
    score = brier(pairs)
    # The best that any threshold on the entropy can do: each side says the share of lost updates on that side.
    by_entropy = sorted((row["entropy"], 1.0 if is_lost(row) else 0.0) for row in rows)
    total, seen, best = sum(t for _, t in by_entropy), 0.0, 1.0
    n = len(by_entropy)
    for i, (_, truth) in enumerate(by_entropy[:-1]):
        seen += truth
        low, high = seen / (i + 1), (total - seen) / (n - i - 1)
        best = min(best, ((i + 1) * low * (1 - low) + (n - i - 1) * high * (1 - high)) / n)
    verdict.want("honest: 10 to 50 % of the updates are lost", f"{100 * lost:.0f} % of {n}", 0.1 <= lost <= 0.5)
    verdict.want("honest: of the sure updates (P(lost) < 0.01) at most 0.5 % wrong",
                 f"{100 * wrong:.2f} % of {len(sure)} ({100 * len(sure) / n:.0f} % of all)", bool(sure) and wrong <= 0.005)
    verdict.want("honest: ten bins of equal mass, each within 0.1", f"worst {worst:.3f}", worst <= 0.1)
    verdict.want("honest: Brier score better than any threshold on the entropy", f"{score:.4f} against {best:.4f}",
                 score < best)
    tours = [row for run in tour_claims(bench, museums, max(1, count // 5), method) for row in since_known(run)]
    right = [row for row in tours if not is_lost(row)]
    alarms = mean(row["p_lost"] > 0.5 or not row["localized"] for row in right)
    said, was = mean(row["p_lost"] for row in tours), mean(map(is_lost, tours))
    verdict.want("honest: on busy tours, of the updates that are right at most 2 % with P(lost) > 0.5 or without a \"here\"",
                 f"{100 * alarms:.2f} % of {len(right)}; mean P(lost) {said:.4f}, lost {was:.4f}", alarms <= 0.02)
    picture = bench.cache / "reliability.svg"
    reliability.plot(picture, curve, 0.1, [
        f"{n} updates in ten equal bins ({sum(said < 0.02 for said, _ in curve)} of them under 0.02), {100 * lost:.0f} % lost, {method}",
        f"Brier score {score:.3f}, best threshold on the entropy {best:.3f}"])
    print(f"\ndrawn: {picture}")


def carried_off(draw, minutes):
    """Times [s] and ways: 0.005 a metre at the half metre a second that the robot is walked, at least once; turned by
    about 180 degrees and shifted by up to 1.5 m, which its odometry does not see."""
    kidnaps, at = [], 30.0
    while not kidnaps or at < 60.0 * minutes - 60.0:
        at = 30.0 + draw.uniform(0.0, 60.0 * minutes - 120.0) if not kidnaps else at
        kidnaps.append((round(at, 1), f"{{shift: 1.5, turn: {180.0 + draw.uniform(-45.0, 45.0):.0f}}}"))
        at += 60.0 + draw.expovariate(0.005 * 0.5)
    return kidnaps


def recovery(bench, verdict, print_table, museums, count, methods):
    """The protocol of the 1999 journal version: someone turns the robot about every so often and moves it a little; it has
    recovered when it is within 45 cm for more than 10 s."""
    print(f"\n## recovery protocol: {count} runs of 10 minutes a museum, turned about and shifted at 0.005 a metre\n")
    rows = []
    draw = random.Random(11)
    plans = [[m, 3000 + i, carried_off(draw, 10)] for m in museums for i in range(count)]
    escort = (8, 0.5, 1.4)
    for method in methods:
        for name in filters_of(method):
            runs = bench.each([lambda m=m, s=s, k=k: bench.claims(m, s, 10, "quiet", scenario(escort, k), settings_of(method, name))
                               for m, s, k in plans])
            kidnaps, recovered, times = 0, 0, []
            for run, (_, _, plan) in zip(runs, plans):
                for n, (at, _) in enumerate(plan):
                    end = plan[n + 1][0] if n + 1 < len(plan) else 600.0
                    kidnaps += 1
                    since = None
                    for row in run:
                        if not at + 0.5 <= row["time"] < end:
                            continue
                        good = row["has_pose"] and error_m(row) < 0.45
                        since = (row["time"] if since is None else since) if good else None
                        if since is not None and row["time"] - since > 10.0:
                            recovered += 1
                            times.append(since - at)
                            break
            times.sort()
            rows.append([method, name, kidnaps, f"{100 * recovered / max(1, kidnaps):.0f}",
                         f"{times[len(times) // 2]:.0f}" if times else "-",
                         f"{times[int(0.9 * len(times))]:.0f}" if times else "-"])
            if (method, name) == DEFAULT:
                verdict.want(f"recovery protocol, {method} with the {name} filter: recovers in at least 95 %",
                             f"{100 * recovered / max(1, kidnaps):.0f} % of {kidnaps}", recovered >= 0.95 * kidnaps > 0)
    for museum, seed, plan in plans:
        bench.forget(museum, seed, 10, "quiet", scenario(escort, plan))
    print_table(["method", "filter", "kidnaps", "recovered %", "median s", "90 % s"], rows)


def since_carried_off(run):
    """Rows from the kidnap on. That which first counts it may still tell of the place before: a robot that is right
    there has found nothing."""
    first = next((i for i, row in enumerate(run) if row["kidnaps"] > 0), len(run))
    if 0 < first < len(run):
        before, row = run[first - 1], run[first]
        moved = math.hypot(row["true_x"] - before["true_x"], row["true_y"] - before["true_y"])
        first += moved <= abs(before["speed"]) * (row["time"] - before["time"]) + LOST_M
    return run[first:]


def kidnapping(bench, verdict, print_table, museums, count):
    print(f"\n## kidnapping: {count} whole robots a museum, quiet, carried off once in the middle of their tours\n")
    rows = []
    for museum in museums:
        draw = random.Random(13)
        plans = [(4000 + i, round(draw.uniform(100.0, 160.0), 1)) for i in range(count)]
        carried = "events:\n  - {{at: {:.1f}, kidnap: {{from_hazards: 1.5}}}}\n"
        runs = bench.each([lambda s=s, a=a: bench.of_tours(museum, s, 7, "quiet", 40, carried.format(a))[0] for s, a in plans])
        times, noticed, resumed, touched, was_sure, km = [], [], 0, 0, 0, 0.0
        for run in runs:
            after = since_carried_off(run)
            before = run[-len(after) - 1] if len(run) > len(after) else run[0]
            km += run[-1]["distance"] / 1000
            was_sure += before["localized"] > 0
            lost_from = next((i for i, row in enumerate(after) if not row["localized"]), None)
            found = next((i for i, row in enumerate(after) if row["localized"] and not is_lost(row)), None)
            resumed += bool(after) and after[-1]["explained"] > after[0]["explained"]
            if lost_from is not None:
                noticed.append(after[lost_from]["time"] - after[0]["time"])
                touched += after[-1]["contacts"] - after[lost_from]["contacts"] + after[-1]["violations"] - after[lost_from]["violations"]
            if found is None:
                continue
            driving = sum(min(1.0, b["time"] - a["time"]) for a, b in zip(after[:found], after[1:found + 1])
                          if abs(b["speed"]) > 0.02 or abs(b["true_heading"] - a["true_heading"]) > 0.3)
            times.append((driving, after[found]["time"] - after[0]["time"]))
        times.sort()
        noticed.sort()
        share = len(times) / count
        median = times[len(times) // 2][0] if times else float("inf")
        rows.append([museum, count, was_sure, f"{km:.1f}", f"{100 * share:.0f}", f"{median:.1f}",
                     f"{times[int(0.9 * len(times))][0]:.1f}" if times else "-",
                     f"{noticed[len(noticed) // 2]:.1f}" if noticed else "-", int(touched), resumed])
        verdict.want(f"{museum}, kidnapped: recovers in at least 95 %", f"{100 * share:.0f} % of {count}", share >= 0.95)
        verdict.want(f"{museum}, kidnapped: median under 15 s of driving", f"{median:.1f} s", median < 15.0)
        verdict.want(f"{museum}, kidnapped: no contact once it reports being lost", f"{int(touched)} in {km:.1f} km", touched == 0)
        verdict.want(f"{museum}, kidnapped: the tour resumes, at least 95 %", f"{resumed} of {count}", resumed >= 0.95 * count)
    print_table(["museum", "kidnaps", "knew before", "km", "recovered %", "median s of driving", "90 % s", "noticed after s",
                 "contacts", "resumed"], rows)


def evaluate(bench, verdict, print_table, parts, is_slice, methods, seeds=None):
    """`seeds`: how many of the twenty seeds, or of the hundred starts and kidnaps a museum; None: all."""
    museums = ["bonn"] if is_slice else ["bonn", "smithsonian"]
    if "tracking" in parts:
        tracking(bench, verdict, print_table, range(1, 2 if is_slice else 1 + (seeds or 20)), 2 if is_slice else 10, museums, methods, is_slice)
    if "start" in parts:
        unknown_start(bench, verdict, print_table, 6 if is_slice else seeds or 100, museums, methods)
    if "honest" in parts and not is_slice:
        honesty(bench, verdict, print_table, museums, seeds or 30, DEFAULT[0])
    if "kidnap" in parts and not is_slice:
        kidnapping(bench, verdict, print_table, museums, seeds or 100)
    if "pressing" in parts and not is_slice:
        pressing.protocol(bench, verdict, print_table, seeds or 20)
    if "active" in parts and not is_slice:
        twins.active(bench, verdict, print_table, seeds or 20)
    if "sonar-dies" in parts:
        sonar_dies.protocol(bench, verdict, print_table, museums, 1 if is_slice else seeds or 5, is_slice, methods)
    if "recovery" in parts and not is_slice:
        recovery(bench, verdict, print_table, museums, seeds or 10, methods)
