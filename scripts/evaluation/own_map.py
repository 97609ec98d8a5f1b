"""Tours on a map that the robot made itself: it maps the museum at night, a technician drives it about, and whatever somebody marks
or places (hazards, border, exhibits, home) is placed by the pose that the robot takes itself to have at the time."""
import csv
import math
import random
import shutil
import subprocess

from evaluation import crippled, exploration, tour
from evaluation.tables import Verdict, print_table

MARKED_WITHIN = 0.03  # [m], one standard deviation of each coordinate: a hand that points at a corner
DRIVE_MINUTES = 20  # that the technician drives about
NEAREST = 10  # moments of the drive that place a point: those at which the robot was nearest to it
KINDS = {"bonn": 10, "smithsonian": 5}  # seeds, as in `tour` and `smithsonian`


class Marks:
    """Where the robot's own pose puts what truly lies elsewhere."""

    def __init__(self, claims, seed):
        self.poses = [tuple(float(row[name]) for name in ("true_x", "true_y", "true_heading", "x", "y", "heading"))
                      for row in claims if row["localized"] == "1" and row["x"]]
        self.hand = random.Random(f"marks {seed}")
        self.off = []  # [m] of each point

    def place(self, x, y):
        """[m], and how much [deg] headings are turned there."""
        near = sorted(self.poses, key=lambda pose: (pose[0] - x) ** 2 + (pose[1] - y) ** 2)[:NEAREST]
        points, turns = [], []
        for true_x, true_y, true_heading, own_x, own_y, own_heading in near:
            turn = math.radians(own_heading - true_heading)
            turns.append(math.degrees(math.atan2(math.sin(turn), math.cos(turn))))
            dx, dy = x - true_x, y - true_y
            points.append((own_x + math.cos(turn) * dx - math.sin(turn) * dy, own_y + math.sin(turn) * dx + math.cos(turn) * dy))
        mean = [sum(values) / len(near) for values in zip(*points)]
        marked = [round(value + self.hand.gauss(0, MARKED_WITHIN), 3) for value in mean]
        self.off.append(math.dist(marked, (x, y)))
        return marked, sum(turns) / len(turns)

    def of(self, node):
        """The same tree, with all that stands in it for a place put where the robot's pose puts it."""
        if isinstance(node, dict):
            if {"x", "y"} <= node.keys():
                (x, y), turn = self.place(node["x"], node["y"])
                more = {"heading": round(node["heading"] + turn, 2)} if "heading" in node else {}
                return node | {"x": x, "y": y} | more
            return {key: self.of(value) for key, value in node.items()}
        if isinstance(node, list):
            if len(node) == 2 and all(isinstance(value, (int, float)) for value in node):
                return self.place(*node)[0]
            return [self.of(value) for value in node]
        return node


def set_up(simulations, name, seed):
    """The museum as the robot knows it after it has mapped it and was shown round; and how far off [m] its marks lie."""
    import yaml
    original = simulations.museums / name
    folder = simulations.cache / "own-map" / f"{name}-{seed}-{simulations.key(original)[:16]}"
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([simulations.docent, "explore", "--museum", original, "--seed", str(seed), *exploration.STARTS.get(name, []), "--out",
                    folder / "explored", "--quiet"],
                   check=True, capture_output=True)
    shown, own = folder / f"shown-{name}", folder / f"own-{name}"
    for target in (shown, own):
        shutil.copytree(original, target)
        for part in ("map.yaml", "map.pgm"):
            shutil.copy(folder / "explored" / part, target / part)
    kept, _ = simulations.run_logged("own-map", shown, 100 + seed, DRIVE_MINUTES / 60, ["--crowd", "empty", "--requests-per-hour", "40"],
                                     {"--claims": "claims.csv"})
    with open(kept["claims.csv"], newline="", encoding="utf-8") as file:
        marks = Marks(csv.DictReader(file), seed)
    museum = marks.of(yaml.safe_load((original / "museum.yaml").read_text()))
    (own / "museum.yaml").write_text(yaml.safe_dump(museum, allow_unicode=True, sort_keys=False, width=140))
    subprocess.run([simulations.docent, "check", own], check=True, capture_output=True)
    return own, marks.off


def protocol(simulations, options):
    verdict = Verdict()
    minutes = tour.SLICE_MINUTES if options.slice else options.minutes or tour.MINUTES
    names = options.museums.split(",") if options.museums else list(KINDS)[:1] if options.slice else list(KINDS)
    for name in names:
        seeds = list(range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else KINDS[name]))))
        own, off = set_up(simulations, name, options.first_seed)
        print(f"\n## {name} on its own map, busy, {len(seeds)} seeds x {minutes:g} minutes, unknown start\n")
        reports = simulations.of_seeds("own-map", own, seeds, minutes, ["--crowd", "busy"])
        print_table(tour.HEADER, [tour.row_of(seed, report) for seed, report in zip(seeds, reports)])
        share = len(seeds) * minutes / 300
        idle = 0.3 if len(seeds) * minutes < 60 else 1.0
        print()
        found = tour.judge(reports, minutes, {"offered": 12 * idle, "km": 2 * share * idle, "explained": 100 * share * idle})
        found.note("marks and places by the robot's own pose", f"{len(off)}, {100 * sum(off) / len(off):.1f} cm off on average, "
                   f"{100 * max(off):.1f} cm at most")
        found.print()
        verdict.add(found)
        if not options.slice and not options.no_crippled:
            for how, arguments in crippled.CRIPPLED.items():
                verdict.add(tour.run_crippled(simulations, own, how, arguments, seeds[:crippled.CRIPPLED_SEEDS], minutes))
    return verdict
