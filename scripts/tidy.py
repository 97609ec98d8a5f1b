#!/usr/bin/env python3
"""scripts/tidy.py FILE…: clang-tidy over sources that build/dev has compiled, as many at a time as there are processors.

Most of the time goes into reading the same headers. So the sources of a folder are looked at as one file, and those of
several folders too, where no names meet (cmake/joint_groups.py); where that finds something, folder by folder, and then
one by one. What was found good is not looked at again until it, a header of it, its compiler options, the list of checks
or clang-tidy itself has changed: $XDG_CACHE_HOME/docent/tidy (~/.cache) has one empty file for each source, named after a
hash of all that. Where the clone lies is no part of it, so that all clones share what is known.
"""
import hashlib
import json
import os
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "cmake"))
sys.dont_write_bytecode = True  # the work tree stays as it was
import joint_groups  # noqa: E402

BUILD = ROOT / "build" / "dev"
GOOD = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "docent" / "tidy"
KEPT_DAYS = 30  # of what nobody asks for
TOGETHER = BUILD / "tidy" / "together"  # files which include several sources
MOST_TOGETHER = 64  # sources: what finds something is read once more, one by one
SINGLE = BUILD / "tidy" / "single"  # commands for each source, however it was compiled
TIDY = "clang-tidy-14"
FOREIGN = " -Wno-subobject-linkage"  # an option that only the compiler of build/dev knows


def without_place(text):
    """A text of this clone as it would be in any other."""
    return text.replace(str(ROOT), "ROOT")


@cache
def hash_of(path):
    """None: there is no such file (any more)."""
    if not path.is_file():
        return None
    return hashlib.sha256(path.read_bytes().replace(str(ROOT).encode(), b"ROOT")).hexdigest()


@cache
def resolved(name):
    return (BUILD / name).resolve()


def files_read_by_compiler():
    """Source to all files that it read, itself among them, as ninja has noted them."""
    listed = subprocess.run(["ninja", "-C", BUILD, "-t", "deps"], capture_output=True, text=True, check=True).stdout
    read = {}
    for block in listed.split("\n\n"):
        head, *names = block.strip().splitlines() or [""]
        if "(VALID)" in head and names:
            paths = [resolved(name.strip()) for name in names]
            read[paths[0]] = paths
    return read


def sources_in(path):
    """Those that a file which cmake wrote includes, so that they are compiled as one (DOCENT_UNITY)."""
    return [ROOT / "src" / line.split('"')[1] for line in path.read_text().splitlines() if line.startswith("#include")]


def commands_of_compiler():
    """Source to its compiler's entry, also where it is compiled as one with others; and the file as which it is."""
    commands, compiled_as = {}, {}
    if not (BUILD / "compile_commands.json").is_file():
        sys.exit("scripts/tidy.py: build/dev is not configured: cmake --preset dev, and build it, for clang-tidy looks at what was compiled")
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        path = Path(entry["file"])
        is_joint = path.parent.name in {"Unity", "joint"} and path.is_file()
        for source in sources_in(path) if is_joint else [path]:
            command = entry["command"].replace(FOREIGN, "").replace(str(path), str(source))
            commands[source] = {**entry, "file": str(source), "command": command}
            compiled_as[source] = path
    return commands, compiled_as


@cache
def own_includes(path):
    """The project's own files that one includes, as their names say it."""
    names = re.findall(r'^\s*#\s*include "([^"]+)"', path.read_text(errors="ignore"), re.M)
    found = [place / name for name in names for place in ([ROOT / "src", ROOT / "include"] if name.startswith("docent/") else [path.parent])]
    return [name.resolve() for name in found if name.is_file()]


def seen_by(source):
    """The source and all of the project that it includes, however far."""
    seen, new = set(), {source}
    while new:
        seen |= new
        new = {name for path in new for name in own_includes(path)} - seen
    return seen


def is_of_a_source(path):
    """Whether it is written by hand: then a source that does not include it does not see it, though it was compiled with it."""
    return ROOT / "src" in path.parents or ROOT / "include" in path.parents


def keys_of(sources, commands, compiled_as):
    """Source to the hash of all that a finding depends on; none where it was not compiled since it changed."""
    joint = files_read_by_compiler()
    read = {source: joint[path] for source, path in compiled_as.items() if path in joint}
    version = subprocess.run([TIDY, "--version"], capture_output=True, text=True, check=True).stdout
    common = version + hash_of(ROOT / ".clang-tidy") + hash_of(ROOT / ".clang-format")
    keys = {}
    for source in sources:
        if source not in read or source not in commands or any(hash_of(path) is None for path in read[source]):
            continue
        seen = seen_by(source)
        # Neither the joint file nor what was compiled with the source, but every header from outside.
        paths = sorted(seen | {path for path in read[source] if path != compiled_as[source] and not is_of_a_source(path)})
        options = re.sub(r" -o \S+| -c \S+", "", commands[source]["command"])
        text = common + options + str(source) + "".join(f"{path} {hash_of(path)}\n" for path in paths)
        keys[source] = hashlib.sha256(without_place(text).encode()).hexdigest()
    return keys


