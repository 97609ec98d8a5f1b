"""The whole robot docks at a charger whose contacts are two centimetres wide to either side: by its tag, without one, with an eye that fails.
Its battery is low where it stands, 1.5 m before the contacts; its wheels are a percent off."""
import csv
import math
import random
import re
import shutil
from pathlib import Path

from evaluation.tables import print_table

RUNS, SLICE_RUNS = 100, 3
MINUTES = 1.7
CHARGER = (7.0, 1.6, -90.0)  # of a base at the contacts, in Bonn's hall; it looks at the wall
CONTACT = 0.35  # [m] from the tag
BEFORE = 1.5  # [m]
BESIDE, TURNED = 0.5, 30.0  # [m], [deg]
BOX = (6.8, 0.45, 7.2, CHARGER[1] - CONTACT)  # that the tag hangs on
ACROSS, SHORT, BEYOND, ASKEW = 0.02, 0.01, 0.05, 10.0  # [m], [deg] of the contacts
OWED, SIDEWAYS = 0.99, 0.01
LOW = 2.0  # [s] then its battery is low: before it knows its place
TAG = ["dock.enabled=true"]
KINDS = {
    "by tag": (TAG, ""),
    "no eye": ([], ""),
    "eye black": (TAG, "{eye: front, kind: black}"),
    "eye black under way": (TAG, "{eye: front, kind: black}"),
    "a tag of another size": (TAG + ["dock.tag.side=0.12"], ""),
}
STRIKES = {"eye black": 1.0, "eye black under way": 16.0}  # [s]
FEW = 4  # the kinds beside the first two are run on every so many


def museum_of(museums, folder):
    """Bonn with a charger at its southern wall: a box with a tag, on the map as in the hall; the map has its place a little wrong."""
    museum, target = museums / "bonn", folder / "docking"
    if target.exists():
        shutil.rmtree(target)
    shutil.copytree(museum, target)
    x, y, heading = CHARGER
    text = (museum / "museum.yaml").read_text(encoding="utf-8")
    text = re.sub(r"^charger:.*$", f"charger: {{x: {x + 0.02}, y: {y - 0.02}, heading: {heading + 1.5}}}", text, flags=re.M)
    (target / "museum.yaml").write_text(text, encoding="utf-8")
    text = (museum / "simulation.yaml").read_text(encoding="utf-8")
    corners = ", ".join(f"[{a}, {b}]" for a, b in ((BOX[0], BOX[1]), (BOX[2], BOX[1]), (BOX[2], BOX[3]), (BOX[0], BOX[3])))
    solid = f"  - {{id: charger-box, kind: furniture, polygon: [{corners}], top: 0.6}}\n"
    text = text.replace("solids:\n", "solids:\n" + solid, 1)
    text += f"marks:\n  - {{id: charger, tag: 0, x: {x}, y: {BOX[3] + 0.001}, height: 0.35, heading: 90}}\n"
    text += f"contacts: {{x: {x}, y: {y}, heading: {heading}, across: {ACROSS}}}\n"
    (target / "simulation.yaml").write_text(text, encoding="utf-8")
    draw_on_map(target, BOX)
    return target


def draw_on_map(museum, box):
    text = (museum / "map.yaml").read_text(encoding="utf-8")
    cell = float(re.search(r"resolution: ([\d.]+)", text)[1])
    left, bottom = (float(n) for n in re.search(r"origin: \[([-\d.]+), ([-\d.]+)", text).groups())
    file = museum / "map.pgm"
    data = bytearray(file.read_bytes())
    head = re.match(rb"P5\s+(?:#[^\n]*\n)*\s*(\d+)\s+(\d+)\s+\d+\s", data)
    columns, rows = int(head[1]), int(head[2])
    for row in range(rows):
        y = bottom + (rows - row - 0.5) * cell
        for column in range(columns):
            x = left + (column + 0.5) * cell
            if box[0] <= x <= box[2] and box[1] <= y <= box[3]:
                data[head.end() + row * columns + column] = 0
    file.write_bytes(data)


class Docked:
    """How an approach went, by the truth."""

    def __init__(self, rows, began):
        x, y, heading = CHARGER
        self.across, self.at, self.least = None, None, 9.0
        self.approach = None
        for row in rows:
            time, ahead, left, turned = (float(row["time"]), *in_contacts(row))
            if self.approach is None and time >= began:
                self.approach = (ahead, left, turned)
            if time < began:
                continue
            is_there = abs(left) <= ACROSS and -SHORT <= ahead <= BEYOND and abs(turned) <= ASKEW and abs(float(row["speed"])) < 0.01
            if is_there and self.at is None:
                self.at = time - began
            if not is_there:
                self.at = None
        _, self.across, self.turned = in_contacts(rows[-1])
        self.ahead = in_contacts(rows[-1])[0]
        self.contacts = int(rows[-1]["contacts"])


