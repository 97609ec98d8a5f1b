"""Recordings of other robots, by what rosbag2, MCAP, rosbag and tf allow. Each case knows from how it was made what a reader must find (odd_drive).

A case: `what` "log", `path`; `robots`: the drives of which one must come out; None: there is no right value. `refusal`, `say` as in odd_maps;
`excuse`: what the notes must say where the value is another one. The rest: what `fault_of` allows.
"""
import math

from .odd_bags import Odometry, Scan, Transforms, TYPES, about_z, database, encoded, mcap, ros1_bag, zstd
from .odd_drive import FIRST, Drive, Scanner, kinds, quaternion_of, recorded, turn_about

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


# ---- containers

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
        mcap(folder / "odd.mcap", turned, "", rng.choice([0, 2]))
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


# ---- robots and topics

def two(rng):
    return Drive(rng, 7), Drive(rng, rng.choice([7, 8])), Scanner(rng), Scanner(rng)


def two_robots(folder, rng):
    """By name spaces; tf of each, or one for both with prefixed frames."""
    a, b, one_scanner, other = two(rng)
    names = rng.choice([("/robot1", "/robot2"), ("/tb3_0", "/tb3_1"), ("/fleet/a", "/fleet/b"), ("", "/robot2")])
    prefixed = rng.random() < 0.5 and names[0]
    messages = []
    for drive, scanner, name in [(a, one_scanner, names[0]), (b, other, names[1])]:
        prefix = name[1:] + "/" if prefixed else ""
        scanner.frame = prefix + "laser"
        messages += recorded(drive, [scanner], rng, (name + "/scan",), name + "/odom", prefix + "odom", prefix + "base_link", "/tf_static" if prefixed else name + "/tf_static")
    more, chosen = {}, rng.random() < 0.4
    if chosen:
        more = {"robot": 1, "ask": {"robot": names[1]}}
    return case_of(written(folder, rng, sorted(messages, key=lambda m: m[2])), [a, b], **({} if chosen else {"say": "several robots"}), **more)


def two_by_frames(folder, rng):
    """Two robots in one /tf, told apart by their frames; odometry in topics or in tf alone."""
    a, b, one_scanner, other = two(rng)
    names, by_tf = rng.choice([("robot1", "robot2"), ("tb3_0", "tb3_1")]), rng.random() < 0.6
    messages = []
    for drive, scanner, name, topic in [(a, one_scanner, names[0], rng.choice(["/scan1", "/robot1/scan"])), (b, other, names[1], rng.choice(["/scan2", "/robot2/scan"]))]:
        scanner.frame = name + "/laser"
        messages += recorded(drive, [scanner], rng, (topic,), None if by_tf else f"/odom_{name}", name + "/odom", name + "/base_link", tf_odometry="/tf" if by_tf else False)
    return case_of(written(folder, rng, sorted(messages, key=lambda m: m[2])), [a, b], say="several robots|left out")


def second_odometry(messages, drive, rng, topic, parent="odom", child="base_link", rate=20.0, spoil=(0.9, 1.07), offset=(3.0, -2.0, 0.7)):
    """Of another source: by other lengths and turns, so that its use shows."""
    more = []
    for t, k, time, c in messages:
        if isinstance(c, Odometry) and (rate >= 20 or rng.random() < rate / 20):
            x, y, h = c.pose
            for again in range(2 if rate > 20 else 1):
                more.append((topic, k, time + 10**6 * (again + 1), c._replace(parent=parent, child=child, stamp=c.stamp + 10**6 * again,
                             pose=(offset[0] + x * spoil[0] + 0.3 * y, offset[1] + y * spoil[0], offset[2] + h * spoil[1]))))
    return sorted(messages + more, key=lambda m: m[2])


