"""`scripts/evaluate localize-logs --part starts`: recorded logs begun at many scans, forward and reversed, with an unknown start, with the right one and with
wrong ones, some of them amid recorded people. How often is the robot sure and wrong, and how soon does it know?

Truth is the log's reference; for Wean Hall, which has none, the whole log's track with the fewest readings that end in free space: those tell a corridor from
its neighbour six metres on, while readings that end near walls do not."""
import csv
import math
import re
import statistics
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

import numpy
from scipy.ndimage import distance_transform_edt

from evaluation import starts_peer, trial_logs
from evaluation.tables import print_table

WEAN = ["wean-1", "wean-2"]
CORRECTED = ["aces", "belgioioso", "edmonton", "freiburg-101", "orebro", "seattle"]
KINDS = ["unknown", "unknown", "given", "repeated", "random"]  # the last two: given wrong
CROWDS = [0.0, 0.0, 0.2, 0.4]  # share of the beams
LENGTH = 25.0  # [m] of driving
SURE = 0.01  # P(lost) below which the robot is sure
OFF, TURNED = 0.5, 20.0  # [m], [deg] from the truth: wrong
PEER = "MRPT"
AFTER = 10.0  # [m] of driving, after which a robot should know, or doubt a wrong start
BINS = [0.0, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.01]  # of P(lost)
BOUNDS = {"here wrong": 0.02, "a building's here": 0.04, "sure and wrong": 0.03, "a building's": 0.06, "end": 0.02, "doubted": 0.9, "known": 0.75, "given": 0.9}


@dataclass
class Building:
    """A log, its map and where each of its scans was taken."""
    name: str
    scans: list
    parameters: list
    map: object  # path of the YAML
    truth: dict  # index of the scan -> (x, y, deg)
    options: list  # of docent localize
    is_corrected: bool = False
    grid: object = None


@dataclass
class Trial:
    building: str
    kind: str
    crowd: float
    reverse: bool
    seed: int
    rows: list = field(default_factory=list)  # (way [m], is wrong, P(lost), says so)
    seconds: float = 0.0


class Map:
    """Distances to walls and free places of a map_server map."""

    def __init__(self, path):
        keys = dict(line.split(":", 1) for line in path.read_text(encoding="utf-8").splitlines() if ":" in line)
        self.resolution = float(keys["resolution"])
        self.origin = [float(v) for v in keys["origin"].strip(" []").split(",")][:2]
        image = read_pgm(path.parent / keys["image"].strip())
        shade = image / 255.0 if int(keys.get("negate", "0")) else 1.0 - image / 255.0
        occupied = shade > float(keys["occupied_thresh"])
        self.free = numpy.flipud(shade < float(keys["free_thresh"]))
        self.clearance = distance_transform_edt(numpy.flipud(~occupied)) * self.resolution
        self.room = distance_transform_edt(self.free) * self.resolution  # to what is not known to be free

    def at(self, grid, x, y, outside):
        column = numpy.floor((numpy.asarray(x) - self.origin[0]) / self.resolution).astype(int)
        row = numpy.floor((numpy.asarray(y) - self.origin[1]) / self.resolution).astype(int)
        inside = (row >= 0) & (column >= 0) & (row < grid.shape[0]) & (column < grid.shape[1])
        return numpy.where(inside, grid[numpy.clip(row, 0, grid.shape[0] - 1), numpy.clip(column, 0, grid.shape[1] - 1)], outside)

    def places(self, every):
        step = max(1, round(every / self.resolution))
        rows, columns = numpy.nonzero((self.room > 0.3)[::step, ::step])
        return numpy.stack([self.origin[0] + (columns * step + 0.5) * self.resolution,
                            self.origin[1] + (rows * step + 0.5) * self.resolution], axis=1)


def read_pgm(path):
    data = path.read_bytes()
    words, at = [], 0
    while len(words) < 4:
        end = at
        while data[end:end + 1] not in (b" ", b"\n", b"\t", b"\r"):
            end += 1
        if data[at:at + 1] == b"#":
            end = data.index(b"\n", at)
        elif end > at:
            words.append(data[at:end])
        at = end + 1
    width, height = int(words[1]), int(words[2])
    return numpy.frombuffer(data, numpy.uint8, width * height, at).reshape(height, width)


