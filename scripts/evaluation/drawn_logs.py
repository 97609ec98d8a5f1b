"""Drawn buildings that look alike when shifted or turned, for `scripts/evaluate localize-logs --part drawn`: wings whose recesses repeat every 3 to 12 m, and rings of
corridors that are the same after half a turn. The walls that a log sees are up to 5 cm off those of the map, and boxes stand along them; people as in recorded logs."""
import math
import random

import numpy
from scipy.ndimage import binary_dilation

from evaluation import starts, trial_logs

CELL = 0.05  # [m] of the maps
REACH = 8.2  # [m] of the laser
MISDRAWN = 0.05  # [m]
CLEAR = 6  # cells about a start


class Drawing:
    """Free rectangles in solid rock."""

    def __init__(self, width, height):
        self.free = numpy.zeros((int(height / CELL), int(width / CELL)), bool)

    def carve(self, x0, y0, x1, y1, free=True):
        rows, columns = self.free.shape
        row = [min(rows, max(0, round(y / CELL))) for y in (y0, y1)]
        column = [min(columns, max(0, round(x / CELL))) for x in (x0, x1)]
        self.free[row[0]:row[1], column[0]:column[1]] = free

    def sweep(self, pose, bearings):
        """Ranges [m] of a laser."""
        steps = numpy.arange(1, int(2 * REACH / CELL) + 1) * (CELL / 2)
        headings = (pose[2] + bearings)[:, None]
        columns = numpy.floor((pose[0] + numpy.cos(headings) * steps) / CELL).astype(int)
        rows = numpy.floor((pose[1] + numpy.sin(headings) * steps) / CELL).astype(int)
        inside = (rows >= 0) & (columns >= 0) & (rows < self.free.shape[0]) & (columns < self.free.shape[1])
        is_wall = ~(inside & self.free[rows % self.free.shape[0], columns % self.free.shape[1]])
        return numpy.where(is_wall.any(axis=1), steps[is_wall.argmax(axis=1)], REACH)

    def is_clear(self, x, y):
        row, column = int(y / CELL), int(x / CELL)
        return bool(row >= CLEAR and column >= CLEAR and self.free[row - CLEAR:row + CLEAR + 1, column - CLEAR:column + CLEAR + 1].all())

    def save(self, path):
        wall = binary_dilation(self.free, iterations=3) & ~self.free
        image = numpy.flipud(numpy.where(self.free, 254, numpy.where(wall, 0, 205)).astype(numpy.uint8))
        path.with_suffix(".pgm").write_bytes(f"P5\n{image.shape[1]} {image.shape[0]}\n255\n".encode() + image.tobytes())
        path.write_text(f"image: {path.stem}.pgm\nresolution: {CELL}\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n", encoding="ascii")


def wing(seed, off):
    """A corridor of 50 to 70 m with alike recesses, some rooms that break the rhythm, and one other end: drawing, period [m], the way, a place that looks like another."""
    draw = random.Random(f"wing/{seed}")
    period = draw.choice([3, 4, 6, 6, 8, 10, 12])
    count = int(draw.uniform(50, 70) / period)
    length, width = count * period, draw.uniform(2.0, 3.0)
    depth, gap, has_two_sides = draw.uniform(0.3, 1.2), draw.uniform(0.9, min(2.0, 0.5 * period)), draw.random() < 0.5
    rooms, end = {draw.randrange(count) for _ in range(draw.randint(1, 3))}, draw.uniform(1.5, 4.0)
    drawing = Drawing(length + 10, width + 14)
    drawing.carve(3, 7, 3 + length, 7 + width)
    for k in range(count):
        x = 3 + (k + 0.5) * period + off()
        drawing.carve(x - gap / 2, 6.9 + width, x + gap / 2, 7 + width + depth + off() + (2.0 if k in rooms else 0.0))
        if has_two_sides:
            drawing.carve(x - gap / 2 + off(), 7 - depth + off(), x + gap / 2, 7.1)
    drawing.carve(3 + length - end, 7 - end, 3 + length, 7.1)
    return drawing, period, [(4.0, 7 + width / 2), (2 + length, 7 + width / 2)], None