def two_odometries(folder, rng):
    drive, _, messages = one(rng, odometry=rng.choice(["/odom", "/wheel/odom", "/base/odometry", "/diff_drive_controller/odom"]))
    topic = rng.choice(["/odometry/filtered", "/visual_odom", "/rtabmap/odom", "/odom_rf2o", "/ekf/odom", "/amcl_odom", "/gps/odom", "/icp_odom", "/camera/odom/sample",
                        "/kiss/odometry", "/lio_sam/mapping/odometry", "/zed/odom", "/vio/odometry", "/aft_mapped_to_init", "/orb_slam3/odom"])
    return case_of(written(folder, rng, second_odometry(messages, drive, rng, topic, rate=rng.choice([10, 20, 40]))), [drive], say=topic)


def truth_topics(folder, rng):
    drive, _, messages = one(rng)
    topic = rng.choice(["/ground_truth/odom", "/base_pose_ground_truth", "/odom_gt", "/gt/odom", "/truth/pose", "/gazebo/odom", "/p3d/odom", "/vicon/robot", "/mocap/odom", "/sim/odom",
                        "/qualisys/robot/odom", "/vrpn_client_node/robot/odom", "/groundtruth_odom", "/perfect_odom", "/map_odom", "/pose_odom"])
    parent = "map" if topic in ("/map_odom", "/pose_odom") or rng.random() < 0.3 else rng.choice(["odom", "world"])
    return case_of(written(folder, rng, second_odometry(messages, drive, rng, topic, parent, rate=rng.choice([20, 40]))), [drive], say=topic)


def asked(folder, rng):
    """What somebody chooses is taken, and what is not there is refused."""
    drive, scanner, messages = one(rng)
    messages = second_odometry(messages, drive, rng, "/other/odom", rate=40)
    if rng.random() < 0.3:
        return case_of(written(folder, rng, messages), None, ask=rng.choice([{"odometry": "/nothing"}, {"scans": ["/nothing"]}, {"robot": "/nobody"}]), refusal="nothing|nobody")
    return case_of(written(folder, rng, messages), [drive], ask={"odometry": "/odom", **({"scans": ["/scan"]} if rng.random() < 0.5 else {})})


def scan_topics(folder, rng):
    """Raw scans beside what was made of them; a scanner whose place nobody says; two scanners."""
    odd = rng.choice(["made", "made", "camera", "two"])
    if odd == "two":
        drive = Drive(rng)
        scanners = [Scanner(rng, "front_laser"), Scanner(rng, "rear_laser")]
        messages = recorded(drive, scanners, rng, ("/front/scan", "/rear/scan"))
        return case_of(written(folder, rng, messages), [drive])
    drive, scanner, messages = one(rng)
    topic = rng.choice(["/scan_filtered", "/scan/throttled", "/scan_merged", "/filter/scan", "/scan_downsampled", "/safety_scan"]) if odd == "made" else "/camera/scan"
    more = []
    for t, k, time, c in messages:
        if isinstance(c, Scan):
            ranges = [r * 0.5 for r in c.ranges]
            more.append((topic, k, time + 10**6, c._replace(ranges=ranges, frame=c.frame if odd == "made" else "camera_depth_frame")))
    return case_of(written(folder, rng, sorted(messages + more, key=lambda m: m[2])), [drive], say=topic)


# ---- tf

def tf_only(folder, rng):
    base = rng.choice(["base_link", "base_footprint", "base", "chassis", "robot1/base_link", "base_frame"])
    parent = "robot1/odom" if "/" in base else rng.choice(["odom", "odom", "odom_combined", "odom_frame"])
    space = rng.choice(["", "", "/robot1"])
    drive, _, messages = one(rng, odometry=None, tf_odometry=space + "/tf", parent=parent, base=base, tf=rng.choice([space + "/tf_static", "/tf_static"]), topics=(space + "/scan",))
    if rng.random() < 0.5:  # where it is in its map, as localization says
        messages += [(space + "/tf", k, time + 10**5, Transforms([(c.links[0][0], "map", parent, (1.0 + 1e-9 * (time - FIRST), 0.5, 0.0), about_z(0.3))]))
                     for t, k, time, c in messages if t == space + "/tf"][::5]
    return case_of(written(folder, rng, sorted(messages, key=lambda m: m[2])), [drive], say="transform")


