import gc
import threading

import numpy
import pytest

import docent
from conftest import scan, sweep


def params():
    return docent.LocalizerParams(sensor=docent.ProximityModelParams(max_range=8.0))


def follow(localizer, caster, drive, seed=1):
    """Scan by scan; odometry begins somewhere else than the map."""
    random = numpy.random.default_rng(seed)
    odom_from_map = docent.Pose2(3.0, -2.0, 0.7)
    for i, pose in enumerate(drive):
        odom = odom_from_map * docent.Pose2(*pose)
        localizer.observe(sweep(scan(caster, pose, random)), odom, docent.time_from_seconds(0.25 * i))
    return localizer.map_from_robot(odom)


@pytest.fixture(scope="module", params=["grid", "particles"])
def followed(request, world, caster, drive):
    """A localizer after the drive, and where it believes the robot to be."""
    if request.param == "grid":
        localizer = docent.MarkovLocalizer(world, params(), seed=3)
    else:
        localizer = docent.MonteCarloLocalizer(world, params(), docent.MonteCarloParams(most=5000), seed=3)
    assert not localizer.verdict().localized() and localizer.map_from_robot((0, 0, 0)) is None
    return localizer, follow(localizer, caster, drive)


def test_the_robot_is_found(followed, drive):
    localizer, found = followed
    assert numpy.hypot(found.x - drive[-1][0], found.y - drive[-1][1]) < 0.1
    assert abs(found.theta - drive[-1][2]) < numpy.radians(3)
    assert localizer.verdict().localized() and localizer.verdict().p_lost() < 0.2
    assert localizer.verdict().doubt().agreement > 0.5


def test_summary(followed):
    summary = followed[0].summary()
    mode = summary.modes[0]
    assert mode.mass > 0.9 and mode.covariance.shape == (3, 3) and not mode.covariance.flags.writeable
    assert (mode.covariance == mode.covariance.T).all() and numpy.linalg.eigvalsh(mode.covariance).min() >= 0
    cells, rest = summary.cells, summary.rest
    assert cells.dtype.names == ("x", "y", "theta", "mass") and rest.ndim == 2
    assert cells["mass"].sum() + rest.sum() == pytest.approx(1.0, abs=0.02)
    masses = cells["mass"].copy()
    del summary, mode
    gc.collect()
    assert (cells["mass"] == masses).all()


def test_density_is_a_view_that_lives_on(followed):
    localizer = followed[0]
    density = localizer.density()
    mass = density.mass
    assert mass.dtype == numpy.float32 and mass.shape == (density.frame.rows, density.frame.columns)
    assert mass.sum() == pytest.approx(1.0, abs=1e-3) and mass.min() >= 0
    assert numpy.shares_memory(mass, density.mass)
    with pytest.raises(ValueError):
        mass[0, 0] = 1
    row, column = numpy.unravel_index(mass.argmax(), mass.shape)
    likely = density.frame.centre((int(column), int(row)))
    best = localizer.summary().modes[0].map_from_robot
    assert numpy.hypot(likely.x - best.x, likely.y - best.y) < 0.4
    total = mass.sum()
    del density
    gc.collect()
    assert mass.sum() == total


def test_particles(world, caster, drive):
    localizer = docent.MonteCarloLocalizer(world, params(), docent.MonteCarloParams(most=2000), seed=3)
    follow(localizer, caster, drive[:20])
    before = localizer.particles()
    x, copy = before.x, before.x.copy()
    assert len(before) == before.size() == len(x) > 0 and not x.flags.writeable
    assert numpy.hypot(before.heading_x, before.heading_y) == pytest.approx(numpy.ones(len(x)), abs=1e-3)
    follow(localizer, caster, drive[20:40])
    assert (x == copy).all()


def test_a_seed_gives_the_same_belief(world, caster, drive):
    made = [docent.MonteCarloLocalizer(world, params(), seed=5) for _ in range(2)]
    for localizer in made:
        follow(localizer, caster, drive[:15])
    first, second = (localizer.particles() for localizer in made)
    assert (first.x == second.x).all() and (first.weight == second.weight).all()


