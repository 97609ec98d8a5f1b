#!/usr/bin/env python3
"""What a change needs to be tested, from git and from the graph of the CMakeLists.txt files.

  scripts/testing/changes.py plan [--base REV]     what scripts/test --quick runs: lines "base REV", "folder F", "suite S",
                                                   "page", "everything"; none but the first: checks are enough
  scripts/testing/changes.py tests FOLDER...       of build/dev: lines "TARGET NAME" of the tests of folders, as built there;
                                                   tests/F: its unit tests, tests/F!: all its tests
  scripts/testing/changes.py tests                 the same of all unit tests and replays
  scripts/testing/changes.py filter FOLDER...      what GoogleTest takes for all tests of these folders (GTEST_FILTER): programs
                                                   may hold those of others, too
  scripts/testing/changes.py tidy [--base REV]     sources that clang-tidy has to look at: changed ones and those that include
                                                   a changed header, the nearest first, forty at most

Changed is what differs between REV and the files that are there: committed or not, tracked or not. REV is where this branch left
origin/main or main, else HEAD. For tidy, where that leaves nothing (a fresh clone of main), it is HEAD's first parent.
"""
import argparse
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SOURCE = "src/docent/"
PUBLIC = "include/docent/"  # headers of the folders of SOURCE
MOST_TIDIED = 40
SECTIONS = {"SOURCES", "HOT", "DEPENDS", "LIBRARIES", "TEST_DEPENDS", "TEST_LIBRARIES"}
CODE = {".h", ".cpp", ".inc"}
TEXTS = ("museums/", "tests/corpus/")  # here *.md is what programs read, elsewhere a document
# Files that tests read although no include says so: the beginning of a path, and what it needs. A folder F stands for
# its tests and those of all that uses it; =F for its own alone.
READ_BY = {
    "museums/": ["=museum", "=apps/simulate", "tests/museums"],
    "robots/": ["=robot", "=apps/simulate"],
    "docs/robot.yaml": ["=apps/config"],
    "share/": ["tests/lichtblick"],
    "share/dds/": ["=transport", "42-second-vendor"],
    "tests/second_vendor/": ["42-second-vendor"],
    "prolog/": ["=task_control/golog", "=task_control/golog_planner", "=apps/golog", "12-prolog"],
    "tests/corpus/": ["13-fuzz-replay"],
    "scripts/testing/seeds.sh": ["13-fuzz-replay"],
    "include/": ["14-reference"],
    "include/README.md": ["14-reference"],  # its first page
    "docs/reference/": ["14-reference"],
    "scripts/reference": ["14-reference"],
    "packaging/": ["45-package"],
    "scripts/package": ["45-package"],
    "tests/package/": ["45-package"],
    "tests/package/small_debian.sh": ["46-library"],
    "tests/package/local_root.sh": ["46-library"],
    "tests/library/": ["46-library"],
    "tests/closed_loop/": ["tests/closed_loop"],
    "tests/web_contract/": ["page", "=telepresence/contract"],
    "tests/evaluation/": ["10-verdicts", "11-figures"],
    "scripts/evaluate": ["10-verdicts", "11-figures"],
    "scripts/evaluation/": ["10-verdicts", "11-figures"],
    "scripts/fuzz": ["13-fuzz-replay"],
    "web/": ["page"],
    "examples/": ["46-library"],
    "python/": ["everything"],
    "cmake/": ["everything"],
    "CMakeLists.txt": ["everything"],
    "CMakePresets.json": ["everything"],
    "src/docent/CMakeLists.txt": ["everything"],
    "tests/CMakeLists.txt": ["everything"],
}


def git(root, *words, check=True):
    done = subprocess.run(["git", *words], cwd=root, capture_output=True, text=True, check=False)
    if check and done.returncode != 0:
        raise SystemExit(f"changes.py: git {' '.join(words)}: {done.stderr.strip()}")
    return done.stdout.strip() if done.returncode == 0 else ""


def base_of(root, wanted=None):
    if wanted:
        return git(root, "rev-parse", "--verify", f"{wanted}^{{commit}}")
    for branch in ("origin/main", "main"):
        if found := git(root, "merge-base", "HEAD", branch, check=False):
            return found
    return git(root, "rev-parse", "HEAD")


def changed_files(root, base):
    names = git(root, "diff", "--name-only", "--no-renames", "-z", base, "--").split("\0")
    return sorted({*names, *git(root, "ls-files", "-z", "--others", "--exclude-standard").split("\0")} - {""})


