"""Office missions ([Buhmann1995], Office Delivery and Office Cleanup): in drawn office buildings the whole robot brings things to rooms and looks for cans
and wads of paper amid things that are none, which it has to leave alone. What it knows by sight it was taught in other buildings, from pictures that its
own eyes took there. The same robot with its colour camera shut must find nothing."""
import csv
import math
import random
import re
import shutil
import subprocess
from pathlib import Path

import numpy
import yaml

from evaluation.tables import print_table
from evaluation.ways import inside

OFFICES, FIRST = 10, 301
TAUGHT = (901, 902, 903)  # seeds of the buildings in which it is taught
A_KIND = 45  # pictures of a kind that it is taught by
CANS, WADS, OTHERS, DELIVERIES = 5, 5, 7, 4
DELIVERY_S, TIDY_S = 130.0, 2100.0
SLICE_TIDY_S = 240.0
CELL = 0.1  # [m]
BODY, ROOM = 0.38, 0.30  # [m] that the robot's centre and a thing keep off what stands there
NEAR = 0.35  # [m] of a thing from where the robot has it
IN_ROOM = 1.0  # [m] of the robot from where a room wants it
ROBOT = ["sight.enabled=true", "office.enabled=true", "things.enabled=true", "mission.goes_home=false", "mission.mingles=false", "office.ask_s=12", "office.hand_over_s=20"]
# Things that lie about and are no litter: kind, outline, height [m]. The first three are taught as what they are, the others nobody has taught it.
BOX = ("box", lambda r: {"box": (r.uniform(0.14, 0.28), r.uniform(0.12, 0.24))}, (0.08, 0.26))
BOTTLE = ("bottle", lambda r: {"circle": r.uniform(0.035, 0.048)}, (0.22, 0.30))
BIN = ("bin", lambda r: {"circle": r.uniform(0.11, 0.15)}, (0.26, 0.34))
SHOE = ("shoe", lambda r: {"box": (r.uniform(0.26, 0.31), r.uniform(0.09, 0.12))}, (0.08, 0.13))
CUP = ("cup", lambda r: {"circle": r.uniform(0.045, 0.06)}, (0.08, 0.10))
BOOK = ("book", lambda r: {"box": (r.uniform(0.20, 0.26), r.uniform(0.14, 0.18))}, (0.05, 0.07))
TEACHES, STRANGE = [BOX, BOTTLE, BIN], [SHOE, CUP, BOOK]


