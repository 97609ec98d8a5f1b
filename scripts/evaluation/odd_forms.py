"""Recordings in every container that ROS has, whole and not: for odd_recordings, whose cases these are."""
import math

from .odd_bags import Odometry, Scan, Transforms, TYPES, database, encoded, mcap, ros1_bag, zstd
from .odd_drive import FIRST, Drive, Scanner, recorded

STRING = "std_msgs/msg/String"


def one(rng, **more):
    """(drive, scanner, messages) of one robot with one scanner."""
    drive, scanner = Drive(rng), Scanner(rng)
    return drive, scanner, recorded(drive, [scanner], rng, **more)


def written(folder, rng, messages, form=None):
    """The path of a recording in some container."""
    form = form or rng.choice(["db3", "db3 folder", "mcap", "mcap lz4", "mcap zstd", "bag", "bag bz2", "bag lz4"])
    if form.startswith("bag"):
        path = folder / "odd.bag"
        ros1_bag(path, as_ros1(messages), form[4:] or "none", rng.choice([1, 3]))
        return path
    if form.startswith("db3"):
        inside = folder / "bag" if form == "db3 folder" else folder
        inside.mkdir(exist_ok=True)
        database(inside / "bag_0.db3", messages)
        return inside if form == "db3 folder" else inside / "bag_0.db3"
    path = folder / "odd.mcap"
    mcap(path, messages, form[5:], rng.choice([0, 1, 3]) if form == "mcap" else rng.choice([1, 3]))
    return path


def as_ros1(messages):
    return [(t, TYPES[type(c)][1], time, c) for t, _, time, c in messages]


def case_of(path, robots, **more):
    return {"what": "log", "path": str(path), "robots": robots, **more}


def plain(folder, rng):
    drive, _, messages = one(rng)
    messages += [("/chatter", STRING, FIRST + 10**9, b"")]
    return case_of(written(folder, rng, sorted(messages, key=lambda m: m[2])), [drive])


def metadata(folder, names, mode=""):
    listed = "".join(f"    - {n}\n" for n in names)
    (folder / "metadata.yaml").write_text(
        "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n  duration:\n    nanoseconds: 5\n  relative_file_paths:\n" + listed +
        f"  compression_format: \"{'zstd' if mode else ''}\"\n  compression_mode: \"{mode}\"\n")


def zstd_by_file(folder, rng):
    drive, _, messages = one(rng)
    kind, parts = rng.choice(["db3", "mcap"]), rng.choice([1, 2])
    names = split(folder, messages, kind, parts)
    packed = []
    for name in names:
        file = folder / name
        (folder / (name + ".zstd")).write_bytes(zstd(file.read_bytes()))
        packed.append(name + ".zstd")
        if rng.random() < 0.8:
            file.unlink()
    if rng.random() < 0.7:
        metadata(folder, packed, "FILE")
    return case_of(folder if parts > 1 or rng.random() < 0.7 else folder / packed[0], [drive])


def zstd_by_message(folder, rng):
    drive, _, messages = one(rng)
    kind = rng.choice(["db3", "mcap"])
    if kind == "db3":
        database(folder / "bag_0.db3", messages, zstd)
    else:
        mcap(folder / "bag_0.mcap", messages, pack=zstd)
    if rng.random() < 0.7:
        metadata(folder, [f"bag_0.{kind}"], "MESSAGE")
    return case_of(folder if rng.random() < 0.7 else folder / f"bag_0.{kind}", [drive])