class Graph:
    """Which folder of src/docent uses which, and which of them a folder of tests links."""

    def __init__(self, root):
        self.depends, self.test_depends, self.linked_by_tests = {}, {}, {}
        self.with_fuzzer = {path.parent.relative_to(root / SOURCE).as_posix() for path in (root / SOURCE).rglob("*_fuzzer.cpp")}
        for file in sorted((root / SOURCE).rglob("CMakeLists.txt")):
            for call in re.findall(r"docent_capability\(([^)]*)\)", re.sub(r"#.*", "", file.read_text())):
                folder, *words = call.split()
                found = {section: set() for section in SECTIONS}
                section = "SOURCES"
                for word in words:
                    if word in SECTIONS:
                        section = word
                    else:
                        found[section].add(word)
                self.depends[folder], self.test_depends[folder] = found["DEPENDS"], found["TEST_DEPENDS"]
        by_target = {"docent_" + folder.replace("/", "_"): folder for folder in self.depends}
        for file in sorted((root / "tests").glob("*/CMakeLists.txt")):
            words = re.findall(r"\w+", file.read_text())
            self.linked_by_tests[file.parent.name] = {by_target[word] for word in words if word in by_target}

    def folder_of(self, path):
        """The capability that a file of src/docent or include/docent belongs to, or None."""
        parts = path.removeprefix(SOURCE).removeprefix(PUBLIC).split("/")[:-1]
        while parts and "/".join(parts) not in self.depends:
            parts.pop()
        return "/".join(parts) or None

    def users(self, folders):
        """The folders and all that use them, however far."""
        found, new = set(), set(folders)
        while new:
            found |= new
            new = {folder for folder, names in self.depends.items() if names & new} - found
        return found


def is_document(path):
    return path.endswith(".md") and not path.startswith(TEXTS)


def plan(graph, files, suites):
    """What tests a change of these files needs: (folders, folders of tests, suites, has a page, everything)."""
    libraries, own, tests, chosen = set(), set(), set(), set()
    wants = set()
    for path in files:
        for start, needs in READ_BY.items():
            if path == start or (start.endswith("/") and path.startswith(start) and not is_document(path)):
                wants |= set(needs)
        name = path.removeprefix("tests/suites/")
        if name in suites:
            chosen.add(name)
        if is_document(path):
            continue
        if path.startswith((SOURCE, PUBLIC)):
            folder = graph.folder_of(path)
            if folder:
                stem = Path(path).stem
                (own if stem.endswith(("_test", "_benchmark", "_fuzzer")) else libraries).add(folder)
        elif path.startswith("tests/") and Path(path).suffix in {*CODE, ".txt"} and path.split("/")[1] in graph.linked_by_tests:
            tests.add(path.split("/")[1])
    for want in wants - {"page", "everything"}:
        if want.startswith("="):
            own.add(want[1:])
        elif want.startswith("tests/"):
            tests.add(want.split("/")[1])
        else:
            chosen.add(want)
    if any(folder in graph.with_fuzzer for folder in libraries | own):
        chosen.add("13-fuzz-replay")
    touched = graph.users(libraries)
    folders = touched | {folder for folder, names in graph.test_depends.items() if names & touched} | own
    tests |= {name for name, names in graph.linked_by_tests.items() if names & touched}
    return folders & graph.depends.keys(), tests, chosen & suites, "page" in wants, "everything" in wants


def built_tests(build):
    """(name, path of its program, label) of each test, as CMake has written them."""
    found = []
    for file in sorted(build.rglob("CTestTestfile.cmake")):
        text = file.read_text()
        labels = dict(re.findall(r'^set_tests_properties\((?:\[=\[|")?(.+?)(?:\]=\]|")? PROPERTIES .*?LABELS "(\w+)"', text, re.M))
        for name, program in re.findall(r'^add_test\((?:\[=\[|")?(.+?)(?:\]=\]|")? "([^"]+)"', text, re.M):
            if Path(program).is_relative_to(build):  # not the interpreter of the Python package's tests
                found.append((name, Path(program), labels.get(name, "")))
    return found


def chosen_tests(tests, build, folders, test_folders, changed_tests):
    """(target, name): of folders of src/docent, and of folders of tests: those of the label `unit`, or all where the
    folder itself was changed."""
    chosen = []
    for name, program, label in tests:
        place = program.parent.relative_to(build).parts
        if place[0] == "src":
            is_chosen = folders is None or bool(set(name.split("+")) & set(folders))
        elif folders is None:
            is_chosen = label in ("unit", "replay")
        else:
            is_chosen = place[1] in changed_tests or (place[1] in test_folders and label == "unit")
        if is_chosen:
            chosen.append((program.name, name))
    return chosen


