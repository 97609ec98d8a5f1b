"""A small hall whose answers are known by hand, and a log driven through it."""
import numpy
import pytest

import docent

RESOLUTION = 0.05


def hall():
    """10 x 6 m of floor in a wall of 10 cm, with a partition and a niche, so that no two places look the same."""
    cells = numpy.zeros((124, 204), numpy.int8)
    cells[:2] = cells[-2:] = 100
    cells[:, :2] = cells[:, -2:] = 100
    cells[2:60, 80:82] = 100
    cells[90:122, 140:160] = 100
    return docent.OccupancyGrid(cells, RESOLUTION, (0.0, 0.0))


def way():
    """Poses [n, 3] of a drive round the partition, 10 cm or 5 degrees apart."""
    corners = [(1.5, 1.5), (1.5, 4.2), (6.0, 4.2), (6.0, 1.5), (8.5, 1.5)]
    poses = []
    for (x, y), (to_x, to_y) in zip(corners, corners[1:]):
        heading = numpy.arctan2(to_y - y, to_x - x)
        if poses:
            before = poses[-1][2]
            turn = (heading - before + numpy.pi) % (2 * numpy.pi) - numpy.pi
            for part in numpy.linspace(0, 1, max(2, int(abs(turn) / 0.09)))[1:]:
                poses.append((x, y, before + turn * part))
        for part in numpy.arange(0.0, 1.0, 0.1 / numpy.hypot(to_x - x, to_y - y)):
            poses.append((x + part * (to_x - x), y + part * (to_y - y), heading))
    return numpy.array(poses)


def scan(caster, pose, random=None, beams=181, max_range=8.0):
    """Ranges [beams] that a laser of 180 degrees reads at a pose of the robot."""
    headings = pose[2] + numpy.linspace(-numpy.pi / 2, numpy.pi / 2, beams)
    ranges = caster.cast((pose[0], pose[1]), headings, max_range)
    if random is not None:
        ranges = ranges + random.normal(0.0, 0.01, beams)
    return ranges


def sweep(ranges, max_range=8.0):
    result = docent.RangeSweep()
    reading = docent.LaserReading(ranges.astype(numpy.float32), -numpy.pi / 2, numpy.pi / (len(ranges) - 1),
                                  max_range=max_range)
    result.append(reading)
    return result


def carmen_lines(caster, poses, seed=1):
    """The drive as a CARMEN log, with the odometry of good wheels."""
    random = numpy.random.default_rng(seed)
    lines = ["PARAM laser_front_laser_resolution 1.0"]
    for i, pose in enumerate(poses):
        ranges = " ".join(f"{r:.3f}" for r in numpy.minimum(scan(caster, pose, random), 81.9))
        place = f"{pose[0]:.4f} {pose[1]:.4f} {pose[2]:.5f}"
        lines.append(f"FLASER 181 {ranges} {place} {place} {i * 0.2:.2f} robot {i * 0.2:.2f}")
    return lines


@pytest.fixture(scope="session")
def world():
    return hall()


@pytest.fixture(scope="session")
def caster(world):
    return docent.RayCaster(world)


@pytest.fixture(scope="session")
def drive():
    return way()


@pytest.fixture(scope="session")
def log_path(caster, drive, tmp_path_factory):
    path = tmp_path_factory.mktemp("log") / "hall.log"
    path.write_text("\n".join(carmen_lines(caster, drive)) + "\n")
    return path
