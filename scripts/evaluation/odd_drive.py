"""A drive through a small world, and what a reader of its recording must find: for odd_recordings."""
import math

import numpy as np

from .odd_bags import Odometry, Scan, Transforms

SIDE_X, SIDE_Y = 9.0, 7.0  # [m]
STEP = 0.01  # [s] of the way
FIRST = 1_700_000_000 * 10**9  # [ns]
SPLIT_M, SPLIT_RAD = 0.012, 0.01  # between two scans: odometry is interpolated
POINT_M = 0.01  # of a beam's end on the robot
STAMP_S = 0.002
NEAREST = 0.05  # [m] range_min of the scans: nearer is no reading


def boxes(rng):
    """Walls as segments [n, 4]: the room and three boxes at its walls."""
    walls = [(0, 0, SIDE_X, 0), (SIDE_X, 0, SIDE_X, SIDE_Y), (SIDE_X, SIDE_Y, 0, SIDE_Y), (0, SIDE_Y, 0, 0)]
    for _ in range(3):
        x, y = rng.choice([0.0, SIDE_X - 1.0]), rng.uniform(0, SIDE_Y - 1.0)
        a, b, c, d = x, y, x + rng.uniform(0.3, 1.0), y + rng.uniform(0.3, 1.0)
        walls += [(a, b, c, b), (c, b, c, d), (c, d, a, d), (a, d, a, b)]
    return np.array(walls, float)


def cast(walls, origins, bearings):
    """[n] m from each origin [n, 2] along each bearing [n] to the first wall."""
    ox, oy = origins[:, :1], origins[:, 1:]
    dx, dy = np.cos(bearings)[:, None], np.sin(bearings)[:, None]
    ax, ay, bx, by = walls.T
    ex, ey = bx - ax, by - ay
    across = dx * ey - dy * ex
    with np.errstate(divide="ignore", invalid="ignore"):
        far = ((ax - ox) * ey - (ay - oy) * ex) / across
        along = ((ax - ox) * dy - (ay - oy) * dx) / across
    far[~((far > 1e-9) & (along >= -1e-9) & (along <= 1 + 1e-9))] = np.inf
    return far.min(axis=1)


def turn_about(axis, angle):
    c, s = math.cos(angle), math.sin(angle)
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    turn = np.eye(3)
    turn[i, i], turn[i, j], turn[j, i], turn[j, j] = c, -s, s, c
    return turn


def quaternion_of(turn):
    """(x, y, z, w) of a rotation matrix."""
    w = math.sqrt(max(0.0, 1 + turn[0, 0] + turn[1, 1] + turn[2, 2])) / 2
    x = math.copysign(math.sqrt(max(0.0, 1 + turn[0, 0] - turn[1, 1] - turn[2, 2])) / 2, turn[2, 1] - turn[1, 2])
    y = math.copysign(math.sqrt(max(0.0, 1 - turn[0, 0] + turn[1, 1] - turn[2, 2])) / 2, turn[0, 2] - turn[2, 0])
    z = math.copysign(math.sqrt(max(0.0, 1 - turn[0, 0] - turn[1, 1] + turn[2, 2])) / 2, turn[1, 0] - turn[0, 1])
    return float(x), float(y), float(z), float(w)


class Drive:
    """One robot for some seconds: where it is, what its scanners see, and where these are."""

    def __init__(self, rng, seconds=None, begin=None):
        self.rng, self.walls = rng, boxes(rng)
        self.seconds = seconds or rng.uniform(6, 9)
        step, count = STEP, int((self.seconds + 0.5) / STEP)
        times = np.arange(count) * step
        speed = 0.35 + 0.15 * np.sin(times + rng.uniform(0, 6))
        turning = 0.5 * np.sin(0.7 * times + rng.uniform(0, 6)) + rng.choice([0.35, -0.35])
        heading = rng.uniform(-3, 3) + np.concatenate([[0], np.cumsum(turning[:-1] * step)])
        x0, y0 = begin or (rng.uniform(3.2, 5.5), rng.uniform(2.8, 4.0))
        x = x0 + np.concatenate([[0], np.cumsum(speed[:-1] * step * np.cos(heading[:-1]))])
        y = y0 + np.concatenate([[0], np.cumsum(speed[:-1] * step * np.sin(heading[:-1]))])
        self.way, self.times, self.speed, self.turning = (x.tolist(), y.tolist(), heading.tolist()), times, speed.tolist(), turning.tolist()
        self.zero = (rng.uniform(-20, 20), rng.uniform(-20, 20), rng.uniform(-3, 3))  # of odometry in the world
        self.truth = {}  # by fingerprint: what must be found

    def at(self, time):
        """(x, y, heading) in the world at `time` [s] of the drive."""
        k = min(int(time / STEP), len(self.times) - 2)
        share = time / STEP - k
        return tuple(v[k] + share * (v[k + 1] - v[k]) for v in self.way)

    def odometry_at(self, time):
        x, y, heading = self.at(time)
        c, s, (zx, zy, zh) = math.cos(-self.zero[2]), math.sin(-self.zero[2]), self.zero
        return c * (x - zx) - s * (y - zy), s * (x - zx) + c * (y - zy), heading - zh

    def speed_at(self, time):
        k = min(int(time / STEP), len(self.times) - 1)
        return self.speed[k], self.turning[k]


