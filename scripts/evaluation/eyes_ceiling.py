"""Where the robot is by the ceiling alone: a drive maps the ceiling, others find themselves under it, from anywhere again and again, by pictures
and odometry; in the same light, with other exposures, with lamps out, turned over; under ceilings that repeat themselves or show nothing."""
import csv
import subprocess
from pathlib import Path

from evaluation.low_things import upper
from evaluation.programs import laboratory
from evaluation.tables import print_table

SEEDS, PICTURES, RESTART = 4, 320, 40
MAPPED = 640  # pictures of the drive that maps
SURE = 0.01  # P(wrong)
PLACE = 0.5  # [m] from the truth: farther is another place
WITHIN = 10.0  # [m] of way
HALLS = ["bonn", "smithsonian", "hall"]
# How the light of a drive differs from that of the map.
LIGHTS = {"the same light": [], "steps of exposure": ["--exposure-steps", "0.2"], "lamps of two circuits out": ["--dark", "1", "4"],
          "all lamps out": ["--dark", "0", "1", "2", "3", "4", "5", "6", "7", "--daylight", "0.1"]}
UNTOLD = {"a ceiling that repeats itself": ["--ceiling", "periodic"], "a plain ceiling": ["--ceiling", "plain"]}


class Bench:
    def __init__(self, docent, cache, museums):
        self.docent, self.lab, self.folder, self.museums = docent, laboratory(docent), Path(cache) / "ceiling", museums
        self.folder.mkdir(parents=True, exist_ok=True)

    @staticmethod
    def run(*command):
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
        if done.returncode:
            raise RuntimeError(f"{' '.join(str(word) for word in command)}: {done.stderr.strip()[-400:]}")

    def drive(self, hall, name, seed, pictures, more):
        folder = self.folder / f"{hall}-{name}-{seed}"
        if not (folder / "done").exists():
            place = ["--hall-seed", 5, "--opening", 15] if hall == "hall" else ["--museum", self.museums / hall]
            self.run(self.lab, "take-pictures", *place, "--kinds", "up", "--pictures", pictures, "--drive-seed", seed, "--seed", seed, "--out", folder, *more)
            (folder / "done").write_text("")
        return folder

    def ceiling(self, hall, name, more):
        made = self.folder / f"{hall}-{name}.yaml"
        if not made.exists():
            self.run(self.docent, "map-ceiling", self.drive(hall, f"map-{name}", 1, MAPPED, more), "--out", made)
        return made

    def follow(self, ceiling, drive, *more):
        out = drive / f"{ceiling.stem}{''.join(more)}.csv"
        self.run(self.lab, "follow-ceiling", ceiling, drive, "--restart", RESTART, "--out", out, *more)
        with open(out, newline="", encoding="utf-8") as file:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


class Told:
    """Of many drives of one kind."""

    def __init__(self):
        self.pictures = self.sure = self.wrong = self.starts = self.found = 0
        self.errors, self.turns, self.ways = [], [], []

    def add(self, rows):
        for start in sorted({row["start"] for row in rows}):
            own = [row for row in rows if row["start"] == start]
            sure = [row for row in own if row["said"] and row["p_wrong"] < SURE]
            right = [row for row in sure if row["error"] <= PLACE]
            self.pictures += len(own)
            self.sure += len(sure)
            self.wrong += len(sure) - len(right)
            self.errors += [row["error"] for row in right]
            self.turns += [row["turn"] for row in right]
            if len(own) < RESTART // 2:
                continue
            self.starts += 1
            if right and right[0]["way"] <= WITHIN:
                self.found += 1
                self.ways.append(right[0]["way"])

    @staticmethod
    def part(values, share):
        return sorted(values)[int(share * (len(values) - 1))] if values else float("nan")

    def row(self, hall, kind):
        return [hall, kind, self.starts, self.found, f"{self.part(self.ways, 0.5):.1f}", self.pictures, self.sure, self.wrong,
                f"{self.part(self.errors, 0.5):.3f}", f"{self.part(self.errors, 0.95):.3f}", f"{self.part(self.turns, 0.95):.2f}"]


def part(docent, root, cache, options, verdict):
    bench = Bench(docent, cache, root / "museums")
    seeds = range(10 + options.first_seed, 10 + options.first_seed + (options.seeds or (1 if options.slice else SEEDS)))
    halls = options.museums.split(",") if options.museums else HALLS[:1] if options.slice else HALLS
    lights = dict(list(LIGHTS.items())[:1]) if options.slice else LIGHTS
    rows, told, false_ones = [], Told(), Told()
    for hall in halls:
        ceiling = bench.ceiling(hall, "own", [])
        for light, more in lights.items():
            kind = Told()
            for seed in seeds:
                followed = bench.follow(ceiling, bench.drive(hall, light.replace(" ", "-"), seed, PICTURES, more))
                kind.add(followed)
                (told if light == "the same light" else false_ones).add(followed)
            rows.append(kind.row(hall, light))
        kind = Told()
        for seed in seeds:
            followed = bench.follow(ceiling, bench.drive(hall, "the-same-light", seed, PICTURES, []), "--upside-down")
            kind.add(followed)
            false_ones.add(followed)
        rows.append(kind.row(hall, "the camera turned over"))
    for name, more in {} if options.slice else UNTOLD.items():
        short, kind = more[1], Told()
        ceiling = bench.ceiling("hall", short, more)
        for seed in seeds:
            followed = bench.follow(ceiling, bench.drive("hall", short, seed, PICTURES, more))
            kind.add(followed)
            false_ones.add(followed)
        rows.append(kind.row("hall", name))
    print("\n## By the ceiling alone\n")
    print_table(["hall", "drive", "starts", "found", "way [m]", "pictures", "sure", "sure and wrong", "error [m]", "95 %", "turn 95 % [deg]"], rows)
    print()
    verdict.want("starts from anywhere, found within 10 m, in the same light (95 %)", f"{told.found} of {told.starts}",
                 told.starts > 0 and told.found >= 0.95 * told.starts)
    error, turn = Told.part(told.errors, 0.95), Told.part(told.turns, 0.95)
    verdict.want("followed: 95 % of the sure ones within 10 cm and 1.5 degrees", f"{error:.3f} m, {turn:.2f} degrees, {len(told.errors)} pictures",
                 bool(told.errors) and error <= 0.10 and turn <= 1.5)
    pictures, wrong = told.pictures + false_ones.pictures, told.wrong + false_ones.wrong
    verdict.want("sure and wrong, over all (0.1 %)", upper(wrong, pictures) + " pictures", pictures > 0 and wrong <= 0.001 * pictures)