def test_start_at(world, caster, drive):
    localizer = docent.MarkovLocalizer(world, params())
    mode = docent.BeliefMode(tuple(drive[0]), numpy.diag([0.04, 0.04, 0.01]))
    localizer.start_at([mode], (0.0, 0.0, 0.0), docent.Time())
    step = localizer.observe(sweep(scan(caster, drive[0])), (0.0, 0.0, 0.0), docent.time_from_seconds(5.0))
    assert step.updated and step.beams_used > 10 and step.fit is not None
    best = localizer.map_from_robot((0.0, 0.0, 0.0))
    assert numpy.hypot(best.x - drive[0][0], best.y - drive[0][1]) < 0.1
    gains = localizer.entropy_gains(sweep(scan(caster, drive[0])), (0.0, 0.0, 0.0))
    assert gains.dtype == numpy.float32 and len(gains) in {0, 181}
    with pytest.raises(ValueError, match="modes"):
        localizer.start_at([], (0.0, 0.0, 0.0), docent.Time())


def test_modes_are_checked():
    for covariance in [numpy.zeros((3, 3)), numpy.full((3, 3), numpy.nan), numpy.eye(2), -numpy.eye(3),
                       numpy.eye(3) + numpy.eye(3, k=1)]:
        with pytest.raises(ValueError, match="covariance"):
            docent.BeliefMode((0, 0, 0), covariance)
    for mass in [0.0, -1.0, 2.0, numpy.nan]:
        with pytest.raises(ValueError, match="mass"):
            docent.BeliefMode((0, 0, 0), numpy.eye(3), mass)


def test_a_map_without_floor_is_refused():
    for cell in [-1, 100]:
        with pytest.raises(docent.Error, match="no free place"):
            docent.MarkovLocalizer(docent.OccupancyGrid(numpy.full((40, 40), cell, numpy.int8)))
    with pytest.raises(ValueError, match="cache"):
        docent.MarkovLocalizer(docent.OccupancyGrid(numpy.zeros((40, 40), numpy.int8)), cache="/no/such/folder")


def test_an_empty_sweep_and_a_jump_of_odometry(world):
    localizer = docent.MonteCarloLocalizer(world, params(), docent.MonteCarloParams(most=2000))
    for i, odom in enumerate([(0, 0, 0), (0.5, 0, 0), (1e5, 0, 0), (-1e5, 2, 3)]):
        localizer.observe(docent.RangeSweep(), odom, docent.time_from_seconds(i))
    assert not localizer.verdict().localized()


def test_threads_take_turns(world, caster, drive):
    localizer = docent.MarkovLocalizer(world, params(), seed=3)
    failures = []

    def work(first):
        try:
            for i, pose in enumerate(drive[first:first + 20]):
                localizer.observe(sweep(scan(caster, pose)), tuple(pose), docent.time_from_seconds(float(i)))
                assert localizer.density().mass.sum() == pytest.approx(1.0, abs=1e-2)
                localizer.summary(), localizer.verdict()
        except BaseException as failure:  # for the thread that waits
            failures.append(failure)
    threads = [threading.Thread(target=work, args=(first,)) for first in (0, 5, 10)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures


def test_virtual_measurements_of_a_belief(followed):
    localizer, found = followed
    hazard = [(found.x + 1.0, found.y - 0.5), (found.x + 1.4, found.y - 0.5), (found.x + 1.4, found.y + 0.5),
              (found.x + 1.0, found.y + 0.5)]
    area = [(0, 0), (10.2, 0), (10.2, 6.2), (0, 6.2)]
    scan_of_all = docent.VirtualMeasurements(area, [hazard]).measure(localizer.summary())
    assert scan_of_all.ranges.shape == (180,) and not scan_of_all.ranges.flags.writeable
    assert 0.5 < scan_of_all.ranges[90] < 1.1  # straight ahead; the belief's cells are as wide as 15 cm
    assert scan_of_all.ranges[0] > 2.0  # behind it nothing is near but the border
    assert scan_of_all.possible_mass == pytest.approx(1.0, abs=0.05)
