#!/usr/bin/env python3
"""Tour programs that never answer, take all memory, halt or hold typing errors: each is named, and the robot guides on.

    tests/golog/hostile_programs.py DOCENT [--only NAME]... [--minutes M]

Each runs as the program of the museum in Bonn, in an empty hall with wishes. The shipped program must be called faulty in none.
"""
import argparse
import csv
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RUN = "proc(main, [?(some(E, due(E))), ?(go_wrong)]).\n"
# name: program, and words of the fault
PROGRAMS = {
    "recursion": (RUN + "go_wrong :- go_wrong.\n", "inferences"),
    "repeat": (RUN + "go_wrong :- repeat, fail.\n", "inferences"),
    "a loop of GOLOG": ("proc(main, while(true, ?(true))).\n", "inferences"),
    "sleep": (RUN + "go_wrong :- sleep(1000000).\n", "gave no answer"),
    "a message that never comes": (RUN + "go_wrong :- thread_self(Me), thread_get_message(Me, word).\n", "gave no answer"),
    "another thread": (RUN + "go_wrong :- thread_create((repeat, fail), _), sleep(1000000).\n", "gave no answer"),
    "an endless directive": (":- repeat, fail.\n" + RUN + "go_wrong.\n", "gave no answer"),
    "a directive that sleeps": (":- sleep(1000000).\n" + RUN + "go_wrong.\n", "gave no answer"),
    "to and fro": ("proc(main, [?(some(E, due(E))), while(true, [drive(home), wait_a_little])]).\nproc(wait_a_little, within(0, ?(closing))).\n", "comes to no end"),
    "a list that grows": (RUN + "go_wrong :- grow([]).\ngrow(L) :- grow([L, L | L]).\n", "Stack limit"),
    "an atom that grows": (RUN + "go_wrong :- grow(x).\ngrow(A) :- atom_concat(A, A, B), grow(B).\n", "no memory"),
    "all solutions of repeat": (RUN + "go_wrong :- findall(x, repeat, L), length(L, _).\n", "Stack limit"),
    "a number that grows": (RUN + "go_wrong :- X is 7 ** (7 ** 12), X > 0.\n", "Stack limit"),
    "halt": (RUN + "go_wrong :- halt.\n", "halt, exit status 0"),
    "a directive that halts": (":- halt(3).\n" + RUN + "go_wrong.\n", "exit status 3"),
    "abort": (RUN + "go_wrong :- abort.\n", "ended by the program itself"),
    "a broken Prolog": (RUN + "go_wrong :- current_prolog_flag(pid, P), format(atom(C), 'kill -SEGV ~d', [P]), shell(C), sleep(9).\n", "SIGSEGV"),
    "words on the line": (RUN + "go_wrong :- forall(stream_property(S, file_no(1)), (write(S, 'l9:x'), flush_output(S))).\n", "what is no value"),
    "a bracket that is missing": ("proc(main, [goto(home)).\n", "tour.pl:1"),
    "an unknown action": ("proc(main, jump).\n", "jump is neither an action nor a procedure"),
    "an unknown place": ("proc(main, drive(e99)).\n", "there is no place"),
    "another language": ("def main():\n    drive('zuse')\n", "tour.pl:2: Syntax error"),
    "an exception": (RUN + "go_wrong :- throw(nonsense).\n", "the program throws nonsense"),
}


def run(docent, program, minutes, folder):
    """@returns what the mission was called for, and the report."""
    museum = folder / "bonn"
    shutil.copytree(ROOT / "museums/bonn", museum)
    if program:
        (museum / "tour.pl").write_text(program, encoding="utf-8")
    done = subprocess.run([docent, "simulate", "--museum", museum, "--crowd", "empty", "--hours", f"{minutes / 60:g}", "--requests-per-hour", "120",
                           "--set", "mission.planner=golog", "--health-log", folder / "health.csv", "--report", folder / "report.json"],
                          capture_output=True, text=True, timeout=600, check=False)
    if done.returncode != 0:
        return [f"the robot ended with {done.returncode}: {done.stderr.strip()[-300:]}"], None
    with open(folder / "health.csv", newline="", encoding="utf-8") as file:
        said = [row["reason"] for row in csv.DictReader(file) if row["module"] == "mission"]
    return said, json.loads((folder / "report.json").read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("docent")
    parser.add_argument("--only", action="append", choices=PROGRAMS)
    parser.add_argument("--minutes", type=float, default=6)
    options = parser.parse_args()
    chosen = options.only or list(PROGRAMS)
    failed = 0
    for name in ["the shipped one", *chosen]:
        program, words = PROGRAMS.get(name, ("", ""))
        with tempfile.TemporaryDirectory(prefix="docent-golog-") as folder:
            said, report = run(options.docent, program, options.minutes, Path(folder))
        served = report["requests"]["fulfilled"] if report else 0
        faults = [reason for reason in said if "tour.pl" in reason or "the program" in reason]  # commas are semicolons there
        is_named = any(words.replace(",", ";") in reason for reason in faults) if program else not faults
        good = is_named and served >= 1
        failed += not good
        print(f"{'pass' if good else 'FAIL'}  {name}: {served} wishes fulfilled; {faults[0] if faults else (said or ['nothing said'])[0]}", flush=True)
    print(f"{len(chosen) + 1 - failed} passed, {failed} failed")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
