"""The sonars die in the middle of a crowd, which preceded RHINO's error of 30 cm: the robot must not be lost, touch
nothing, and say which sensor it is where that can be known.

By hand: a robot is walked through a museum amid an escort of eight, so that it goes on whatever it thinks of its sensors, and
its sonars fall silent, freeze, hear everything at 0.3 m, hear nothing, hear the echoes of others, each for a minute or
more; replayed by every way to believe. By itself: the whole robot on its tours in a busy museum, struck once and for good.
"""
import random

from evaluation.bounds import bounded
from evaluation.claims import LOST_M, error_m, is_lost, mean, since_known

KINDS = ["dead", "frozen", "short", "deaf", "storm"]
ESCORT = (8, 0.5, 1.4)
SONARS = ["localize.sonar.beams=12"]
WAYS = {  # name: settings
    "lasers alone": [],
    "with sonars": SONARS,
}
# Takes every echo for certain, whatever the sonars do.
CRIPPLED = ["localize.sonar.beams=24", "localize.sonar.filter=none", "localize.sonar.independent_beams=24",
            "localize.sonar.most_nats=1000", "evaluation.trusts_dead_sonars=true"]
NAMED_WITHIN = 5.0  # [s]


def faults_by_hand(seed, minutes):
    """Every kind once, in an order and at moments of the seed: (kind, from, to) [s]."""
    draw = random.Random(7000 + seed)
    order = KINDS[:]
    draw.shuffle(order)
    slot = 60.0 * minutes / len(order)
    faults = []
    for i, kind in enumerate(order):
        lasts = draw.uniform(0.45, 0.65) * slot
        at = i * slot + draw.uniform(0.25, 0.3) * slot
        faults.append((kind, round(at, 1), round(at + lasts, 1)))
    return faults


def by_hand(bench, museum, seed, minutes, ways):
    """Rows of what each way to believe said, for one recording."""
    faults = faults_by_hand(seed, minutes)
    count, near, far = ESCORT
    lines = ["events:", "  - {at: 0, steering: {speed: 0.5}}", f"  - {{at: 0, escort: {{count: {count}, near: {near}, far: {far}}}}}"]
    lines += [f"  - {{at: {at}, fault: {{sensor: sonar, kind: {kind}, for: {to - at:.1f}}}}}" for kind, at, to in faults]
    events = "\n".join(lines) + "\n"
    found = {name: bench.claims(museum, seed, minutes, "quiet", events, settings) for name, settings in ways.items()}
    bench.forget(museum, seed, minutes, "quiet", events)
    return faults, found


def judge_by_hand(rows):
    """Whether a robot that went on was never lost: (good, in words)."""
    lost = mean(map(is_lost, rows))
    unsure = mean(not row["localized"] for row in rows)
    worst = max((error_m(row) for row in rows), default=float("inf"))
    good = bool(rows) and lost == 0.0 and unsure <= 0.01 and worst <= LOST_M
    return good, f"{100 * lost:.2f} % of {len(rows)} updates lost, {100 * unsure:.2f} % unsure, worst {100 * worst:.0f} cm"


def hand_protocol(bench, verdict, print_table, museums, seeds, minutes, methods, crippled):
    print(f"\n## sonars die, walked by hand amid an escort of {ESCORT[0]}: {len(seeds)} seeds x {minutes:g} minutes "
          f"in {', '.join(museums)}, each kind of death once a run\n")
    ways = {f"{method}, {name}": [f"localize.method={method}", *settings] for method in methods for name, settings in WAYS.items()}
    if crippled:
        ways.update({f"{method}, certain of its sonars": [f"localize.method={method}", *CRIPPLED] for method in methods})
    runs = bench.each([lambda m=m, s=s: by_hand(bench, m, s, minutes, ways) for m in museums for s in seeds])
    km = sum(found[next(iter(ways))][-1]["distance"] for _, found in runs) / 1000
    dead_s = sum(to - at for faults, _ in runs for _, at, to in faults)
    print(f"{km:.2f} km, {dead_s / 60:.0f} minutes with sonars dead, {100 * mean(row['blocked'] for _, found in runs for row in found[next(iter(ways))]):.0f} % "
          "of the lasers' beams blocked\n")
    table = []
    for name in ways:
        whole = []
        for kind in ["well", *KINDS]:
            rows = []
            for faults, found in runs:
                for row in since_known(found[name]):
                    now = next((k for k, at, to in faults if at <= row["time"] < to), "well")
                    if now == kind:
                        rows.append(row)
            whole += rows
            errors = sorted(error_m(row) for row in rows)
            table.append([name, kind, len(rows), f"{100 * mean(map(is_lost, rows)):.2f}",
                          f"{100 * mean(not row['localized'] for row in rows):.2f}", f"{max((row['p_lost'] for row in rows), default=1):.3f}",
                          f"{100 * mean(errors):.1f}", f"{100 * errors[int(0.95 * len(errors))]:.1f}" if errors else "-",
                          f"{100 * errors[-1]:.0f}" if errors else "-"])
        good, words = judge_by_hand(whole)
        if "certain" in name:
            verdict.want(f"{name} (must fail)", words, not good)
        else:
            verdict.want(f"{name}: never lost, at most 1 % unsure, every error at most {100 * LOST_M:g} cm", words, good)
    print_table(["robot", "sonars", "updates", "lost %", "unsure %", "largest P(lost)", "error cm", "95 % cm", "worst cm"], table)


