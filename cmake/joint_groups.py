#!/usr/bin/env python3
"""Which folders can be compiled as one file: joint_groups.py MOST <FOLDERS, prints a line "a b c" for each such file.

A line of FOLDERS is a folder's name and its sources, with blanks between them. Two folders go together where no name
that one's sources define at the beginning of a line (what stands in unnamed namespaces is among that) is used by the
other's, unless their namespaces differ; and where they have at most MOST sources. A folder goes to the first of its layer
(the first part of its name) that has room for it, else to any: neighbours read the same headers.

What it does not see: a name that a header of one folder declares may hide one further out that another folder means. The
compiler refuses that; a source then names the namespace (docent::to_text).
"""
import re
import sys
from functools import cache
from pathlib import Path

TYPES = re.compile(r"^(?:struct|class|enum class|enum) (\w+)", re.M)
VALUES = re.compile(r"^(?!struct|class|enum|namespace|using)(?:\[\[nodiscard\]\] )?[A-Za-z][^(=;{}\n#/]*[ &*](\w+) ?[\[({=]", re.M)
USINGS = re.compile(r"^using (?:(\w+) =|[\w:]*::(\w+);)", re.M)
TESTS = re.compile(r"^TEST\w*\((\w+), (\w+)", re.M)
NAMESPACE = re.compile(r"^namespace (docent[\w:]*)", re.M)
NO_CODE = re.compile(r"//[^\n]*|R\"\((?:.|\n)*?\)\"|\"(?:\\.|[^\"\\\n])*\"|#include[^\n]*")
WORDS = re.compile(r"(?<![\w.>:])[A-Za-z_]\w*")  # not members, nor what names its namespace


@cache
def names_of(source):
    """(its namespace, what it defines, what it uses)."""
    text = NO_CODE.sub('""', Path(source).read_text())
    found = NAMESPACE.search(text)
    defined = {*TYPES.findall(text), *VALUES.findall(text), *map("".join, USINGS.findall(text)), *map("_".join, TESTS.findall(text))}
    return found[1] if found else "", defined, defined | set(WORDS.findall(text))


def places_of(folder):
    """Where the headers of a folder of sources lie: beside them and, public ones, in include."""
    within = [i for i, part in enumerate(folder.parts) if part == "src"]
    return [folder, *(Path(*folder.parts[:i], "include", *folder.parts[i + 1:]) for i in within[-1:])]


class Group:
    def __init__(self):
        self.folders, self.sources, self.layers = [], [], set()
        self.defined, self.used = {}, {}  # by namespace

    def add(self, folder, sources):
        headers = {path for source in sources for folder in places_of(Path(source).parent) for path in folder.glob("*.h")}
        self.folders.append(folder)
        self.sources += sources
        self.layers.add(folder.split("/")[0])
        for source in sources:
            namespace, defined, used = names_of(source)
            self.defined.setdefault(namespace, set()).update(defined)
            self.used.setdefault(namespace, set()).update(used)
        for header in headers:
            namespace, _, used = names_of(header)
            self.used.setdefault(namespace, set()).update(used)
        return self

    def fits(self, other, most):
        def meet(a, b):  # what a defines is seen in the namespaces within, too
            return any(names & used for space, names in a.defined.items() for inner, used in b.used.items()
                       if inner == space or inner.startswith(space + "::"))
        return len(self.sources) + len(other.sources) <= most and not meet(self, other) and not meet(other, self)


def groups_of(folders, most):
    """folders: [(name, sources)]."""
    groups = []
    for folder, sources in folders:
        new = Group().add(folder, sources)
        fit = [group for group in groups if group.fits(new, most)]
        near = [group for group in fit if folder.split("/")[0] in group.layers]
        if fit:
            (near or fit)[0].add(folder, sources)
        else:
            groups.append(new)
    return groups


if __name__ == "__main__":
    lines = [line.split() for line in sys.stdin]
    for one in groups_of([(name, sources) for name, *sources in lines], int(sys.argv[1])):
        print(*one.folders)