class Scanner:
    """Its place on the robot (x, y [m], turn: 3 x 3) and its fan."""

    def __init__(self, rng, frame="laser", upside_down=None, clockwise=None, place=None):
        self.frame = frame
        self.place = place or (rng.uniform(-0.3, 0.3), rng.uniform(-0.25, 0.25), rng.choice([0.0, math.pi, rng.uniform(-3, 3)]))
        self.upside_down = rng.random() < 0.2 if upside_down is None else upside_down
        self.turn = turn_about(2, self.place[2]) @ (turn_about(0, math.pi) if self.upside_down else np.eye(3))
        self.beams = rng.randrange(24, 64)
        self.step = rng.uniform(0.6, 1.0) * 2 * math.pi / self.beams
        self.first = rng.uniform(-math.pi, 0)
        if rng.random() < 0.15 if clockwise is None else clockwise:
            self.first, self.step = self.first + self.step * (self.beams - 1), -self.step

    def look(self, drive, time, most=12.0):
        """The ranges at that time of the drive, and what a reader must make of them: [beams, 2] m on the robot."""
        x, y, heading = drive.at(time)
        bearings = self.first + self.step * np.arange(self.beams)
        ways = self.turn @ np.stack([np.cos(bearings), np.sin(bearings), np.zeros(self.beams)])
        on_robot = np.arctan2(ways[1], ways[0])
        c, s = math.cos(heading), math.sin(heading)
        origin = np.array([[x + c * self.place[0] - s * self.place[1], y + s * self.place[0] + c * self.place[1]]])
        ranges = told_apart(cast(drive.walls, np.repeat(origin, self.beams, axis=0), on_robot + heading).astype(np.float32), drive.truth)
        points = np.stack([self.place[0] + ranges * np.cos(on_robot), self.place[1] + ranges * np.sin(on_robot)], axis=1)
        ranges = ranges.tolist()
        drive.truth[fingerprint(ranges)] = (time, drive.odometry_at(time), dict(zip(ranges, points.tolist())))
        return ranges

    def links(self, base, stamp, rng, chain=None):
        """Transforms from `base` to the scanner, over a frame or two between whose turns take each other back."""
        place, turn, parent, all_of = np.array([self.place[0], self.place[1], 0.3]), self.turn, base, []
        for k in range(rng.randrange(3) if chain is None else chain):
            between = turn_about(rng.randrange(3), rng.uniform(-2, 2)) @ turn_about(rng.randrange(3), rng.uniform(-2, 2))
            at = np.array([rng.uniform(-0.3, 0.3) for _ in range(3)])
            child = f"{base.rsplit('/', 1)[0] + '/' if '/' in base else ''}mast{k}_{self.frame.rsplit('/', 1)[-1]}"
            all_of.append((stamp, parent, child, tuple(at), quaternion_of(between)))
            place, turn, parent = between.T @ (place - at), between.T @ turn, child
        all_of.append((stamp, parent, self.frame, tuple(place), quaternion_of(turn)))
        return all_of


def told_apart(ranges, truth):
    """No reading twice in a sweep, and no sweep twice in a drive, as of a robot that stands: what is found is looked up by these."""
    seen = set()
    for k in range(len(ranges)):
        while float(ranges[k]) in seen:
            ranges[k] = np.nextafter(ranges[k], np.float32(np.inf))
        seen.add(float(ranges[k]))
    while fingerprint(ranges.tolist()) in truth:
        ranges[-1] += np.float32(1e-5)
    return ranges


def fingerprint(ranges):
    """The same in any order of the beams."""
    return round(math.fsum(r for r in ranges if NEAREST <= r < 1e5), 6)


def ticks(rng, seconds, rate):
    return [k / rate for k in range(int(seconds * rate))]