def by_itself(bench, museum, seed, kind, at, minutes, settings):
    events = f"events:\n  - {{at: {at:.1f}, fault: {{sensor: sonar, kind: {kind}}}}}\n"
    return bench.of_tours(museum, seed, minutes, "busy", 40, events, settings)


def named_after(health, at):
    """Seconds until any module named the sonars; None: none did."""
    times = [float(row["time"]) - at for row in health if "sonar" in row["reason"] and float(row["time"]) >= at]
    return min(times, default=None)


def tour_protocol(bench, verdict, print_table, museums, seeds, minutes):
    print(f"\n## sonars die for good, the whole robot on its tours, busy: {len(seeds)} seeds x {minutes:g} minutes in {', '.join(museums)}\n")
    table = []
    # A robot that needs its sonars stands when they are silent; one that does without them must still not be lost.
    ways = {**WAYS, "with sonars, drives without": [*SONARS, "avoid.needs_sonar=false"]}
    plans = []
    for museum in museums:
        for i, seed in enumerate(seeds):
            draw = random.Random(8000 + seed)
            plans.append((museum, 5000 + seed, KINDS[i % len(KINDS)], round(draw.uniform(0.3, 0.6) * 60.0 * minutes, 1)))
    for name, settings in ways.items():
        runs = bench.each([lambda p=p: by_itself(bench, *p, minutes, settings) for p in plans])
        lost = unsure = updates = touched = 0
        km = minutes_after = 0.0
        late, moved, worst, alarms, well_minutes = [], [], 0.0, 0, 0.0
        for (museum, seed, kind, at), (claims, health) in zip(plans, runs):
            after = [row for row in claims if row["time"] >= at]
            before = [row for row in claims if row["time"] < at]
            knew = bool(before) and before[-1]["localized"] > 0
            rows = after if knew else since_known(after)
            updates += len(rows)
            lost += sum(map(is_lost, rows))
            unsure += sum(not row["localized"] for row in rows)
            worst = max([worst, *map(error_m, rows)])
            touched += claims[-1]["contacts"] + claims[-1]["violations"]
            km += (after[-1]["distance"] - after[0]["distance"]) / 1000 if after else 0.0
            minutes_after += minutes - at / 60.0
            named = named_after(health, at)
            alarms += sum("sonar" in row["reason"] and 2.0 < float(row["time"]) < at for row in health)
            well_minutes += at / 60.0
            if kind == "dead":
                late.append(NAMED_WITHIN + 1 if named is None else named)
                if "avoid.needs_sonar=false" not in settings:
                    moved += [abs(row["speed"]) for row in after if row["time"] > at + 2.0]
            table.append([name, museum, seed, kind, f"{at:.0f}", "yes" if knew else "no", len(rows), int(sum(map(is_lost, rows))),
                          f"{100 * mean(not row['localized'] for row in rows):.1f}",
                          f"{100 * max(map(error_m, rows), default=float('nan')):.0f}",
                          "-" if named is None else f"{named:.1f}", f"{after[-1]['distance'] - after[0]['distance']:.0f}" if after else "-",
                          int(claims[-1]["contacts"]), int(claims[-1]["violations"])])
        verdict.want(f"{name}: never lost after the sonars died, every error at most {100 * LOST_M:g} cm",
                     f"{lost} of {updates} updates in {minutes_after:.0f} minutes and {km:.2f} km, {100 * unsure / max(1, updates):.1f} % unsure, "
                     f"worst {100 * worst:.0f} cm", updates > 0 and lost == 0 and worst <= LOST_M)
        verdict.want(f"{name}: contacts and area violations", bounded(int(touched), km), touched == 0)
        verdict.want(f"{name}: silent sonars are named within {NAMED_WITHIN:g} s", f"worst {max(late, default=99):.1f} s of {len(late)}",
                     bool(late) and max(late) <= NAMED_WITHIN)
        verdict.want(f"{name}: sonars that are well are not called dead", f"{alarms} alarms in {well_minutes:.0f} minutes", alarms == 0)
        if moved:
            verdict.want(f"{name}: stands from 2 s after the sonars fell silent", f"at most {max(moved):.3f} m/s", max(moved) <= 0.02)
    print_table(["robot", "museum", "seed", "sonars", "at s", "knew", "updates", "lost", "unsure %", "worst cm", "named after s",
                 "driven m", "contacts", "area"], table)


def protocol(bench, verdict, print_table, museums, count, is_slice, methods, crippled=True):
    hand_protocol(bench, verdict, print_table, museums, range(1, 1 + count), 3 if is_slice else 10, methods, crippled)
    tour_protocol(bench, verdict, print_table, museums, range(1, 1 + count), 4 if is_slice else 10)
