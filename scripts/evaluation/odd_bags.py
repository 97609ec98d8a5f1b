"""Encoders of recordings for odd_recordings: messages as CDR and as ROS 1 wrote them; rosbag2's databases, MCAP and bags of ROS 1.

A message is (topic, type, time [ns] of the file, content); contents are Scan, Odometry, Transforms or bytes. Written from the documents of the formats.
"""
import bz2
import ctypes
import sqlite3
import struct
import zlib
from collections import namedtuple

Scan = namedtuple("Scan", "stamp frame first step ranges least most")
Odometry = namedtuple("Odometry", "stamp parent child pose speed quaternion", defaults=[None])
Transforms = namedtuple("Transforms", "links")  # of (stamp, parent, child, (x, y, z), (x, y, z, w))

TYPES = {Scan: ("sensor_msgs/msg/LaserScan", "sensor_msgs/LaserScan"), Odometry: ("nav_msgs/msg/Odometry", "nav_msgs/Odometry"),
         Transforms: ("tf2_msgs/msg/TFMessage", "tf2_msgs/TFMessage"), bytes: ("std_msgs/msg/String", "std_msgs/String")}


class Writer:
    """CDR: aligned, texts that end in 0. Of ROS 1: packed, and a number before a header's stamp."""

    def __init__(self, is_cdr, order="<"):
        self.bytes, self.is_cdr, self.order, self.number = bytearray(), is_cdr, order, 0

    def put(self, kind, *values):
        if self.is_cdr:
            self.bytes += bytes(-len(self.bytes) % struct.calcsize(kind))
        self.bytes += struct.pack(f"{self.order}{len(values)}{kind}", *values)
        return self

    def text(self, text):
        data = text.encode() + (b"\0" if self.is_cdr else b"")
        self.put("I", len(data))
        self.bytes += data
        return self

    def head(self, stamp, frame):
        if not self.is_cdr:
            self.put("I", 7)
        return self.put("i" if self.is_cdr else "I", stamp // 10**9).put("I", stamp % 10**9).text(frame)

    def floats(self, values):
        self.put("I", len(values))
        return self.put("f", *values) if values else self

    def done(self):
        return (b"\0\1\0\0" if self.order == "<" else b"\0\0\0\0") + bytes(self.bytes) if self.is_cdr else bytes(self.bytes)


def encoded(content, is_cdr=True, order="<"):
    to = Writer(is_cdr, order)
    if isinstance(content, bytes):
        return to.text("odd").done()
    if isinstance(content, Scan):
        last = content.first + content.step * (len(content.ranges) - 1)
        to.head(content.stamp, content.frame).put("f", content.first, last, content.step, 0.0, 0.1, content.least, content.most)
        return to.floats(content.ranges).floats([]).done()
    if isinstance(content, Odometry):
        x, y, quaternion = content.pose[0], content.pose[1], content.quaternion or about_z(content.pose[2])
        to.head(content.stamp, content.parent).text(content.child).put("d", x, y, 0.0, *quaternion, *[0.0] * 36)
        return to.put("d", content.speed[0], 0.0, 0.0, 0.0, 0.0, content.speed[1], *[0.0] * 36).done()
    to.put("I", len(content.links))
    for stamp, parent, child, place, quaternion in content.links:
        to.head(stamp, parent).text(child).put("d", *place, *quaternion)
    return to.done()


def about_z(angle):
    import math
    return 0.0, 0.0, math.sin(angle / 2), math.cos(angle / 2)


# ---- packing; by the libraries that ROS itself uses

ZSTD, LZ4 = ctypes.CDLL("libzstd.so.1"), ctypes.CDLL("liblz4.so.1")
for name in ("ZSTD_compressBound", "ZSTD_compress"):
    getattr(ZSTD, name).restype = ctypes.c_size_t
for name in ("LZ4F_compressFrameBound", "LZ4F_compressFrame"):
    getattr(LZ4, name).restype = ctypes.c_size_t


def zstd(data):
    room = ctypes.create_string_buffer(ZSTD.ZSTD_compressBound(ctypes.c_size_t(len(data))))
    size = ZSTD.ZSTD_compress(room, ctypes.c_size_t(len(room)), data, ctypes.c_size_t(len(data)), 1)
    return room.raw[:size]


def lz4(data):
    room = ctypes.create_string_buffer(LZ4.LZ4F_compressFrameBound(ctypes.c_size_t(len(data)), None))
    size = LZ4.LZ4F_compressFrame(room, ctypes.c_size_t(len(room)), data, ctypes.c_size_t(len(data)), None)
    return room.raw[:size]


PACKED = {"": lambda d: d, "none": lambda d: d, "zstd": zstd, "lz4": lz4, "bz2": bz2.compress}


# ---- containers

def database(path, messages, pack=lambda d: d):
    """rosbag2's SQLite file."""
    with sqlite3.connect(path) as db:
        db.execute("PRAGMA synchronous=OFF")
        db.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL, "
                   "offered_qos_profiles TEXT NOT NULL)")
        db.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL)")
        ids = {}
        for topic, kind, time, content in messages:
            if topic not in ids:
                ids[topic] = len(ids) + 1
                db.execute("INSERT INTO topics VALUES(?, ?, ?, 'cdr', '')", (ids[topic], topic, kind))
        db.executemany("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)",
                       [(ids[m[0]], m[2], pack(data_of(m[3]))) for m in messages])
    db.close()