def tf_spaces(folder, rng):
    """Mounts under the robot's name space, or for all, or some here and some there."""
    drive, scanner = Drive(rng), Scanner(rng)
    space, base = rng.choice(["/robot1", "/a/b"]), rng.choice(["base_link", "base_footprint"])
    messages = recorded(drive, [scanner], rng, (space + rng.choice(["/scan", "/front/scan"]),), space + "/odom", base=base, tf=None)
    links = scanner.links(base, FIRST, rng, 2)
    odd = rng.choice(["own", "all", "parted"])
    where = {"own": [space] * 3, "all": [""] * 3, "parted": rng.choice([["", space, space], [space, "", ""]])}[odd]
    messages += [(w + "/tf_static", kinds()[2], FIRST, Transforms([link])) for w, link in zip(where, links)]
    if odd != "own" and rng.random() < 0.5:  # its own /tf says where it is in its map, and nothing of mounts
        messages += [(space + "/tf", kinds()[2], time + 10**5, Transforms([(c.stamp, "map", "odom", (1.0, 0.5, 0.0), about_z(0.3))])) for t, k, time, c in messages if isinstance(c, Odometry)]
    return case_of(written(folder, rng, sorted(messages, key=lambda m: m[2])), [drive])


def tf_again(folder, rng):
    """Mounts said again and again in /tf, beside /tf_static or alone."""
    drive, scanner = Drive(rng), Scanner(rng)
    with_static = rng.random() < 0.5
    messages = recorded(drive, [scanner], rng, tf="/tf_static" if with_static else None)
    links = scanner.links("base_link", FIRST, rng, rng.choice([0, 1]))
    if with_static:
        links = messages[[m[0] for m in messages].index("/tf_static")][3].links
    for time in range(FIRST, FIRST + int(drive.seconds * 1e9), 10**8):
        messages.append(("/tf", kinds()[2], time, Transforms([(time, *link[1:]) for link in links])))
    return case_of(written(folder, rng, sorted(messages, key=lambda m: m[2])), [drive])


def tf_chain(folder, rng):
    """Odometry of base_footprint, scanners on base_link, which stands elsewhere; the one frame above or below the other."""
    drive, scanner = Drive(rng), Scanner(rng)
    at, turn = (rng.uniform(-0.3, 0.3), rng.uniform(-0.2, 0.2), 0.1), rng.choice([0.0, 0.5, math.pi])
    bases = rng.choice([("base_footprint", "base_link"), ("base_link", "base_footprint"), ("base_link", "chassis_link"), ("base_footprint", "base_link")])
    messages = recorded(drive, [scanner], rng, base=bases[0], tf=None)
    rotation = turn_about(2, turn)
    # Of the scanner in the second frame: what it is in the first, taken back by the step between.
    step = [at[0], at[1]]
    x, y = scanner.place[0] - step[0], scanner.place[1] - step[1]
    c, s = math.cos(-turn), math.sin(-turn)
    place = (c * x - s * y, s * x + c * y, 0.2)
    links = [(FIRST, bases[1], "laser", place, quaternion_of(rotation.T @ scanner.turn))]
    if rng.random() < 0.5:
        links.append((FIRST, bases[0], bases[1], at, about_z(turn)))
    else:  # told the other way round: the second frame is the parent
        links.append((FIRST, bases[1], bases[0], (-(c * at[0] - s * at[1]), -(s * at[0] + c * at[1]), -0.1), about_z(-turn)))
    messages.append(("/tf_static", kinds()[2], FIRST, Transforms(links)))
    return case_of(written(folder, rng, sorted(messages, key=lambda m: m[2])), [drive])


