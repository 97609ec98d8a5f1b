#!/usr/bin/python3
"""Odd words on the command line and odd values in robot.yaml: docent says in a line what is wrong, or does it; it never breaks.

  odd_commands.py DOCENT [--runs N] [--seed S] [--replay K]

Every command of `docent --help` is called with its own options and values that people mistype or that somebody sends on purpose; robot.yaml is
that of `docent config` with single values spoilt. Wrong is: an end by a signal, a broken promise, an uncaught exception, a refusal without
a word, and whatever neither ends nor runs quietly. Run K of a seed is always the same.
"""
import argparse
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PATIENCE = 4.0  # [s] of a run; what still works then is ended as a person would, and must obey
OBEYS = 8.0  # [s] with sanitizers and many processes on a busy computer
NUMBERS = ["0", "-1", "1", "0.5", "-0.0", "1e308", "-1e308", "1e-320", "nan", "inf", "-inf", "99999999999999999999", "0x10", "1,5", "1e", "", " ", "true"]
# None of them leads out of the folder of a run but devices, for what is written there is written.
TEXTS = ["", " ", "my robot", "a/b", "sub/..", "-", "--", "-x", "é", "\u202eabc", "\U0001f916", "a" * 300, "x\ny", "x\ty", "%s%n", "$(date)", "'", '"',
         "\\", "*", "rt/cmd_vel", "name.with.dots", "1robot", "~", "/dev/null", "/dev/full", "nowhere/at/all", "README.md/x", ".", "museums/bonn",
         "museums/bonn/museum.yaml", "docs/robot.yaml", "README.md", "localhost", "127.0.0.1:1", ":::", "[::1]:8080", "host:99999", "host:-1"]
YAML_VALUES = ["", "~", "[]", "{}", "[1, 2", "{a: b}", "[[1, 2], [3]]", "yes", "'text'", '"\\u0000"', "!!binary aaaa", "&a [*a]", "*nothing", "|", "1e999", "-1", "0",
               "0.0000001", "1000000", "1e18", "nan", ".inf", "-.inf", "[.nan, .nan, .nan]", "front", "9223372036854775808", "'" + "é" * 200 + "'", "my robot", "a/b"]
BROKEN = re.compile(r"broken promise|terminate called|AddressSanitizer|runtime error:|Segmentation|std::|what\(\)|basic_string|vector::_M|\[json\.exception")
SHORT = {"simulate": ["--hours", "0.0005"], "explore": ["--hours", "0.0005"]}  # else a good call takes its time
# Calls that would change this computer or wait for a person.
LEFT_OUT = {"--port"}  # of the other programs here


