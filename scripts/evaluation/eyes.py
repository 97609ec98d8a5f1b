"""What the robot's eyes know of pictures that nobody here took: things on photographs, beside OpenCV's classifiers."""
import os
import subprocess
from pathlib import Path

from evaluation.tables import Verdict

PARTS = ["objects"]
BESIDE_OPENCV = "tests/objects_beside_opencv/docent_objects_test"


def protocol(build, root, options):
    """@param build  folder of the build"""
    verdict = Verdict()
    data = Path(os.environ.get("DOCENT_DATA", root.parent / "shared" / "data"))
    if options.part not in ("", None, "objects"):
        return verdict
    program = build / BESIDE_OPENCV
    subprocess.run(["cmake", "--build", build, "--target", program.name], check=True, stdout=subprocess.DEVNULL)
    done = subprocess.run([program, "--gtest_brief=1"], env={**os.environ, "DOCENT_DATA": str(data)}, check=False)
    photographs = sum(1 for _ in (data / "vision" / "objects").glob("*/*.jpg"))
    verdict.want("things on photographs: known as well as OpenCV's discriminants and neighbours know them", f"{photographs} photographs",
                 done.returncode == 0 and photographs > 0)
    verdict.print()
    return verdict
