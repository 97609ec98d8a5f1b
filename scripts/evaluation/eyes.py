"""What the robot's eyes make of pictures: things on photographs, beside OpenCV's classifiers; a ride under a real ceiling; mosaics of drawn ones; the
floor in colour pictures beside a depth camera's; tags, and docking by one."""
import os
import re
import subprocess
from pathlib import Path

from evaluation import ceilings, eyes_ceiling, eyes_dock, eyes_office, eyes_packed, eyes_sight
from evaluation.tables import Verdict, print_table

PARTS = ["objects", "real-ceiling", "mosaic", "rgbd", "docking", "dock", "things", "stairs", "ceiling", "packed", "office"]
BESIDE_OPENCV = "tests/objects_beside_opencv/docent_objects_test"
BESIDE_DEPTH = "tests/floor_beside_depth/docent_floor_test"
BY_TAG = "tests/docking_by_tag/docent_docking_test"
DRAWN_CEILINGS = "tests/drawn_ceilings/docent_drawn_ceilings_test"
REAL_CEILING = "tests/real_ceiling/docent_real_ceiling_test"
NEAR = 0.05  # [m]
UPDATE = 1000  # [us]
RMS = 0.03  # [m]
SECONDS = 60
MEGABYTES = 1024


def run(build, program, **environment):
    """Builds a test program, runs it and shows what it prints. @returns it with its output"""
    program = build / program
    subprocess.run(["cmake", "--build", build, "--target", program.name], check=True, stdout=subprocess.DEVNULL)
    done = subprocess.run([program, "--gtest_brief=1"], env={**os.environ, **environment}, check=False, text=True, stdout=subprocess.PIPE)
    print(done.stdout, end="")
    return done


def objects(build, data, verdict):
    done = run(build, BESIDE_OPENCV, DOCENT_DATA=str(data))
    photographs = sum(1 for _ in (data / "vision" / "objects").glob("*/*.jpg"))
    verdict.want("things on photographs: known as well as OpenCV's discriminants and neighbours know them", f"{photographs} photographs",
                 done.returncode == 0 and photographs > 0)


def real_ceiling(build, data, options, verdict):
    drawn = {"DOCENT_CEILING_FIGURE": str(Path(options.pictures) / "real-ceiling.svg")} if options.pictures else {}
    if drawn:
        Path(options.pictures).mkdir(parents=True, exist_ok=True)
    done = run(build, REAL_CEILING, DOCENT_DATA=str(data), **drawn)
    line = re.compile(r"real-ceiling (\w+): as it is mean ([\d.]+) most ([\d.]+) m; laid upon mean ([\d.]+) most ([\d.]+) m; "
                      r"unsaid (\d+) of (\d+); update (\d+) us")
    found = {row[1]: row for row in map(line.match, done.stdout.splitlines()) if row}
    for of, by in (("lamps", "the grid of its lamps"), ("ride", "the mosaic of the ride alone")):
        row = found.get(of)
        what = f"real ceiling by {by}: "
        if row is None:
            verdict.want(what + "followed", "nothing", False)
            continue
        exposure = f"{row[7]} pictures"
        verdict.want(what + "most distance from the reference, laid upon it", f"{row[5]} m, mean {row[4]} m, {exposure}", float(row[5]) <= NEAR)
        verdict.note(what + "as it is", f"most {row[3]} m, mean {row[2]} m")
        verdict.want(what + "pictures that said nothing", f"{row[6]} of {row[7]}", row[6] == "0")
        verdict.want(what + "an update", f"{row[8]} us of processor in the median", int(row[8]) <= UPDATE)
    verdict.want("real ceiling: no slip by a lamp", "its test", done.returncode == 0 and bool(found))