def recorded(drive, scanners, rng, topics=("/scan",), odometry="/odom", parent="odom", base="base_link", tf="/tf_static", clock=None, tf_odometry=False, rate=20.0):
    """Messages of one robot in the order of the file. clock(time of the drive) [s] -> stamp [s]; the file's times are true."""
    clock = clock or (lambda t: FIRST / 1e9 + t)
    stamp = lambda t: int(round(clock(t) * 1e3)) * 10**6  # noqa: E731
    filed = lambda t, late: FIRST + int(round(t * 1e3)) * 10**6 + late  # noqa: E731
    messages = [(tf, kinds()[2], FIRST, Transforms([link for s in scanners for link in s.links(base, stamp(0.0), rng)]))] if tf else []
    for t in ticks(rng, drive.seconds + 0.3, rate):
        pose, speed = drive.odometry_at(t), drive.speed_at(t)
        if tf_odometry:
            from .odd_bags import about_z
            messages.append((tf_odometry, kinds()[2], filed(t, 10**6), Transforms([(stamp(t), parent, base, (pose[0], pose[1], 0.0), about_z(pose[2]))])))
        if odometry:
            messages.append((odometry, kinds()[1], filed(t, 10**6), Odometry(stamp(t), parent, base, pose, speed)))
    each = rng.uniform(5, 9)
    for topic, scanner in zip(topics, scanners):
        late = rng.uniform(0.1, 0.2)
        for t in ticks(rng, drive.seconds - 0.3, each):
            t = round(t + late, 3)
            messages.append((topic, kinds()[0], filed(t, 3 * 10**6), Scan(stamp(t), scanner.frame, scanner.first, scanner.step, scanner.look(drive, t), NEAREST, 12.0)))
    return sorted(messages, key=lambda m: m[2])


def kinds():
    return "sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage"


# ---- judging

def relative(a, b):
    c, s = math.cos(-a[2]), math.sin(-a[2])
    x, y = b[0] - a[0], b[1] - a[1]
    return c * x - s * y, s * x + c * y, math.remainder(b[2] - a[2], 2 * math.pi)


def fault_of(case, answer):
    """What is wrong with a recording that was read; empty: nothing."""
    scans = answer["scans"]
    found = [next((k for k, d in enumerate(case["robots"]) if fingerprint(s["ranges"]) in d.truth), None) for s in scans]
    if None in found:
        return "a scan that is none of the right ones"
    if len(set(found)) != 1:
        return "scans of several robots"
    drive = case["robots"][found[0]]
    truth = [drive.truth[fingerprint(s["ranges"])] for s in scans]
    if "robot" in case and found[0] != case["robot"]:
        return "not the robot that was chosen"
    count = case.get("scans", len(drive.truth))
    if len(scans) != count and not (case.get("loses") and len(scans) < count):
        return f"{len(scans)} scans for {count}"
    if len(scans) < case.get("least", 0):
        return f"{len(scans)} scans for {case['least']} or more before the cut"
    for scan, (_, _, points) in zip(scans, truth):
        x, y, heading = scan["mount"]
        for k, r in enumerate(scan["ranges"]):
            if r < 0:
                continue
            bearing = heading + scan["bearing"] + k * scan["step"]
            right = points[r]
            if math.hypot(x + r * math.cos(bearing) - right[0], y + r * math.sin(bearing) - right[1]) > POINT_M:
                return f"a beam ends {math.hypot(x + r * math.cos(bearing) - right[0], y + r * math.sin(bearing) - right[1]):.2f} m off: the scanner's place is wrong"
    return way_fault(case, scans, truth)


def way_fault(case, scans, truth):
    for k in range(1, len(scans)):
        a, b = truth[k - 1], truth[k]
        if b[0] < a[0] - 1e-6:
            return "scans out of order"
        if any(a[0] <= jump <= b[0] for jump in case.get("jumps", [])):
            continue
        way, right = relative(scans[k - 1]["odometry"], scans[k]["odometry"]), relative(a[1], b[1])
        if math.hypot(way[0] - right[0], way[1] - right[1]) > case.get("way", SPLIT_M) or abs(math.remainder(way[2] - right[2], 2 * math.pi)) > case.get("turn", SPLIT_RAD):
            return f"between scans {k - 1} and {k} of {len(scans)} the robot drove {way[0]:.3f}, {way[1]:.3f} m, {way[2]:.3f} rad for {right[0]:.3f}, {right[1]:.3f}, {right[2]:.3f}"
        took = (scans[k]["time"] - scans[k - 1]["time"]) / 1e9
        if abs(took - (b[0] - a[0]) * case.get("pace", 1.0)) > case.get("times", STAMP_S):
            return f"between scans {k - 1} and {k} {took:.3f} s for {b[0] - a[0]:.3f}"
    return ""
