"""What the robot's eyes know of pictures that nobody here took: things on photographs, beside OpenCV's classifiers; the
floor in colour pictures beside a depth camera's; tags, and docking by one."""
import os
import subprocess
from pathlib import Path

from evaluation.tables import Verdict

PARTS = ["objects", "rgbd", "docking"]
BESIDE_OPENCV = "tests/objects_beside_opencv/docent_objects_test"
BESIDE_DEPTH = "tests/floor_beside_depth/docent_floor_test"
BY_TAG = "tests/docking_by_tag/docent_docking_test"


def run_test(build, program, data, **environment):
    """Builds a program of tests and runs it; what it prints is the table."""
    subprocess.run(["cmake", "--build", build, "--target", Path(program).name], check=True, stdout=subprocess.DEVNULL)
    return subprocess.run([build / program, "--gtest_brief=1"], env={**os.environ, "DOCENT_DATA": str(data), **environment}, check=False).returncode == 0


def objects(verdict, build, data):
    good = run_test(build, BESIDE_OPENCV, data)
    photographs = sum(1 for _ in (data / "vision" / "objects").glob("*/*.jpg"))
    verdict.want("things on photographs: known as well as OpenCV's discriminants and neighbours know them", f"{photographs} photographs",
                 good and photographs > 0)


def rgbd(verdict, build, data):
    good = run_test(build, BESIDE_DEPTH, data)
    frames = sum(1 for _ in (data / "vision" / "rgbd").glob("*.color.jpg"))
    verdict.want("floor by colour: IoU with depth's at least 0.85; distances to where it ends, by lines up to 3 m, within 10 % in 95 %",
                 f"{frames} frames", good and frames > 0)


def docking(verdict, build, data):
    runs = os.environ.get("DOCKING_RUNS", "100")
    good = run_test(build, BY_TAG, data, DOCKING_RUNS=runs)
    verdict.want("docking by tag from 30 degrees and 0.5 m: 99 % at the contacts, within 1 cm beside; tags of photographs found", f"{runs} approaches", good)


def protocol(build, root, part=None):
    """@param build  folder of the build; part: one of PARTS, None: all"""
    verdict = Verdict()
    data = Path(os.environ.get("DOCENT_DATA", root.parent / "shared" / "data"))
    for name, run in {"objects": objects, "rgbd": rgbd, "docking": docking}.items():
        if part in (None, name):
            run(verdict, build, data)
    verdict.print()
    return verdict