def ring(seed, off):
    """Corridors round a block, the same after half a turn but for one niche: as `wing`, and the centre."""
    draw = random.Random(f"ring/{seed}")
    a, b, width = draw.uniform(20, 40), draw.uniform(10, 20), draw.uniform(2.0, 3.0)
    period, depth, gap = draw.choice([3, 4, 5, 6, 8]), draw.uniform(0.3, 1.0), draw.uniform(0.9, 1.6)
    drawing = Drawing(a + 8, b + 8)
    drawing.carve(3, 3, 3 + a, 3 + b)
    drawing.carve(3 + width, 3 + width, 3 + a - width, 3 + b - width, False)
    for k in range(1, int((a - width - 1) / period)):
        drawing.carve(3 + k * period + off(), 3 - depth + off(), 3 + k * period + gap, 3.1)
        drawing.carve(3 + a - k * period - gap, 2.9 + b, 3 + a - k * period + off(), 3 + b + depth + off())
    drawing.carve(1.5, 3 + b / 2, 3.1, 5 + b / 2)
    near, far_x, far_y = 3 + width / 2, 3 + a - width / 2, 3 + b - width / 2
    return drawing, period, [(near, near), (far_x, near), (far_x, far_y), (near, far_y), (near, near)], (3 + a / 2, 3 + b / 2)


SHAPES = {"wing": wing, "ring": ring}


def between(a, b):
    return (b - a + math.pi) % (2 * math.pi) - math.pi


def driven(corners, begin, length, step, draw):
    """Poses (x, y, heading) along a way, with its turns in quarters."""
    legs = [(a, b, math.dist(a, b)) for a, b in zip(corners, corners[1:])]
    total, is_closed = sum(leg[2] for leg in legs), corners[0] == corners[-1]
    poses, at, aside, last = [], begin, 0.0, None
    while at < begin + length and (is_closed or at < total):
        left = at % total if is_closed else at
        for a, b, leg in legs:
            if left <= leg:
                break
            left -= leg
        heading = math.atan2(b[1] - a[1], b[0] - a[0])
        aside += draw.gauss(0.0, 0.03) - 0.1 * aside
        x, y = a[0] + left / leg * (b[0] - a[0]) - aside * math.sin(heading), a[1] + left / leg * (b[1] - a[1]) + aside * math.cos(heading)
        if last is not None and abs(between(last, heading)) > 0.4:
            poses += [(x, y, last + part * between(last, heading)) for part in (0.25, 0.5, 0.75)]
        poses.append((x, y, heading + draw.gauss(0.0, 0.03)))
        at, last = at + step, heading
    return poses


def odometry(poses, draw):
    """What wheels say of it: 3 % of a way and of a turn, and a drift."""
    found, scale, drift = [(0.0, 0.0, 0.0)], 1.0 + draw.gauss(0.0, 0.03), draw.gauss(0.0, 0.005)
    for a, b in zip(poses, poses[1:]):
        way, bearing = math.dist(a[:2], b[:2]), math.atan2(b[1] - a[1], b[0] - a[0]) - a[2]
        x, y, heading = found[-1]
        told = way * scale * (1.0 + draw.gauss(0.0, 0.03))
        turn = between(a[2], b[2]) * (1.0 + draw.gauss(0.0, 0.03)) + drift * way + draw.gauss(0.0, 0.003)
        found.append((x + told * math.cos(heading + bearing), y + told * math.sin(heading + bearing), heading + turn))
    return found


def alike(shape, mapped, period, centre, pose, ahead, draw):
    """Another place from which the first scan looks the same: a repetition on or back, or after half a turn."""
    if centre and draw.random() < 0.5:
        return 2 * centre[0] - pose[0], 2 * centre[1] - pose[1], pose[2] + math.pi
    ways = [(pose[0] + sign * period * math.cos(ahead), pose[1] + sign * period * math.sin(ahead)) for sign in draw.sample([1, -1], 2)]
    x, y = next((way for way in ways if mapped.is_clear(*way)), ways[0])
    return x, y, pose[2]