def mosaic(build, options, verdict):
    asked = {} if options.slice else {"DOCENT_WHOLE_HALLS": "1"}
    if options.pictures:
        Path(options.pictures).mkdir(parents=True, exist_ok=True)
        asked["DOCENT_MOSAIC_FIGURE"] = str(Path(options.pictures) / "mosaic.svg")
    done = run(build, DRAWN_CEILINGS, **asked)
    line = re.compile(r"mosaic (\w+) ([\w-]+): rms ([\d.]+) worst ([\d.]+) m; (\d+) pictures (\d+) unknowns; "
                      r"heights (\d+) low ([\d.]+) of ([\d.]+) high ([\d.]+) of ([\d.]+); ([\d.]+) s (\d+) MB")
    found = [row.groups() for row in map(line.match, done.stdout.splitlines()) if row]
    print_table(["hall", "solved", "RMS [m]", "worst [m]", "pictures", "unknowns", "parts", "low [m]", "true", "high [m]", "true", "s", "MB"], found)
    for row in found:
        if row[1] != "whole":
            continue
        verdict.want(f"mosaic of hall {row[0]}: RMS of the poses", f"{row[2]} m, {row[4]} pictures", float(row[2]) <= RMS)
        verdict.want(f"mosaic of hall {row[0]}: one core and memory", f"{row[11]} s, {row[12]} MB", float(row[11]) <= SECONDS and int(row[12]) <= MEGABYTES)
        others = [other for other in found if other[0] == row[0] and other[1] != "whole"]
        if others:
            verdict.note(f"mosaic of hall {row[0]}: RMS without", ", ".join(f"{other[1]} {other[2]} m" for other in others))
    verdict.want("mosaics of drawn halls: poses, heights within 2 %", f"{len(found)} mosaics", done.returncode == 0 and bool(found))


def rgbd(build, data, verdict):
    good = run(build, BESIDE_DEPTH, DOCENT_DATA=str(data)).returncode == 0
    frames = sum(1 for _ in (data / "vision" / "rgbd").glob("*.color.jpg"))
    verdict.want("floor by colour: IoU with depth's at least 0.85; distances to where it ends, by lines up to 3 m, within 10 % in 95 %",
                 f"{frames} frames", good and frames > 0)


def docking(build, data, verdict):
    runs = os.environ.get("DOCKING_RUNS", "100")
    good = run(build, BY_TAG, DOCENT_DATA=str(data), DOCKING_RUNS=runs).returncode == 0
    verdict.want("docking by tag from 30 degrees and 0.5 m: 99 % at the contacts, within 1 cm beside; tags of photographs found", f"{runs} approaches", good)


def protocol(build, root, options, simulations):
    """@param build  folder of the build"""
    verdict = Verdict()
    data = Path(os.environ.get("DOCENT_DATA", root.parent / "shared" / "data"))
    if options.part in (None, "objects"):
        objects(build, data, verdict)
    if options.part in (None, "real-ceiling"):
        real_ceiling(build, data, options, verdict)
    if options.part in (None, "mosaic"):
        mosaic(build, options, verdict)
        if not options.slice:
            ceilings.simulated(build, root, options, verdict)
    if options.part in (None, "rgbd"):
        rgbd(build, data, verdict)
    if options.part in (None, "docking"):
        docking(build, data, verdict)
    if options.part in (None, "dock"):
        eyes_dock.part(simulations, options, verdict)
    if options.part in (None, "things"):
        eyes_sight.part_things(simulations, options, verdict)
    if options.part in (None, "stairs"):
        eyes_sight.part_stairs(simulations, options, verdict, simulations.cache)
    if options.part in (None, "ceiling"):
        eyes_ceiling.part(simulations.docent, root, simulations.cache, options, verdict)
    if options.part == "packed" or options.part is None and not options.slice:
        eyes_packed.part(eyes_ceiling.Bench(simulations.docent, simulations.cache, root / "museums"), simulations, options, verdict)
    if options.part == "office" or options.part is None and not options.slice:
        eyes_office.part(simulations, options, verdict)
    verdict.print()
    return verdict
