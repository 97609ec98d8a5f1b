"""Rooms, hallways and doors: labelled floor plans of real buildings, bare and furnished by a seeded furnisher, and drawn office buildings
whose hallways and doors are known."""
import json
import math
import subprocess
import tempfile
from pathlib import Path

from evaluation.programs import laboratory
from evaluation.tables import Verdict, print_table

PARTS = ["plans", "kinds", "examples"]
CELL = 0.05  # [m] of the plans
LEAST = 1.0  # [m2] less is no room
RECALL, PRECISION = 0.950, 0.948  # published for Voronoi on bare plans
F1_BARE, F1_FURNISHED = 0.83, 0.69  # the best that was measured of others, at 0.5 overlap: aims
DOOR_WITHIN = 0.8  # [m] of its leaf, which hangs beside it
LEARNED = range(1, 9)  # drawn buildings whose places are the examples of place_kind.cpp
HELD_OUT = range(1001, 1021)


def grey(path):
    import matplotlib.image
    import numpy
    pixels = matplotlib.image.imread(path)
    return numpy.round(255 * (pixels[..., 0] if pixels.ndim == 3 else pixels)).astype(int)


def write_map(stem, free, known):
    import numpy
    cells = numpy.where(free, 254, numpy.where(known, 0, 205)).astype(numpy.uint8)
    stem.with_suffix(".pgm").write_bytes(b"P5\n%d %d\n255\n" % (free.shape[1], free.shape[0]) + cells.tobytes())
    stem.with_suffix(".yaml").write_text(f"image: {stem.name}.pgm\nresolution: {CELL}\norigin: [0, 0, 0]\nnegate: 0\n"
                                         "occupied_thresh: 0.65\nfree_thresh: 0.196\n")


def read_cells(path):
    import numpy
    file = path.read_bytes()
    start = file.index(b"65535\n") + 6
    columns, rows = map(int, file.split(b"\n", 2)[1].split())
    return numpy.frombuffer(file[start:], ">u2").reshape(rows, columns).astype(int)


def furnished(free, seed):
    """The floor with tables in the middle of rooms, cabinets along walls, chairs; no door is shut, and doorsteps stay free."""
    import numpy
    from scipy import ndimage
    draw = numpy.random.default_rng([1994, seed])
    floor = free.copy()
    clear = ndimage.distance_transform_edt(numpy.pad(free, 1))[1:-1, 1:-1] * CELL
    rows, columns = numpy.nonzero(free)
    aim = 0.12 * free.sum()
    for _ in range(40000):
        if free.sum() - floor.sum() >= aim:
            break
        at = draw.integers(len(rows))
        row, column = rows[at], columns[at]
        kind = draw.choice(["table", "cabinet", "chair"], p=[0.25, 0.35, 0.4])
        length, width = {"table": (draw.uniform(1.2, 2.0), 0.8), "cabinet": (draw.uniform(0.8, 2.0), 0.45), "chair": (0.45, 0.45)}[kind]
        angle = draw.choice([0, math.pi / 2]) + (0 if kind == "cabinet" else draw.normal(0, 0.1))
        reach = int(math.hypot(length, width) / 2 / CELL) + 2
        window = (slice(max(0, row - reach), row + reach + 1), slice(max(0, column - reach), column + reach + 1))
        y, x = numpy.mgrid[window]
        along = (x - column) * CELL * math.cos(angle) + (y - row) * CELL * math.sin(angle)
        across = -(x - column) * CELL * math.sin(angle) + (y - row) * CELL * math.cos(angle)
        body = (abs(along) <= length / 2) & (abs(across) <= width / 2)
        round_it = (abs(along) <= length / 2 + 0.7) & (abs(across) <= width / 2 + 0.7)
        if not free[window][body].all() or not floor[window][body].all():
            continue
        near_wall = clear[window][body].min()
        if kind == "cabinet":  # its back on the wall, and a room's width before it
            fits = near_wall <= 0.1 and clear[window][body].max() <= 0.5 and clear[window][round_it].max() >= 1.1
            far = slice(max(0, row - 30), row + 31), slice(max(0, column - 30), column + 31)
            fits = fits and clear[far].max() >= 1.3
        else:
            fits = near_wall >= (0.9 if kind == "table" else 0.7)
        if not fits:
            continue
        floor[window] &= ~body
    return floor


