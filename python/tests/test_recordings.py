import os
import struct

import numpy
import pytest

import docent
from sample_messages import SCHEMA, mcap, sample

CHANNELS = [("/sample", "sample/msg/Sample", SCHEMA), ("/number", "std_msgs/msg/Int32", "int32 data\n")]


def number(value):
    return b"\x00\x01\x00\x00" + struct.pack("<i", value)


def reader(tmp_path, channels, messages):
    path = tmp_path / "sample.mcap"
    path.write_bytes(mcap(channels, messages))
    return docent.McapReader.open(path)


@pytest.fixture
def recording(tmp_path):
    return reader(tmp_path, CHANNELS, [(1, 10, number(1)), (0, 20, sample()), (1, 30, number(3)), (1, 40, number(4))])


def decoded(tmp_path, schema, data):
    (message,) = reader(tmp_path, [("/sample", "sample/msg/Sample", schema)], [(0, 1, data)]).messages()
    return message.decode()


def test_topics_and_types(recording):
    assert recording.types_by_topic() == {"/sample": "sample/msg/Sample", "/number": "std_msgs/msg/Int32"}
    assert recording.profile() == "ros2" and recording.message_count() is None and recording.counts_by_topic() == {}
    assert recording.damage() == [] and isinstance(recording.is_complete(), bool)


def test_messages(recording):
    messages = recording.messages(topics={"/number"})
    assert [message.decode().data for message in messages] == [1, 3, 4]
    assert [message.log_time.nanoseconds for message in messages] == [10, 30, 40]
    assert messages[0].data == number(1) and messages[0].type == "std_msgs/msg/Int32"
    between = recording.messages(from_=docent.Time(20), to=docent.Time(30))
    assert [message.topic for message in between] == ["/sample", "/number"]


def test_every_kind_of_field(recording):
    message = recording.messages(topics={"/sample"})[0].decode()
    assert message.name == "robin" and message.kind == 200 and message.large == -(2**60)
    assert message.flags.dtype == bool and message.flags.tolist() == [True, False, True]
    assert [(corner.x, corner.y) for corner in message.corners] == [(1.5, -2.0), (0.25, 8.0)]
    assert message.ranges.dtype == numpy.float64 and message.ranges.tolist() == [1.0, 2.5]
    assert (message.stamp.sec, message.stamp.nanosec) == (-7, 999)
    assert not hasattr(message, "KIND")


def test_empty_sequences(tmp_path):
    message = decoded(tmp_path, SCHEMA, sample(ranges=(), flags=()))
    assert len(message.ranges) == 0 and message.kind == 200


def test_cut_messages(tmp_path):
    whole = sample()
    for size in range(len(whole)):
        with pytest.raises(docent.Error):
            decoded(tmp_path, SCHEMA, whole[:size])


@pytest.mark.parametrize("schema, said", [
    ("sample/Sample again\n", "nests too deeply"),
    ("Other other\n", "not described"),
    ("int32\n", "no field"),
    ("int32[x] field\n", "no type"),
    ("int32[3 field\n", "no type"),
    ("int32[ field\n", "no type"),
    ("int32[3]] field\n", "no type"),
    ("Nothing[4000000000] field\n====\nMSG: sample/Nothing\n", "more values"),
    ("float64[4000000000] field\n", "ends early"),
    ("string[] field\n", "ends early"),
    ("uint8[] field\n", "ends early"),
])
def test_hostile_types(tmp_path, schema, said):
    with pytest.raises(docent.Error, match=said):
        decoded(tmp_path, schema, b"\x00\x01\x00\x00" + b"\xff" * 8)


def test_other_encodings(tmp_path):
    with pytest.raises(docent.Error, match="little endian"):
        decoded(tmp_path, "int32 data\n", b"\x00\x00\x00\x00\x00\x00\x00\x01")
    path = tmp_path / "other.mcap"
    path.write_bytes(mcap([("/number", "Number", "int32 data")], [(0, 1, b"{}")]).replace(b"ros2msg", b"protobf"))
    message = docent.McapReader.open(path).messages()[0]
    assert message.data == b"{}"
    with pytest.raises(docent.Error, match="/number: .*protobf.*not decoded"):
        message.decode()


def test_a_handler_ends_the_reading(recording):
    seen = []
    recording.read(lambda message: seen.append(message.topic) or len(seen) < 2)
    assert seen == ["/number", "/sample"]

    def fails(message):
        raise KeyError("mine")
    with pytest.raises(KeyError, match="mine"):
        recording.read(fails)
    assert len(recording.messages()) == 4

    def reads_again(message):
        recording.messages()
    with pytest.raises(docent.Error, match="is being read already"):
        recording.read(reads_again)


