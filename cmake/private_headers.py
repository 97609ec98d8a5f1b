#!/usr/bin/env python3
"""Copies the private headers that public ones include: private_headers.py ROOT DESTINATION. They are installed apart from
the public ones, since they may change with every version."""
import os
import re
import shutil
import sys
from pathlib import Path

INCLUDE = re.compile(r'^#include "(docent/[^"]+)"', re.M)


def private_headers(root):
    """Their names below ROOT/src, in order. Raises where a header includes one that is not there."""
    found, left = set(), [path for path in (root / "include").rglob("*.h")]
    while left:
        header = left.pop()
        for name in INCLUDE.findall(header.read_text()):
            private = root / "src" / name
            if private.is_file():
                if name not in found:
                    found.add(name)
                    left.append(private)
            elif not (root / "include" / name).is_file():
                raise FileNotFoundError(f"{header}: there is no {name}")
    return sorted(found)


if __name__ == "__main__":
    source, destination = Path(sys.argv[1]), Path(sys.argv[2])
    shutil.rmtree(destination, ignore_errors=True)
    os.umask(0o022)  # everybody may read what is installed
    for name in private_headers(source):
        (destination / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source / "src" / name, destination / name)
        (destination / name).chmod(0o644)