def score(places, truth):
    """Recall and precision as published (the largest share of each labelled room in one place, and of each place in one room), F1 at 0.5
    overlap, and how many rooms and places."""
    import numpy
    both = (places > 0) & (truth > 0)
    shared = numpy.zeros((truth.max() + 1, places.max() + 1))
    numpy.add.at(shared, (truth[both], places[both]), 1)
    of_room, of_place = shared.sum(1), shared.sum(0)
    rooms = [i for i in range(1, len(of_room)) if of_room[i] * CELL ** 2 >= LEAST]
    found = [j for j in range(1, len(of_place)) if of_place[j] * CELL ** 2 >= LEAST]
    recall = sum(shared[i].max() / of_room[i] for i in rooms) / len(rooms)
    precision = sum(shared[:, j].max() / of_place[j] for j in found) / len(found)
    right = sum(shared[i, j] > 0.5 * (of_room[i] + of_place[j] - shared[i, j]) for i in rooms for j in found)
    return recall, precision, 2 * right / (len(rooms) + len(found)), len(rooms), len(found)


def open_doors(world, along):
    """Corners of the leaves of doors that stand open. A leaf that lies along the hallway, [deg], is shut: its hallway is not seen from
    the room."""
    for solid in world["solids"]:
        if not solid["id"].startswith("door"):
            continue
        (x, y), (far_x, far_y) = solid["polygon"][0], solid["polygon"][1]
        turned = abs((math.degrees(math.atan2(far_y - y, far_x - x)) - along + 90) % 180 - 90)
        if turned > 15:
            yield solid["polygon"]


class Rooms:
    def __init__(self, program, pictures):
        self.program = program
        self.scratch = tempfile.TemporaryDirectory(prefix="docent-rooms-")
        self.folder = Path(pictures or self.scratch.name)
        self.folder.mkdir(parents=True, exist_ok=True)

    def of(self, yaml, name):
        cells, report = self.folder / f"{name}.cells.pgm", self.folder / f"{name}.json"
        subprocess.run([laboratory(self.program), "rooms", "--map", yaml, "--cells", cells, "--report", report, "--picture", self.folder / f"{name}.png"],
                       check=True, capture_output=True)
        return read_cells(cells), json.loads(report.read_text())

    def plan(self, path, seed):
        """A labelled plan, bare (seed None) or furnished: how its places match the labels."""
        from scipy import ndimage
        plan, labels = grey(path), grey(path.with_name(path.stem + "_gt_segmentation.png"))
        truth, _ = ndimage.label(labels > 250)
        free, known = plan > 250, plan != 205
        if seed is not None:
            floor = furnished(free, seed)
            known, free = known | (free & ~floor), floor
        name = path.stem + ("" if seed is None else f"-furnished-{seed}")
        write_map(self.folder / name, free, known)
        places, _ = self.of(self.folder / f"{name}.yaml", name)
        return score(places * free, truth)

    def building(self, seed):
        """A drawn office building: its places with whether each is truly a hallway, and its open doors with whether each was found."""
        import yaml
        folder = self.folder / f"office-{seed}"
        subprocess.run([self.program, "office", "--seed", str(seed), "--out", folder], check=True, capture_output=True)
        cells, report = self.of(folder / "map.yaml", f"office-{seed}-places")
        museum, frame = yaml.safe_load((folder / "museum.yaml").read_text()), yaml.safe_load((folder / "map.yaml").read_text())
        stops = [museum["home"], *(exhibit["pose"] for exhibit in museum["exhibits"])]  # home and stops lie in hallways
        hallways = set()
        for stop in stops:
            column, row = (int((stop[axis] - frame["origin"][i]) / frame["resolution"]) for i, axis in enumerate("xy"))
            hallways.add(cells[cells.shape[0] - 1 - row, column])
        return ([(place, place["number"] in hallways) for place in report["places"]],
                [any(math.dist((found["x"], found["y"]), end) <= DOOR_WITHIN for found in report["doors"] for end in leaf)
                 for leaf in open_doors(yaml.safe_load((folder / "simulation.yaml").read_text()), museum["home"]["heading"])])


