#!/usr/bin/env python3
"""Bad input of every kind: the program says why in one line, naming the file (and the line where it has lines), exits
with another code than 0, and leaves nothing half written."""
import os
import shutil
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCENT = Path(os.environ.get("DOCENT_BINARY", ROOT / "build/dev/bin/docent"))
work = Path(tempfile.mkdtemp(prefix="docent-bad-input-"))
passed = failed = 0


def case(name, arguments, *wanted, leaves_nothing=None, many=False):
    """Runs docent; every text in `wanted` must stand in the one line it prints. `many`: it lists all faults, a line each."""
    global passed, failed
    done = subprocess.run([DOCENT, *map(str, arguments)], capture_output=True, text=True, timeout=60, check=False,
                          stdin=subprocess.DEVNULL, cwd=work)
    lines = [line for line in done.stderr.splitlines() if line.strip()]
    faults = []
    if done.returncode == 0:
        faults.append("exit code 0")
    if done.returncode < 0:
        faults.append(f"ended by signal {-done.returncode}")
    if len(lines) != 1 and not many:
        faults.append(f"{len(lines)} lines instead of one")
    for text in wanted:
        if text not in done.stderr:
            faults.append(f"does not say '{text}'")
    if leaves_nothing and list(work.glob(leaves_nothing + "*")):
        faults.append(f"left {leaves_nothing}")
    if faults:
        failed += 1
        print(f"FAIL {name}: {'; '.join(faults)}\n     {done.stderr.strip()[:400]}")
    else:
        passed += 1


def write(name, text):
    path = work / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def museum_with(name, old, new, file="museum.yaml"):
    """A copy of the museum of Bonn in which `old` is `new`; returns its folder and the line of the change."""
    folder = work / name
    shutil.copytree(ROOT / "museums/bonn", folder)
    text = (folder / file).read_text()
    assert old in text, f"{name}: '{old}' does not stand in {file}"
    (folder / file).write_text(text.replace(old, new, 1))
    return folder, text[: text.index(old)].count("\n") + 1


def museums():
    changes = [
        ("unknown key", "languages:", "langauges:", "'languages'"),
        ("tab", "home: {x:", "home:\t{x", ""),
        ("home is text", "home: {x: 9.0", "home: {x: nine", "number"),
        ("unknown hazard kind", "kind: stairs", "kind: lava", "lava"),
        ("unknown language", "languages: [en, de]", "languages: [en, xx]", ""),
        ("no map", "map: map.yaml", "map: none.yaml", "none.yaml"),
        ("exhibit twice", "id: cyclotron", "id: particle-trap", "particle-trap"),
        ("text missing", "content/cyclotron.short.en.md", "content/none.md", "none.md"),
    ]
    for name, old, new, says in changes:
        folder, _ = museum_with("museum-" + name.replace(" ", "-"), old, new)
        case("museum: " + name, ["simulate", "--museum", folder, "--hours", "0.001"], "museum.yaml:" if "map:" not in old else "", says)
        case("check: " + name, ["check", folder], "museum.yaml:" if "map:" not in old else "", says, many=True)
    case("museum: no folder", ["simulate", "--museum", work / "nowhere"], "nowhere")
    case("museum: empty folder", ["check", work], "museum.yaml", many=True)
    write("not-a-folder", "x")
    case("museum: a file", ["check", work / "not-a-folder"], "not-a-folder", many=True)
    folder, line = museum_with("world-unknown-kind", "kind: plate", "kind: cake", "simulation.yaml")
    case("simulation.yaml: unknown kind", ["simulate", "--museum", folder, "--hours", "0.001"], f"simulation.yaml:{line}:", "cake")
    folder, line = museum_with("world-unknown-key", "entrances:", "enterances:", "simulation.yaml")
    case("simulation.yaml: unknown key", ["simulate", "--museum", folder, "--hours", "0.001"], f"simulation.yaml:{line}:", "enterances")


def maps():
    plan = ["--from", "1,1", "--to", "2,2"]
    good = write("good.pgm", b"P5\n2 2\n255\nabcd")
    assert good
    header = "resolution: 0.1\norigin: [0, 0, 0]\n"
    case("map: no file", ["plan", "--map", work / "none.yaml", *plan], "none.yaml")
    case("map: no image", ["plan", "--map", write("m1.yaml", "image: none.pgm\n" + header), *plan], "m1.yaml:1:", "none.pgm")
    case("map: no resolution", ["plan", "--map", write("m2.yaml", "image: good.pgm\norigin: [0, 0, 0]\n"), *plan], "m2.yaml:1:", "resolution")
    case("map: resolution 0", ["plan", "--map", write("m3.yaml", "image: good.pgm\nresolution: 0\norigin: [0, 0, 0]\n"), *plan], "m3.yaml:2:")
    case("map: origin of two", ["plan", "--map", write("m4.yaml", "image: good.pgm\nresolution: 0.1\norigin: [0, 0]\n"), *plan], "m4.yaml:3:")
    case("map: unknown key", ["plan", "--map", write("m5.yaml", "image: good.pgm\ncolour: red\n" + header), *plan], "m5.yaml:2:", "colour")
    case("map: not YAML", ["plan", "--map", write("m6.yaml", "image: [\n"), *plan], "m6.yaml:")
    write("short.pgm", b"P5\n20 20\n255\nabcd")
    case("map: image ends early", ["plan", "--map", write("m7.yaml", "image: short.pgm\n" + header), *plan], "short.pgm:4:", "ends early")
    write("huge.pgm", b"P5\n999999 999999\n255\n")
    case("map: image too large", ["plan", "--map", write("m8.yaml", "image: huge.pgm\n" + header), *plan], "huge.pgm:")
    write("text.png", "no image at all, only words")
    case("map: not an image", ["plan", "--map", write("m9.yaml", "image: text.png\n" + header), *plan], "text.png:1:")


