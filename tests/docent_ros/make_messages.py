#!/usr/bin/env python3
"""Headers of ROS 2 messages as rosidl makes them for C++, as far as docent_ros uses them.

usage: make_messages.py MSG_FOLDER OUT

MSG_FOLDER holds the .msg files of docent_msgs as the build writes them, so that these headers are those of the messages
on the wire. The other packages' definitions, of ROS 2 Jazzy, stand below with all their fields.
"""
import pathlib
import re
import sys

MESSAGES = {
    "builtin_interfaces/Time": "int32 sec\nuint32 nanosec",
    "builtin_interfaces/Duration": "int32 sec\nuint32 nanosec",
    "std_msgs/Header": "builtin_interfaces/Time stamp\nstring frame_id",
    "geometry_msgs/Point": "float64 x\nfloat64 y\nfloat64 z",
    "geometry_msgs/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w 1",
    "geometry_msgs/Pose": "Point position\nQuaternion orientation",
    "geometry_msgs/PoseStamped": "std_msgs/Header header\nPose pose",
    "geometry_msgs/PoseWithCovariance": "Pose pose\nfloat64[36] covariance",
    "geometry_msgs/PoseWithCovarianceStamped": "std_msgs/Header header\nPoseWithCovariance pose",
}
_RESULT = "uint16 error_code\nstring error_msg"
_FEEDBACK = """geometry_msgs/PoseStamped current_pose
builtin_interfaces/Duration navigation_time
builtin_interfaces/Duration estimated_time_remaining
int16 number_of_recoveries
float32 distance_remaining"""
ACTIONS = {
    "nav2_msgs/NavigateToPose": ("geometry_msgs/PoseStamped pose\nstring behavior_tree", _RESULT, _FEEDBACK),
    "nav2_msgs/NavigateThroughPoses": ("geometry_msgs/PoseStamped[] poses\nstring behavior_tree", _RESULT,
                                       _FEEDBACK + "\nint16 number_of_poses_remaining"),
}
USED = ["docent_msgs/GoalState", "docent_msgs/Request", "docent_msgs/RequestBoard"]
PLAIN = {"bool": "bool", "float32": "float", "float64": "double", "string": "std::string", "byte": "std::uint8_t"}
PLAIN.update({f"{sign}int{bits}": f"std::{sign}int{bits}_t" for sign in ("", "u") for bits in (8, 16, 32, 64)})


def snake(name):
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def struct(package, name, definition, includes, indent="", needed=None):
    lines = [f"{indent}struct {name} {{", f"{indent}  using SharedPtr = std::shared_ptr<{name}>;"]
    for line in definition.splitlines():
        line = line.split("#")[0].strip()
        if not line or "=" in line:
            continue
        kind, field, *default = line.split()
        array = re.fullmatch(r"(.+?)\[(\d*)\]", kind)
        if array:
            kind = array.group(1)
        if kind in PLAIN:
            written = PLAIN[kind]
        else:
            owner, _, message = kind.replace("/msg/", "/").rpartition("/")
            owner = owner or package
            includes.add(f"#include <{owner}/msg/{snake(message)}.hpp>")
            written = f"{owner}::msg::{message}"
            if needed is not None:
                needed.append(f"{owner}/{message}")
        if array:
            written = f"std::array<{written}, {array.group(2)}>" if array.group(2) else f"std::vector<{written}>"
        lines.append(f"{indent}  {written} {field}{{{default[0] if default else ''}}};")
    return "\n".join(lines + [f"{indent}}};"])


def write(out, kind, package, name, body, includes):
    includes = sorted(includes | {"#include <array>", "#include <cstdint>", "#include <memory>", "#include <string>",
                                  "#include <vector>"})
    file = out / package / kind / (snake(name) + ".hpp")
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text("#pragma once\n" + "\n".join(includes) +
                    f"\nnamespace {package}::{kind} {{\n{body}\n}}  // namespace {package}::{kind}\n")


def main(folder, out):
    messages = dict(MESSAGES)
    own = sorted(pathlib.Path(folder).glob("*.msg"))
    if not own:
        sys.exit(f"{folder}: no messages of docent_msgs")
    for file in own:
        messages["docent_msgs/" + file.stem] = file.read_text()
    waiting = list(MESSAGES) + USED
    written = set()
    while waiting:
        full = waiting.pop()
        if full in written:
            continue
        written.add(full)
        package, name = full.split("/")
        includes, needed = set(), []
        body = struct(package, name, messages[full], includes, needed=needed)
        write(out, "msg", package, name, body, includes)
        waiting += needed
    for full, parts in ACTIONS.items():
        package, name = full.split("/")
        includes = set()
        inner = "\n".join(struct(package, part, definition, includes, "  ")
                          for part, definition in zip(("Goal", "Result", "Feedback"), parts))
        write(out, "action", package, name, f"struct {name} {{\n{inner}\n}};", includes)


if __name__ == "__main__":
    main(sys.argv[1], pathlib.Path(sys.argv[2]))
