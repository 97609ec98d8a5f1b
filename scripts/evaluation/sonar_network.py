"""The learned model of the sonars against cones made by hand, in worlds that nothing was learned in ([Rhino1999] 3.2.2).

A training a seed, each in other drawn office buildings, scored in others again and in both museums: cross-entropy of single
views, and the area under the ROC curve of a map of 150 views.
"""
import concurrent.futures
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from evaluation.tables import Verdict, print_table

GAIN = 0.20  # lower cross-entropy than the cones, at least


def train(program, root, seed, is_slice, folder, pictures):
    report = folder / f"{seed}.json"
    if pictures:
        Path(pictures).mkdir(parents=True, exist_ok=True)
    size = ["--worlds", 6, "--places", 150, "--held-out", 2] if is_slice else ["--worlds", 20, "--places", 400, "--held-out", 5]
    museums = [] if is_slice else ["--museum", root / "museums/bonn", "--museum", root / "museums/smithsonian"]
    drawn = ["--picture", Path(pictures) / f"sonar-network-{seed}.png"] if pictures else []
    done = subprocess.run([program, "train-sonar", "--out", folder / f"network-{seed}.json", "--seed", str(seed), "--report", report,
                           *map(str, [*size, *museums, *drawn])], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"seed {seed}: docent-lab train-sonar exited {done.returncode}: {done.stderr.strip()[-500:]}")
    print(f"   seed {seed} trained", file=sys.stderr, flush=True)
    return json.loads(report.read_text())


def protocol(program, root, options):
    seeds = range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else 5)))
    with tempfile.TemporaryDirectory(prefix="docent-sonar-network-") as folder, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        runs = list(pool.map(lambda seed: train(program, root, seed, options.slice, Path(folder), options.pictures), seeds))
    rows, gains, areas = [], [], []
    for seed, run in zip(seeds, runs):
        for world in run["held_out"]:
            network, cones, fitted = world["network"], world["cones"], world["cones_fitted"]
            gain = 1 - network["cross_entropy_nat"] / cones["cross_entropy_nat"]
            gains.append(gain)
            areas.append(network["map_roc_area"] - cones["map_roc_area"])
            rows.append([seed, Path(world["world"]).name, network["examples"], *[f"{model['cross_entropy_nat']:.3f}" for model in (network, cones, fitted)],
                         f"{100 * gain:.0f}", *[f"{model['map_roc_area']:.3f}" for model in (network, cones, fitted)]])
    print_table(["seed", "world", "examples", "network nat", "cones", "fitted", "gain %", "network's map ROC", "cones", "fitted"], rows)
    verdict = Verdict()
    mean = sum(gains) / len(gains)
    verdict.want("cross-entropy below the cones', mean (20 %)", f"{100 * mean:.1f} %, {100 * min(gains):.1f} to {100 * max(gains):.1f} % over {len(gains)} worlds",
                 mean >= GAIN)
    larger = sum(area > 0 for area in areas)
    verdict.want("larger area under the map's ROC curve, mean and 4 of 5 worlds", f"{larger} of {len(areas)}, mean {sum(areas) / len(areas):+.3f}",
                 sum(areas) > 0 and larger >= 0.8 * len(areas))
    print()
    verdict.print()
    return verdict