def tf_odd(folder, rng):
    """A scanner that moves on the robot, one that is tilted, one without a place: said."""
    drive, scanner = Drive(rng), Scanner(rng, upside_down=False)
    messages = recorded(drive, [scanner], rng, tf=None)
    odd = rng.choice(["turntable", "tilted", "none"])
    place = (*scanner.place[:2], 0.3)
    if odd == "turntable":
        messages += [("/tf", kinds()[2], FIRST + k * 10**8, Transforms([(FIRST + k * 10**8, "base_link", "laser", place, about_z(scanner.place[2] + 0.05 * k))])) for k in range(70)]
    elif odd == "tilted":
        tilted = quaternion_of(scanner.turn @ turn_about(rng.choice([0, 1]), rng.choice([0.4, -0.6, 1.2])))
        messages.append(("/tf_static", kinds()[2], FIRST, Transforms([(FIRST, "base_link", "laser", place, tilted)])))
    return case_of(written(folder, rng, sorted(messages, key=lambda m: m[2])), [drive], say={"turntable": "moves", "tilted": "tilted", "none": "unknown"}[odd],
                   excuse={"turntable": "moves", "tilted": "tilted", "none": "unknown"}[odd])


def mounts(folder, rng):
    """Clockwise scanners and such that hang upside down, and both."""
    drive = Drive(rng)
    scanner = Scanner(rng, upside_down=rng.random() < 0.6, clockwise=rng.random() < 0.6)
    return case_of(written(folder, rng, recorded(drive, [scanner], rng)), [drive])


# ---- clocks

def of_clock(folder, rng, clock, form=None, **more):
    drive, _, messages = one(rng, clock=clock)
    return case_of(written(folder, rng, messages, form), [drive], **more)


def clock_simulated(folder, rng):
    """Stamps from zero on, slower or faster than the file's time."""
    pace = rng.choice([1.0, 0.3, 0.7, 2.0, 5.0])
    begin = rng.choice([0.0, 0.0, 12.5, 3600.0])
    return of_clock(folder, rng, lambda t: begin + t * pace, pace=pace, times=0.002 if begin else 1.0)


def clock_jump(folder, rng):
    """Set by more than any line is late: a computer that began in 1970, a counter that wraps, a clock that is set."""
    at, wrong = rng.uniform(1, 5), rng.choice([-1_700_000_000.0 + 5, 3600.0, -3600.0, -4294.967296, 12.0, 86400.0])
    is_first = rng.random() < 0.5

    def clock(t):
        return FIRST / 1e9 + t + (wrong if (t < at) == is_first else 0.0)
    return of_clock(folder, rng, clock, say="clock", times=0.02, way=0.03, turn=0.03)


def clock_stands(folder, rng):
    """Stamps that are all zero, or stand from some time on."""
    if rng.random() < 0.5:
        return of_clock(folder, rng, lambda t: 0.0, times=0.02, way=0.03, turn=0.03)
    at = rng.uniform(0.5, 4)
    return of_clock(folder, rng, lambda t: FIRST / 1e9 + min(t, at), say="stands", times=0.02, way=0.03, turn=0.03)


def clock_mixed(folder, rng):
    """Scans by another clock than odometry; two clocks in one topic."""
    drive, _, messages = one(rng)
    ahead = rng.choice([5, -30, 3600, -1_699_999_000]) * 10**9
    odd = rng.choice(["topics", "topics", "alternating", "close"])
    if odd == "close":
        ahead = rng.choice([2, -3, 6]) * 10**9
    mixed, k = [], 0
    for t, kind, time, c in messages:
        if isinstance(c, Scan):
            k += 1
            if odd == "topics" or rng.random() < 0.5:
                c = c._replace(stamp=c.stamp + ahead)
        mixed.append((t, kind, time, c))
    return case_of(written(folder, rng, mixed), [drive], say="clock", times=0.02, way=0.03, turn=0.03)


def clock_back(folder, rng):
    """Set back by a few seconds, as by the network."""
    at, back = rng.uniform(2, 5), rng.choice([0.5, 1.5, 4.0, 8.0])
    return of_clock(folder, rng, lambda t: FIRST / 1e9 + t - (back if t >= at else 0.0), say="clock", excuse="set back")


def file_times(folder, rng):
    """Times of the file that tell nothing: the stamps do."""
    drive, _, messages = one(rng)
    same = rng.choice([0, FIRST])
    return case_of(written(folder, rng, [(t, k, same, c) for t, k, _, c in messages], rng.choice(["mcap", "db3", "bag"])), [drive])


