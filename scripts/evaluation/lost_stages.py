"""The stages of `lost`: kidnaps, drawn corridors, zones round the robot, faults that come together."""
import math
import random
import re
import shutil
import subprocess
from pathlib import Path

KIDNAPS_A_RUN, FIRST_S, EVERY_S = 8, 40.0, 50.0
KIDNAP_MINUTES = (FIRST_S + KIDNAPS_A_RUN * EVERY_S + 30.0) / 60.0
NEAR_M = 0.5  # from the robot's outline to a hazard


def kidnaps_beside_hazards(seed, keeps_speed=0.0):
    """Carried off while it drives, the worst moment: set down standing, with wheels that go on as they were told; or with a share of its speed,
    as nobody's hands could."""
    draw = random.Random(seed)
    events = [f"  - {{at: {FIRST_S + EVERY_S * i:.1f}, during: driving, after: {draw.uniform(0.5, 4.0):.1f}, kidnap: {{near_hazards: {NEAR_M}, keeps_speed: {keeps_speed:g}}}}}"
              for i in range(KIDNAPS_A_RUN)]
    return "events:\n" + "\n".join(events) + "\n"


def rectangle(x0, y0, x1, y1):
    return f"[[{x0:.3f}, {y0:.3f}], [{x1:.3f}, {y0:.3f}], [{x1:.3f}, {y1:.3f}], [{x0:.3f}, {y1:.3f}]]"


def draw_corridors(folder, seed, docent):
    """A museum folder of a ring of corridors about 2 m wide, whose ways are told apart by cupboards and a niche here and there. Returns it
    and a pose to start from, as --start takes it."""
    draw = random.Random(seed)
    length, deep, width = draw.uniform(14.0, 24.0), draw.uniform(10.0, 16.0), draw.uniform(1.85, 2.15)
    solids = []

    def box(name, x0, y0, x1, y1, top=3.0, kind="wall"):
        solids.append(f"  - {{id: {name}, kind: {kind}, bottom: 0.0, top: {top}, polygon: {rectangle(x0, y0, x1, y1)}}}")
    box("south", -0.2, -0.2, length + 0.2, 0.0)
    box("north", -0.2, deep, length + 0.2, deep + 0.2)
    box("west", -0.2, 0.0, 0.0, deep)
    box("east", length, 0.0, length + 0.2, deep)
    niche = draw.uniform(width + 1.0, length - width - 3.0)
    box("block-a", width, width + 0.6, length - width, deep - width)
    box("block-b", width, width, niche, width + 0.6)
    box("block-c", niche + 1.2, width, length - width, width + 0.6)
    for i in range(draw.randint(2, 4)):
        side, along = draw.randrange(4), draw.uniform(0.25, 0.75)
        size, thick = draw.uniform(0.6, 1.2), draw.uniform(0.25, 0.4)
        x, y = along * length, along * deep
        corners = [(x, 0.0, x + size, thick), (x, deep - thick, x + size, deep), (0.0, y, thick, y + size), (length - thick, y, length, y + size)]
        box(f"cupboard-{i}", *corners[side], 2.0, "furniture")
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "content").mkdir(parents=True)
    (folder / "content" / "case.md").write_text("Here it stands.\n", encoding="utf-8")
    middle = 0.5 * width
    area = rectangle(0.3, 0.3, length - 0.3, deep - 0.3)
    (folder / "simulation.yaml").write_text("\n".join([
        "ceiling_height: 3.0", f"floor: {rectangle(0, 0, length, deep)}", f"operating_area: {area}", f"entrances: [[{middle:.3f}, {middle:.3f}]]",
        f"home: {{x: {length - middle:.3f}, y: {deep - middle:.3f}}}", "visitors_per_hour: 6", "exhibits: [case]", "tours: []", "solids:"] + solids)
        + "\n", encoding="utf-8")
    (folder / "museum.yaml").write_text("\n".join([
        'name: {en: "Corridors"}', "languages: [en]", "map: map.yaml", f"area: {area}", "hazards: []",
        f"home: {{x: {length - middle:.3f}, y: {deep - middle:.3f}, heading: 0}}", "exhibits:", "  - id: case", '    title: {en: "The case"}',
        f"    pose: {{x: {middle:.3f}, y: {middle:.3f}, heading: 180}}", f"    look_at: {{x: 0.0, y: {middle:.3f}}}",
        "    short: {en: content/case.md}", "    topics: [cases]", "tours: []", "simulation: simulation.yaml"]) + "\n", encoding="utf-8")
    done = subprocess.run([docent, "survey", "--world", folder / "simulation.yaml", "--out", folder, "--seed", str(seed)], capture_output=True,
                          text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"docent survey: {done.stderr.strip()}")
    sides = [(draw.uniform(width, length - width), middle), (draw.uniform(width, length - width), deep - middle),
             (middle, draw.uniform(width, deep - width)), (length - middle, draw.uniform(width, deep - width))]
    x, y = draw.choice(sides)
    return folder, f"{x:.3f},{y:.3f},{draw.uniform(-180.0, 180.0):.1f}"


class Zone:
    """A copy of a museum with a zone drawn on free floor, and the robot in its middle."""

    def __init__(self, folder, x, y, heading, half):
        self.folder, self.x, self.y, self.half, self.heading = folder, x, y, half, heading
        self.begin = f"{x:.3f},{y:.3f},{heading:.1f}"

    def carried_in(self, at):
        return f"events:\n  - {{at: {at:.1f}, kidnap: {{to: [{self.x:.3f}, {self.y:.3f}], heading: {self.heading:.1f}}}}}\n"

    def holds(self, x, y):
        return max(abs(x - self.x), abs(y - self.y)) <= self.half