def arms(scan, most=60):
    """Ends of a scan's readings, seen from the laser [n, 2]; without those that met nothing."""
    bearings = -math.pi / 2 + scan.step * numpy.arange(len(scan.ranges))
    ranges = numpy.array(scan.ranges)
    kept = numpy.nonzero((ranges > 0.3) & (ranges < 7.9))[0]
    kept = kept[::max(1, len(kept) // most)]
    return numpy.stack([ranges[kept] * numpy.cos(bearings[kept]), ranges[kept] * numpy.sin(bearings[kept])], axis=1)


def ends_at(scan, pose):
    heading = math.radians(pose[2])
    seen = arms(scan)
    return (pose[0] + math.cos(heading) * seen[:, 0] - math.sin(heading) * seen[:, 1],
            pose[1] + math.sin(heading) * seen[:, 0] + math.cos(heading) * seen[:, 1])


def read_poses(path):
    with open(path, encoding="ascii") as file:
        return list(csv.DictReader(file))


def wean_truth(logs, name, scans, grid):
    """The track of the whole log, of those that four runs find, with the fewest readings in free space."""
    tracks = []
    for method in ("grid", "particles"):
        for way in ([], ["--reverse"]):
            poses = logs.scratch_file(f"{name}-{method}{len(way)}.csv")
            logs.localize(f"{name} truth {method}{''.join(way)}",
                          ["--map", logs.data / "maps" / "wean.yaml", "--log", logs.log(f"{name}.clf.gz"), "--method", method,
                           "--wall-depth", "0.2", "--poses", poses, *way])
            rows = [row for row in read_poses(poses) if row["hindsight_x"] != "nan"]
            track = {int(row["scan"]): tuple(float(row["hindsight_" + key]) for key in ("x", "y", "heading_deg")) for row in rows}
            if len(track) < 0.5 * len(scans):
                continue
            far = [float((grid.at(grid.clearance, *ends_at(scans[i], pose), 9.0) > 0.6).mean()) for i, pose in list(track.items())[::5]]
            tracks.append((statistics.mean(far), f"{method}{''.join(way)}", track))
    if not tracks:
        raise RuntimeError(f"{name}: no run over the whole log knew where it was in half of the scans")
    tracks.sort(key=lambda track: track[0])
    best = tracks[0][2]

    def same(track):
        both = [i for i in track if i in best]
        return sum(math.dist(track[i][:2], best[i][:2]) < OFF for i in both) / max(1, len(both))
    print("   truth of " + name + ", readings in free space: " +
          ", ".join(f"{label} {100 * far:.2f} % (the same way in {100 * same(track):.0f} %)" for far, label, track in tracks), flush=True)
    truth = dict(best)
    for _, _, track in tracks[1:]:
        if same(track) > 0.95:
            truth = {**track, **truth}
    return truth


def buildings(logs, names, motion, surfaces):
    found = []
    for name in names:
        if name in WEAN:
            scans, parameters = trial_logs.read_log(logs.log(f"{name}.clf.gz"))
            themap = logs.data / "maps" / "wean.yaml"
            grid = Map(themap)
            found.append(Building(name, scans, parameters, themap, wean_truth(logs, name, scans, grid), ["--wall-depth", "0.2"],
                                  grid=grid))
        elif name == "intel":
            log, reference = logs.log("intel-raw.clf.gz"), logs.log("intel-reference.txt")
            scans, parameters = trial_logs.read_log(log)
            themap = logs.map("intel", log, ["--reference", reference])
            known = {}
            for line in reference.read_text(encoding="ascii").splitlines():
                words = line.split()
                if words and words[0] != "#":
                    known[f"{float(words[0]):.2f}"] = (float(words[1]), float(words[2]), math.degrees(float(words[3])))
            truth = {i: known[f"{float(s.rest[0]):.2f}"] for i, s in enumerate(scans) if f"{float(s.rest[0]):.2f}" in known}
            found.append(Building(name, scans, parameters, themap, truth, ["--wall-depth", surfaces], grid=Map(themap)))
        else:
            log = logs.log(f"{name}-corrected.log.gz")
            scans, parameters = trial_logs.read_log(log)
            themap = logs.map(name, log, ["--reference", "logged", "--scans", "odd"])
            truth = {i: (*scan.pose[:2], math.degrees(scan.pose[2])) for i, scan in enumerate(scans)}
            found.append(Building(name, scans, parameters, themap, truth, ["--wall-depth", surfaces, "--set", motion], True, Map(themap)))
    return found


def wrong_start(building, scan, truth, kind, rng):
    """Another place: one from which the first scan looks much the same, or any."""
    places = building.grid.places(0.25)
    places = places[numpy.hypot(places[:, 0] - truth[0], places[:, 1] - truth[1]) > 2.0]
    if kind == "random":
        x, y = places[rng.randrange(len(places))]
        return x, y, rng.uniform(-180.0, 180.0)
    best = (9.9, None)
    for turn in range(0, 360, 10):
        xs, ys = ends_at(scan, (0.0, 0.0, truth[2] + turn))
        for part in range(0, len(places), 4000):
            some = places[part:part + 4000]
            off = numpy.minimum(building.grid.at(building.grid.clearance, some[:, :1] + xs, some[:, 1:] + ys, 1.0), 1.0).mean(axis=1)
            least = int(off.argmin())
            if off[least] < best[0]:
                best = (float(off[least]), (*some[least], truth[2] + turn))
    return best[1]


def turned(a, b):
    return abs((a - b + 180.0) % 360.0 - 180.0)


def run_from_free_place(command, said):
    """CPU seconds. A start that falls into a wall of the map as the program reads it is moved to the free place that the program names."""
    try:
        return starts_peer.cpu_of(command, said)
    except RuntimeError as error:
        nearest = re.search(r"--start .*the nearest free place of .* is (-?[\d.]+,-?[\d.]+)", str(error))
        if not nearest:
            raise
    at = command.index("--start") + 1
    heading = command[at].rsplit(",", 1)[1]
    return starts_peer.cpu_of([*command[:at], f"{nearest[1]},{heading}", *command[at + 1:]], said)


def run_trial(logs, building, moments, number, count, method, first_seed):
    """The `number`-th of `count` beginnings of a log, by one of our methods or by PEER."""
    seed = first_seed * 1000 + number
    rng = trial_logs.random.Random(f"{building.name}/{seed}")
    trial = Trial(building.name, KINDS[number % len(KINDS)], CROWDS[(number // len(KINDS) + number) % len(CROWDS)], number % 2 == 1, seed)
    ways = trial_logs.driven(building.scans)
    starts = [i for i in sorted(building.truth) if ways[-1] - ways[i] > 0.6 * LENGTH and (not building.is_corrected or i % 2 == 0)]
    spread = (number + rng.random()) / count
    begin = starts[min(len(starts) - 1, int(spread * len(starts)))]
    scans = trial_logs.piece(building.scans, begin, LENGTH)
    shown = trial_logs.with_people(scans, moments, trial.crowd, seed)
    log = logs.scratch_file(f"{building.name}-{method}-{seed}.log")
    trial_logs.write_log(log, shown, building.parameters)
    poses = log.with_suffix(".csv")
    arguments = ["--map", building.map, "--log", log, "--method", method, "--poses", poses, "--seed", seed, *building.options]
    first = begin + len(scans) - 1 if trial.reverse else begin
    used = list(range(begin, begin + len(scans)))
    if building.is_corrected:
        arguments += ["--reference", "logged", "--scans", "even", "--odometry", "perturbed", "--odometry-seed", seed]
        used = used[1::2]
        first = used[-1] if trial.reverse else used[0]
    if trial.reverse:
        arguments.append("--reverse")
    if trial.kind != "unknown":
        first = min(building.truth, key=lambda i: abs(i - first))
        where = building.truth[first]
        if trial.kind != "given":
            where = wrong_start(building, building.scans[first], where, trial.kind, rng)
        arguments += ["--start", f"{where[0]:.3f},{where[1]:.3f},{where[2]:.2f}"]
    if method == PEER:
        perturbed = seed if building.is_corrected else None
        poses, trial.seconds = starts_peer.localized(logs.program, building, log, log.with_suffix(""), trial.reverse, perturbed)
        beliefs = [(pose, 0.0, True) for pose in poses]  # it has no doubts
    else:
        trial.seconds = run_from_free_place([logs.program, "localize", *arguments], log.with_suffix(".txt"))
        beliefs = [((float(row["x"]), float(row["y"]), float(row["heading_deg"])) if row["has_pose"] == "1" else None,
                    float(row["p_lost"]), row["localized"] == "1") for row in read_poses(poses)]
        if trial.reverse:
            beliefs.reverse()
    if len(beliefs) != len(used):
        raise RuntimeError(f"{building.name}, seed {seed}: {len(beliefs)} poses of {len(used)} scans")
    way, last = 0.0, None
    for index, (pose, p_lost, knows) in zip(reversed(used) if trial.reverse else used, beliefs):
        way += abs(ways[index] - ways[last]) if last is not None else 0.0
        last = index
        if index not in building.truth:
            continue
        true = building.truth[index]
        is_wrong = pose is None or math.dist(pose[:2], true[:2]) > OFF or turned(pose[2], true[2]) > TURNED
        trial.rows.append((way, is_wrong, p_lost, knows))
    log.unlink()
    return trial


def right_from(trial):
    """Index of the first row from which on the best pose is right for good; None where it is wrong at the end."""
    wrong = [n for n, row in enumerate(trial.rows) if row[1]]
    first = wrong[-1] + 1 if wrong else 0
    return first if first < len(trial.rows) else None


def is_doubted(trial):
    """True when the robot that was told a wrong place is right, or no longer says "here", once it has driven AFTER metres; of a shorter trial, at its end."""
    seen = [row for row in trial.rows if row[0] <= AFTER] or trial.rows[:1]
    if trial.rows[-1][0] >= AFTER:
        seen.append(next(row for row in trial.rows if row[0] >= AFTER))
    _, is_wrong, _, knows = seen[-1]
    return not is_wrong or not knows


def bins_of(trials):
    """Of each bin of P(lost): beliefs, mean of P(lost), share that is wrong."""
    rows = [row for trial in trials for row in trial.rows]
    found = []
    for least, most in zip(BINS, BINS[1:]):
        some = [row for row in rows if least <= row[2] < most]
        if some:
            found.append((least, most, len(some), statistics.mean(row[2] for row in some), share(sum(row[1] for row in some), len(some))))
    return found


def print_bins(trials):
    print()
    print_table(["P(lost)", "beliefs", "said, mean %", "wrong %"], [[f"{least:g} to {min(most, 1.0):g}", count, f"{100 * said:.1f}", f"{100 * wrong:.1f}"]
                                                                for least, most, count, said, wrong in bins_of(trials)])


def print_kinds(trials):
    """Of each kind of start, amid so many people, forward and reversed: how often "here" was wrong."""
    print()
    kinds = [("start " + kind, [t for t in trials if t.kind == kind]) for kind in dict.fromkeys(KINDS)]
    kinds += [(f"{100 * crowd:.0f} % of the beams on people", [t for t in trials if t.crowd == crowd]) for crowd in sorted(set(CROWDS))]
    kinds += [("reversed" if back else "forward", [t for t in trials if t.reverse == back]) for back in (False, True)]
    print_table(["kind", "trials", "said \"here\"", "of them wrong %", "knows, right %"],
                [[name, (f := judged(some))["trials"], f["here"], f"{100 * share(f['here wrong'], f['here']):.1f}",
                  f"{100 * share(f['known'], f['right later']):.0f}"] for name, some in kinds if some])


def share(part, whole):
    return part / whole if whole else float("nan")


def judged(trials):
    """The figures of some trials."""
    figures = {"trials": len(trials)}
    sure = [row for trial in trials for row in trial.rows if row[2] < SURE]
    figures["beliefs"] = sum(len(trial.rows) for trial in trials)
    figures["sure"], figures["sure wrong"] = len(sure), sum(row[1] for row in sure)
    figures["end"] = sum(trial.rows[-1][1] and trial.rows[-1][2] < SURE for trial in trials)
    wrong = [trial for trial in trials if trial.kind in ("repeated", "random")]
    figures["wrong starts"] = len(wrong)
    figures["doubted"] = sum(map(is_doubted, wrong))
    here = [row for trial in trials for row in trial.rows if row[3]]
    figures["here"], figures["here wrong"] = len(here), sum(row[1] for row in here)
    later = [row for trial in trials if (first := right_from(trial)) is not None for row in trial.rows[first:] if row[0] >= AFTER]
    figures["right later"], figures["known"] = len(later), sum(row[3] for row in later)
    given = [row for trial in trials if trial.kind == "given" for row in trial.rows[1:] if not row[1]]
    figures["given"], figures["given known"] = len(given), sum(row[3] for row in given)
    unknown = [trial for trial in trials if trial.kind == "unknown"]
    figures["unknown"] = len(unknown)
    ways = [trial.rows[first][0] if (first := right_from(trial)) is not None else math.inf for trial in unknown]
    figures["right at the end"] = sum(map(math.isfinite, ways))
    figures["metres"] = statistics.median(ways) if ways else math.nan
    return figures


def print_figures(title, trials):
    rows = []
    for name in [*dict.fromkeys(trial.building for trial in trials), "all"]:
        f = judged([trial for trial in trials if name in (trial.building, "all")])
        rows.append([name, f["trials"], f["beliefs"], f["sure"], f"{100 * share(f['sure wrong'], f['sure']):.1f}", f["end"],
                     f"{f['doubted']} of {f['wrong starts']}", f"{100 * share(f['known'], f['right later']):.0f}",
                     f"{100 * share(f['given known'], f['given']):.0f}", f"{100 * share(f['here wrong'], f['here']):.1f}", f"{f['right at the end']} of {f['unknown']}",
                     f"{f['metres']:.1f}"])
    print(f"\n### {title}\n")
    print_table(["log", "trials", "beliefs", "sure", "of them wrong %", "end sure, wrong", "wrong start doubted", "knows, right %",
                 "given: knows %", "\"here\" wrong %", "unknown: right", "after m"], rows)


def judge(method, trials, verdict):
    all_of = judged(trials)
    names = list(dict.fromkeys(trial.building for trial in trials))
    worst = max(names, key=lambda name: share(judged([t for t in trials if t.building == name])["sure wrong"],
                                              max(1, judged([t for t in trials if t.building == name])["sure"])))
    of_worst = judged([trial for trial in trials if trial.building == worst])

    def want(what, part, whole, is_good):
        verdict.want(f"{method}: {what}", f"{100 * share(part, whole):.1f} % ({part} of {whole})", whole > 0 and is_good)
    want("beliefs with P(lost) < 1 % that are wrong (at most 3 %)", all_of["sure wrong"], all_of["sure"],
         all_of["sure wrong"] <= BOUNDS["sure and wrong"] * all_of["sure"])
    want(f"the same in the worst building, {worst} (6 %)", of_worst["sure wrong"], max(1, of_worst["sure"]),
         of_worst["sure wrong"] <= BOUNDS["a building's"] * of_worst["sure"])
    want("scans said \"here\" that are wrong (at most 2 %)", all_of["here wrong"], all_of["here"],
         all_of["here wrong"] <= BOUNDS["here wrong"] * all_of["here"])
    of_each = {name: judged([trial for trial in trials if trial.building == name]) for name in names}
    worst_here = max(names, key=lambda name: of_each[name]["here wrong"] / max(1, of_each[name]["here"]))
    want(f"the same in the worst building, {worst_here} (4 %)", of_each[worst_here]["here wrong"], max(1, of_each[worst_here]["here"]),
         of_each[worst_here]["here wrong"] <= BOUNDS["a building's here"] * of_each[worst_here]["here"])
    want("runs that end sure and wrong (2 %)", all_of["end"], all_of["trials"], all_of["end"] <= BOUNDS["end"] * all_of["trials"])
    want("wrong starts doubted within 10 m (90 %)", all_of["doubted"], all_of["wrong starts"],
         all_of["doubted"] >= BOUNDS["doubted"] * all_of["wrong starts"])
    want("says that it knows, where right for good and after 10 m (75 %)", all_of["known"], all_of["right later"],
         all_of["known"] >= BOUNDS["known"] * all_of["right later"])
    want("says that it knows from a right start's second scan on (90 %)", all_of["given known"], all_of["given"],
         all_of["given known"] >= BOUNDS["given"] * all_of["given"])


def starts(logs, methods, count, first_seed, names, motion, surfaces, verdict):
    """`count` beginnings of each log by each method."""
    print(f"\n## Starts: {count} beginnings a log of {LENGTH:.0f} m, seed {first_seed}\n")
    moments = trial_logs.read_people(logs.data / "pedestrians")
    found = buildings(logs, names, motion, surfaces)
    for method in methods:
        tasks = [(building, number) for building in found for number in range(count)]
        trials = []
        with ThreadPoolExecutor(2) as pool:
            for done, trial in enumerate(pool.map(lambda task: run_trial(logs, task[0], moments, task[1], count, method, first_seed), tasks), 1):
                trials.append(trial)
                if done % 10 == 0:
                    print(f"   {method}: {done} of {len(tasks)} trials", file=sys.stderr, flush=True)
        print_figures(f"{method}, {statistics.mean(t.seconds for t in trials):.1f} CPU s a trial", trials)
        print_bins(trials)
        print_kinds(trials)
        ends = [t for t in trials if t.rows[-1][1] and t.rows[-1][2] < SURE]
        for trial in ends:
            print(f"   ends sure and wrong: {trial.building}, {trial.kind}, crowd {trial.crowd}, {'reversed' if trial.reverse else 'forward'}, seed {trial.seed}")
        judge(method, trials, verdict)


def peer(logs, methods, count, first_seed, names, motion, surfaces, verdict):
    """The trials of `starts` that begin anywhere, by us and by MRPT's pf-localization."""
    starts_peer.converter(logs.program)
    print(f"\n## Unknown starts, beside MRPT's pf-localization: {count} beginnings a log, seed {first_seed}\n")
    moments = trial_logs.read_people(logs.data / "pedestrians")
    found = buildings(logs, names, motion, surfaces)
    tasks = [(building, number) for building in found for number in range(count) if KINDS[number % len(KINDS)] == "unknown"]
    runs = {}
    for method in [PEER, *methods]:
        with ThreadPoolExecutor(2) as pool:
            runs[method] = list(pool.map(lambda task: run_trial(logs, task[0], moments, task[1], count, method, first_seed), tasks))
        print(f"   {method}: {len(tasks)} trials", file=sys.stderr, flush=True)
    rows = []
    for name in [*names, "all"]:
        for method, trials in runs.items():
            some = [trial for trial in trials if name in (trial.building, "all")]
            f = judged(some)
            rows.append([name, method, f"{f['right at the end']} of {f['unknown']}", f"{f['metres']:.1f}",
                         f"{statistics.mean(trial.seconds for trial in some):.1f}"])
    print_table(["log", "by", "right at the end", "for good after m, median", "CPU s a trial"], rows)
    theirs = judged(runs[PEER])
    for method in methods:
        ours = judged(runs[method])
        verdict.want(f"{method}: right at the end, at least as often as MRPT", f"{ours['right at the end']} and {theirs['right at the end']} of {ours['unknown']}",
                     ours["right at the end"] >= theirs["right at the end"])
        worse = [name for name in names if judged([t for t in runs[method] if t.building == name])["right at the end"] <
                 judged([t for t in runs[PEER] if t.building == name])["right at the end"]]
        verdict.note(f"{method}: buildings where MRPT is right more often (aim: none)", ", ".join(worse) or "none")
        verdict.note(f"{method}: right for good after, median (aim: no later than MRPT)", f"{ours['metres']:.1f} and {theirs['metres']:.1f} m")
        ours_s, theirs_s = (statistics.mean(t.seconds for t in runs[m]) for m in (method, PEER))
        verdict.note(f"{method}: CPU a trial, ours and MRPT's (aim: no more)", f"{ours_s:.1f} and {theirs_s:.1f} s")