class Building:
    """What is true of a drawn office."""

    def __init__(self, folder):
        self.world = yaml.load((folder / "simulation.yaml").read_text(), yaml.CSafeLoader if yaml.__with_libyaml__ else yaml.SafeLoader)
        corners = self.world["floor"]
        self.x0, self.y0 = min(c[0] for c in corners), min(c[1] for c in corners)
        self.columns = int((max(c[0] for c in corners) - self.x0) / CELL) + 1
        self.rows = int((max(c[1] for c in corners) - self.y0) / CELL) + 1
        self.area = self.world["operating_area"]
        self.solids = [s["polygon"] for s in self.world["solids"] if s.get("bottom", 0.0) < 1.3]
        self.away = self.distances()
        self.reach = self.reachable([])

    def centre(self, column, row):
        return self.x0 + (column + 0.5) * CELL, self.y0 + (row + 0.5) * CELL

    def cell(self, x, y):
        return int((x - self.x0) / CELL), int((y - self.y0) / CELL)

    def distances(self):
        """[rows, columns] to the nearest solid or the border [m], up to a metre."""
        x = self.x0 + (numpy.arange(self.columns)[None, :] + 0.5) * CELL
        y = self.y0 + (numpy.arange(self.rows)[:, None] + 0.5) * CELL
        taken = ~inside(self.area, x, y)
        for polygon in self.solids:
            taken |= inside(polygon, x, y)
        for polygon in [self.area, *self.solids]:  # thin ones lie between the cells' middles
            for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1]):
                steps = max(1, int(math.hypot(bx - ax, by - ay) / (0.5 * CELL)))
                for k in range(steps + 1):
                    column, row = self.cell(ax + (bx - ax) * k / steps, ay + (by - ay) * k / steps)
                    if 0 <= row < self.rows and 0 <= column < self.columns:
                        taken[row, column] = True
        away = numpy.ones(taken.shape)
        padded = numpy.pad(taken, 9, constant_values=True)
        for dr in range(-9, 10):
            for dc in range(-9, 10):
                near = padded[9 + dr:9 + dr + self.rows, 9 + dc:9 + dc + self.columns]
                away[near] = numpy.minimum(away[near], math.hypot(dr, dc) * CELL)
        return away

    def reachable(self, things):
        """[rows, columns] where the robot's centre gets from home."""
        x = self.x0 + (numpy.arange(self.columns)[None, :] + 0.5) * CELL
        y = self.y0 + (numpy.arange(self.rows)[:, None] + 0.5) * CELL
        free = self.away >= BODY
        for tx, ty in things:
            free &= (x - tx) ** 2 + (y - ty) ** 2 > (BODY + 0.08) ** 2
        column, row = self.cell(self.world["home"]["x"], self.world["home"]["y"])
        seen = numpy.zeros(free.shape, bool)
        seen[row, column] = True
        open_ = [(row, column)]
        free = numpy.pad(free, 1)
        while open_:
            row, column = open_.pop()
            for other in ((row + 1, column), (row - 1, column), (row, column + 1), (row, column - 1)):
                if free[other[0] + 1, other[1] + 1] and not seen[other]:
                    seen[other] = True
                    open_.append(other)
        return seen

    def gets_near(self, x, y):
        column, row = self.cell(x, y)
        return bool(self.reach[max(0, row - 3):row + 4, max(0, column - 3):column + 4].any())

    def can_be_seen(self, x, y):
        """From somewhere where the robot gets, over floor on which nothing stands."""
        for k in range(24):
            for away in (1.1, 1.5):
                px, py = x + away * math.cos(k * math.pi / 12), y + away * math.sin(k * math.pi / 12)
                column, row = self.cell(px, py)
                if not (0 <= row < self.rows and 0 <= column < self.columns and self.reach[row, column]):
                    continue
                cells = [self.cell(x + (px - x) * i / 20, y + (py - y) * i / 20) for i in range(21)]
                if all(self.away[r, c] > 0.1 for c, r in cells):
                    return True
        return False

    def litter(self, rng, kinds):
        """Places for things of these kinds: [(kind, x, y)]. None hides another or bars a way."""
        placed = []
        free = self.reach.sum()
        for kind in kinds:
            for _ in range(4000):
                column, row = rng.randrange(self.columns), rng.randrange(self.rows)
                if self.away[row, column] < ROOM:
                    continue
                x, y = self.centre(column, row)
                home = self.world["home"]
                if any(math.hypot(x - px, y - py) < 0.6 for _, px, py in placed) or math.hypot(x - home["x"], y - home["y"]) < 1.0 or not self.can_be_seen(x, y):
                    continue
                left = self.reachable([(px, py) for _, px, py in placed] + [(x, y)]).sum()
                if left < free - 120:  # it bars a door
                    continue
                free = left
                placed.append((kind, x, y))
                break
        return placed


def outline(rng, kind, x, y):
    form = kind[1](rng)
    if "circle" in form:
        return f"circle: {{x: {x:.3f}, y: {y:.3f}, radius: {form['circle']:.3f}}}"
    length, width = form["box"]
    return f"box: {{x: {x:.3f}, y: {y:.3f}, length: {length:.3f}, width: {width:.3f}, heading: {rng.uniform(0, 180):.0f}}}"


def solid(rng, name, kind, x, y):
    """A line of simulation.yaml."""
    if kind == "can":
        return f"  - {{id: {name}, kind: can, bottom: 0.0, top: 0.12, circle: {{x: {x:.3f}, y: {y:.3f}, radius: 0.033}}}}"
    if kind == "wad":
        radius = rng.uniform(0.038, 0.055)
        return f"  - {{id: {name}, kind: wad, bottom: 0.0, top: {1.7 * radius:.3f}, circle: {{x: {x:.3f}, y: {y:.3f}, radius: {radius:.3f}}}}}"
    return f"  - {{id: {name}, kind: {'bin' if kind is BIN else 'furniture'}, bottom: 0.0, top: {rng.uniform(*kind[2]):.3f}, movable: true, {outline(rng, kind, x, y)}}}"


def name_of(kind):
    return kind if isinstance(kind, str) else kind[0]


