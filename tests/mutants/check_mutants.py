#!/usr/bin/env python3
"""Whether the merge tier finds faults that are put in on purpose (faults.yaml): check_mutants.py [CAPABILITY...]

Each fault is compiled into a copy of HEAD in build/mutants; the stages of scripts/test run on that in their order until one
fails. Prints a table of faults and the stages that found them. About two minutes a fault where a unit test finds it.
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
    return [row for row in rows if row not in {"10-verdicts", "11-figures", "12-prolog", "14-page"}]


def failed_tests(output):
    names = re.findall(r"^\[  FAILED  \] (\w[\w/.]*\.\w[\w/]*)", output, re.M)
    return ", ".join(list(dict.fromkeys(names))[:3])


def found_by():
    """The first stage that fails, or None."""
    if build().returncode != 0:
        return "build"
    unit = run(*UNIT, cwd=TREE)
    if unit.returncode != 0:
        return f"unit tests: {failed_tests(unit.stdout) or 'a program that ended'}"
    data = os.environ.get("DOCENT_DATA", str((ROOT / "../shared/data").resolve()))
    for suite in suites():
        if run(TREE / "tests/suites" / suite, cwd=TREE, env={**os.environ, "DOCENT_DATA": data}).returncode != 0:
            return suite
    return None


def main(wanted):
    faults = yaml.safe_load(FAULTS.read_text())
    chosen = [fault for fault in faults if not wanted or fault["capability"] in wanted]
    if not chosen:
        sys.exit(f"check_mutants: there are {', '.join(fault['capability'] for fault in faults)}")
    prepare()
    if (whole := build()).returncode != 0:
        sys.exit(f"check_mutants: HEAD does not build\n{whole.stdout[-2000:]}")
    if (stage := found_by()) is not None:
        sys.exit(f"check_mutants: HEAD itself fails without a fault: {stage}")
    missed = 0
    for fault in chosen:
        path = TREE / fault["file"]
        sound = path.read_text()
        if sound.count(fault["old"]) != 1:
            sys.exit(f"{fault['file']}: does not have once: {fault['old']}")
        path.write_text(sound.replace(fault["old"], fault["new"]))
        try:
            stage = found_by()
        finally:
            path.write_text(sound)
        missed += stage is None
        print(f"| {fault['capability']} | {fault['what']} | {stage or '**not found**'} |", flush=True)
    print(f"{len(chosen) - missed} passed, {missed} failed")
    return missed


if __name__ == "__main__":
    sys.exit(1 if main(sys.argv[1:]) else 0)
