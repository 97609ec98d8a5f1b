#!/usr/bin/env python3
"""The architecture test: which folder may include which, which may name the truth, in which namespace names stand, which
module publishes a topic that must have one publisher. And no file may hold a path of one machine or the host of a registry.

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
PUBLIC = ROOT / "include" / "docent"  # the public headers, in folders of the same names

# Lower layers first. A folder may depend on folders of its own layer or below.
LAYERS = [
    {"base"},
    {"geometry", "vocabulary"},
    {"grid"},
    {"pictures", "motion_models", "sensor_models", "messages", "museum", "robot"},
    {"localization", "mapping", "planning", "collision_avoidance", "people", "task_control", "interaction", "vision"},
    {"transport", "recording", "simulator", "telepresence", "visualization", "evaluation"},
    {"modules"},
    {"apps"},
]
# Subfolders that are layered too, the lower floors first. A subfolder may see those of lower floors, and no other.
FLOORS = {
    "collision_avoidance": [
        {"body", "clocks"},
        {"obstacle_field", "dynamic_window", "watches", "virtual_measurements"},
        {"local_planner", "expected_sweeps"},
        {"plausibility"},
        {"avoider"},
    ],
    "mapping": [
        {"occupancy", "scan_matching", "pose_graph", "sonar_network", "topological"},
        {"graph_mapping", "mount_calibration", "rooms"},
        {"expectation_maximization"},
    ],
    "localization": [
        {"belief", "expected_ranges"},
        {"beam_choice", "particles", "sonar/tracker"},
        {"judgement"},
        {"localizer"},
        {"markov", "pose_watch"},
        {"monte_carlo", "learning", "sonar/evidence"},
    ],
}
LAYER_OF = {name: i for i, names in enumerate(LAYERS) for name in names}
# Seen by modules and apps only (and among themselves where listed).
EDGE = {"transport", "recording", "simulator", "telepresence", "visualization", "evaluation", "messages", "robot"}
EDGE_MAY_SEE = {
    "messages": {"base", "geometry"},
    "robot": {"base", "geometry"},
    "transport": {"base", "messages"},
    "recording": {"base", "geometry", "messages", "motion_models", "transport"},
    "telepresence": {"base", "geometry", "grid", "messages", "museum", "pictures", "vocabulary"},
    "visualization": {"base", "geometry", "grid", "messages", "museum"},
    "evaluation": {"base", "geometry", "messages", "recording", "transport", "vocabulary"},
    # The world and the robot share no model: the simulator sees no capability, no museum, no robot configuration.
    "simulator": {"base", "geometry", "messages", "transport", "simulator", "pictures", "grid", "vocabulary"},
}
# What every folder speaks stands in `docent` itself; the names of each other folder in a namespace that is called like it.
COMMON = {"base", "geometry", "vocabulary", "grid", "messages"}
# The folders of these see no other one of their own, but `shared` and what lies within them; what starts them all sees all.
APART = {"modules": {"modules/host"}, "apps": {"apps", "apps/laboratory"}}
TRUTH = re.compile(r"kTrueState|kTrueContact|kTrueOffer|kRunInfo|for_each_truth_topic|\"truth/")
TRUTH_MAY = {"messages", "simulator", "evaluation", "recording", "apps", "transport"}
CODE = {".h", ".cpp", ".inc"}
# What cripples a robot: the laboratory's own.
ABLATIONS = re.compile(r"\bAblationParams\b|\bEvaluationParams\b|\bCrippledRobot\b|\bablations::|\bevaluation\(\)")
# The modules that may publish a topic that must have one publisher (architecture 10.7); its name as topics.h has it.
ONE_PUBLISHER = {"docent/drive": "avoid_module.cpp"}


def top(folder):
    return folder.split("/")[0]


def below(path, root):
    """A path as it is included, from the folder of sources or that of public headers."""
    return path.relative_to(PUBLIC if path.is_relative_to(PUBLIC) else root)


def all_files(root):
    """Those of a folder of sources; with SOURCE itself the public headers, too."""
    return sorted(root.rglob("*")) + (sorted(PUBLIC.rglob("*")) if root == SOURCE else [])


def folder_of(path):
    return below(path, SOURCE).parent.as_posix()


def check_floors(source, target, where):
    """Whether a folder may see another one inside the same top folder."""
    floors = FLOORS.get(top(source))
    if floors is None or source == target:
        return
    floor_of = {f"{top(source)}/{room}": i for i, rooms in enumerate(floors) for room in rooms}
    for folder in (source, target):
        check(folder in floor_of, f"{where}: room {folder} stands on no floor")
    if source in floor_of and target in floor_of:
        check(floor_of[target] < floor_of[source], f"{where}: {source} may not see {target} (no lower floor)")


def check_arrow(source, target, where):
    a, b = top(source), top(target)
    if a == b and not re.search(r"(_test|_benchmark)\.cpp:|/testing\.h:", where):
        check_floors(source, target, where)
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


def check_apart(source, target, where):
    is_own = target == source or target.startswith(source + "/")
    if top(source) == top(target) and top(source) in APART and not is_own and source not in APART[top(source)]:
        check(target == f"{top(source)}/shared", f"{where}: {source} may not see {target}, only {top(source)}/shared")


def check_namespaces(root, common):
    for path in all_files(root):
        if path.suffix not in CODE or path.parent == root:
            continue
        folder = below(path, root).parts[0]
        for name in re.findall(r"^namespace (docent\b[\w:]*) \{$", path.read_text(), re.M):
            parts = name.split("::")
            wanted = [] if folder in common else [folder]
            right = parts[1:2] == wanted or folder in common and parts[1:] in (["docent_msgs"], [path.stem])  # a test's own
            check(right, f"{below(path, root)}: namespace {name} in folder {folder}")


def check_types(root):
    """No two headers give two types one full name: the linker would take the functions of one for those of the other."""
    defined = {}
    for path in (path for path in all_files(root) if path.suffix == ".h"):
        namespaces = []
        for line in path.read_text().splitlines():
            if found := re.match(r"namespace ([\w:]+) \{$", line):
                namespaces.append(found[1])
            elif line.startswith("}  // namespace"):
                namespaces.pop()
            elif found := re.match(r"(?:struct|class|enum|enum class) (\w+)(?: final)?(?: : .*)? \{", line):
                name = "::".join([*namespaces, found[1]])
                other = defined.setdefault(name, path)
                check(other == path, f"{below(path, root)}: {name} is defined in {below(other, root)}, too")


def component_folders(table):
    """The folders of src/docent that belong to the library, by the table of its components."""
    return [folder for found in re.findall(r"docent_component\(\w+\s+FOLDERS\s+([\w/\s]+?)(?:\s[A-Z]+\s|\))", table.read_text())
            for folder in found.split()]


def check_public(public, source, table):
    """Each public header lies in a folder of a component, beside which src has the same folder; there is no second one of its name."""
    folders = component_folders(table)
    for path in sorted(public.rglob("*")):
        if path.is_dir():
            continue
        name = path.relative_to(public)
        folder = name.parent.as_posix()
        check(path.suffix == ".h", f"include/docent/{name}: is no header")
        check(any(folder == root or folder.startswith(root + "/") for root in folders),
              f"include/docent/{name}: {folder} belongs to no component of {table.name}")
        check((source / folder).is_dir(), f"include/docent/{name}: src/docent/{folder} is not there")
        check(not (source / name).exists(), f"include/docent/{name}: src/docent has it, too")


def sources(root):
    """(path, text) of all code that is no test."""
    return [(path, path.read_text()) for path in all_files(root)
            if path.suffix in CODE and not path.stem.endswith(("_test", "_benchmark", "_fuzzer"))]


def check_sources():
    for path in all_files(SOURCE):
        if path.suffix not in CODE:
            continue
        folder = folder_of(path)
        for number, line in enumerate(path.read_text().splitlines(), 1):
            where = f"{path.relative_to(ROOT)}:{number}"
            match = re.match(r'\s*#include "docent/(.+)/[^/]+"', line)
            if match:
                check_arrow(folder, match.group(1), where)
                if not path.stem.endswith("_test"):
                    check_apart(folder, match.group(1), where)
            if TRUTH.search(line) and not path.stem.endswith("_test"):
                check(top(folder) in TRUTH_MAY, f"{where}: {folder} names the truth")


def check_dependencies():
    for cmake in sorted(SOURCE.rglob("CMakeLists.txt")):
        if cmake.parent == SOURCE:
            continue
        text = re.sub(r"#.*", "", cmake.read_text())
        for call in re.findall(r"docent_capability\(([^)]*)\)", text):
            words = call.split()
            folder = words[0]
            section = ""
            for word in words[1:]:
                if word in {"SOURCES", "HOT", "LABORATORY", "DEPENDS", "LIBRARIES", "TEST_DEPENDS", "TEST_LIBRARIES"}:
                    section = word
                elif section == "DEPENDS":
                    check_arrow(folder, word, f"{cmake.relative_to(ROOT)}")
                    check_apart(folder, word, f"{cmake.relative_to(ROOT)}")


def check_laboratory(root):
    """What only docent-lab needs (keyword LABORATORY) is seen by such folders alone, so that `docent` compiles none of it; and
    nothing else knows of the switches that cripple a robot."""
    sees, laboratory = {}, set()
    for cmake in sorted(root.rglob("CMakeLists.txt")):
        for call in re.findall(r"docent_capability\(([^)]*)\)", re.sub(r"#.*", "", cmake.read_text())):
            folder, *words = call.split()
            sees[folder] = words
            if words[:1] == ["LABORATORY"]:
                laboratory.add(folder)
    for folder, words in sees.items():
        for word in words:
            check(folder in laboratory or word not in laboratory, f"{folder}: is no LABORATORY folder and depends on {word}, which is one")
    for path, text in sources(root):
        folder = below(path, root).parent.as_posix()
        for other in re.findall(r'#include "docent/(.+)/[^/\n]+"', text):
            check(folder in laboratory or other not in laboratory, f"{below(path, root)}: no LABORATORY folder, includes {other}, which is one")
        named = ABLATIONS.search(text)
        check(folder in laboratory or not named, f"{below(path, root)}: no LABORATORY folder, names {named and named[0]}")


def check_modules():
    """A module never talks to another but by the bus."""
    for path in sorted((SOURCE / "modules").rglob("*_module.cpp")):
        for other in re.findall(r'#include "docent/modules/(?:\w+/)*(\w+_module)\.h"', path.read_text()):
            check(other == path.stem, f"{path.relative_to(ROOT)}: includes another module, {other}")


def check_publishers(root, topics_header, one_publisher):
    """A topic on which robots depend has one publisher, and only its own header spells its name."""
    topics = topics_header.read_text()
    for topic, owner in one_publisher.items():
        constant = re.search(rf'\b(k\w+)\{{"{topic}"', topics)
        check(constant, f"{topics_header.name}: there is no {topic}")
        if not constant:
            continue
        publisher = re.compile(rf"\bpublisher(?:<[^()]*>)?\(\s*(?:\w+::)*{constant[1]}\b")
        publishers = [path for path, text in sources(root) for _ in publisher.findall(text)]
        names = ", ".join(below(path, root).as_posix() for path in publishers)
        check([path.name for path in publishers] == [owner], f"{topic}: published by {names or 'nobody'}, not by {owner} alone")
        for path, text in sources(root):
            check(path == topics_header or f'"{topic}"' not in text, f"{below(path, root)}: spells {topic} itself")


def check_machines():
    """Machine paths and registry hosts do not belong in the project."""
    grep = subprocess.run(
        ["git", "grep", "-nIE", r"(^|[^A-Za-z0-9_.])/(work|farm)/|\"resolved\": \"http", "--", "."],
        cwd=ROOT, capture_output=True, text=True, check=False)
    for line in grep.stdout.splitlines():
        if "check_includes.py" not in line:
            check(False, f"a path or host of a machine: {line[:160]}")


if __name__ == "__main__":
    check_sources()
    check_dependencies()
    check_laboratory(SOURCE)
    check_modules()
    check_namespaces(SOURCE, COMMON)
    check_types(SOURCE)
    check_public(PUBLIC, SOURCE, ROOT / "cmake" / "DocentComponents.cmake")
    check_publishers(SOURCE, PUBLIC / "messages" / "topics.h", ONE_PUBLISHER)
    check_machines()
    sys.exit(report())
