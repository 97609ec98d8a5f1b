"""Whatever is given for an array ends in an exception that names it."""
import numpy
import pytest

import docent

FLOATS = numpy.ones(10, numpy.float32)


def reading(ranges):
    return docent.LaserReading(ranges, 0.0, 0.1)


@pytest.mark.parametrize("ranges, error, said", [
    ([1.0, 2.0], TypeError, "numpy array"),
    ("ranges", TypeError, "numpy array"),
    (None, TypeError, "numpy array"),
    (numpy.ones(10, numpy.int32), TypeError, "int32"),
    (numpy.ones(10, numpy.float16), TypeError, "float16"),
    (numpy.ones(10, numpy.complex64), TypeError, "complex64"),
    (numpy.ones(10, object), TypeError, "object"),
    (FLOATS.astype(">f4"), TypeError, ">f4"),
    (numpy.ones((2, 5)), ValueError, r"\(2, 5\)"),
    (numpy.array(1.0), ValueError, "1 dimensions"),
    (FLOATS[::2], ValueError, "contiguous"),
])
def test_ranges(ranges, error, said):
    with pytest.raises(error, match=f"ranges.*{said}"):
        reading(ranges)


def test_ranges_may_say_nothing():
    odd = numpy.array([numpy.nan, numpy.inf, -numpy.inf, -1.0, 2.0], numpy.float32)
    sweep = docent.RangeSweep()
    sweep.append(reading(odd))
    assert [bool(beam["no_return"]) for beam in sweep.beams] == [True, False]
    sweep.append(reading(numpy.empty(0, numpy.float32)))
    assert len(sweep) == 2


@pytest.mark.parametrize("name", ["first_bearing", "bearing_step", "min_range", "max_range"])
@pytest.mark.parametrize("value", [numpy.nan, numpy.inf])
def test_scalars_are_finite(name, value):
    given = {"first_bearing": 0.0, "bearing_step": 0.1, name: value}
    with pytest.raises(ValueError, match=name):
        docent.LaserReading(FLOATS, **given)


def test_poses_are_finite():
    for pose in [(numpy.nan, 0, 0), (0, numpy.inf, 0), (0, 0, numpy.nan)]:
        with pytest.raises(ValueError, match="[xy]|theta"):
            docent.Pose2(*pose)
    with pytest.raises(ValueError, match="x, y, theta"):
        docent.Pose2((1.0, 2.0))
    with pytest.raises(TypeError):
        docent.inverse("here")


@pytest.mark.parametrize("pair, error, said", [
    ((numpy.nan, 0), ValueError, "point's x: a finite number is expected, not nan"),
    ((0, -numpy.inf), ValueError, "point's y: a finite number is expected, not -inf"),
    ((0, 1e300), ValueError, r"point's y: a number from -1000000.0 to 1000000.0 is expected, not 1e\+300"),
    (("a", 0), TypeError, "point's x: a number is expected, not str"),
    ((None, 0), TypeError, "point's x: a number is expected, not NoneType"),
    ((1, 2, 3), ValueError, r"a point is \(x, y\)"),
])
def test_a_tuple_for_a_point(pair, error, said):
    for use in [docent.Point2, docent.GridFrame(3, 3).cell_at, lambda pair: docent.GridFrame(3, 3, origin=pair)]:
        with pytest.raises(error, match=said):
            use(pair)


@pytest.mark.parametrize("pose, error, said", [
    ((numpy.nan, 0, 0), ValueError, "pose's x: a finite number is expected, not nan"),
    ((0, 1e300, 0), ValueError, r"pose's y: a number from .*not 1e\+300"),
    ((0, 0, numpy.inf), ValueError, "pose's theta: a finite number is expected, not inf"),
    (("a", 1, 2), TypeError, "pose's x: a number is expected, not str"),
    ((1, 2), ValueError, r"a pose is \(x, y, theta\)"),
])
def test_a_tuple_for_a_pose(world, pose, error, said):
    sweep = docent.RangeSweep()
    for use in [docent.Pose2, docent.inverse, lambda pose: sweep.append(reading(FLOATS), pose),
                lambda pose: docent.BeliefMode(pose, numpy.eye(3))]:
        with pytest.raises(error, match=said):
            use(pose)


