import gc

import numpy
import pytest

import docent


def test_cells_are_a_view(world):
    cells = world.cells
    assert (cells.dtype, cells.shape) == (numpy.int8, (124, 204))
    assert numpy.shares_memory(cells, world.cells)
    with pytest.raises(ValueError):
        cells[0, 0] = 0
    with pytest.raises(ValueError):
        cells.flags.writeable = True


def test_cells_outlive_their_grid():
    cells = docent.OccupancyGrid(numpy.full((300, 400), 7, numpy.int8)).cells
    gc.collect()
    spoil = [numpy.zeros(120000, numpy.int8) for _ in range(20)]
    assert (cells == 7).all() and spoil


def test_a_grid_copies_what_it_is_given():
    given = numpy.zeros((3, 4), numpy.int8)
    grid = docent.OccupancyGrid(given)
    given[:] = 100
    assert not grid.cells.any()


def test_frame(world):
    frame = world.frame
    assert (frame.columns, frame.rows, frame.resolution) == (204, 124, 0.05)
    assert frame.cell_at((0.12, 0.26)) == (2, 5)
    assert frame.centre((2, 5)) == docent.Point2(0.125, 0.275)
    assert frame.extent() == pytest.approx((0.0, 10.2, 0.0, 6.2))


def test_a_map_comes_back_as_it_was_saved(world, tmp_path):
    docent.save_map(world, tmp_path / "hall")
    again = docent.load_map(tmp_path / "hall.yaml")
    assert (again.cells == world.cells).all()
    assert docent.map_hash(again) == docent.map_hash(world)


def test_errors_name_file_and_line(tmp_path):
    path = tmp_path / "bad.yaml"
    path.write_text("image: bad.pgm\nresolution: -1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n")
    with pytest.raises(docent.Error) as raised:
        docent.load_map(path)
    assert raised.value.file == str(path) and raised.value.line == 2
    assert str(raised.value).startswith(f"{path}:2: ")
    with pytest.raises(docent.Error, match="none.yaml"):
        docent.load_map(tmp_path / "none.yaml")


def test_rays(caster):
    ranges = caster.cast((1.0, 1.0), numpy.radians([0.0, 90.0, 180.0, -90.0]), 20.0)
    assert ranges == pytest.approx([3.0, 5.1, 0.9, 0.9], abs=1e-6)
    assert caster.cast((1.0, 1.0), numpy.zeros(1), 2.0) == pytest.approx([2.0])
    assert numpy.isnan(caster.cast((-5.0, -5.0), numpy.zeros(1), 20.0)).all()
    assert numpy.isnan(caster.cast((-9e5, 9e5), numpy.zeros(3), 20.0)).all()
    for bad in [numpy.array([numpy.nan]), numpy.array([1, 2])]:
        with pytest.raises((TypeError, ValueError), match="headings"):
            caster.cast((1.0, 1.0), bad, 20.0)
    for most in [numpy.nan, 0.0, -1.0, numpy.inf]:
        with pytest.raises(ValueError, match="max_range"):
            caster.cast((1.0, 1.0), numpy.zeros(1), most)


def test_distance_transform_and_coarsened(world):
    away = docent.distance_transform(world.frame, world.cells >= 65)
    assert away.dtype == numpy.float32 and away.shape == world.cells.shape
    assert away[20, 5] == pytest.approx(4 * 0.05) and away[0, 0] == 0.0
    with pytest.raises(ValueError, match="occupied"):
        docent.distance_transform(world.frame, numpy.zeros((3, 4), bool))
    with pytest.raises(TypeError, match="occupied"):
        docent.distance_transform(world.frame, world.cells)
    assert docent.coarsened(world, 2).cells.shape == (62, 102)
    with pytest.raises(ValueError, match="factor"):
        docent.coarsened(world, 0)


def test_poses():
    map_from_robot = docent.Pose2(1.0, 2.0, numpy.pi / 2)
    ahead = map_from_robot * docent.Point2(1.0, 0.0)
    assert (ahead.x, ahead.y) == pytest.approx((1.0, 3.0))
    home = docent.inverse(map_from_robot) * map_from_robot
    assert (home.x, home.y, home.theta) == pytest.approx((0.0, 0.0, 0.0))
    assert docent.Pose2(theta=4 * numpy.pi).theta == pytest.approx(0.0)


def test_museum():
    museum = docent.load_museum("museums/bonn")
    assert museum.map.cells.shape == (museum.map.frame.rows, museum.map.frame.columns)
    assert museum.area.shape[1] == 2 and len(museum.hazards) == len(museum.hazard_polygons())
    assert all(exhibit.title for exhibit in museum.exhibits) and museum.languages[0] in museum.name
    cells, size = museum.map.cells, museum.map.cells.sum()
    del museum
    gc.collect()
    assert cells.sum() == size
    with pytest.raises(docent.Error):
        docent.load_museum("museums/nowhere")