def split(folder, messages, kind, parts, first=0):
    size, names = -(-len(messages) // parts), []
    for k in range(parts):
        names.append(f"bag_{k + first}.{kind}")
        piece = messages[k * size:(k + 1) * size]
        database(folder / names[-1], piece) if kind == "db3" else mcap(folder / names[-1], piece, "", 1)
    return names


def split_parts(folder, rng):
    drive, _, messages = one(rng)
    names = split(folder, messages, rng.choice(["db3", "mcap"]), rng.choice([2, 4]), rng.choice([0, 8]))
    odd = rng.choice(["", "none", "wrong order", "other folder", "missing", "broken", "half"])
    more = {}
    if odd == "wrong order":
        metadata(folder, names[::-1])
    elif odd == "missing":
        metadata(folder, [*names, "bag_77.db3"])
        more["say"] = "not there"
    elif odd == "broken":
        (folder / "metadata.yaml").write_text(rng.choice(["", "{", "rosbag2_bagfile_information: 5\n", "- a\n"]))
        more["say"] = "metadata"
    elif odd == "half":
        metadata(folder, names[:1])
        more["say"] = "not named"
    elif odd != "none":
        metadata(folder, [f"other/{n}" if odd else n for n in names])
    return case_of(folder, [drive], **more)


def torn(folder, rng):
    """The last part, or the only file, ends early or is empty."""
    drive, _, messages = one(rng)
    form = rng.choice(["split", "split", "mcap", "bag"])
    if form == "split":
        names = split(folder, messages, rng.choice(["db3", "mcap"]), 3)
        last = folder / names[-1]
        data = last.read_bytes()
        last.write_bytes(data[:rng.choice([0, 0, 1, 40, len(data) // 2, len(data) - 30])])
        if rng.random() < 0.5:
            metadata(folder, names)
        return case_of(folder, [drive], loses=True, excuse=f"{names[-1]}|bag_2")
    path = written(folder, rng, messages, {"mcap": rng.choice(["mcap lz4", "mcap zstd"]), "bag": rng.choice(["bag", "bag bz2", "bag lz4"])}[form])
    data = path.read_bytes()
    path.write_bytes(data[:rng.randrange(len(data) * 2 // 3, len(data) - 40)])
    return case_of(path, [drive], loses=True, refusal="holds no|early|damaged|nothing", excuse="early|damage|broken|left out|no end|cut")


def cut(folder, rng):
    """All in one chunk or one database, cut anywhere behind its beginning: what stands before the cut is read, of what is not packed nearly all."""
    drive, _, messages = one(rng)
    form = rng.choice(["mcap", "mcap lz4", "mcap zstd", "bag", "bag bz2", "bag lz4", "db3"])
    path = folder / {"m": "odd.mcap", "b": "odd.bag", "d": "odd_0.db3"}[form[0]]
    if form == "db3":
        database(path, messages)
    elif form.startswith("bag"):
        ros1_bag(path, as_ros1(messages), form[4:] or "none", 1)
    else:
        mcap(path, messages, form[5:], 1)
    data, share = path.read_bytes(), rng.uniform(0.5, 0.97)
    path.write_bytes(data[:int(share * len(data))])
    if " " in form:  # packed in blocks, of which the first may be cut
        return case_of(path, [drive], loses=True, refusal="holds no", excuse="early")
    return case_of(path, [drive], loses=True, least=int(len(drive.truth) * (share - 0.15)), say="early")


def both_forms(folder, rng):
    """The same recording twice in one folder, as after a conversion: not twice the scans."""
    drive, _, messages = one(rng)
    database(folder / "bag_0.db3", messages)
    mcap(folder / "bag_0.mcap", messages)
    if rng.random() < 0.5:
        metadata(folder, [rng.choice(["bag_0.db3", "bag_0.mcap"])])
    return case_of(folder, [drive], say="twice|not named")


def out_of_order(folder, rng):
    """Messages that lie in the file in another order than they came, as after a merge."""
    drive, _, messages = one(rng)
    half = len(messages) // 2
    turned = messages[half:] + messages[:half]
    form = rng.choice(["mcap", "bag", "bag bz2"])
    if form == "mcap":
        mcap(folder / "odd.mcap", turned, rng.choice(["", "zstd", "lz4"]), rng.choice([0, 2, 5]), whole_chunks=rng.random() < 0.3)
        return case_of(folder / "odd.mcap", [drive])
    return case_of(written(folder, rng, turned, form), [drive])


def ros1_forms(folder, rng):
    """Bags as recorders, filters and crashes leave them."""
    drive, _, messages = one(rng)
    if rng.random() < 0.4:  # frames with a slash, as tf had them
        messages = [(t, k, time, with_slash(c)) for t, k, time, c in messages]
    said = as_ros1(messages)
    if rng.random() < 0.4:
        said = [(t, "tf/tfMessage" if k.startswith("tf2") else k, time, c) for t, k, time, c in said]
    odd = rng.choice(["unindexed", "unchunked", "no end", "order", "order", "relative", "old", "encrypted", "unknown"])
    path = folder / rng.choice(["odd.bag", "odd.bag.active", "odd.orig"])
    packing, more = rng.choice(["none", "bz2", "lz4"]), {}
    if odd == "relative":
        said = [(t.lstrip("/"), k, time, c) for t, k, time, c in said]
    ros1_bag(path, said, packing, 0 if odd == "unchunked" else rng.choice([1, 4]), odd != "unindexed", odd != "no end", rng.shuffle if odd == "order" else None,
             "rosbag/AesCbcEncryptor" if odd == "encrypted" else "")
    data = path.read_bytes()
    if odd == "old":
        path.write_bytes(data.replace(b"#ROSBAG V2.0", rng.choice([b"#ROSBAG V1.2", b"#ROSRECORD V1.2"]), 1))
        more = {"robots": None, "refusal": "2.0|ROS 1"}
    elif odd == "encrypted":
        more = {"robots": None, "refusal": "encrypt"}
    elif odd == "unknown":
        path.write_bytes(data.replace(b"compression=" + packing.encode(), b"compression=" + b"zzzz"[:len(packing)]))
        more = {"robots": None, "refusal": "compression"}
    return {**case_of(path, [drive]), **more}


def with_slash(content):
    if isinstance(content, Scan):
        return content._replace(frame="/" + content.frame)
    if isinstance(content, Odometry):
        return content._replace(parent="/" + content.parent, child="/" + content.child)
    return Transforms([(s, "/" + p, "/" + c, at, q) for s, p, c, at, q in content.links])


def encodings(folder, rng):
    """Messages that are damaged, big-endian, JSON, or of the encoding of ROS 1 in MCAP."""
    drive, _, messages = one(rng)
    odd = rng.choice(["ros1", "json", "big-endian", "cut", "cut", "nan"])
    if odd == "ros1":
        mcap(folder / "odd.mcap", as_ros1(messages), "", 2, "ros1")
        return case_of(folder / "odd.mcap", [drive])
    if odd == "json":
        mcap(folder / "odd.mcap", messages, "", 2, "json")
        return case_of(folder / "odd.mcap", None, refusal="json")
    if odd == "big-endian":
        spoiled = [(t, k, time, ("raw", encoded(c, order=">"))) for t, k, time, c in messages]
        return case_of(written(folder, rng, spoiled, rng.choice(["db3", "mcap"])), None, refusal="big-endian|damaged")
    some = [m for m in messages if m[0] == "/scan"]
    hit = rng.sample(some, 3)
    if odd == "cut":
        messages = [(t, k, time, ("raw", encoded(c)[:rng.randrange(60)])) if (t, k, time, c) in hit else (t, k, time, c) for t, k, time, c in messages]
    else:
        messages = [(t, k, time, c._replace(first=math.nan)) if (t, k, time, c) in hit else (t, k, time, c) for t, k, time, c in messages]
    return case_of(written(folder, rng, messages, rng.choice(["db3", "mcap"])), [drive], loses=True, say="left out|damaged")


KINDS = {"containers": plain, "packed by file": zstd_by_file, "packed by message": zstd_by_message, "split": split_parts, "torn": torn,
         "cut in its only chunk": cut,
         "twice in a folder": both_forms, "out of order": out_of_order, "bags of ROS 1": ros1_forms, "encodings": encodings}