def numbers_of(text, name):
    found = re.search(rf"^{name}:\s*\[?([-0-9., ]+)", text, re.MULTILINE)
    return [float(part) for part in found.group(1).split(",") if part.strip()]


def read_pgm(path):
    """Columns, rows and shades, the first row on top."""
    data = path.read_bytes()
    fields = re.match(rb"P5\s+(?:#[^\n]*\s+)*(\d+)\s+(\d+)\s+(\d+)\s", data)
    columns, rows = int(fields.group(1)), int(fields.group(2))
    return columns, rows, data[fields.end():fields.end() + columns * rows]


def draw_zone(folder, museum, seed, half=1.0):
    draw = random.Random(seed)
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(museum, folder)
    text = (folder / "museum.yaml").read_text(encoding="utf-8")
    about = (folder / "map.yaml").read_text(encoding="utf-8")
    columns, rows, shades = read_pgm(folder / re.search(r"^image:\s*(\S+)", about, re.MULTILINE).group(1))
    step, origin = numbers_of(about, "resolution")[0], numbers_of(about, "origin")
    kept = [(float(x), float(y)) for x, y in re.findall(r"\{x:\s*([-0-9.]+),\s*y:\s*([-0-9.]+), heading", text)]
    hazards = [(float(x), float(y)) for line in text.splitlines() if "polygon:" in line for x, y in re.findall(r"\[([-0-9.]+), ([-0-9.]+)\]", line)]

    def is_free(x, y):
        column, row = int((x - origin[0]) / step), rows - 1 - int((y - origin[1]) / step)
        return 0 <= column < columns and 0 <= row < rows and shades[row * columns + column] >= 250
    around = [(0.45 * math.cos(a), 0.45 * math.sin(a)) for a in [math.pi * k / 8 for k in range(16)]] + [(0.0, 0.0)]
    while True:
        x, y = origin[0] + draw.uniform(0.0, columns * step), origin[1] + draw.uniform(0.0, rows * step)
        if all(is_free(x + dx, y + dy) for dx, dy in around) and all(math.hypot(x - a, y - b) > half * 1.42 + 0.5 for a, b in kept) and all(
                math.hypot(x - a, y - b) > half * 1.42 + 1.5 for a, b in hazards):
            break
    zone = rectangle(x - half, y - half, x + half, y + half)
    (folder / "museum.yaml").write_text(text.replace("hazards:\n", f"hazards:\n  - {{id: drawn, kind: other, polygon: {zone}}}\n", 1), encoding="utf-8")
    return Zone(folder, x, y, draw.uniform(-180.0, 180.0), half)


FAULT_MINUTES = 14.0
FAULTS_AT, FAULTS_FOR = 90.0, 120.0
WISHES = ["zeolite", "tv-sat", "cyclotron", "particle-trap", "polar", "wankel", "airbus"]


def eight_faults(seed):
    """Seven wishes; and for two minutes: a blind front laser in half of its beams, a lying rear one, deaf sonars, no tactile ring, a bad wire,
    wheels that slip, a robot that is carried off, and a mob that presses it among runners."""
    draw = random.Random(seed)
    where = draw.choice([(9.0, 8.0), (12.0, 20.0), (20.0, 20.0), (25.0, 8.0)])
    at, lasts = FAULTS_AT, FAULTS_FOR
    events = [f"  - {{at: {2.0 + i:.0f}, request: {{kind: exhibit, target: {wish}}}}}" for i, wish in enumerate(WISHES)]
    events += [
        f"  - {{at: {at}, fault: {{sensor: laser_front, kind: half, for: {lasts}}}}}",
        f"  - {{at: {at}, lie: {{sensor: laser_rear, kind: offset, amount: {draw.uniform(0.3, 0.8):.2f}, for: {lasts}}}}}",
        f"  - {{at: {at}, fault: {{sensor: sonar, kind: deaf, for: {lasts}}}}}",
        f"  - {{at: {at}, fault: {{sensor: tactile, kind: dead, for: {lasts}}}}}",
        f"  - {{at: {at}, transport: {{sensor: all, jitter: 0.05, drop: 0.05, for: {lasts}}}}}",
        f"  - {{at: {at + 5.0}, odometry_jump: {{x: {draw.uniform(-1.0, 1.0):.2f}, y: {draw.uniform(-0.5, 0.5):.2f}, "
        f"heading: {draw.uniform(-60.0, 60.0):.0f}, over: 3}}}}",
        f"  - {{at: {at + 20.0}, kidnap: {{to: [{where[0]}, {where[1]}], heading: {draw.uniform(-180.0, 180.0):.0f}}}}}",
        f"  - {{at: {at + 20.0}, pushers: {{count: 4, at: [{where[0] - 0.8}, {where[1] + 0.8}], heading: {draw.uniform(-180.0, 180.0):.0f}, for: 60}}}}",
        f"  - {{at: {at + 20.0}, runners: {{count: 4, at: [{where[0]}, {where[1]}], within: 3, for: {lasts - 20.0}}}}}",
        f"  - {{at: {at + 20.0}, escort: {{count: 12, near: 0.4, far: 1.4, for: {lasts - 20.0}}}}}"]
    order = sorted(events, key=lambda line: float(re.search(r"at: ([0-9.]+)", line).group(1)))
    return "events:\n" + "\n".join(order) + "\n"


def ends_of(events):
    """How each of the wishes ended; "open" where it did not."""
    ends = []
    for wish in WISHES:
        ids = {row["subject"] for row in events if row["source"] == "event" and row["kind"] == "request_queued" and row["detail"] == wish}
        over = [row["kind"][len("request_"):] for row in events if row["source"] == "event" and row["subject"] in ids
                and row["kind"] in ("request_fulfilled", "request_failed", "request_cancelled", "request_refused")]
        ends.append(over[-1] if over else "open")
    return ends