def draw(docent, folder, seed, kinds):
    """A building with things on its floor and names for its rooms. @returns what lies where, and rooms to which the robot gets [(id, x, y)]"""
    if folder.exists():
        shutil.rmtree(folder)
    subprocess.run([docent, "office", "--out", folder, "--seed", str(seed)], check=True, stdout=subprocess.DEVNULL)
    rng = random.Random(f"office {seed}")
    building = Building(folder)
    placed = building.litter(rng, kinds(rng))
    lines = [solid(rng, f"{name_of(kind)}-{seed}-{i}", kind, x, y) for i, (kind, x, y) in enumerate(placed)]
    world = folder / "simulation.yaml"
    world.write_text(world.read_text(encoding="utf-8").replace("solids:\n", "solids:\n" + "\n".join(lines) + "\n", 1), encoding="utf-8")
    laboratory = Path(docent).with_name("docent-lab")
    told = subprocess.run([laboratory, "rooms", "--museum", folder], check=True, capture_output=True, text=True).stdout
    rooms = [(name, float(x), float(y)) for name, x, y in re.findall(r"^((?:room|hallway)-\d+)\s+at \((-?[\d.]+), (-?[\d.]+)\)", told, re.MULTILINE)]
    named = "".join(f"  - {{id: office-{i + 1}, name: {{en: \"office {i + 1}\"}}, at: {{x: {x}, y: {y}}}}}\n" for i, (_, x, y) in enumerate(rooms))
    with open(folder / "museum.yaml", "a", encoding="utf-8") as file:
        file.write("rooms:\n" + named)
    near = [(f"office-{i + 1}", x, y) for i, (_, x, y) in enumerate(rooms)
            if building.gets_near(x, y)]
    return [(name_of(kind), x, y) for kind, x, y in placed], near