def in_contacts(row):
    """Where the base stands [m] past and to the left of the place at the contacts, and how it is turned [deg]."""
    x, y, heading = CHARGER
    dx, dy, turn = float(row["x"]) - x, float(row["y"]) - y, math.radians(heading)
    turned = (float(row["heading"]) - heading + 180.0) % 360.0 - 180.0
    return math.cos(turn) * dx + math.sin(turn) * dy, -math.sin(turn) * dx + math.cos(turn) * dy, turned


def run(simulations, museum, seed, kind):
    settings, fault = KINDS[kind]
    draw = random.Random(f"dock {seed}")
    beside, turned = draw.uniform(-BESIDE, BESIDE), draw.uniform(-TURNED, TURNED)
    way, turn = (1.0 + draw.choice([-0.01, 0.01]) for _ in range(2))
    x, y, heading = CHARGER
    start = f"{x + beside:.3f},{y + BEFORE:.3f},{heading + turned:.1f}"
    events = f"  - {{at: {LOW:.0f}, battery: {{charge: 0.15}}}}\n"
    if fault:
        events = (f"  - {{at: {STRIKES[kind]:.0f}, eye: {fault}}}\n" + events) if STRIKES[kind] < LOW else events + f"  - {{at: {STRIKES[kind]:.0f}, eye: {fault}}}\n"
    scenario = f"build: {{odometry: {{way: {way}, turn: {turn}}}}}\nevents:\n{events}"
    arguments = ["--crowd", "empty", "--requests-per-hour", "0", "--start", start] + [word for setting in settings for word in ("--set", setting)]
    kept, report = simulations.run_logged("eyes-dock", museum, seed, MINUTES / 60, arguments,
                                          {"--drive-log": "drive.csv", "--health-log": "health.csv"}, scenario)
    with open(kept["drive.csv"], newline="", encoding="utf-8") as file:
        docked = Docked(list(csv.DictReader(file)), LOW)
    with open(kept["health.csv"], newline="", encoding="utf-8") as file:
        docked.named = any("front camera" in str(row) for row in csv.DictReader(file))
    return docked


def part(simulations, options, verdict):
    count = options.seeds or (SLICE_RUNS if options.slice else RUNS)
    museum = museum_of(simulations.museums, Path(simulations.cache))
    seeds = range(options.first_seed, options.first_seed + count)
    of = lambda i: seeds if i < 2 else seeds[:max(1, count // FEW)]
    kinds = list(KINDS)[:2] if options.no_crippled else list(KINDS)
    calls = [(simulations, museum, seed, kind) for i, kind in enumerate(kinds) for seed in of(i)]
    made = iter(simulations.each(run, calls))
    rows, found = [], {}
    for i, kind in enumerate(kinds):
        runs = found[kind] = [next(made) for _ in of(i)]
        there = [one for one in runs if one.at is not None]
        beside = sorted(abs(one.across) for one in runs)
        times = sorted(one.at for one in there)
        rows.append([kind, len(runs), len(there), f"{1000 * beside[len(beside) // 2]:.0f}", f"{1000 * beside[int(0.95 * (len(beside) - 1))]:.0f}",
                     f"{1000 * beside[-1]:.0f}", sum(abs(one.across) <= SIDEWAYS for one in there),
                     f"{times[len(times) // 2]:.0f}" if times else "-", f"{times[-1]:.0f}" if times else "-", sum(one.contacts for one in runs)])
    print("\n## Docking by the charger's tag, with the whole robot\n")
    print_table(["robot", "approaches", "at the contacts", "beside median [mm]", "p95", "most", "there within 1 cm", "median s", "most", "touches"], rows)
    print()
    for kind in kinds[:1]:
        for seed, one in zip(seeds, found[kind]):
            if one.at is None or abs(one.across) > SIDEWAYS:
                verdict.note(f"{kind}, seed {seed}", f"ends {1000 * one.ahead:.0f} mm past, {1000 * one.across:.0f} mm left, {one.turned:.1f} degrees")
    docked, good = rows[0][2], rows[0][6]
    verdict.want("docking by tag: at the contacts", f"{docked} of {count}", docked >= OWED * count)
    verdict.want("docking by tag: within 1 cm sideways", f"{good} of {docked}", good >= OWED * docked)
    verdict.note("docking without an eye: at the contacts", f"{rows[1][2]} of {rows[1][1]}")
    if len(kinds) > 2:
        black = found["eye black"]
        verdict.want("an eye that is black is named in health", f"{sum(one.named for one in black)} of {len(black)}", all(one.named for one in black))
        wrong = next(row for row in rows if row[0] == "a tag of another size")
        verdict.want("a tag of another size than robot.yaml says (must fail)", f"{wrong[2]} of {wrong[1]} at the contacts", wrong[2] < OWED * wrong[1])