def trial_of(shape, seed, kind, crowd, reverse, length, moments, folder):
    """Writes map and log; arguments of docent localize, and the truth of each scan in the order of the log."""
    draw = random.Random(f"{shape}/{seed}")
    mapped, period, corners, centre = SHAPES[shape](seed // 10, lambda: 0.0)
    world = SHAPES[shape](seed // 10, lambda: draw.uniform(-MISDRAWN, MISDRAWN))[0]
    if draw.random() < 0.5:
        corners = corners[::-1]
    total = sum(math.dist(a, b) for a, b in zip(corners, corners[1:]))
    margin = period + 2.0
    begin = draw.uniform(margin, max(margin + 0.1, total - margin - (0.0 if centre else length)))
    poses = driven(corners, begin, length, draw.choice([0.25, 0.4, 0.6]), draw)
    for _ in range(draw.randint(0, 4)):
        x, y, heading = draw.choice(poses)
        aside = draw.choice([-0.9, 0.9])
        world.carve(x - aside * math.sin(heading) - 0.25, y + aside * math.cos(heading) - 0.2,
                    x - aside * math.sin(heading) + 0.25, y + aside * math.cos(heading) + 0.2, False)
    noise, bearings = numpy.random.default_rng(seed), -math.pi / 2 + math.pi / 180 * numpy.arange(180)
    scans = []
    for i, (pose, told) in enumerate(zip(poses, odometry(poses, draw))):
        ranges = world.sweep(pose, bearings)
        ranges = numpy.where(ranges < REACH - 0.1, ranges + noise.normal(0.0, 0.02, len(ranges)), REACH)
        scans.append(trial_logs.Scan([float(value) for value in ranges], pose, told, [f"{0.5 * i:.3f}", "robot", f"{0.5 * i:.3f}"]))
    themap, log = folder / f"{shape}-{seed}.yaml", folder / f"{shape}-{seed}.log"
    mapped.save(themap)
    trial_logs.write_log(log, trial_logs.with_people(scans, moments, crowd, seed), ["PARAM robot_frontlaser_offset 0.0", "PARAM laser_front_laser_max 8.1"])
    arguments = ["--map", themap, "--log", log, "--wall-depth", "0", *(["--reverse"] if reverse else [])]
    if kind != "unknown":
        a, b = (poses[-1], poses[-2]) if reverse else (poses[0], poses[1])
        where = a if kind == "given" else alike(shape, mapped, period, centre, a, math.atan2(b[1] - a[1], b[0] - a[0]), draw)
        arguments += ["--start", f"{where[0]:.3f},{where[1]:.3f},{math.degrees(where[2]):.2f}"]
    return arguments, [(x, y, math.degrees(heading)) for x, y, heading in poses]


def run_trial(logs, shape, number, moments, method, first_seed):
    seed = 1000 * first_seed + number
    trial = starts.Trial(f"{shape} {seed // 10}", starts.KINDS[number % len(starts.KINDS)],
                         starts.CROWDS[(number // len(starts.KINDS) + number) % len(starts.CROWDS)], number % 2 == 1, seed)
    arguments, truth = trial_of(shape, seed, trial.kind, trial.crowd, trial.reverse, starts.LENGTH, moments, logs.scratch_file(""))
    poses = logs.scratch_file(f"{shape}-{method}-{seed}.csv")
    trial.seconds = starts.run_from_free_place([logs.program, "localize", *arguments, "--method", method, "--seed", seed, "--poses", poses],
                                               poses.with_suffix(".txt"))
    rows = starts.read_poses(poses)
    if len(rows) != len(truth):
        raise RuntimeError(f"{trial.building}, seed {seed}: {len(rows)} poses of {len(truth)} scans")
    way, last = 0.0, None
    for at, row in zip(reversed(truth) if trial.reverse else truth, reversed(rows) if trial.reverse else rows):
        way += math.dist(at[:2], last[:2]) if last else 0.0
        last = at
        is_wrong = row["has_pose"] != "1" or math.dist((float(row["x"]), float(row["y"])), at[:2]) > starts.OFF \
            or starts.turned(float(row["heading_deg"]), at[2]) > starts.TURNED
        trial.rows.append((way, is_wrong, float(row["p_lost"]), row["localized"] == "1"))
    return trial


def protocol(logs, methods, buildings, first_seed, verdict):
    """Ten beginnings in each of so many wings and so many rings."""
    print(f"\n## Drawn wings and rings that look alike when shifted or turned: {buildings} of each, ten beginnings, seed {first_seed}\n")
    moments = trial_logs.read_people(logs.data / "pedestrians")
    for method in methods:
        trials = [run_trial(logs, shape, number, moments, method, first_seed) for shape in SHAPES for number in range(10 * buildings)]
        starts.print_figures(f"{method}, drawn", trials)
        starts.print_bins(trials)
        starts.print_kinds(trials)
        starts.judge(f"{method}, drawn", trials, verdict)
