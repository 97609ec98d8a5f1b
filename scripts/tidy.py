#!/usr/bin/env python3
"""scripts/tidy.py FILE…: clang-tidy over sources that build/dev has compiled, as many at a time as there are processors.

The sources of a folder are looked at as one file, for most of the time goes into reading the same headers; where that
finds something, and in folders that say SOURCES_APART, one by one. What was found good is not looked at again until it,
a header of it, its compiler options, the list of checks or clang-tidy itself has changed: build/dev/tidy has one empty
file for each folder or source, named after a hash of all that.
"""
import hashlib
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build" / "dev"
GOOD = BUILD / "tidy"
TOGETHER = GOOD / "together"  # one file a folder, which includes its sources
SINGLE = GOOD / "single"  # commands for each source, however it was compiled
TIDY = "clang-tidy-14"
FOREIGN = " -Wno-subobject-linkage"  # an option that only the compiler of build/dev knows


@cache
def hash_of(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def files_read_by_compiler():
    """Source to all files that it read, itself among them, as ninja has noted them."""
    listed = subprocess.run(["ninja", "-C", BUILD, "-t", "deps"], capture_output=True, text=True, check=True).stdout
    read = {}
    for block in listed.split("\n\n"):
        head, *names = block.strip().splitlines() or [""]
        if "(VALID)" in head and names:
            paths = [(BUILD / name.strip()).resolve() for name in names]
            read[paths[0]] = paths
    return read


def sources_in(path):
    """Those that a file which cmake wrote includes, so that they are compiled as one (DOCENT_UNITY)."""
    return [Path(line.split('"')[1]) for line in path.read_text().splitlines() if line.startswith("#include")]


def commands_of_compiler():
    """Source to its compiler's entry, also where it is compiled as one with others; and the file as which it is."""
    commands, compiled_as = {}, {}
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        path = Path(entry["file"])
        is_joint = path.parent.name == "Unity" and path.is_file()
        for source in sources_in(path) if is_joint else [path]:
            command = entry["command"].replace(FOREIGN, "").replace(str(path), str(source))
            commands[source] = {**entry, "file": str(source), "command": command}
            compiled_as[source] = path
    return commands, compiled_as


def keys_of(sources, commands, compiled_as):
    """Source to the hash of all that a finding depends on; none where it was not compiled since it changed."""
    joint = files_read_by_compiler()
    read = {source: joint[path] for source, path in compiled_as.items() if path in joint}
    version = subprocess.run([TIDY, "--version"], capture_output=True, text=True, check=True).stdout
    common = version + hash_of(ROOT / ".clang-tidy") + hash_of(ROOT / ".clang-format")
    keys = {}
    for source in sources:
        if source in read and source in commands and all(path.is_file() for path in read[source]):
            text = common + commands[source]["command"] + "".join(f"{path} {hash_of(path)}\n" for path in read[source])
            keys[source] = hashlib.sha256(text.encode()).hexdigest()
    return keys


def groups_of(sources):
    """Lists of sources that can be read as one file: those of a folder, or single ones."""
    folders = {}
    for source in sources:
        folders.setdefault(source.parent, []).append(source)
    groups = []
    for folder, members in folders.items():
        target = folder / "CMakeLists.txt"
        text = target.read_text() if target.is_file() else ""
        if "docent_capability(" in text and "SOURCES_APART" not in text:
            groups.append(members)
        else:
            groups += [[member] for member in members]
    return sorted(groups, key=len, reverse=True)  # the longest first


def tidy(source, database):
    checks = ["--checks=-bugprone-suspicious-include"] if database == TOGETHER else []  # it includes sources
    done = subprocess.run([TIDY, "--quiet", *checks, "-p", database, source], capture_output=True, text=True, check=False)
    return done.returncode == 0, done.stdout + done.stderr


def write_together(groups, commands):
    """The files that include the sources of a group, with the compiler's options; list of (group, file)."""
    TOGETHER.mkdir(parents=True, exist_ok=True)
    entries, files = [], []
    for group in groups:
        if len(group) == 1 or any(source not in commands for source in group):
            files.append((group, None))
            continue
        name = TOGETHER / ("_".join(group[0].parent.relative_to(ROOT).parts) + ".cpp")
        name.write_text("".join(f'#include "{source}"\n' for source in group))
        command = commands[group[0]]["command"].replace(str(group[0]), str(name))
        for source in group[1:]:  # targets of one folder need not see the same
            seen = [word for word in commands[source]["command"].split() if word.startswith(("-I", "-D"))]
            command += "".join(f" {word}" for word in seen if f" {word} " not in command)
        entries.append({"directory": str(BUILD), "file": str(name), "command": command})
        files.append((group, name))
    (TOGETHER / "compile_commands.json").write_text(json.dumps(entries))
    return files


def main():
    sources = [Path(name).resolve() for name in sys.argv[1:]]
    GOOD.mkdir(parents=True, exist_ok=True)
    commands, compiled_as = commands_of_compiler()
    SINGLE.mkdir(exist_ok=True)
    (SINGLE / "compile_commands.json").write_text(json.dumps(list(commands.values())))
    keys = keys_of(sources, commands, compiled_as)
    known = {path.name for path in GOOD.iterdir() if path.is_file()}
    to_do = [source for source in sources if keys.get(source) not in known]

    def look_at(job):
        group, together = job
        if together and tidy(together, TOGETHER)[0]:
            findings = {source: (True, "") for source in group}
        else:
            findings = {source: tidy(source, SINGLE) for source in group}
        for source, (is_good, text) in findings.items():
            if not is_good:
                print(text, end="", flush=True)
            elif source in keys:
                (GOOD / keys[source]).touch()
        return all(is_good for is_good, _ in findings.values())

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        good = list(pool.map(look_at, write_together(groups_of(to_do), commands)))
    for old in known - set(keys.values()):
        (GOOD / old).unlink()
    print(f"clang-tidy: {len(sources)} files, {len(sources) - len(to_do)} of them unchanged since they were found good")
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
