import gc

import numpy
import pytest

import docent

START, GOAL = (1.5, 1.5), (8.5, 1.5)


@pytest.fixture
def planner(world):
    return docent.RoutePlanner(world)


def test_value_iteration_by_hand():
    iteration = docent.ValueIteration(docent.GridFrame(4, 1, 1.0))
    costs = numpy.array([[1.0, 2.0, numpy.inf, 5.0]], numpy.float32)
    iteration.set_costs(costs)
    iteration.set_goals([(0, 0)])
    assert iteration.iterate() and iteration.is_settled()
    assert iteration.values().tolist() == [[0.0, 1.0, 3.0, numpy.inf]]
    assert iteration.descend((2, 0)).tolist() == [[1, 0], [0, 0]]
    assert iteration.descend((3, 0)).shape == (0, 2)


def test_value_iteration_refuses():
    iteration = docent.ValueIteration(docent.GridFrame(4, 3))
    for costs, error in [(numpy.ones((4, 3)), ValueError), (numpy.zeros((3, 4)), ValueError),
                         (numpy.full((3, 4), numpy.nan), ValueError), (numpy.ones((3, 4), int), TypeError)]:
        with pytest.raises(error, match="costs"):
            iteration.set_costs(costs)
    for cell in [(4, 0), (0, 3), (-1, 0), (2**31 - 1, 0)]:
        with pytest.raises(IndexError):
            iteration.set_goals([cell])
        with pytest.raises(IndexError):
            iteration.descend(cell)
    with pytest.raises(ValueError, match="most_visits"):
        iteration.iterate(-1)
    with pytest.raises(ValueError, match="columns"):
        docent.GridFrame(0, 3)


def test_a_way_leads_round_the_partition(planner, world):
    planner.set_goals([GOAL], tolerance=0.2)
    assert planner.iterate()
    way = planner.way(START)
    assert way.dtype == numpy.float64 and way.shape[1] == 2
    assert numpy.hypot(*(way[-1] - GOAL)) < 0.3 and numpy.hypot(*(way[0] - START)) < 0.5
    assert way[:, 1].max() > 3.0  # the partition ends there
    away = docent.distance_transform(world.frame, world.cells >= 65)
    columns, rows = (way / world.frame.resolution).astype(int).T
    assert away[rows, columns].min() > 0.3
    length = numpy.hypot(*numpy.diff(way, axis=0).T).sum()
    assert planner.cost_from(START) >= 0.95 * length


def test_values_fall_along_the_way(planner):
    planner.set_goals(numpy.array([GOAL]))
    planner.iterate()
    values, frame = planner.values(), planner.frame()
    assert values.dtype == numpy.float32 and values.shape == (frame.rows, frame.columns)
    assert numpy.isinf(values[0]).all()
    along = [values[frame.cell_at(tuple(point))[::-1]] for point in planner.way(START)[::20]]
    assert all(after < before for before, after in zip(along, along[1:]))


def test_static_costs_are_a_view(planner):
    costs = planner.static_costs()
    assert numpy.shares_memory(costs, planner.static_costs())
    with pytest.raises(ValueError):
        costs[0, 0] = 1
    assert numpy.isinf(costs[0, 0]) and numpy.isfinite(costs[20, 10])
    copy = costs.copy()
    del planner
    gc.collect()
    assert (costs == copy).all()


def test_obstacles_lengthen_the_way(planner):
    planner.set_goals([GOAL])
    planner.iterate()
    before = planner.cost_from(START)
    frame = planner.frame()
    obstacles = numpy.zeros((frame.rows, frame.columns), bool)
    column, row = frame.cell_at((4.0, 4.0))
    obstacles[row - 3:row + 3, column - 2:column + 2] = True
    planner.set_obstacles(obstacles)
    assert planner.settle(START)
    assert planner.cost_from(START) > before
    planner.hold_way(START)
    assert len(planner.way(START))
    for bad, error in [(obstacles[1:], ValueError), (obstacles.astype(int), TypeError), (obstacles[::-1], ValueError)]:
        with pytest.raises(error, match="obstacles"):
            planner.set_obstacles(bad)


def test_no_way(planner):
    assert planner.way(START).shape == (0, 2)  # nobody has said where to
    planner.set_goals([(-50.0, 50.0)])
    planner.iterate()
    assert planner.way(START).shape == (0, 2) and numpy.isinf(planner.cost_from(START))
    assert planner.is_closed((-50.0, 50.0)) and not planner.is_closed(START)
    assert planner.way((1e6, -1e6)).shape == (0, 2)
    with pytest.raises(ValueError, match="tolerance"):
        planner.set_goals([GOAL], 0.0)
    with pytest.raises(ValueError, match="goals"):
        planner.set_goals([(0.0, numpy.nan)])


def test_virtual_measurements_of_a_pose():
    hazard = [(2.0, -1.0), (3.0, -1.0), (3.0, 1.0), (2.0, 1.0)]
    params = docent.VirtualMeasurementParams(cell_padding=0.0)
    measurements = docent.VirtualMeasurements((), [hazard], params, ends="hazards")
    scan = measurements.measure(numpy.array([[0.0, 0.0, 0.0, 1.0]]))
    assert scan.ranges[90] == pytest.approx(2.0, abs=0.1) and scan.ranges[90] <= 2.0
    assert scan.ranges[0] == pytest.approx(docent.VirtualMeasurements.kMaxRange, abs=0.1)
    turned = measurements.measure([[0.0, 0.0, numpy.pi / 2, 1.0]])  # now it lies to the right
    assert turned.ranges[45] == pytest.approx(2.0, abs=0.1)
    assert measurements.nearest((0.0, 0.0)) == pytest.approx(2.0)
    assert not measurements.is_possible((2.5, 0.0))
    assert (measurements.measure(numpy.zeros((0, 4))).ranges == 0.0).all()


def test_virtual_measurements_refuse():
    measurements = docent.VirtualMeasurements((), ())
    for poses in [numpy.zeros((1, 3)), numpy.full((1, 4), numpy.nan), numpy.array([[0.0, 0.0, 0.0, -1.0]])]:
        with pytest.raises(ValueError, match="poses"):
            measurements.measure(poses)
    with pytest.raises(ValueError, match="ends"):
        docent.VirtualMeasurements((), (), ends="walls")