def forget_the_old():
    """What nobody has asked for in a month."""
    for path in GOOD.iterdir():
        if path.is_file() and path.stat().st_mtime < time.time() - KEPT_DAYS * 86400:
            path.unlink(missing_ok=True)


def is_program(source):
    return re.search(r"^int main\(", source.read_text(), re.M) is not None


def by_folder(sources):
    """Lists of sources that can be read as one file: those of a folder, or single ones."""
    folders, single = {}, []
    for source in sources:
        target = source.parent / "CMakeLists.txt"
        if target.is_file() and "docent_capability(" in target.read_text() and not is_program(source):
            folders.setdefault(source.parent, []).append(source)
        else:
            single.append([source])
    return list(folders.values()) + single


def groups_of(sources):
    """Likewise, those of several folders."""
    joint, alone = [], []
    for members in by_folder(sources):
        if len(members) == 1 and is_program(members[0]):
            alone.append(members)
        else:
            joint.append((str(members[0].parent.relative_to(ROOT / "src" / "docent")), members))
    groups = [group.sources for group in joint_groups.groups_of(joint, MOST_TOGETHER)] + alone
    return sorted(groups, key=len, reverse=True)  # the longest first


def tidy(source, database):
    checks = ["--checks=-bugprone-suspicious-include"] if database == TOGETHER else []  # it includes sources
    done = subprocess.run([TIDY, "--quiet", *checks, "-p", database, source], capture_output=True, text=True, check=False)
    return done.returncode == 0, done.stdout + done.stderr


def with_all_seen(command, others):
    """The command, which sees what those of the other sources see, too."""
    words = command.split()
    for other in others:
        seen = other.split()
        for i, word in enumerate(seen):
            option = [word, seen[i + 1]] if word == "-isystem" else [word] if word.startswith(("-I", "-D")) else []
            if option and option[-1] not in words:
                words += option
    return " ".join(words)


def write_together(groups, commands):
    """The files that include the sources of a group, with the compiler's options: tuple of sources to file."""
    TOGETHER.mkdir(parents=True, exist_ok=True)
    entries, files = [], {}
    for group in groups:
        if len(group) == 1 or tuple(group) in files or any(source not in commands for source in group):
            continue
        name = TOGETHER / ("_".join(group[0].parent.relative_to(ROOT).parts) + f"_{len(group)}.cpp")
        name.write_text("".join(f'#include "{source}"\n' for source in group))
        command = commands[group[0]]["command"].replace(str(group[0]), str(name))
        command = with_all_seen(command, [commands[source]["command"] for source in group[1:]])
        entries.append({"directory": str(BUILD), "file": str(name), "command": command})
        files[tuple(group)] = name
    (TOGETHER / "compile_commands.json").write_text(json.dumps(entries))
    return files


def main():
    sources = [Path(name).resolve() for name in sys.argv[1:]]
    GOOD.mkdir(parents=True, exist_ok=True)
    commands, compiled_as = commands_of_compiler()
    SINGLE.mkdir(parents=True, exist_ok=True)
    (SINGLE / "compile_commands.json").write_text(json.dumps(list(commands.values())))
    keys = keys_of(sources, commands, compiled_as)
    known = {key for key in keys.values() if (GOOD / key).is_file()}
    for key in known:
        (GOOD / key).touch()
    to_do = [source for source in sources if keys.get(source) not in known]

    groups = groups_of(to_do)
    together = write_together(groups + by_folder(to_do), commands)

    def is_good(group):
        """Looks at it as one file, else at its parts; prints what single sources are found guilty of."""
        if len(group) == 1:
            good, text = tidy(group[0], SINGLE)
            print(text if not good else "", end="", flush=True)
        else:
            good = tuple(group) in together and tidy(together[tuple(group)], TOGETHER)[0]
        if not good and len(group) > 1:
            folders = by_folder(group)
            return all([is_good(part) for part in (folders if len(folders) > 1 else [[one] for one in group])])
        for source in group:
            if good and source in keys:
                (GOOD / keys[source]).touch()
        return good

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        good = list(pool.map(is_good, groups))
    forget_the_old()
    print(f"clang-tidy: {len(sources)} files, {len(sources) - len(to_do)} of them unchanged since they were found good")
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
