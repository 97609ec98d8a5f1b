"""Recordings of other robots, by what rosbag2, MCAP, rosbag and tf allow. Each case knows from how it was made what a reader must find (odd_drive).

A case: `what` "log", `path`; `robots`: the drives of which one must come out; None: there is no right value. `refusal`, `say` as in odd_maps;
`excuse`: what the notes must say where the value is another one. The rest: what `fault_of` allows.
"""
import math
import struct

from . import odd_clocks, odd_forms
from .odd_bags import Odometry, Scan, Transforms, about_z, encoded
from .odd_drive import FIRST, Drive, Scanner, fingerprint, kinds, quaternion_of, recorded, turn_about
from .odd_forms import case_of, one, written


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


def scan_fields(folder, rng):
    """Scans as drivers fill them in: no reach, 0 or an odd number where nothing comes back, intensities of another count."""
    drive, scanner, messages = one(rng)
    odd = rng.choice(["reach 0", "reach infinite", "reach huge", "zeros", "beyond", "failed", "intensities"])
    near, spoiled, truth = rng.uniform(0.5, 0.9), [], {}  # of a sweep's readings that stay
    nothing = {"zeros": lambda: 0.0, "beyond": lambda: rng.choice([math.inf, 12.0, 12.5, 64.0]), "failed": lambda: rng.choice([math.nan, -math.inf, 0.01])}.get(odd)
    for t, k, time, c in messages:
        if isinstance(c, Scan):
            far = sorted(c.ranges)[int(near * (len(c.ranges) - 1))]
            ranges = [nothing() if nothing and r > far else r for r in c.ranges]
            truth[fingerprint([r for r in ranges if 0.05 <= r < 12.0])] = drive.truth[fingerprint(c.ranges)]
            most = {"reach 0": 0.0, "reach infinite": math.inf, "reach huge": 1e9}.get(odd, c.most)
            c = c._replace(ranges=ranges, most=most)
            if odd == "intensities":
                count = rng.choice([1, 3, len(ranges) + 2])
                c = ("raw", encoded(c)[:-4] + struct.pack(f"<I{count}f", count, *[5.0] * count))
        spoiled.append((t, k, time, c))
    drive.truth = truth
    return case_of(written(folder, rng, spoiled, rng.choice(["db3", "mcap"]) if odd == "intensities" else None), [drive])


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


KINDS = {**odd_forms.KINDS, "two robots": two_robots, "two by frames": two_by_frames, "two odometries": two_odometries, "ground truth": truth_topics,
         "topics asked for": asked, "scans made of scans": scan_topics, "odometry in tf": tf_only, "tf under name spaces": tf_spaces, "mounts sent again": tf_again,
         "base frames": tf_chain, "odd mounts": tf_odd, "clockwise, upside down": mounts, "fields of scans": scan_fields, **odd_clocks.KINDS, "odometry that jumps": odometry_jumps,
         "odometry of no use": odometry_useless, "impossible readings": readings}
