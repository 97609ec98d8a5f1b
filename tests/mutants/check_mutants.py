#!/usr/bin/env python3
"""Whether the merge tier finds faults that are put in on purpose (faults.yaml): check_mutants.py [CAPABILITY...]

Each fault is compiled into a copy of HEAD in build/mutants; stages of scripts/test run on that until one fails: the unit tests of
the fault's folder, all unit tests, the suites in their order. At the end each stage that has found something runs on HEAD without
a fault, where it must pass. Prints a table of faults and the stages that found them. A minute or two a fault where a unit test
finds it.
"""
import os
import re
import subprocess
import sys
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
TREE = ROOT / "build" / "mutants"
FAULTS = Path(__file__).with_name("faults.yaml")
UNIT = ["ctest", "--preset", "dev", "-LE", "closed_loop|end_to_end", "-j2", "--no-tests=error"]


def run(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)


def prepare():
    """A clean copy of HEAD, configured as scripts/test does in an empty clone."""
    if not TREE.exists():
        run("git", "worktree", "prune", cwd=ROOT)
        made = run("git", "worktree", "add", "--detach", TREE, "HEAD", cwd=ROOT)
    else:
        made = run("git", "checkout", "--force", "--detach", run("git", "rev-parse", "HEAD", cwd=ROOT).stdout.strip(), cwd=TREE)
    if made.returncode != 0:
        sys.exit(f"check_mutants: {made.stderr.strip()}")
    configured = run(TREE / "scripts/testing/configure", cwd=TREE)
    if configured.returncode != 0:
        sys.exit(f"check_mutants: HEAD cannot be configured\n{configured.stderr[-2000:]}")


def build():
    return run("cmake", "--build", "--preset", "dev", cwd=TREE)


def suites():
    """Those of the merge tier that see the program, in the order of tests/suites/budgets.txt."""
    rows = re.findall(r"^(?:merge|both)\s+(?:alone|lane)\s+(\S+)", (ROOT / "tests/suites/budgets.txt").read_text(), re.M)
    return [row for row in rows if row not in {"10-verdicts", "11-figures", "12-prolog", "14-page", "14-reference"}]


def failed_tests(output):
    names = re.findall(r"^\[  FAILED  \] (\w[\w/.]*\.\w[\w/]*)", output, re.M)
    return ", ".join(list(dict.fromkeys(names))[:3])


def stages(fault):
    """(name, command) in the order in which they look for it."""
    folder = re.escape(str(Path(fault["file"]).parent.relative_to("src/docent")))
    yield "unit tests", [*UNIT, "-R", rf"(^|\+){folder}(\+|$)"]
    yield "unit tests", UNIT
    for suite in suites():
        yield suite, [TREE / "tests/suites" / suite]


def run_stage(command):
    data = os.environ.get("DOCENT_DATA", str((ROOT / "../shared/data").resolve()))
    return run(*command, cwd=TREE, env={**os.environ, "DOCENT_DATA": data})


def found_by(fault):
    """(what a table says of the first stage that fails, its command), or None."""
    if build().returncode != 0:
        return "build", None
    for name, command in stages(fault):
        done = run_stage(command)
        if done.returncode != 0:
            tests = failed_tests(done.stdout)
            return (f"{name}: {tests}" if tests else name), command
    return None


def try_fault(fault):
    path = TREE / fault["file"]
    sound = path.read_text()
    if sound.count(fault["old"]) != 1:
        sys.exit(f"{fault['file']}: does not have once: {fault['old']}")
    path.write_text(sound.replace(fault["old"], fault["new"]))
    try:
        return found_by(fault)
    finally:
        path.write_text(sound)


def main(wanted):
    faults = yaml.safe_load(FAULTS.read_text())
    chosen = [fault for fault in faults if not wanted or fault["capability"] in wanted]
    if not chosen:
        sys.exit(f"check_mutants: there are {', '.join(fault['capability'] for fault in faults)}")
    prepare()
    if (whole := build()).returncode != 0:
        sys.exit(f"check_mutants: HEAD does not build\n{whole.stdout[-2000:]}")
    missed, used = 0, {}
    for fault in chosen:
        found = try_fault(fault)
        missed += found is None
        if found and found[1]:
            used[tuple(map(str, found[1]))] = found[0]
        print(f"| {fault['capability']} | {fault['what']} | {found[0] if found else '**not found**'} |", flush=True)
    build()
    for command, name in used.items():
        if run_stage(command).returncode != 0:
            print(f"{name}: fails without a fault, too")
            missed += 1
    print(f"{len(chosen) - missed} passed, {missed} failed")
    return missed


if __name__ == "__main__":
    sys.exit(1 if main(sys.argv[1:]) else 0)
