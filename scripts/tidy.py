#!/usr/bin/env python3
"""scripts/tidy.py FILE…: clang-tidy over sources that build/dev has compiled, as many at a time as there are processors.

A file that was found good is not looked at again until it, a header of it, its compiler options, the list of checks or
clang-tidy itself has changed: build/dev/tidy has one empty file for each, named after a hash of all that.
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
TIDY = "clang-tidy-14"


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


def keys_of(sources):
    """Source to the hash of all that a finding depends on; none where it was not compiled since it changed."""
    read = files_read_by_compiler()
    commands = {Path(entry["file"]): entry["command"] for entry in json.loads((BUILD / "compile_commands.json").read_text())}
    version = subprocess.run([TIDY, "--version"], capture_output=True, text=True, check=True).stdout
    common = version + hash_of(ROOT / ".clang-tidy") + hash_of(ROOT / ".clang-format")
    keys = {}
    for source in sources:
        if source in read and source in commands and all(path.is_file() for path in read[source]):
            text = common + commands[source] + "".join(f"{path} {hash_of(path)}\n" for path in read[source])
            keys[source] = hashlib.sha256(text.encode()).hexdigest()
    return keys


def main():
    sources = [Path(name).resolve() for name in sys.argv[1:]]
    GOOD.mkdir(parents=True, exist_ok=True)
    keys = keys_of(sources)
    known = {path.name for path in GOOD.iterdir()}
    to_do = [source for source in sources if keys.get(source) not in known]

    def look_at(source):
        done = subprocess.run([TIDY, "--quiet", "-p", BUILD, source], capture_output=True, text=True, check=False)
        if done.returncode == 0 and source in keys:
            (GOOD / keys[source]).touch()
        elif done.returncode != 0:
            print(done.stdout + done.stderr, end="", flush=True)
        return done.returncode == 0

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        good = list(pool.map(look_at, to_do))
    for old in known - set(keys.values()):
        (GOOD / old).unlink()
    print(f"clang-tidy: {len(sources)} files, {len(sources) - len(to_do)} of them unchanged since they were found good")
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
