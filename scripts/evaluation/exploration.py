"""A robot without a map maps buildings by itself, in simulation; what it made is scored against the true world.

Both museums, at night and among 20 people, and drawn office buildings. A robot that ignores what people have marked must
touch something.
"""
import concurrent.futures
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from evaluation.bounds import bounded
from evaluation import floor_plans
from evaluation.programs import laboratory, program_for
from evaluation.tables import Verdict, print_table

COVERED = 0.98  # of the floor that lasers can see from where the robot can drive
WALLS = 0.05  # [m], mean
GHOSTS = 0.001  # of the free cells
MINUTES = {"bonn": 15, "smithsonian": 30, "office": 15}  # with nobody about; people stand in the way:
SLOWER_AMID_PEOPLE = 1.5
LIMIT_HOURS = 1.0
# The robot begins where its lasers see walls: in the middle of that hall, 20 m wide, they see none, and what is marked in the frame of the first
# pose would lie as wrong as odometry turns until it sees some.
STARTS = {"smithsonian": ["--start", "12,15,0"]}


PARTS = ["plans"]


class Explorations:
    def __init__(self, program, root, pictures, jobs):
        self.program, self.root, self.jobs = program, root, jobs
        self.scratch = tempfile.TemporaryDirectory(prefix="docent-exploration-")
        self.pictures = Path(pictures) if pictures else Path(self.scratch.name)

    def call(self, *arguments, may_fail=False, program=None):
        done = subprocess.run([program or program_for(self.program, arguments), *map(str, arguments)], capture_output=True, text=True, check=False)
        if done.returncode != 0 and not may_fail:
            raise RuntimeError(f"docent {' '.join(map(str, arguments))} exited {done.returncode}: {done.stderr.strip()[-500:]}")
        return done.returncode == 0

    def museum(self, kind, seed):
        if kind != "office":
            return self.root / "museums" / kind
        folder = Path(self.scratch.name) / f"office-{seed}"
        self.call("office", "--seed", seed, "--out", folder)
        return folder

    def run(self, kind, people, seed, *more):
        name = f"{kind}-{people}-{seed}{'-crippled' if more else ''}"
        return self.run_in(self.museum(kind, seed), name, people, seed, *STARTS.get(kind, []), *more, may_fail=bool(more))

    def run_in(self, museum, name, people, seed, *more, may_fail=False):
        """What the robot made of a museum; None when it may fail and did. One that made its map and did not come home is judged all the same."""
        folder = self.pictures / name
        is_done = self.call("explore", "--museum", museum, "--seed", seed, "--people", people, "--hours", LIMIT_HOURS, "--out", folder, "--quiet",
                            *more, may_fail=True)
        if not is_done and may_fail:
            return None
        if not (folder / "report.json").exists():
            raise RuntimeError(f"docent explore made no map of {museum}, seed {seed}")
        self.call("score-map", "--map", folder / "map.yaml", "--world", museum / "simulation.yaml", "--report", folder / "score.json",
                  program=laboratory(self.program))
        run = json.loads((folder / "report.json").read_text())
        run |= json.loads((folder / "score.json").read_text())
        print(f"   {name}: {run['exploration']['minutes']:.1f} min, {100 * run['covered']:.1f} % covered", file=sys.stderr, flush=True)
        return run


def contacts_of(run):
    return sum(run["contacts"].values())


def row_of(kind, people, seed, run):
    told = run["exploration"]
    return [kind, people, seed, f"{told['minutes']:.1f}", f"{told['way_m']:.0f}", f"{told['way_m'] / told['minutes'] / 60:.2f}", told["loops"],
            f"{100 * run['covered']:.2f}", f"{run['floor_m2']:.0f}", f"{run['wall_error_m']:.3f}", run["ghosts"],
            f"{100 * run['ghosts'] / run['free']:.3f}", contacts_of(run), "no" if told["warning"] else "yes"]


def judge(verdict, kind, people, runs):
    name = f"{kind}, {people} people"
    most = MINUTES[kind] * (SLOWER_AMID_PEOPLE if people else 1)
    exposure = f"{len(runs)} runs, {sum(run['exploration']['way_m'] for run in runs) / 1000:.2f} km"
    covered = min(run["covered"] for run in runs)
    walls = max(run["wall_error_m"] for run in runs)
    ghosts = max(run["ghosts"] / run["free"] for run in runs)
    minutes = max(run["exploration"]["minutes"] for run in runs)
    contacts = sum(map(contacts_of, runs))
    verdict.want(f"{name}: covered, worst run (98 %)", f"{100 * covered:.2f} % of the floor that can be seen; {exposure}", covered >= COVERED)
    verdict.want(f"{name}: time, longest run ({most:g} min)", f"{minutes:.1f} min", minutes <= most)
    verdict.want(f"{name}: contacts (0)", f"{bounded(contacts, sum(run['exploration']['way_m'] for run in runs) / 1000)}; {len(runs)} runs", contacts == 0)
    verdict.want(f"{name}: walls, worst run (5 cm)", f"{100 * walls:.1f} cm", walls <= WALLS)
    verdict.want(f"{name}: ghosts, worst run (0.1 %)", f"{100 * ghosts:.3f} % of the free cells", ghosts <= GHOSTS)


def protocol(program, root, options):
    explorations = Explorations(program, root, options.pictures, options.jobs)
    if options.part == "plans":
        return floor_plans.protocol(explorations, root, options)
    verdict, rows = Verdict(), []
    count = options.seeds or (1 if options.slice else 5)
    seeds = range(options.first_seed, options.first_seed + count)
    kinds = [("bonn", 20)] if options.slice else [("bonn", 0), ("bonn", 20), ("smithsonian", 0), ("smithsonian", 20), ("office", 0)]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for kind, people in kinds:
            runs = list(pool.map(lambda seed: explorations.run(kind, people, seed), seeds))  # noqa: B023
            rows += [row_of(kind, people, seed, run) for seed, run in zip(seeds, runs)]
            judge(verdict, kind, people, runs)
    print_table(["world", "people", "seed", "min", "m", "m/s", "loops", "covered %", "floor m2", "walls m", "ghosts", "% of free", "contacts", "trusted"], rows)
    if not options.no_crippled and not options.slice:  # it touches something once in three runs
        runs, crippled = [], range(options.first_seed, options.first_seed + 3)
        for seed in crippled:  # until one touches something
            runs.append(explorations.run("bonn", 0, seed, "--set", "evaluation.ignores_hazards=true"))
            if not runs[-1] or contacts_of(runs[-1]):
                break
        lost = sum(run is None for run in runs)
        runs = [run for run in runs if run]
        contacts = sum(map(contacts_of, runs))
        verdict.want("crippled, ignores what people marked: touches something", f"{contacts} contacts in {sum(run['exploration']['way_m'] for run in runs):.0f} m, "
                     f"{lost} of {len(runs) + lost} never came back", contacts + lost > 0)
    print()
    verdict.print()
    return verdict