def filter_of(root, folders):
    """GoogleTest's filter for all tests of folders of src/docent, and of tests/F or tests/F!."""
    suites = set()
    for folder in folders:
        place = root / folder.removesuffix("!") if folder.startswith("tests/") else root / SOURCE / folder
        for path in place.glob("*_test.cpp"):
            suites |= set(re.findall(r"^\s*TEST\w*\((\w+),", path.read_text(), re.M))
    return ":".join(f"{suite}.*:*/{suite}.*:{suite}/*:*/{suite}/*" for suite in sorted(suites))


def includes_of(root, files):
    """File to the files of src, include and tests that it includes, as they are spelt."""
    found = {}
    public = {path for path in files if path.startswith(PUBLIC)}

    def place(name):
        return "include/" + name if "include/" + name in public else "src/" + name

    for path in files:
        text = (root / path).read_text(errors="ignore")
        found[path] = {place(name) if name.startswith("docent/") else str(Path(path).parent / name)
                       for name in re.findall(r'^\s*#\s*include "([^"]+)"', text, re.M)}
    return found


def to_tidy(root, changed, most=MOST_TIDIED):
    """(sources, how many more there would be): changed ones first, then those that include changed headers, the nearest first."""
    files = git(root, "ls-files", "-z", "--cached", "--others", "--exclude-standard", "src", "include").split("\0")
    files = [path for path in files if Path(path).suffix in CODE and (root / path).is_file()]
    includes = includes_of(root, files)
    users = {}
    for path, names in includes.items():
        for name in names:
            users.setdefault(name, set()).add(path)
    near = sorted(path for path in changed if path in includes)
    order = list(near)
    while near:
        near = sorted({user for path in near for user in users.get(path, ())} - set(order))
        order += near
    sources = [path for path in order if path.endswith(".cpp") and not path.endswith(("_test.cpp", "_benchmark.cpp", "_fuzzer.cpp"))]
    return sources[:most], max(0, len(sources) - most)


def print_plan(options):
    base = base_of(ROOT, options.base)
    files = changed_files(ROOT, base)
    suites = {path.name for path in (ROOT / "tests/suites").iterdir() if path.suffix != ".txt"}
    folders, tests, chosen, has_page, is_everything = plan(Graph(ROOT), files, suites)
    print(f"base {base[:12]}, {len(files)} files changed")
    for folder in sorted(folders):
        print(f"folder {folder}")
    for name in sorted(tests):
        is_own = any(path.startswith(f"tests/{name}/") for path in files)
        print(f"folder tests/{name}{'!' if is_own else ''}")
    for name in sorted(chosen):
        print(f"suite {name}")
    if has_page:
        print("page")
    if is_everything:
        print("everything")


def print_tests(options):
    build = ROOT / "build/dev"
    folders = [name for name in options.folders if not name.startswith("tests/")]
    named = [name.removeprefix("tests/") for name in options.folders if name.startswith("tests/")]
    itself = {name.removesuffix("!") for name in named if name.endswith("!")}
    for target, name in chosen_tests(built_tests(build), build, folders if options.folders else None, set(named), itself):
        print(target, name)


def print_tidied(options):
    base = base_of(ROOT, options.base)
    files = changed_files(ROOT, base)
    if not files and not options.base:
        base = git(ROOT, "rev-parse", "--verify", "HEAD^1", check=False) or base
        files = changed_files(ROOT, base)
    sources, more = to_tidy(ROOT, files)
    print(f"clang-tidy: {len(sources)} sources of what changed since {base[:12]}" +
          (f"; {more} more that include it are left to scripts/test --all" if more else ""), file=sys.stderr)
    print("\n".join(sources))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    for name, function in (("plan", print_plan), ("tests", print_tests), ("tidy", print_tidied),
                           ("filter", lambda chosen: print(filter_of(ROOT, chosen.folders)))):
        command = commands.add_parser(name)
        command.set_defaults(function=function)
        if name in ("tests", "filter"):
            command.add_argument("folders", nargs="*", help="as plan prints them")
        else:
            command.add_argument("--base", help="a revision")
    options = parser.parse_args()
    options.function(options)


if __name__ == "__main__":
    main()
