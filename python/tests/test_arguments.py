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