def judged(rng):
    others = [STRANGE[i % 3] if i % 2 else TEACHES[i // 2 % 3] for i in range(OTHERS)]
    return ["can"] * CANS + ["wad"] * WADS + others


def start_of(folder):
    home = yaml.safe_load(next(line for line in (folder / "museum.yaml").read_text().splitlines() if line.startswith("home:")))["home"]
    return f"{home['x']},{home['y']},{home['heading']}"


def teach(simulations, cache):
    """The object book: pictures that the robot's eyes take in other buildings, sorted by what lay there."""
    folder = Path(cache) / "office-taught"
    book = folder / f"objects-{simulations.key(simulations.museums / 'bonn')[:16]}.json"
    if book.exists():
        return book
    folder.mkdir(parents=True, exist_ok=True)
    taken = {}
    for seed in TAUGHT:
        building = folder / f"office-{seed}"
        lies, _ = draw(simulations.docent, building, seed, lambda rng: ["can", "wad", *TEACHES] * 12)
        kept = folder / f"kept-{seed}"
        shutil.rmtree(kept, ignore_errors=True)
        kept.mkdir()
        settings = [*ROBOT, f"things.keep={kept}"]
        subprocess.run([simulations.docent, "simulate", "--museum", building, "--hours", f"{1200 / 3600:.4f}", "--seed", str(seed), "--crowd", "empty", "--requests-per-hour", "0",
                        "--start", start_of(building), "--quiet", "--scenario", scenario_file(building, "events:\n  - {at: 5, office: {kind: tidy}}\n"),
                        *[word for setting in settings for word in ("--set", setting)]], check=True, stdout=subprocess.DEVNULL)
        for picture in sorted(kept.glob("*.jpg")):
            _, x, y = picture.stem.split("_")
            near = [(math.hypot(float(x) - lx, float(y) - ly), kind) for kind, lx, ly in lies]
            if near and min(near)[0] < NEAR:
                taken.setdefault(min(near)[1], []).append(picture)
    sorted_ = folder / "sorted"
    shutil.rmtree(sorted_, ignore_errors=True)
    for kind, pictures in taken.items():
        (sorted_ / kind).mkdir(parents=True)
        for picture in random.Random(kind).sample(pictures, min(A_KIND, len(pictures))):
            shutil.copy(picture, sorted_ / kind / f"{picture.parent.name}-{picture.name}")
    subprocess.run([simulations.docent, "learn-objects", sorted_, "--out", book, "--known", "0.98"], check=True)
    return book


def scenario_file(folder, text):
    path = folder / "scenario.yaml"
    path.write_text(text)
    return path


def office(simulations, cache, book, seed, tidy_s, is_shut):
    folder = Path(cache) / "offices" / f"office-{seed}{'-shut' if is_shut else ''}"
    lies, rooms = draw(simulations.docent, folder, seed, judged)
    rng = random.Random(f"deliveries {seed}")
    wanted = [rng.choice(rooms) for _ in range(0 if is_shut else DELIVERIES)]
    events = ["  - {at: 1, office: {kind: helper, after: 4}}"]
    if is_shut:
        events.append("  - {at: 2, eye: {eye: front, kind: black}}")
    events += [f"  - {{at: {10 + i * DELIVERY_S}, office: {{kind: deliver, room: {room[0]}}}}}" for i, room in enumerate(wanted)]
    begins = 10 + len(wanted) * DELIVERY_S
    events.append(f"  - {{at: {begins}, office: {{kind: tidy}}}}")
    settings = [*ROBOT, f"things.book={book}"]
    arguments = ["--crowd", "empty", "--requests-per-hour", "0", "--start", start_of(folder)] + [word for setting in settings for word in ("--set", setting)]
    kept, report = simulations.run_logged("eyes-office", folder, seed, (begins + tidy_s) / 3600, arguments, {"--office-log": "office.csv"}, "events:\n" + "\n".join(events) + "\n")
    with open(kept["office.csv"], newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return lies, wanted, rows, report


def judge(lies, wanted, rows):
    """@returns what was found of cans and wads, what was asked for and is none, deliveries that came"""
    asked = [(float(row["x"]), float(row["y"])) for row in rows if row["what"] == "state" and row["name"] == "asking"]
    found, false = set(), []
    for x, y in asked:
        near = [(math.hypot(x - lx, y - ly), i) for i, (_, lx, ly) in enumerate(lies)]
        away, i = min(near, default=(9.0, -1))
        if away < NEAR and lies[i][0] in ("can", "wad"):
            found.add(i)
        else:
            false.append((round(x, 2), round(y, 2), lies[i][0] if away < NEAR else "nothing"))
    came = 0
    for room in wanted:
        came += any(row["name"] == "handing_over" and row["about"] == f"deliver {room[0]}" and math.hypot(float(row["x"]) - room[1], float(row["y"]) - room[2]) < IN_ROOM for row in rows)
    last = next((row for row in reversed(rows) if row["what"] == "state"), None)
    return found, false, came, last["name"] if last else "nothing"


def part(simulations, options, verdict):
    cache = Path(simulations.cache)
    book = teach(simulations, cache)
    count = options.seeds or (1 if options.slice else OFFICES)
    first = FIRST if options.first_seed == 1 else options.first_seed
    tidy_s = (options.minutes or 0) * 60 or (SLICE_TIDY_S if options.slice else TIDY_S)
    calls = [(simulations, cache, book, seed, tidy_s, False) for seed in range(first, first + count)]
    shut = [] if options.no_crippled else [(simulations, cache, book, first, min(tidy_s, 600.0), True)]
    made = simulations.each(office, calls + shut)
    rows, totals = [], dict.fromkeys(("litter", "found", "false", "wanted", "came", "contacts"), 0)
    notes = []
    for (_, _, _, seed, _, is_shut), (lies, wanted, log, report) in zip(calls + shut, made):
        found, false, came, phase = judge(lies, wanted, log)
        litter = [i for i, thing in enumerate(lies) if thing[0] in ("can", "wad")]
        contacts = sum(report["contacts"].values()) if isinstance(report["contacts"], dict) else report["contacts"]
        rows.append([f"{seed}{' shut' if is_shut else ''}", len(litter), len(found), len(lies) - len(litter), len(false), len(wanted), came, phase,
                     f"{report['distance_m']:.0f}", contacts])
        if is_shut:
            verdict.want("office, the colour camera shut: nothing may be found", f"{len(found)} of {len(litter)}", len(found) == 0)
            continue
        for key, value in zip(totals, (len(litter), len(found), len(false), len(wanted), came, contacts)):
            totals[key] += value
        notes += [f"{seed}: not found {lies[i][0]} at ({lies[i][1]:.2f}, {lies[i][2]:.2f})" for i in litter if i not in found]
        notes += [f"{seed}: asked for {what} at ({x}, {y})" for x, y, what in false]
    print("\n## Offices\n")
    print_table(["office", "cans and wads", "found", "other things", "false", "deliveries", "came", "at the end", "m", "contacts"], rows)
    print()
    for note in notes:
        verdict.note("office " + note.split(":")[0], note.split(": ", 1)[1])
    asked = totals["found"] + totals["false"]
    if options.slice:  # a room or two: what it has seen is right
        verdict.want("office: some of the cans and wads found in four minutes", f"{totals['found']} of {totals['litter']}", totals["found"] >= 1)
        verdict.want("office: none of what it asked for is something else", f"{totals['false']} of {asked}", totals["false"] == 0)
        verdict.want("office: deliveries", f"{totals['came']} of {totals['wanted']}", totals["came"] >= totals["wanted"] - 1)
        return
    verdict.want("office: 90 % of the cans and wads found", f"{totals['found']} of {totals['litter']} in {count} offices", totals["found"] >= 0.9 * totals["litter"])
    verdict.want("office: at most 2 % of what it asked for is none", f"{totals['false']} of {asked}", asked > 0 and totals["false"] <= 0.02 * asked)
    verdict.want("office: 95 % of the deliveries come", f"{totals['came']} of {totals['wanted']}", totals["came"] >= 0.95 * totals["wanted"])