def plans(rooms, data, seeds, verdict):
    paths = [path for path in sorted((data / "rooms").glob("*.png")) if not path.stem.endswith("_gt_segmentation")]
    rows, means = [], {}
    for kind, some in (("bare", [None]), ("furnished", seeds)):
        scores = [(path.stem, seed, rooms.plan(path, seed)) for path in paths for seed in some]
        rows += [[name, kind if seed is None else f"{kind} {seed}", found[3], found[4], *(f"{100 * value:.1f}" for value in found[:3])]
                 for name, seed, found in scores]
        means[kind] = [sum(found[i] for _, _, found in scores) / len(scores) for i in range(3)]
        means[f"{kind} pooled"] = len(scores)
    print_table(["plan", "as", "rooms", "places", "recall %", "precision %", "F1 at 0.5 %"], rows)
    print()
    recall, precision, f1 = means["bare"]
    verdict.want(f"bare: recall ({100 * RECALL:.1f} %)", f"{100 * recall:.1f} %, mean of {means['bare pooled']} plans", recall >= RECALL)
    verdict.want(f"bare: precision ({100 * PRECISION:.1f} %)", f"{100 * precision:.1f} %", precision >= PRECISION)
    verdict.want(f"bare: F1 at 0.5 overlap (aim {100 * F1_BARE:.0f} %)", f"{100 * f1:.1f} %", f1 > F1_BARE)
    verdict.want(f"furnished: F1 at 0.5 overlap (aim {100 * F1_FURNISHED:.0f} %)", f"{100 * means['furnished'][2]:.1f} %, mean of "
                 f"{means['furnished pooled']} maps", means["furnished"][2] > F1_FURNISHED)


def kinds(rooms, seeds, verdict):
    buildings = [rooms.building(seed) for seed in seeds]
    places = [place for found, _ in buildings for place in found]
    doors = [found for _, all_doors in buildings for found in all_doors]
    right = {kind: [(place["kind"] == "hallway") == truly for place, truly in places if truly == kind] for kind in (True, False)}
    for kind, name in ((True, "hallways"), (False, "rooms")):
        verdict.want(f"drawn buildings, not learned from: {name} called so (90 %)", f"{sum(right[kind])} of {len(right[kind])}",
                     sum(right[kind]) >= 0.9 * len(right[kind]))
    verdict.want("drawn buildings: open doors found (90 %)", f"{sum(doors)} of {len(doors)}", sum(doors) >= 0.9 * len(doors))


def print_examples(rooms):
    """Lines for the table in place_kind.cpp."""
    for seed in LEARNED:
        for place, truly in rooms.building(seed)[0]:
            print(f"    {{{{{place['area_m2']:.1f}, {place['width_m']:.2f}, {place['elongation']:.2f}, {place['doors']}}}, "
                  f"PlaceKind::{'hallway' if truly else 'room'}}},")


def protocol(program, data, options):
    rooms, verdict = Rooms(program, options.pictures), Verdict()
    if options.part == "examples":
        print_examples(rooms)
        return verdict
    if options.part != "kinds" and not (data / "rooms").is_dir():
        print(f"skipped: labelled floor plans, no data in {data}")
    elif options.part != "kinds":
        plans(rooms, data, range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else 5))), verdict)
    if options.part != "plans":
        kinds(rooms, HELD_OUT[:5] if options.slice else HELD_OUT, verdict)
    verdict.print()
    return verdict
