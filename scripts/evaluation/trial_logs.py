"""Pieces of recorded logs for `scripts/evaluate localize-logs --part starts`: a few scans on end, with recorded people cut into them.

A piece is a CARMEN log of its own. People are discs of 0.25 m that walk as those of `pedestrians/` did, in the frame of the robot's odometry; a beam
that meets one ends on him."""
import gzip
import math
import random
from dataclasses import dataclass, field

BODY = 0.25  # [m] radius of a person
NEAREST = 0.5  # [m] from the laser: nobody walks through the robot
CROWD_REACH = 6.0  # [m] in which people walk about the robot


@dataclass
class Scan:
    """One FLASER line: ranges [m], the pose that is logged beside the odometry, the odometry (x, y [m], theta [rad])."""
    ranges: list
    pose: tuple
    odometry: tuple
    rest: list
    step: float = field(init=False)

    def __post_init__(self):
        self.step = math.pi / (len(self.ranges) if len(self.ranges) % 2 == 0 else len(self.ranges) - 1)

    def line(self):
        numbers = [f"{r:.3f}" for r in self.ranges] + [f"{v:.6f}" for v in (*self.pose, *self.odometry)]
        return " ".join(["FLASER", str(len(self.ranges)), *numbers, *self.rest])


def read_log(path):
    """The scans of a CARMEN log and its PARAM lines."""
    scans, parameters = [], []
    with gzip.open(path, "rt", encoding="ascii", errors="replace") as file:
        for line in file:
            words = line.split()
            if words and words[0] == "PARAM":
                parameters.append(line.rstrip("\n"))
            if not words or words[0] != "FLASER":
                continue
            count = int(words[1])
            numbers = [float(word) for word in words[2:2 + count + 6]]
            scans.append(Scan(numbers[:count], tuple(numbers[count:count + 3]), tuple(numbers[count + 3:count + 6]),
                              words[2 + count + 6:]))
    return scans, parameters


def read_people(folder):
    """Recorded steps of people: a list of moments, each {person: (x, y)}, 0.4 s apart."""
    moments = {}
    for name in ("eth", "zara01", "zara02"):
        for line in (folder / name / "obsmat.txt").read_text(encoding="ascii").splitlines():
            words = [float(word) for word in line.split()]
            if len(words) >= 5:
                moments.setdefault((name, int(words[0])), {})[f"{name}-{int(words[1])}"] = (words[2], words[4])
    return [moments[key] for key in sorted(moments)]


def hit(origin, direction, centre):
    """[m] along a ray until it meets a person, or None."""
    to = (centre[0] - origin[0], centre[1] - origin[1])
    along = to[0] * direction[0] + to[1] * direction[1]
    aside = to[0] * direction[1] - to[1] * direction[0]
    if along <= 0.0 or abs(aside) >= BODY:
        return None
    return along - math.sqrt(BODY * BODY - aside * aside)


def with_people(scans, moments, share, seed):
    """The scans with so many people about the robot that they end `share` of the beams, in the mean over the piece. People keep to their recorded steps; a
    crowd is laid over itself, turned and moved, until there are enough."""
    if share <= 0.0:
        return scans
    rng = random.Random(f"people/{seed}")
    layers = [(rng.randrange(len(moments)), rng.uniform(0.0, 2.0 * math.pi), rng.uniform(-4.0, 4.0), rng.uniform(-4.0, 4.0))
              for _ in range(40)]
    result = []
    for n, scan in enumerate(scans):
        ranges = list(scan.ranges)
        x, y, theta = scan.pose
        people = []
        for begin, turn, off_x, off_y in layers:
            moment = moments[(begin + n) % len(moments)]
            mean = [sum(p[i] for p in moment.values()) / len(moment) for i in (0, 1)]
            for px, py in moment.values():
                px, py = px - mean[0] + off_x, py - mean[1] + off_y
                place = (x + math.cos(turn) * px - math.sin(turn) * py, y + math.sin(turn) * px + math.cos(turn) * py)
                if NEAREST + BODY < math.dist(place, (x, y)) < CROWD_REACH:
                    people.append(place)
        rng_now = random.Random(f"people/{seed}/{n // 5}")
        rng_now.shuffle(people)
        covered = set()
        for place in people:
            if len(covered) >= share * len(ranges):
                break
            for i, measured in enumerate(scan.ranges):
                bearing = theta - math.pi / 2 + i * scan.step
                to = hit((x, y), (math.cos(bearing), math.sin(bearing)), place)
                if to is not None and to < measured:
                    ranges[i] = min(ranges[i], to)
                    covered.add(i)
        result.append(Scan(ranges, scan.pose, scan.odometry, scan.rest))
    return result


def write_log(path, scans, parameters):
    path.write_text("\n".join([*parameters, *(scan.line() for scan in scans)]) + "\n", encoding="ascii")


def driven(scans):
    """[m] from the first scan to each, by the poses that are logged."""
    ways = [0.0]
    for before, after in zip(scans, scans[1:]):
        ways.append(ways[-1] + math.dist(before.pose[:2], after.pose[:2]))
    return ways


def piece(scans, begin, length):
    """The scans from `begin` on that lie within `length` [m] of driving."""
    ways = driven(scans[begin:])
    return scans[begin:begin + sum(way <= length for way in ways)]