def test_tuples_beside_points_and_poses():
    pose = docent.Pose2(1, 2, numpy.pi / 2)
    moved = pose * (1, 0)
    assert isinstance(moved, docent.Point2) and (moved.x, moved.y) == pytest.approx((1, 3))
    turned = pose * (1, 0, 0.5)
    assert (turned.x, turned.y, turned.theta) == pytest.approx((1, 3, numpy.pi / 2 + 0.5))
    with pytest.raises(ValueError, match="point's x"):
        pose * (numpy.nan, 0)
    with pytest.raises(TypeError):
        pose * 3
    assert docent.Point2(1, 2) == (1, 2) and docent.Point2(1, 2) == docent.Point2(1, 2)
    for other in [(1, 3), (1,), ("a", 2), (numpy.nan, 2), 5, None]:
        assert not docent.Point2(1, 2) == other


@pytest.mark.parametrize("kind", [numpy.float32, numpy.float64])
def test_arrays_that_are_not_aligned(caster, kind):
    aligned = numpy.linspace(0, 3, 7).astype(kind)
    odd = numpy.frombuffer(b"x" + aligned.tobytes(), dtype=kind, offset=1)
    assert not odd.flags.aligned
    assert reading(odd).ranges.tolist() == reading(aligned).ranges.tolist()
    assert caster.cast((1, 1), odd, 10.0).tolist() == caster.cast((1, 1), aligned, 10.0).tolist()


def test_a_cache_that_is_no_folder(world, tmp_path):
    for name in ["none\udcff", "x" * 5000]:
        with pytest.raises(ValueError, match="cache: .*is no folder"):
            docent.MarkovLocalizer(world, cache=tmp_path / name)


@pytest.mark.parametrize("polygon, error, said", [
    ([(0, 0), (1, 0)], ValueError, "three corners"),
    (numpy.zeros((4, 3)), ValueError, r"\(n, 2\)"),
    (numpy.zeros(4), ValueError, "2 dimensions"),
    ([(0, 0), (1, 0), (1, numpy.nan)], ValueError, "hazards"),
    ([(0, 0), (1, 0), (1,)], ValueError, ""),
    (numpy.zeros((4, 2), numpy.int64), TypeError, "int64"),
    (numpy.zeros((8, 2))[::2], ValueError, "contiguous"),
])
def test_polygons(world, polygon, error, said):
    with pytest.raises(error, match=said):
        docent.RoutePlanner(world, hazards=[polygon])


@pytest.mark.parametrize("cells, error", [
    (numpy.zeros((3, 4)), TypeError), (numpy.zeros(12, numpy.int8), ValueError), (numpy.zeros((0, 4), numpy.int8), ValueError),
    (numpy.full((3, 4), 101, numpy.int8), ValueError), (numpy.full((3, 4), -2, numpy.int8), ValueError),
    (numpy.zeros((3, 4), numpy.int8).T, ValueError)])
def test_cells(cells, error):
    with pytest.raises(error):
        docent.OccupancyGrid(cells)


def test_resolution():
    for resolution in [0.0, -1.0, numpy.nan, numpy.inf, 1e-9]:
        with pytest.raises(ValueError, match="resolution"):
            docent.OccupancyGrid(numpy.zeros((3, 4), numpy.int8), resolution)


def test_params():
    params = docent.LocalizerParams(beams=30)
    assert (params.beams, docent.LocalizerParams().beams) == (30, 60)
    params.states.cell_size = 0.2
    assert params.states.cell_size == 0.2
    with pytest.raises(ValueError, match="cell_size.*NaN"):
        params.states.cell_size = numpy.nan
    with pytest.raises(AttributeError):
        params.beems = 30
    with pytest.raises(AttributeError):
        docent.LocalizerParams(beems=30)
    with pytest.raises(TypeError):
        params.beams = "many"
    with pytest.raises(TypeError):
        docent.VerdictParams.travelled.fget(params)


def test_params_are_checked_where_they_are_used(world):
    with pytest.raises(ValueError, match="beams must be 4..360"):
        docent.MarkovLocalizer(world, docent.LocalizerParams(beams=1))
    with pytest.raises(ValueError, match="coarsening"):
        docent.RoutePlanner(world, params=docent.RouteParams(coarsening=0))
    with pytest.raises(ValueError, match="confidence"):
        docent.VirtualMeasurements((), (), docent.VirtualMeasurementParams(confidence=2.0))
    with pytest.raises(ValueError, match="states"):
        docent.MarkovLocalizer(world, docent.LocalizerParams(states=docent.StateSpaceParams(cell_size=1e-5)))


def test_classes_that_only_the_library_makes():
    for made in [docent.Verdict, docent.BeliefSummary, docent.ParticleSet, docent.LaserLog, docent.McapReader]:
        with pytest.raises(TypeError):
            made()


def test_a_field_that_is_a_keyword():
    params = docent.ScanMapperParams(pass_=0.3)
    assert params.pass_ == 0.3 and not hasattr(params, "pass")
