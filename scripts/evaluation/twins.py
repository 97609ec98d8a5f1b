"""A robot that does not know which end of a hall it looks at: halls drawn so that every view from their middle fits two
places, but for one thing near one end. Driving to where the two are told apart, against looking round."""
import math
import random
import shutil
import subprocess

from evaluation.claims import error_m, is_lost, mean, read_claims
from evaluation.keys import key_of


def draw_hall(folder, seed, docent):
    """A museum folder of one hall, the same after half a turn about its middle but for one case near its far end; its
    length, width, pillars and niches are drawn by the seed. Returns the pose from which a robot starts."""
    draw = random.Random(seed)
    length, width = draw.uniform(32.0, 42.0), draw.uniform(7.0, 9.0)
    solids = []

    def box(name, x, y, across, deep, height, kind="wall"):
        corners = [(x - across / 2, y - deep / 2), (x + across / 2, y - deep / 2), (x + across / 2, y + deep / 2),
                   (x - across / 2, y + deep / 2)]
        points = ", ".join(f"[{a:.3f}, {b:.3f}]" for a, b in corners)
        solids.append(f"  - {{id: {name}, kind: {kind}, bottom: 0.0, top: {height}, polygon: [{points}]}}")

    def pair(name, x, y, across, deep):
        box(name + "-a", x, y, across, deep, 2.0)
        box(name + "-b", length - x, width - y, across, deep, 2.0)

    for name, x, y, across, deep in (("south", length / 2, -0.1, length + 0.4, 0.2), ("west", -0.1, width / 2, 0.2, width),
                                     ("north", length / 2, width + 0.1, length + 0.4, 0.2),
                                     ("east", length + 0.1, width / 2, 0.2, width)):
        box("wall-" + name, x, y, across, deep, 3.0)
    for i in range(draw.randint(3, 5)):
        pair(f"pillar-{i}", draw.uniform(3.0, length / 2 - 3.0), draw.choice([0.3, 0.5, 0.7]) * width, 0.6, 0.6)
    for i in range(draw.randint(3, 5)):
        pair(f"cupboard-{i}", draw.uniform(1.0, length / 2 - 1.0), 0.3, draw.uniform(0.8, 2.0), 0.6)
    # The one thing that is not twice, too far from the middle to be seen there.
    box("case", length - draw.uniform(1.0, 2.5), width * draw.choice([0.3, 0.7]), 1.4, 1.2, 2.0, "furniture")

    shutil.rmtree(folder, ignore_errors=True)
    (folder / "content").mkdir(parents=True)
    (folder / "content" / "case.md").write_text("Here it stands.\n", encoding="utf-8")
    floor = f"[[0, 0], [{length:.3f}, 0], [{length:.3f}, {width:.3f}], [0, {width:.3f}]]"
    area = f"[[0.4, 0.4], [{length - 0.4:.3f}, 0.4], [{length - 0.4:.3f}, {width - 0.4:.3f}], [0.4, {width - 0.4:.3f}]]"
    stop = (1.0, 0.5 * width)
    (folder / "simulation.yaml").write_text("\n".join([
        "ceiling_height: 3.0", f"floor: {floor}", f"operating_area: {area}", f"entrances: [[{stop[0]}, {stop[1]:.3f}]]",
        f"home: {{x: {length / 2:.3f}, y: {0.5 * width:.3f}}}", "visitors_per_hour: 6", "exhibits: [case]", "tours: []",
        "solids:"] + solids) + "\n", encoding="utf-8")
    (folder / "museum.yaml").write_text("\n".join([
        'name: {en: "Hall of twins"}', "languages: [en]", "map: map.yaml", f"area: {area}", "hazards: []",
        f"home: {{x: {length / 2:.3f}, y: {0.5 * width:.3f}, heading: 0}}", "exhibits:", "  - id: case",
        '    title: {en: "The case"}', f"    pose: {{x: {stop[0]}, y: {stop[1]:.3f}, heading: 180}}",
        f"    look_at: {{x: 0.0, y: {stop[1]:.3f}}}", "    short: {en: content/case.md}", "    topics: [cases]",
        "tours: []", "simulation: simulation.yaml"]) + "\n", encoding="utf-8")
    done = subprocess.run([docent, "survey", "--world", folder / "simulation.yaml", "--out", folder, "--seed", str(seed)],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"docent survey: {done.stderr.strip()}")
    blocks = [[float(v) for v in part.split("polygon: [[")[1].split("]")[0].split(",")] for part in solids]
    while True:
        x, y = length / 2 + draw.uniform(-3.0, 3.0), draw.uniform(0.3, 0.7) * width
        if all(math.hypot(x - bx - 0.5, y - by - 0.5) > 1.5 for bx, by in blocks):
            return x, y, draw.uniform(-180.0, 180.0)


def start(bench, museum, seed, begin, active):
    claims = bench.cache / f"twins-{key_of(bench.docent, museum)}-{active}.csv"
    if not claims.exists():
        made = claims.with_suffix(".part")
        bench.run([bench.docent, "simulate", "--museum", museum, "--crowd", "empty", "--hours", "0.1", "--seed", str(seed),
                   "--requests-per-hour", "0", "--start", ",".join(f"{v:.3f}" for v in begin), "--claims", made, "--quiet",
                   "--set", f"plan.active={active}"])
        made.rename(claims)
    return read_claims(claims)


def active(bench, verdict, print_table, count):
    print(f"\n## told apart: {count} halls whose two halves look the same but for one case near one end\n")
    found = {"true": [], "false": []}
    wrong = {"true": 0, "false": 0}
    km = {"true": 0.0, "false": 0.0}
    halls = []
    for seed in range(1, count + 1):
        folder = bench.cache / f"twins-{seed}"
        halls.append((folder, seed, draw_hall(folder, seed, bench.docent)))
    for choice in ("true", "false"):
        for run in bench.each([lambda m=m, s=s, b=b: start(bench, m, s, b, choice) for m, s, b in halls]):
            right = next((row for row in run if row["localized"] and not is_lost(row)), None)
            wrong[choice] += any(row["localized"] and error_m(row) > 1.0 for row in run)
            km[choice] += run[-1]["distance"] / 1000
            found[choice].append((right["time"], right["distance"]) if right else (360.0, math.inf))
    rows = []
    for choice, name in (("true", "tells hypotheses apart"), ("false", "looks round")):
        seconds = sorted(t for t, _ in found[choice])
        metres = sorted(d for _, d in found[choice])
        rows.append([name, count, sum(d < math.inf for _, d in found[choice]), f"{seconds[len(seconds) // 2]:.0f}",
                     f"{seconds[int(0.9 * len(seconds))]:.0f}", f"{metres[len(metres) // 2]:.1f}", wrong[choice],
                     f"{km[choice]:.2f}"])
    print_table(["robot", "halls", "found itself", "median s", "90 % s", "median m", "sure and wrong", "km"], rows)
    told, looked = (mean(min(t, 360.0) for t, _ in found[choice]) for choice in ("true", "false"))
    verdict.want("told apart: found itself within 6 minutes in at least 90 % of the halls",
                 f"{sum(d < math.inf for _, d in found['true'])} of {count}",
                 sum(d < math.inf for _, d in found["true"]) >= 0.9 * count)
    verdict.want("told apart: never sure and wrong", f"{wrong['true']} of {count}", wrong["true"] == 0)
    verdict.want("told apart: sooner than by looking round", f"mean {told:.0f} s against {looked:.0f} s", told < looked)