def test_handlers(recording):
    for handler in [None, "handler", 1]:
        with pytest.raises(TypeError):
            recording.read(handler)
    for answer in ["yes", [], numpy.zeros(2)]:
        with pytest.raises(TypeError, match=f"handler: True or False .*not {type(answer).__name__}"):
            recording.read(lambda message: answer)
    for answer in [None, False, 0, numpy.bool_(False)]:
        seen = []
        recording.read(lambda message: seen.append(message) or answer)
        assert len(seen) == 1
    seen = []
    recording.read(lambda message: seen.append(message) or numpy.bool_(True))
    assert len(seen) == 4


def test_texts_that_are_not_utf_8(tmp_path):
    damaged = reader(tmp_path, [(b"/a\xff", b"b\xff/C", b"int32 \xff\nstring \xc3\x9c\n")],
                     [(0, 1, number(7) + struct.pack("<I", 3) + b"d\xff\0")])
    assert damaged.types_by_topic() == {"/a\ufffd": "b\ufffd/C"}
    (message,) = damaged.messages()
    assert (message.topic, message.type) == ("/a\ufffd", "b\ufffd/C")
    assert vars(message.decode()) == {"\ufffd": 7, "\u00dc": "d\ufffd"}
    with pytest.raises(docent.Error) as raised:
        decoded(tmp_path, b"f\xff field\n", number(7))
    assert "'f\ufffd' is not described" in str(raised.value)


def test_a_summary_that_is_not_utf_8(tmp_path):
    def record(opcode, content):
        return bytes([opcode]) + struct.pack("<Q", len(content)) + content
    magic = b"\x89MCAP0\r\n"
    channels = b"".join(record(0x04, struct.pack("<HHI", i, 0, len(topic)) + topic + struct.pack("<I", 3) + b"cdr" +
                               struct.pack("<I", 0)) for i, topic in enumerate([b"/a\xff", b"/b"]))
    message = record(0x05, struct.pack("<HIQQ", 0, 0, 1, 1))
    chunk = record(0x06, struct.pack("<QQQIIQ", 1, 1, len(channels + message), 0, 0, len(channels + message)) + channels + message)
    begin = magic + record(0x01, struct.pack("<I", 2) + b"p\xff" + struct.pack("<I", 0))
    data = begin + chunk + record(0x0F, struct.pack("<I", 0))
    index = record(0x08, struct.pack("<QQQQIQIQQ", 1, 1, len(begin), len(chunk), 0, 0, 0, len(chunk), len(chunk)))
    counts = struct.pack("<HQHQ", 0, 5, 1, 6)
    statistics = record(0x0B, struct.pack("<QHIIIIQQI", 11, 0, 2, 0, 0, 1, 1, 1, len(counts)) + counts)
    summary = channels + index + statistics
    path = tmp_path / "summary.mcap"
    path.write_bytes(data + summary + record(0x02, struct.pack("<QQI", len(data), 0, 0)) + magic)
    recording = docent.McapReader.open(path)
    assert recording.profile() == "p\ufffd" and recording.message_count() == 11
    assert recording.counts_by_topic() == {"/a\ufffd": 5, "/b": 6}


def test_paths_that_are_not_utf_8(tmp_path):
    path = tmp_path / "a\udcff.mcap"
    path.write_bytes(b"nothing")
    with pytest.raises(docent.Error) as raised:
        docent.McapReader.open(path)
    assert raised.value.file == str(path) and os.path.exists(raised.value.file)
    assert "a\ufffd.mcap: is not an MCAP file" in str(raised.value)
    with pytest.raises(docent.Error, match="none\ufffd"):
        docent.load_map(tmp_path / "none\udcff.yaml")


def test_what_is_no_recording(tmp_path):
    for content in [b"", b"nothing", b"\x89MCAP0\r\n"[:5]]:
        path = tmp_path / "bad.mcap"
        path.write_bytes(content)
        with pytest.raises(docent.Error) as raised:
            docent.McapReader.open(path)
        assert raised.value.file == str(path)
    with pytest.raises(docent.Error, match="none.mcap"):
        docent.McapReader.open(tmp_path / "none.mcap")


def test_a_recording_that_ends_early(tmp_path):
    whole = mcap(CHANNELS, [(1, 10, number(1)), (1, 20, number(2))])
    path = tmp_path / "cut.mcap"
    for size in range(len(whole) - 60, len(whole), 7):
        path.write_bytes(whole[:size])
        assert docent.McapReader.open(path).messages(skip_damaged=True)[0].decode().data == 1