def data_of(content):
    return content[1] if isinstance(content, tuple) and content[0] == "raw" else encoded(content)


def mcap(path, messages, packing="", chunks=3, encoding="cdr", pack=lambda d: d, whole_chunks=False):
    """One file; without chunks where `chunks` is 0. whole_chunks: each says its channels anew, else the first that has a message of one."""
    def record(op, body):
        return bytes([op]) + struct.pack("<Q", len(body)) + body

    def text(s):
        return struct.pack("<I", len(s)) + s.encode()
    ids, pieces, size = {}, [], max(1, -(-len(messages) // max(1, chunks)))
    for begin in range(0, max(1, len(messages)), size):
        piece, said = b"", set() if whole_chunks else set(ids)
        for topic, kind, time, content in messages[begin:begin + size]:
            if topic not in said:
                said.add(topic)
                ids.setdefault(topic, len(ids) + 1)
                piece += record(3, struct.pack("<H", ids[topic]) + text(kind) + text("ros2msg") + struct.pack("<I", 0))
                piece += record(4, struct.pack("<HH", ids[topic], ids[topic]) + text(topic) + text(encoding) + struct.pack("<I", 0))
            data = encoded(content, False) if encoding == "ros1" else data_of(content)
            piece += record(5, struct.pack("<HIQQ", ids[topic], 0, time, time) + pack(data))
        times = [m[2] for m in messages[begin:begin + size]] or [0]
        packed = PACKED[packing](piece)
        pieces.append(record(6, struct.pack("<QQQI", min(times), max(times), len(piece), zlib.crc32(piece)) + text(packing) +
                             struct.pack("<Q", len(packed)) + packed) if chunks else piece)
    end = record(15, struct.pack("<I", 0)) + record(2, struct.pack("<QQI", 0, 0, 0)) + b"\x89MCAP0\r\n"
    path.write_bytes(b"\x89MCAP0\r\n" + record(1, text("ros2") + text("odd")) + b"".join(pieces) + end)


def ros1_bag(path, messages, packing="none", chunks=3, index=True, terminal=True, shuffle=None, encryptor=""):
    """Version 2.0. shuffle: of a header's fields. Without `index` as a recorder leaves it that was killed."""
    def record(fields, data):
        fields = list(fields)
        if shuffle:
            shuffle(fields)
        head = b"".join(struct.pack("<I", len(n) + 1 + len(v)) + n.encode() + b"=" + v for n, v in fields)
        return struct.pack("<I", len(head)) + head + struct.pack("<I", len(data)) + data

    def connection(topic, kind):
        about = [("topic", topic.encode()), ("type", kind.encode()), ("md5sum", b"0" * 32), ("message_definition", b"float32 x\n# =\n"), ("callerid", b"/odd")]
        data = b"".join(struct.pack("<I", len(n) + 1 + len(v)) + n.encode() + b"=" + v for n, v in about)
        return record([("op", b"\7"), ("conn", struct.pack("<I", ids[topic])), ("topic", topic.encode())], data)
    ids, pieces, infos, known, size = {}, [], [], {}, max(1, -(-len(messages) // max(1, chunks)))
    stamp = lambda t: struct.pack("<II", t // 10**9, t % 10**9)  # noqa: E731
    for begin in range(0, len(messages), size):
        piece, entries = b"", {}
        for topic, kind, time, content in messages[begin:begin + size]:
            if topic not in ids:
                ids[topic], known[topic] = len(ids), kind
                piece += connection(topic, kind)
            entries.setdefault(topic, []).append((time, len(piece)))
            piece += record([("op", b"\2"), ("conn", struct.pack("<I", ids[topic])), ("time", stamp(time))], encoded(content, False))
        if not chunks:
            pieces.append(piece)
            continue
        pieces.append(record([("op", b"\5"), ("compression", packing.encode()), ("size", struct.pack("<I", len(piece)))], PACKED[packing](piece)))
        for topic, all_of in entries.items():
            data = b"".join(stamp(t) + struct.pack("<I", at) for t, at in all_of)
            pieces.append(record([("op", b"\4"), ("ver", struct.pack("<I", 1)), ("conn", struct.pack("<I", ids[topic])), ("count", struct.pack("<I", len(all_of)))], data))
        infos.append(record([("op", b"\6"), ("ver", struct.pack("<I", 1)), ("chunk_pos", bytes(8)), ("start_time", bytes(8)), ("end_time", bytes(8)),
                             ("count", struct.pack("<I", len(entries)))], b"".join(struct.pack("<II", ids[t], len(e)) for t, e in entries.items())))
    body = b"".join(pieces)
    end = (b"".join(connection(t, k) for t, k in known.items()) if terminal else b"") + b"".join(infos) if index else b""
    head = [("op", b"\3"), ("index_pos", struct.pack("<Q", 4117 + len(body) if index else 0)), ("conn_count", struct.pack("<I", len(ids))),
            ("chunk_count", struct.pack("<I", len(infos)))] + ([("encryptor", encryptor.encode())] if encryptor else [])
    begin = record(head, b"")
    begin = begin[:-4] + struct.pack("<I", 4096 - len(begin)) + b" " * (4096 - len(begin))
    path.write_bytes(b"#ROSBAG V2.0\n" + begin + body + end)
