"""How the program is called, with one that says what it was asked for; the robot's own runs are the program's tests."""
import os
import stat

import numpy
import pytest

import docent

SAYS = """#!/usr/bin/python3
import json, sys
options = dict(argument.split("=", 1) for argument in sys.argv[2:] if "=" in argument)
json.dump({"asked": sys.argv[1:]}, open(options["--report"], "w"))
open(options["--event-log"], "w").write("time,kind\\n1.0,started\\n2.5,arrived\\n")
"""
FAILS = """#!/bin/sh
echo "docent: nowhere/museum.yaml: cannot be read" >&2
exit 1
"""


def program(tmp_path, text):
    path = tmp_path / "docent"
    path.write_text(text)
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


def test_report_and_events(tmp_path):
    run = docent.simulate(museum=tmp_path, seed=7, crowd="quiet", minutes=3, program=program(tmp_path, SAYS), max_speed=0.5,
                          set=["a.b=1", "c.d=2"], profile=True, robot=None)
    asked = run.report["asked"]
    assert asked[0] == "simulate" and f"--museum={tmp_path}" in asked and "--seed=7" in asked and "--hours=0.05" in asked
    assert "--set=a.b=1" in asked and "--set=c.d=2" in asked and "--max-speed=0.5" in asked and "--profile" in asked
    assert not any(argument.startswith("--robot") for argument in asked)
    assert run.events == [{"time": "1.0", "kind": "started"}, {"time": "2.5", "kind": "arrived"}]


def test_errors_are_those_of_the_program(tmp_path):
    with pytest.raises(docent.Error) as raised:
        docent.simulate(program=program(tmp_path, FAILS))
    assert str(raised.value) == "nowhere/museum.yaml: cannot be read" and raised.value.file == "nowhere/museum.yaml"
    with pytest.raises(docent.Error, match="No such file"):
        docent.simulate(program=tmp_path / "none")


def test_arguments():
    with pytest.raises(ValueError, match="minutes"):
        docent.simulate(minutes=0)
    with pytest.raises(ValueError, match="minutes"):
        docent.simulate(minutes=float("nan"))
    for taken in ["report", "event_log", "event-log", "quiet", "hours", "help", "version", "help_"]:
        with pytest.raises(TypeError, match=f"simulate.. takes no {taken.replace('-', '_').rstrip('_')}"):
            docent.simulate(**{taken: "mine.json"})
    for minutes in ["5", None, True, [5]]:
        with pytest.raises(TypeError, match=f"minutes: .*not {type(minutes).__name__}"):
            docent.simulate(minutes=minutes)
    for seed in [True, "7", 7.0, None]:
        with pytest.raises(TypeError, match=f"seed: .*not {type(seed).__name__}"):
            docent.simulate(seed=seed)


def test_numbers_of_numpy(tmp_path):
    run = docent.simulate(seed=numpy.uint8(7), minutes=numpy.float32(3), program=program(tmp_path, SAYS))
    assert "--seed=7" in run.report["asked"] and "--hours=0.05" in run.report["asked"]


@pytest.mark.parametrize("text, said", [
    ("#!/bin/sh\nexit 0\n", "docent: wrote no report$"),
    ("#!/bin/sh\nprintf 'odd \\377 text\\n' >&2\nexit 3\n", "^odd \ufffd text$"),
    ("#!/bin/sh\nprintf '\\377'\nexit 3\n", "docent ended with 3$"),
    (SAYS.replace('json.dump({"asked": sys.argv[1:]}, open(options["--report"], "w"))', 'open(options["--report"], "w")'),
     "docent: wrote a report that cannot be read"),
])
def test_programs_that_are_not_docent(tmp_path, text, said):
    with pytest.raises(docent.Error, match=said):
        docent.simulate(program=program(tmp_path, text))


def test_where_the_program_is(tmp_path, monkeypatch):
    monkeypatch.setenv("DOCENT_PROGRAM", "/somewhere/docent")
    assert docent.find_program() == "/somewhere/docent"
    monkeypatch.delenv("DOCENT_PROGRAM")
    monkeypatch.setenv("PATH", str(program(tmp_path, SAYS).parent) + os.pathsep + os.environ["PATH"])
    found = docent.find_program()
    assert os.access(found, os.X_OK) and found.endswith("/docent")


def test_the_program_itself():
    """Beside the package, where it is built and installed."""
    runs = [docent.simulate(museum="museums/bonn", seed=7, crowd="quiet", minutes=0.3) for _ in range(2)]
    assert runs[0].report["seed"] == 7 and runs[0].report["museum"] == "bonn"
    assert runs[0].report["virtual_seconds"] == pytest.approx(18.0, abs=0.2)
    assert runs[0].events == runs[1].events and len(runs[0].events) > 0
    with pytest.raises(docent.Error, match="nowhere"):
        docent.simulate(museum="museums/nowhere", minutes=0.1)