def docent(binary, words, folder):
    """(exit code, or the negative number of a signal, output); ended after PATIENCE."""
    home = os.environ | {"HOME": folder, "XDG_STATE_HOME": folder, "XDG_CACHE_HOME": folder, "XDG_DATA_HOME": folder}
    child = subprocess.Popen([binary, *words], cwd=folder, env=home, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
    is_late = False
    try:
        output, _ = child.communicate(timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        is_late = True
        os.kill(child.pid, signal.SIGTERM)
        try:
            output, _ = child.communicate(timeout=OBEYS)
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, signal.SIGKILL)
            child.communicate()
            return "does not end", ""
    if is_late and child.returncode in (-signal.SIGTERM, 143):
        return 0, output.decode(errors="replace")
    return child.returncode, output.decode(errors="replace")


def commands_of(binary):
    """{command: [(option, takes a value)]}, as the help has them."""
    names = re.findall(r"^  ([a-z][a-z-]+) {2,}", subprocess.run([binary, "--help"], capture_output=True, text=True, check=True).stdout, re.M)
    found = {}
    for name in names:
        text = subprocess.run([binary, name, "--help"], capture_output=True, text=True, check=True).stdout
        if "Example:" not in text and binary.name != "breaks.sh":
            sys.exit(f"{name} --help has no example")
        found[name] = [(option, bool(kind.strip())) for option, kind in re.findall(r"^  (?:-\w,)?(--[a-z-]+)((?: [A-Z]+\S*)?)", text, re.M) if option not in LEFT_OUT]
    return found


def odd_call(draw, commands):
    name = draw.choice(sorted(commands))
    words = [name]
    for option, takes in draw.sample(commands[name], min(len(commands[name]), draw.randint(0, 3))):
        if option == "--help":
            continue
        words.append(option)
        if takes:
            words.append(draw.choice(NUMBERS if draw.random() < 0.4 else TEXTS))
    if draw.random() < 0.3:
        words.append(draw.choice(TEXTS))
    for option, value in zip(SHORT.get(name, [])[::2], SHORT.get(name, [])[1::2]):
        if option not in words:
            words += [option, value]
    return words, None


def odd_robot(draw, lines):
    """robot.yaml with one to three values spoilt."""
    spoilt = list(lines)
    places = [i for i, line in enumerate(lines) if re.match(r"\s*[\w-]+:", line)]
    for i in draw.sample(places, min(len(places), draw.randint(1, 3))):
        key = spoilt[i].split(":", 1)[0]
        kind = draw.random()
        if kind < 0.8:
            spoilt[i] = f"{key}: {draw.choice(YAML_VALUES)}"
        elif kind < 0.9:
            spoilt[i] = f"{key}x: 1"
        else:
            spoilt[i] = "\t" + spoilt[i]
    words = draw.choice([["config", "--robot", "robot.yaml"], ["check", "museums/bonn", "--robot", "robot.yaml"],
                         ["simulate", "--museum", "museums/bonn", "--robot", "robot.yaml", "--hours", "0.0005", "--crowd", "empty", "--quiet"]])
    return words, "\n".join(spoilt) + "\n"


def fault_of(code, output):
    if code == "does not end":
        return f"goes on {OBEYS:g} s after SIGTERM"
    if code < 0 or code >= 128:
        return f"ended by signal {-code if code < 0 else code - 128}"
    broken = BROKEN.search(output)
    if broken:
        return f"says '{broken.group(0)}'"
    if code != 0 and not output.strip():
        return f"refuses with {code} and without a word"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("docent", type=Path)
    parser.add_argument("--runs", type=int, default=120)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--replay", type=int, help="this run alone, with what it says")
    options = parser.parse_args()
    binary = options.docent.resolve()
    commands = commands_of(binary)
    lines = subprocess.run([binary, "config"], capture_output=True, text=True, check=True).stdout.splitlines()

    def one(number):
        draw = random.Random(f"{options.seed} {number}")
        words, robot = odd_call(draw, commands) if number % 2 else odd_robot(draw, lines)
        with tempfile.TemporaryDirectory(prefix="docent-odd-") as folder:
            for name in ("museums/bonn", "docs/robot.yaml", "README.md"):
                copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
                (Path(folder) / name).parent.mkdir(exist_ok=True)
                copy(ROOT / name, Path(folder) / name)
            if robot:
                (Path(folder) / "robot.yaml").write_text(robot, encoding="utf-8")
            words = [word for word in words if "\0" not in word]
            code, output = docent(binary, words, folder)
        return number, words, robot, code, output

    numbers = [options.replay] if options.replay is not None else range(options.runs)
    failed = refused = 0
    with ThreadPoolExecutor(2) as pool:
        for number, words, robot, code, output in pool.map(one, numbers):
            fault = fault_of(code, output)
            refused += code != 0
            if fault:
                failed += 1
                print(f"FAILED  run {number} of seed {options.seed}: {fault}: docent {' '.join(map(repr, words))}")
                if robot:
                    print("        " + "; ".join(line.strip() for line in robot.splitlines() if line not in lines))
                print("        " + "\n        ".join(output.strip().splitlines()[-3:]))
            elif options.replay is not None:
                print(f"docent {' '.join(map(repr, words))}\n{code}\n{output}")
    print(f"{refused} of {len(numbers)} were refused")
    if options.replay is None and not 0.2 * len(numbers) < refused < len(numbers):
        print("FAILED  these words are not odd enough, or nothing else works")
        failed += 1
    print(f"{len(numbers) - failed} passed, {failed} failed")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
