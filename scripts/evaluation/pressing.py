"""A pressing crowd: a whole robot in packed Bonn is carried off to beside the staircase, among pushers, runners and an escort. Nearly all of its beams
end on people. It may be lost as long as that lasts; it must not be sure and wrong."""
import random

from evaluation.claims import is_lost, mean

MINUTES = 12
AT = 60.0  # [s]
BESIDE = ((20.0, 3.2), (20.0, 4.6), (22.0, 6.2), (23.6, 6.2))  # [m] of the staircase of Bonn
SURE = 0.01  # P(lost)
LONGEST = 30.0  # [s] sure and wrong on end
FEWEST_HIDDEN = 0.6  # of the beams, or nobody presses
CRIPPLED_SEEDS = 2


def events(seed):
    draw = random.Random(f"pressing/{seed}")
    x, y = draw.choice(BESIDE)
    pushers = f"{{count: {draw.randint(3, 6)}, at: [{x - 0.8 if x < 21 else x}, {y + 0.8 if x > 21 else y}], heading: {0 if x < 21 else -90}}}"
    return "\n".join(["events:", f"  - {{at: {AT}, kidnap: {{to: [{x}, {y}], heading: {draw.uniform(-180, 180):.0f}}}}}", f"  - {{at: {AT}, pushers: {pushers}}}",
                      f"  - {{at: {AT}, runners: {{count: {draw.randint(3, 6)}, at: [{x}, {y}], within: 3}}}}",
                      f"  - {{at: {AT}, escort: {{count: {draw.randint(12, 20)}, near: 0.4, far: 1.4}}}}", ""])


def longest(claims):
    """[s] that the robot was sure and wrong on end, and altogether."""
    most = total = run = 0.0
    for before, after in zip(claims, claims[1:]):
        step = after["time"] - before["time"]
        if before["p_lost"] < SURE and is_lost(before):
            run += step
            total += step
            most = max(most, run)
        else:
            run = 0.0
    return most, total


def protocol(bench, verdict, print_table, count):
    print(f"\n## a pressing crowd: {count} whole robots in packed Bonn, carried off to beside the staircase, {MINUTES} minutes\n")
    seeds = range(6000, 6000 + count)

    def runs(some, settings=()):
        return bench.each([lambda s=s: bench.of_tours("bonn", s, MINUTES, "packed", 40, events(s), settings)[0] for s in some])
    found = runs(seeds)
    rows = []
    for seed, claims in zip(seeds, found):
        after = [row for row in claims if row["kidnaps"] > 0]
        most, total = longest(after)
        knows = mean(row["localized"] and not is_lost(row) for row in after)
        rows.append([seed, len(after), f"{100 * mean(row['blocked'] for row in after):.0f}", f"{100 * knows:.0f}",
                     sum(row["p_lost"] < SURE for row in after), f"{total:.0f}", f"{most:.0f}"])
    print_table(["seed", "claims", "beams on people %", "knows, right %", "sure", "sure and wrong s", "longest s"], rows)
    after = [row for claims in found for row in claims if row["kidnaps"] > 0]
    hidden = mean(row["blocked"] for row in after)
    verdict.want(f"a pressing crowd: carried off, {100 * FEWEST_HIDDEN:.0f} % of the beams on people",
                 f"{sum(any(row['kidnaps'] > 0 for row in claims) for claims in found)} of {count}, {100 * hidden:.0f} %",
                 all(any(row["kidnaps"] > 0 for row in claims) for claims in found) and hidden >= FEWEST_HIDDEN)
    worst = max(longest([row for row in claims if row["kidnaps"] > 0])[0] for claims in found)
    verdict.want(f"a pressing crowd: sure and wrong on end, at most {LONGEST:.0f} s", f"{worst:.0f} s in the worst of {count}", worst <= LONGEST)
    crippled = runs(list(seeds)[:CRIPPLED_SEEDS], ["evaluation.dead_reckoning=true"])
    of_crippled = max(longest([row for row in claims if row["kidnaps"] > 0])[0] for claims in crippled)
    verdict.want(f"a pressing crowd, dead reckoning (must exceed {LONGEST:.0f} s)", f"{of_crippled:.0f} s", of_crippled > LONGEST)
