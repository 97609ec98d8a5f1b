#!/usr/bin/python3
"""The ROS 2 package docent_msgs against the IDL: every type, every field, in the same order, of the type that ROS gives it.

check_messages.py FOLDER: holds docent.idl and docent_msgs. The .msg files are read by ROS's own parser (rosidl_adapter).
"""
import re
import sys
import xml.etree.ElementTree
from pathlib import Path

from rosidl_adapter.parser import parse_message_file

PACKAGE = "docent_msgs"
# https://docs.ros.org/en/humble/Concepts/Basic/About-Interfaces.html: field types, and what they are in DDS.
ROS_TYPES = {"boolean": "bool", "octet": "uint8", "int8": "int8", "short": "int16", "unsigned short": "uint16", "long": "int32",
             "unsigned long": "uint32", "long long": "int64", "unsigned long long": "uint64", "float": "float32",
             "double": "float64", "string": "string"}


def ros_type(idl_type, arrays):
    if idl_type in arrays:
        element, size = arrays[idl_type]
        return f"{ros_type(element, arrays)}[{size}]"
    if sequence := re.fullmatch(r"sequence<(.+)>", idl_type):
        return ros_type(sequence[1], arrays) + "[]"
    if message := re.fullmatch(r"(\w+)::msg::dds_::(\w+)_", idl_type):
        return f"{message[1]}/{message[2]}"
    return ROS_TYPES[idl_type]


def types_of_idl(text):
    """{name: [(field, ROS type)]} of the package's own types."""
    types = {}
    for package, body in re.findall(r"module (\w+) \{ module msg \{ module dds_ \{\n(.*?)\n\}; \}; \};", text, flags=re.S):
        arrays = {name: (element, size) for element, name, size in re.findall(r"typedef (.+) (\w+)\[(\d+)\];", body)}
        name, fields = re.search(r"struct (\w+)_ \{\n(.*)\n  \};", body, flags=re.S).groups()
        if package == PACKAGE:
            types[name] = [(field.removeprefix("_"), ros_type(idl_type, arrays))
                           for idl_type, field in re.findall(r"^    (.+) (\w+);$", fields, flags=re.M)]
    return types


def main(folder):
    faults = []
    idl = (folder / "docent.idl").read_text()
    expected = types_of_idl(idl)
    if len(expected) != idl.count(f"module {PACKAGE} ") or len(expected) < 30 or not all(expected.values()):
        faults.append(f"docent.idl is not read as it was written: {len(expected)} types")
    found = {}
    others = set()
    explained = 0
    for path in (folder / PACKAGE / "msg").glob("*.msg"):
        message = parse_message_file(PACKAGE, str(path))
        found[path.stem] = [(field.name, str(field.type)) for field in message.fields]
        explained += sum(bool(field.annotations.get("comment")) for field in message.fields)
        others |= {field.type.pkg_name for field in message.fields if field.type.pkg_name} - {PACKAGE}
    for name in sorted(expected.keys() | found.keys()):
        if expected.get(name) != found.get(name):
            faults.append(f"{name}: the IDL has {expected.get(name)}, the .msg file {found.get(name)}")
    manifest = xml.etree.ElementTree.parse(folder / PACKAGE / "package.xml").getroot()
    declared = {element.text for element in manifest.findall("depend")}
    script = (folder / PACKAGE / "CMakeLists.txt").read_text()
    packages = set(re.search(r"set\(packages (.+)\)", script)[1].split())
    if not others == declared == packages:
        faults.append(f"packages: {others} are used, package.xml has {declared}, CMakeLists.txt {packages}")
    if explained < 100:
        faults.append(f"only {explained} fields have their comment")
    for fault in faults:
        print(fault)
    print(f"{len(found)} messages, {sum(map(len, found.values()))} fields, {explained} explained, packages {', '.join(sorted(others))}")
    return 1 if faults else 0


sys.exit(main(Path(sys.argv[1])))
