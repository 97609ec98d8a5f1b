"""Runs of the whole robot in a simulated museum, by the program `docent`.

The program does it, not this process: a run needs everything that Docent links, from the Web server to the speech, while the
package links the library alone; and a seed gives the same run as it gives on the command line.
"""
from __future__ import annotations

import csv
import json
import numbers
import operator
import os
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ._error import Error


@dataclass(frozen=True)
class Simulation:
    """What a run was worth.

    report: the deployment report, as `docent simulate --report` writes it. events: what happened and where the robot was
    then, a dictionary of texts for each row of `--event-log`, in the order of time.
    """

    report: dict[str, Any]
    events: list[dict[str, str]]


def find_program() -> str:
    """The program `docent`: $DOCENT_PROGRAM, else what is installed beside the package, else on the PATH."""
    if named := os.environ.get("DOCENT_PROGRAM"):
        return named
    # lib/python3/dist-packages/docent lies beside bin
    beside = Path(__file__).absolute().parents[4] / "bin" / "docent"
    if os.access(beside, os.X_OK):
        return str(beside)
    if found := shutil.which("docent"):
        return found
    raise Error("the program docent is neither installed beside the package nor on the PATH; DOCENT_PROGRAM may name it")


def _arguments(settings: dict[str, Any]) -> list[str]:
    """{"max_speed": 0.5, "no_cache": True, "set": ["a=1", "b=2"]} as options of the command line."""
    arguments = []
    for name, value in settings.items():
        option = "--" + name.rstrip("_").replace("_", "-")
        if value is True:
            arguments.append(option)
        elif isinstance(value, (list, tuple)):
            arguments += [f"{option}={one}" for one in value]
        elif value is not None and value is not False:
            arguments.append(f"{option}={value}")
    return arguments


def _checked(seed: int, minutes: float, options: dict[str, Any]) -> int:
    """The seed. What the program would misunderstand, or must be asked for in this way alone, goes no further."""
    if isinstance(seed, bool) or not hasattr(seed, "__index__"):
        raise TypeError(f"seed: a whole number is expected, not {type(seed).__name__}")
    if isinstance(minutes, bool) or not isinstance(minutes, numbers.Real):
        raise TypeError(f"minutes: a number is expected, not {type(minutes).__name__}")
    if not minutes > 0.0:
        raise ValueError("minutes: a number > 0 is expected")
    names = {name.rstrip("_").replace("-", "_") for name in options}
    if refused := {"hours", "report", "event_log", "quiet", "help", "version"} & names:
        raise TypeError(f"simulate() takes no {', '.join(sorted(refused))}")
    return operator.index(seed)


def _results(program: str, report: Path, events: Path) -> Simulation:
    try:
        with events.open(newline="", encoding="utf-8", errors="replace") as file:
            return Simulation(json.loads(report.read_text(encoding="utf-8", errors="replace")), list(csv.DictReader(file)))
    except FileNotFoundError as error:
        raise Error(f"{program}: wrote no report") from error
    except (ValueError, csv.Error) as error:
        raise Error(f"{program}: wrote a report that cannot be read: {error}") from error


def simulate(*, museum: str | os.PathLike[str] | None = None, seed: int = 1, crowd: str = "busy", minutes: float = 30.0,
             program: str | os.PathLike[str] | None = None, **options: Any) -> Simulation:
    """Runs the whole robot for some minutes of virtual time; the same seed gives the same run.

    museum: its folder; None: the one that is shipped. crowd: "empty", "quiet", "busy" or "packed". options: any other of
    `docent simulate --help`, by name: robot="robot.yaml", set=["section.key=value"], record="run.mcap".

    Error: what the program said of it.
    """
    seed = _checked(seed, minutes, options)
    with tempfile.TemporaryDirectory(prefix="docent-simulate-") as folder:
        report, events = Path(folder, "report.json"), Path(folder, "events.csv")
        wanted = {"museum": museum and os.fspath(museum), "seed": seed, "crowd": crowd, "hours": minutes / 60.0}
        command = [os.fspath(program or find_program()), "simulate", *_arguments({**wanted, **options}), "--quiet",
                   f"--report={report}", f"--event-log={events}"]
        try:
            done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", errors="replace",
                                  check=False)
        except OSError as error:
            raise Error(f"{command[0]}: {error.strerror}") from error
        if done.returncode != 0:
            lines = done.stderr.strip().splitlines() or [f"{command[0]} ended with {done.returncode}"]
            raise Error(lines[-1].removeprefix("docent: "))
        return _results(command[0], report, events)
