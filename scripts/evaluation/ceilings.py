"""Mosaics of the simulator's ceilings ([Minerva2000] 4.3, Fig. 10): docent-lab take-pictures drives through an empty museum, docent map-ceiling sees its
pictures, told lens and believed poses alone, and what is true is read here."""
import csv
import json
import math
import subprocess
import tempfile
from collections import Counter
from pathlib import Path

from evaluation.tables import print_table

HALLS = {"bonn": ["--museum", "museums/bonn"], "smithsonian": ["--museum", "museums/smithsonian"], "opening": ["--opening", "15"]}
WAYS = {"whole": [], "one-height": ["--one-height"], "one-light": ["--one-light"], "no-priors": ["--no-priors"]}
PICTURES = 640
LARGE = 0.05  # share of the ceiling's area, of parts that must be found
NEAR = 0.02  # of a height
RMS = 0.03  # [m]
SECONDS = 60
MEGABYTES = 1024
UNKNOWNS = 3000


def rows_of(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def off(poses, truth):
    """@returns root of the mean square distance of poses from the truth, and the largest [m]"""
    true = {row["picture"]: row for row in rows_of(truth)}
    away = [math.hypot(float(row["map_x"]) - float(true[row["picture"]]["x"]), float(row["map_y"]) - float(true[row["picture"]]["y"])) for row in rows_of(poses)]
    return math.sqrt(sum(a * a for a in away) / len(away)), max(away)


def heights(truth, parts):
    """@returns of each large part of the ceiling its true height and that of the large part found that is nearest to it [m]; of the parts of an
    opening that a robot only sees from beneath, too"""
    counted = Counter(float(row["height"]) for row in rows_of(truth))
    cells = sum(counted.values())
    true = sorted(height for height, count in counted.items() if count >= LARGE * cells)
    area = sum(part["area_m2"] for part in parts)
    found = [part["height_m"] for part in parts if part["area_m2"] >= 0.5 * LARGE * area]
    return [(height, min(found, key=lambda other: abs(other - height))) for height in true]


def map_ceiling(docent, folder, out, options, pictures):
    report = out.with_suffix(".json")
    command = [docent, "map-ceiling", folder, "--out", out, "--poses", out.with_suffix(".csv"), "--report", report, *options]
    if pictures:
        command += ["--figure", Path(pictures) / f"ceiling-{out.stem}.svg"]
    if subprocess.run(command, check=False, stdout=subprocess.DEVNULL).returncode != 0:
        return None
    return json.loads(report.read_text(encoding="utf-8"))


def simulated(build, root, options, verdict):
    """@param build  folder of the build"""
    table = []
    with tempfile.TemporaryDirectory() as folder:
        for hall, of in HALLS.items():
            drive = Path(folder) / hall
            subprocess.run([build / "bin" / "docent-lab", "take-pictures", *of, "--kinds", "up", "--pictures", str(PICTURES), "--out", drive], check=True,
                           cwd=root, stdout=subprocess.DEVNULL)
            believed = off(drive / "poses.csv", drive / "truth" / "poses.csv")
            table.append([hall, "believed poses", f"{believed[0]:.4f}", f"{believed[1]:.3f}", PICTURES, "", "", "", ""])
            for way, crippled in WAYS.items():
                out = Path(folder) / f"{hall}-{way}.yaml"
                report = map_ceiling(build / "bin" / "docent", drive, out, crippled, options.pictures if way == "whole" else None)
                what = f"mosaic of simulated {hall}, {way}: "
                if report is None:
                    verdict.want(what + "made", "nothing", False)
                    continue
                rms, worst = off(out.with_suffix(".csv"), drive / "truth" / "poses.csv")
                pairs = heights(drive / "truth" / "ceiling.csv", report["parts"])
                shown = ", ".join(f"{found:.2f} of {true:.2f}" for true, found in pairs)
                table.append([hall, way, f"{rms:.4f}", f"{worst:.3f}", report["pictures"], report["unknowns"], shown, f"{report['seconds']:.1f}",
                              f"{report['megabytes']:.0f}"])
                if way != "whole":
                    continue
                verdict.want(what + "RMS of the poses", f"{rms:.4f} m, {report['pictures']} pictures", rms <= RMS)
                verdict.want(what + "heights of its large parts", shown, all(abs(found - true) <= NEAR * true for true, found in pairs))
                verdict.want(what + "unknowns", str(report["unknowns"]), report["unknowns"] > UNKNOWNS)
                verdict.want(what + "one core and memory", f"{report['seconds']:.1f} s, {report['megabytes']:.0f} MB",
                             report["seconds"] <= SECONDS and report["megabytes"] <= MEGABYTES)
    print_table(["hall", "solved", "RMS [m]", "worst [m]", "pictures", "unknowns", "heights [m]", "s", "MB"], table)