def logs():
    map_yaml = ROOT / "museums/bonn/map.yaml"
    def localize(name, log, *says):
        case("log: " + name, ["localize", "--map", map_yaml, "--log", log], *says)
    localize("no file", work / "none.log", "none.log")
    localize("empty", write("empty.log", ""), "empty.log")
    localize("only comments", write("comments.log", "# nothing\n# here\n"), "comments.log")
    localize("too few beams", write("few.log", "# one\nFLASER 180 1.0 2.0\n"), "few.log:2:")
    localize("a word for a number", write("word.log", "FLASER 2 1.0 far 0 0 0 0 0 0 0 nohost 0\n"), "word.log:1:")
    localize("negative count", write("negative.log", "FLASER -3 0 0 0 0 0 0 0 nohost 0\n"), "negative.log:1:")
    localize("not gzip", write("broken.log.gz", b"\x1f\x8b\x08\x00garbage garbage"), "broken.log.gz")
    localize("a folder", work, "holds no")


def configurations():
    simulate = ["simulate", "--museum", ROOT / "museums/bonn", "--hours", "0.001"]
    case("robot.yaml: no file", [*simulate, "--robot", work / "none.yaml"], "none.yaml")
    case("robot.yaml: unknown section", [*simulate, "--robot", write("r1.yaml", "body: {}\nwings: {}\n")], "r1.yaml:2:", "wings")
    case("robot.yaml: unknown key", [*simulate, "--robot", write("r2.yaml", "localize:\n  beems: 3\n")], "r2.yaml:2:", "beems")
    case("robot.yaml: out of range", [*simulate, "--robot", write("r3.yaml", "localize:\n  beams: 0\n")], "r3.yaml:", "beams")
    case("robot.yaml: a word for a number", [*simulate, "--robot", write("r4.yaml", "body:\n  radius: wide\n")], "r4.yaml:2:", "wide")
    case("robot.yaml: not YAML", [*simulate, "--robot", write("r5.yaml", "body: {\n")], "r5.yaml:")
    case("--set without a value", [*simulate, "--set", "localize.beams"], "localize.beams")
    case("--set of an unknown section", [*simulate, "--set", "wings.span=2"], "wings")
    case("--set of an unknown key", [*simulate, "--set", "plan.speed=2"], "speed")
    case("--start in words", [*simulate, "--start", "here"], "--start")
    case("--start in a wall", [*simulate, "--start", "-50,-50,0"], "start")
    case("--crowd unknown", [*simulate, "--crowd", "mob"], "mob")
    case("--mode unknown", [*simulate, "--mode", "turbo"], "turbo")
    case("--hours 0", ["simulate", "--hours", "0"], "--hours")
    case("--hours negative", ["simulate", "--hours", "-1"], "--hours")
    case("unknown option", ["simulate", "--sped", "3"], "--sped")
    case("no command", [], "docent")
    case("unknown command", ["fly"], "fly")
    case("report where no folder is", [*simulate, "--quiet", "--report", work / "nowhere-at-all/where.json"], "where.json", leaves_nothing="nowhere-at-all")
    case("recording where no folder is", [*simulate, "--quiet", "--record", work / "nowhere-at-all/where.mcap"], "where.mcap", leaves_nothing="nowhere-at-all")


def scenarios():
    def scenario(name, text, *says):
        path = write(f"s-{name.replace(' ', '-')}.yaml", text)
        case("scenario: " + name, ["simulate", "--museum", ROOT / "museums/bonn", "--hours", "0.001", "--scenario", path], path.name + ":", *says)
    scenario("unknown event", "events:\n  - {at: 1, explode: {}}\n", ":2:", "explode")
    scenario("no time", "events:\n  - {kidnap: {}}\n", ":2:")
    scenario("negative time", "events:\n  - {at: -3, kidnap: {}}\n", ":2:")
    scenario("unknown sensor", "events:\n  - {at: 1, fault: {sensor: nose, kind: dead}}\n", ":2:", "nose")
    scenario("not a list", "events: 3\n", ":1:")
    scenario("unknown key", "happenings: []\n", ":1:", "happenings")
    scenario("not YAML", "events: [\n")


def recordings():
    case("recording: no file", ["evaluate", work / "none.mcap"], "none.mcap")
    case("recording: empty", ["evaluate", write("empty.mcap", "")], "empty.mcap")
    case("recording: other bytes", ["evaluate", write("other.mcap", "this is no recording" * 50)], "other.mcap")
    case("recording: only the magic", ["evaluate", write("magic.mcap", b"\x89MCAP0\r\n")], "magic.mcap")
    case("replay: no file", ["replay", work / "none.mcap"], "none.mcap")


def ports():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        case("up: port in use", ["up", "--sim", "--museum", ROOT / "museums/bonn", "--state", work / "state", "--port", port, "--domain", "71"], str(port))
    case("up: port of words", ["up", "--sim", "--port", "http"], "--port")
    case("up: no museum", ["up", "--sim", "--museum", work / "nowhere"], "nowhere")
    case("run: unknown module", ["run", "soul", "--museum", ROOT / "museums/bonn", "--state", work / "state", "--domain", "71"], "soul")


for group in (museums, maps, logs, configurations, scenarios, recordings, ports):
    group()
shutil.rmtree(work)
print(f"{passed} passed, {failed} failed")
sys.exit(1 if failed else 0)
