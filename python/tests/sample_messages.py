"""Writes small MCAP files: what a test reads is then known to the byte."""
import struct


def _text(text):
    return struct.pack("<I", len(text)) + text.encode()


def _record(opcode, content):
    return bytes([opcode]) + struct.pack("<Q", len(content)) + content


def mcap(channels, messages):
    """channels: (topic, type, schema). messages: (index of the channel, nanoseconds, CDR). No chunks, no summary."""
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


def sample(ranges=(1.0, 2.5), flags=(True, False, True)):
    """A message of SCHEMA as CDR, laid out by hand: alignment counts from behind the header."""
    body = bytearray()

    def put(code, *values):
        size = struct.calcsize("<" + code[-1])
        while len(body) % size:
            body.append(0)
        body.extend(struct.pack("<" + code, *values))
    put("I", 6)
    body.extend(b"robin\0")
    put("I", len(flags))
    for flag in flags:
        put("?", flag)
    put("f", 1.5), put("f", -2.0), put("f", 0.25), put("f", 8.0)
    put("I", len(ranges))
    for value in ranges:
        put("d", value)
    put("B", 200)
    put("i", -7)
    put("I", 999)
    put("q", -(2**60))
    return b"\x00\x01\x00\x00" + bytes(body)
