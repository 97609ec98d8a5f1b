"""Writes small MCAP files: what a test reads is then known to the byte."""
import struct


def _text(text):
    raw = text if isinstance(text, bytes) else text.encode()
    return struct.pack("<I", len(raw)) + raw


def _record(opcode, content):
    return bytes([opcode]) + struct.pack("<Q", len(content)) + content


def mcap(channels, messages):
    """channels: (topic, type, schema), texts or bytes. messages: (index of the channel, nanoseconds, CDR). No chunks, no summary."""
    parts = [b"\x89MCAP0\r\n", _record(0x01, _text("ros2") + _text("docent's tests"))]
    for i, (topic, kind, schema) in enumerate(channels):
        parts.append(_record(0x03, struct.pack("<H", i + 1) + _text(kind) + _text("ros2msg") + _text(schema)))
        parts.append(_record(0x04, struct.pack("<HH", i, i + 1) + _text(topic) + _text("cdr") + struct.pack("<I", 0)))
    for number, (channel, time, data) in enumerate(messages):
        parts.append(_record(0x05, struct.pack("<HIQQ", channel, number, time, time) + data))
    parts.append(_record(0x0F, struct.pack("<I", 0)))
    parts.append(_record(0x02, struct.pack("<QQI", 0, 0, 0)))
    return b"".join(parts) + b"\x89MCAP0\r\n"


SCHEMA = """# a comment
uint8 KIND=3            # a constant
string<=20 name "unknown"
bool[] flags
geometry/Point[2] corners
float64[] ranges
uint8 kind
Stamp stamp
int64 large
================================================================================
MSG: geometry/Point
float32 x
float32 y
================================================================================
MSG: sample/Stamp
int32 sec
uint32 nanosec
"""


class Cdr:
    """Puts values one after the other; alignment counts from behind the header."""

    def __init__(self):
        self.body = bytearray()

    def put(self, code, *values):
        for value in values:
            while len(self.body) % struct.calcsize(code):
                self.body.append(0)
            self.body.extend(struct.pack("<" + code, value))

    def text(self, text):
        self.put("I", len(text) + 1)
        self.body.extend(text.encode() + b"\0")

    def bytes(self):
        return b"\x00\x01\x00\x00" + bytes(self.body)


LASER_SCAN = """std_msgs/Header header
float32 angle_min
float32 angle_max
float32 angle_increment
float32 time_increment
float32 scan_time
float32 range_min
float32 range_max
float32[] ranges
float32[] intensities
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""


def laser_scan(sec, ranges):
    """A sensor_msgs/LaserScan over 90 degrees."""
    cdr = Cdr()
    cdr.put("i", sec), cdr.put("I", 0), cdr.text("laser")
    cdr.put("f", -0.75, 0.75, 1.5 / (len(ranges) - 1), 0.0, 0.0, 0.1, 8.0)
    cdr.put("I", len(ranges)), cdr.put("f", *ranges), cdr.put("I", 0)
    return cdr.bytes()


def sample(ranges=(1.0, 2.5), flags=(True, False, True)):
    """A message of SCHEMA."""
    cdr = Cdr()
    put = cdr.put
    cdr.text("robin")
    put("I", len(flags))
    for flag in flags:
        put("?", flag)
    put("f", 1.5, -2.0, 0.25, 8.0)
    put("I", len(ranges))
    for value in ranges:
        put("d", value)
    put("B", 200)
    put("i", -7)
    put("I", 999)
    put("q", -(2**60))
    return cdr.bytes()
