#!/usr/bin/env python3
"""The architecture test: who may include whom, who may name the truth, what the project may not say.

The build gives every folder an include path of its own; this test also reads the CMake files, so that nobody widens a
DEPENDS against the arrows of the architecture.
"""
import re
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True  # the work tree stays as it was
from findings import check, report  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "src" / "docent"

# Lower layers first. A folder may depend on folders of its own layer or below.
LAYERS = [
    {"base"},
    {"geometry", "vocabulary"},
    {"grid"},
    {"pictures", "motion_models", "sensor_models", "messages", "museum", "robot"},
    {"localization", "mapping", "planning", "collision_avoidance", "people", "vision", "task_control", "interaction"},
    {"transport", "recording", "simulator", "telepresence", "evaluation"},
    {"modules"},
    {"apps"},
]
LAYER_OF = {name: i for i, names in enumerate(LAYERS) for name in names}
# Seen by modules and apps only (and among themselves where listed).
EDGE = {"transport", "recording", "simulator", "telepresence", "evaluation", "messages", "robot"}
EDGE_MAY_SEE = {
    "messages": {"base", "geometry"},
    "robot": {"base", "geometry"},
    "transport": {"base", "messages"},
    "recording": {"base", "geometry", "messages", "transport"},
    "telepresence": {"base", "geometry", "grid", "messages", "museum", "pictures", "vocabulary"},
    "evaluation": {"base", "geometry", "messages", "recording", "transport", "vocabulary"},
    # The world and the robot share no model: the simulator sees no capability, no museum, no robot configuration.
    "simulator": {"base", "geometry", "messages", "transport", "simulator", "pictures", "grid", "vocabulary"},
}
TRUTH = re.compile(r"kTrueState|kTrueContact|kTrueOffer|kRunInfo|for_each_truth_topic|\"truth/")
TRUTH_MAY = {"messages", "simulator", "evaluation", "recording", "apps", "transport"}


def top(folder):
    return folder.split("/")[0]


def folder_of(path):
    return path.parent.relative_to(SOURCE).as_posix()


def check_arrow(source, target, where):
    a, b = top(source), top(target)
    check(a in LAYER_OF, f"{where}: folder {a} stands in no layer")
    check(b in LAYER_OF, f"{where}: folder {b} stands in no layer")
    if a not in LAYER_OF or b not in LAYER_OF or a == b:
        return
    check(LAYER_OF[b] <= LAYER_OF[a], f"{where}: {source} may not see {target} (a higher layer)")
    if a in EDGE_MAY_SEE:
        check(b in EDGE_MAY_SEE[a], f"{where}: {source} may not see {target}")
    elif b in EDGE:
        check(a in {"modules", "apps"}, f"{where}: only modules and apps may see {target}, not {source}")
    if b == "simulator":
        check(a == "apps", f"{where}: only apps may see the simulator, not {source}")


def main():
    for path in sorted(SOURCE.rglob("*")):
        if path.suffix not in {".h", ".cpp"}:
            continue
        folder = folder_of(path)
        for number, line in enumerate(path.read_text().splitlines(), 1):
            where = f"{path.relative_to(ROOT)}:{number}"
            match = re.match(r'\s*#include "docent/(.+)/[^/]+"', line)
            if match:
                check_arrow(folder, match.group(1), where)
            if TRUTH.search(line) and not path.stem.endswith("_test"):
                check(top(folder) in TRUTH_MAY, f"{where}: {folder} names the truth")
    for cmake in sorted(SOURCE.rglob("CMakeLists.txt")):
        if cmake.parent == SOURCE:
            continue
        text = re.sub(r"#.*", "", cmake.read_text())
        for call in re.findall(r"docent_capability\(([^)]*)\)", text):
            words = call.split()
            folder = words[0]
            section = ""
            for word in words[1:]:
                if word in {"SOURCES", "HOT", "DEPENDS", "LIBRARIES", "TEST_DEPENDS", "TEST_LIBRARIES"}:
                    section = word
                elif section == "DEPENDS":
                    check_arrow(folder, word, f"{cmake.relative_to(ROOT)}")
    # A module never talks to another but by the bus.
    modules = SOURCE / "modules"
    if modules.is_dir():
        for path in modules.glob("*_module.cpp"):
            own = path.stem
            for other in re.findall(r'#include "docent/modules/(\w+_module)\.h"', path.read_text()):
                check(other == own, f"{path.relative_to(ROOT)}: includes another module, {other}")
    # Machine paths and registry hosts do not belong in the project.
    grep = subprocess.run(
        ["git", "grep", "-nIE", r"(^|[^A-Za-z0-9_.])/(work|farm)/|\"resolved\": \"http", "--", "."],
        cwd=ROOT, capture_output=True, text=True, check=False)
    for line in grep.stdout.splitlines():
        if "check_includes.py" not in line:
            check(False, f"a path or host of a machine: {line[:160]}")
    return report()


sys.exit(main())