def by_index(folder, rng):
    """Clocks that are of no use at all: the order of the messages is asked for."""
    drive, _, messages = one(rng)
    mad = [(t, k, time, c._replace(stamp=rng.randrange(FIRST)) if not isinstance(c, Transforms) else c) for t, k, time, c in messages]
    return case_of(written(folder, rng, mad), [drive], ask={"times": "index"}, say="order", times=60.0, way=0.05, turn=0.05)


# ---- odometry and readings

def odometry_jumps(folder, rng):
    drive, _, messages = one(rng)
    at = rng.uniform(2, 5)
    kind = rng.choice(["zero", "teleport"])
    base = drive.odometry_at(at)
    moved, dx, dy = [], rng.choice([-1, 1]) * rng.uniform(2, 9), rng.uniform(2, 9)
    for t, k, time, c in messages:
        if isinstance(c, Odometry) and time - FIRST > at * 1e9:
            x, y, h = c.pose
            if kind == "zero":
                co, si = math.cos(-base[2]), math.sin(-base[2])
                c = c._replace(pose=(co * (x - base[0]) - si * (y - base[1]), si * (x - base[0]) + co * (y - base[1]), h - base[2]))
            else:
                c = c._replace(pose=(x + dx, y + dy, h))
        moved.append((t, k, time, c))
    return case_of(written(folder, rng, moved), [drive], jumps=[at, at + 0.05], say="jumped")


def odometry_useless(folder, rng):
    """Speeds without a place, a heading that was never set, none at all: said."""
    drive, _, messages = one(rng)
    odd = rng.choice(["speeds", "heading", "none"])
    if odd == "none":
        messages = [m for m in messages if not isinstance(m[3], Odometry)]
    else:
        messages = [(t, k, time, c if not isinstance(c, Odometry) else c._replace(pose=(0.0, 0.0, 0.0)) if odd == "speeds" else c._replace(quaternion=(0.0, 0.0, 0.0, 0.0)))
                    for t, k, time, c in messages]
    say = {"speeds": "speeds|stands", "heading": "orientation|quaternion|rotation", "none": "no odometry"}[odd]
    return case_of(written(folder, rng, messages), [drive], say=say, excuse=say)


def readings(folder, rng):
    """Distances that cannot be: in millimetres, or none."""
    drive, _, messages = one(rng)
    odd = rng.choice(["millimetres", "nothing", "empty", "no scans"])
    change = {"millimetres": lambda c: c._replace(ranges=[r * 1000 for r in c.ranges]), "nothing": lambda c: c._replace(ranges=[math.inf] * len(c.ranges)),
              "empty": lambda c: c._replace(ranges=[]), "no scans": lambda c: None}[odd]
    changed = [(t, k, time, change(c) if isinstance(c, Scan) else c) for t, k, time, c in messages]
    return case_of(written(folder, rng, [m for m in changed if m[3] is not None]), None, refusal="metres|no beam|no laser scan")


KINDS = {"containers": plain, "packed by file": zstd_by_file, "packed by message": zstd_by_message, "split": split_parts, "torn": torn, "twice in a folder": both_forms,
         "out of order": out_of_order, "bags of ROS 1": ros1_forms, "encodings": encodings, "two robots": two_robots, "two by frames": two_by_frames,
         "two odometries": two_odometries, "ground truth": truth_topics, "topics asked for": asked, "scans made of scans": scan_topics, "odometry in tf": tf_only,
         "tf under name spaces": tf_spaces, "mounts sent again": tf_again, "base frames": tf_chain, "odd mounts": tf_odd, "clockwise, upside down": mounts,
         "simulated clocks": clock_simulated, "clocks that jump": clock_jump, "clocks that stand": clock_stands, "two clocks": clock_mixed, "clocks set back": clock_back,
         "times of the file": file_times, "times by index": by_index, "odometry that jumps": odometry_jumps, "odometry of no use": odometry_useless, "impossible readings": readings}
