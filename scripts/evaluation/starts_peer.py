"""MRPT's pf-localization on the trials of `scripts/evaluate localize-logs --part starts` that begin anywhere.

200,000 particles in the map's free space, 36 beams of a scan, a likelihood field; the number of particles adapts itself as in the configuration that MRPT
ships. Its belief is the particles' mean. It draws its random numbers by the clock: its figures differ a little from run to run."""
import os
import re
import shutil
import subprocess
from pathlib import Path

PARTICLES = 200000
BEAMS = 36
CONFIGURATION = """
[KLD_options]
KLD_binSize_PHI_deg=10
KLD_binSize_XY=0.10
KLD_delta=0.01
KLD_epsilon=0.01
KLD_maxSampleSize={particles}
KLD_minSampleSize=150
KLD_minSamplesPerBin=0
[PF_options]
PF_algorithm=0
resamplingMethod=0
adaptiveSampleSize=1
BETA=0.5
sampleSize=1
[LocalizationExperiment]
use_3D_poses=false
map_file={folder}/map.gridmap
rawlog_file={folder}/log.rawlog
logOutput_dir={folder}/out
3DSceneFrequency=-1
experimentRepetitions=1
particles_count={particles}
init_PDF_mode=0
init_PDF_min_x={left}
init_PDF_max_x={right}
init_PDF_min_y={bottom}
init_PDF_max_y={top}
SHOW_PROGRESS_3D_REAL_TIME=false
[MetricMap]
occupancyGrid_count=1
likelihoodMapSelection=-1
[MetricMap_occupancyGrid_00_creationOpts]
resolution={resolution}
[MetricMap_occupancyGrid_00_insertOpts]
mapAltitude=0
useMapAltitude=0
[MetricMap_occupancyGrid_00_likelihoodOpts]
likelihoodMethod=4
LF_decimation={decimation}
LF_stdHit=0.40
LF_maxCorrsDistance=0.30
LF_zHit=0.95
LF_zRandom=0.05
LF_maxRange=80
LF_alternateAverageMethod=0
"""
ESTIMATE = re.compile(r"PDF estimation: \(([-+.0-9e]+),\s*([-+.0-9e]+),\s*([-+.0-9e]+)deg\)")


def converter(program):
    """Of a trial to MRPT's files, where MRPT is installed."""
    found = Path(program).parents[1] / "tests/mapping_peer/docent_mrpt_trial"
    if not found.exists() or not shutil.which("pf-localization"):
        raise RuntimeError("part peer needs mrpt-apps, libmrpt-maps-dev and a build with tests: cmake --build --preset dev")
    return found


def cpu_of(command, said):
    """CPU seconds of a command of its own; what it says is written to the file `said`."""
    with open(said, "wb") as out:
        process = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=out, stderr=out)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise RuntimeError(f"{command[0]} exited {process.returncode}: {Path(said).read_text(encoding='utf-8', errors='replace').strip()[-500:]}")
    return usage.ru_utime + usage.ru_stime


def localized(program, building, log, folder, reverse, perturbed):
    """Poses (x, y [m], degrees) of every scan in the order of the run, and CPU seconds."""
    folder.mkdir()
    arguments = [*(["reverse"] if reverse else []), *(["perturbed", str(perturbed)] if perturbed is not None else [])]
    done = subprocess.run([converter(program), building.map, log, folder, *arguments], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"docent_mrpt_trial {building.name}: {done.stderr.strip()[-500:]}")
    grid = building.grid
    rows, columns = grid.free.shape
    (folder / "peer.ini").write_text(CONFIGURATION.format(
        particles=PARTICLES, folder=folder, resolution=grid.resolution, decimation=max(1, round(len(building.scans[0].ranges) / BEAMS)),
        left=grid.origin[0], right=grid.origin[0] + columns * grid.resolution, bottom=grid.origin[1],
        top=grid.origin[1] + rows * grid.resolution), encoding="ascii")
    said = folder / "said.txt"
    seconds = cpu_of(["pf-localization", folder / "peer.ini"], said)
    text = said.read_text(encoding="utf-8", errors="replace")
    poses = [(float(x), float(y), float(turn)) for x, y, turn in ESTIMATE.findall(text)]
    if not poses:
        raise RuntimeError(f"pf-localization {building.name}: {text.strip()[-500:]}")
    shutil.rmtree(folder)
    return poses, seconds
