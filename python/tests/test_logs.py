import gc
import gzip
import sqlite3

import numpy
import pytest

import docent
from sample_messages import LASER_SCAN, laser_scan, mcap


def test_scans(log_path, caster, drive):
    log = docent.read_laser_log(log_path)
    scans = log.scans
    assert len(log) == len(scans) == len(drive) and log.base_from_sonar.shape == (0, 3)
    scan = scans[10]
    assert scan.ranges.dtype == numpy.float32 and scan.ranges.shape == (181,)
    assert scan.first_bearing == pytest.approx(-numpy.pi / 2) and scan.bearing_step == pytest.approx(numpy.pi / 180)
    assert (scan.odom_from_base.x, scan.odom_from_base.y) == pytest.approx(tuple(drive[10][:2]), abs=1e-3)
    assert docent.to_seconds(scan.time) == pytest.approx(2.0) and scan.line == 12 and not scan.rear
    sweep = docent.sweep_of(scan, log.max_range)
    assert 100 < len(sweep) <= 181
    assert log.notes is not None and log.parameters["laser_front_laser_resolution"] == "1.0"


def test_ranges_outlive_their_log(log_path):
    ranges = docent.read_carmen_log(log_path).scans[3].ranges
    copy = ranges.copy()
    gc.collect()
    assert (ranges == copy).all() and not ranges.flags.writeable


def test_gzip(log_path, tmp_path):
    packed = tmp_path / "hall.log.gz"
    packed.write_bytes(gzip.compress(log_path.read_bytes()))
    assert len(docent.read_laser_log(packed)) == len(docent.read_laser_log(log_path))


RANGES = [[1.0, 2.0, 3.0, 4.0], [1.5, 2.5, 8.0, 4.5]]


def check_scans(log):
    assert [docent.to_seconds(scan.time) for scan in log.scans] == [100.0, 101.0] and log.max_range == 8.0
    assert log.scans[0].ranges.tolist() == RANGES[0] and log.scans[0].first_bearing == pytest.approx(-0.75)
    assert log.scans[1].ranges.tolist()[:2] == RANGES[1][:2] and log.scans[0].bearing_step == pytest.approx(0.5)
    assert docent.sweep_of(log.scans[1], log.max_range).beams["no_return"].tolist() == [False, False, True, False]
    assert any("odometry" in note for note in log.notes)


def test_an_mcap_recording(tmp_path):
    path = tmp_path / "drive.mcap"
    messages = [(0, int((100 + i) * 1e9), laser_scan(100 + i, ranges)) for i, ranges in enumerate(RANGES)]
    path.write_bytes(mcap([("/scan", "sensor_msgs/msg/LaserScan", LASER_SCAN)], messages))
    check_scans(docent.read_laser_log(path))
    decoded = docent.McapReader.open(path).messages()[1].decode()
    assert decoded.ranges.dtype == numpy.float32 and decoded.ranges.tolist() == RANGES[1]
    assert (decoded.header.stamp.sec, decoded.header.frame_id) == (101, "laser")


def test_a_rosbag2_database(tmp_path):
    path = tmp_path / "drive.db3"
    with sqlite3.connect(path) as database:
        database.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT)")
        database.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)")
        database.execute("INSERT INTO topics VALUES (1, '/scan', 'sensor_msgs/msg/LaserScan')")
        for i, ranges in enumerate(RANGES):
            database.execute("INSERT INTO messages VALUES (?, 1, ?, ?)", (i, int((100 + i) * 1e9), laser_scan(100 + i, ranges)))
    database.close()
    check_scans(docent.read_laser_log(path))
    assert "/scan" in docent.read_laser_log(path, scans=["/scan"]).sources
    with pytest.raises(docent.Error):
        docent.read_laser_log(path, scans=["/scans"])


def test_errors_name_file_and_line(tmp_path):
    path = tmp_path / "torn.log"
    path.write_text("# a comment\nFLASER 3 1.0 2.0\n")
    with pytest.raises(docent.Error) as raised:
        docent.read_laser_log(path)
    assert (raised.value.file, raised.value.line) == (str(path), 2)
    path.write_text("# nothing\n")
    with pytest.raises(docent.Error) as raised:
        docent.read_laser_log(path)
    assert (raised.value.file, raised.value.line) == (str(path), None)
    with pytest.raises(docent.Error):
        docent.read_laser_log(tmp_path)


def test_what_is_no_log(tmp_path):
    random = numpy.random.default_rng(1)
    for size in [0, 1, 100, 5000]:
        path = tmp_path / f"{size}"
        path.write_bytes(b"\x89MCAP0\r\n" + random.bytes(size))
        with pytest.raises(docent.Error):
            docent.read_laser_log(path)


def test_a_log_that_is_not_utf_8(log_path, tmp_path):
    path = tmp_path / "odd.log"
    path.write_bytes(b"PARAM odd_\xff a\xffb\n" + log_path.read_bytes())
    assert docent.read_laser_log(path).parameters["odd_\ufffd"] == "a\ufffdb"


def test_a_log_becomes_a_map(log_path, world):
    stages = set()
    made = docent.map_log(docent.read_laser_log(log_path), progress=lambda stage, done, of: stages.add(stage))
    cells = made.map.cells
    assert made.map_from_base.shape == (len(made.scans), 3) and "chain" in stages
    assert 0.5 * (world.cells == 0).sum() < (cells == 0).sum() < 1.1 * (world.cells == 0).sum()
    # The first pose is that of its odometry, so the map lies where the hall does.
    rows, columns = numpy.nonzero(cells == 100)
    x = made.map.frame.origin.x + (columns + 0.5) * made.map.frame.resolution
    y = made.map.frame.origin.y + (rows + 0.5) * made.map.frame.resolution
    away = docent.distance_transform(world.frame, world.cells >= 65)
    held = (x > 0) & (x < 10.19) & (y > 0) & (y < 6.19)
    near = away[(y[held] / 0.05).astype(int), (x[held] / 0.05).astype(int)]
    assert len(rows) > 200 and held.mean() > 0.95 and (near <= 0.101).mean() > 0.95
    assert made.revisit_error < 0.1 and isinstance(made.judgement.is_trusted, bool)


def test_mapping_refuses(log_path):
    log = docent.read_laser_log(log_path)
    for bad in [{"way": numpy.nan}, {"turn": -1.0}, {"params": docent.ScanMapperParams(resolution=0.0)}]:
        with pytest.raises(ValueError):
            docent.map_log(log, **bad)

    def stop(stage, done, of):
        raise RuntimeError("enough")
    with pytest.raises(RuntimeError, match="enough"):
        docent.map_log(log, progress=stop)
