"""What goes wrong while the robot gives tours, ten seeds each, in the museum of Bonn: what must be seen and by when; and crippled robots,
which must fail. A seed draws where the robot starts, what its sensors and wheels do, what people make of it, and when it goes wrong."""
import csv
import hashlib
import json
import os
import random
import re
import shutil
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass

from evaluation import kill
from evaluation.keys import key_of
from evaluation.programs import program_for, programs_of
from evaluation.reports import contacts_of, touched
from evaluation.tables import Verdict, print_table

SEEDS, CRIPPLED_SEEDS = 10, 3
SLICE = ("visitors-leave", "way-closed")  # the shortest; charging and the mission's deaths are in the slice of day
CHARGER = (7.0, 1.5)  # as in museums/bonn
PLANNERS = {"plans": [], "golog": ["mission.planner=golog"]}
LATEST = 3.0  # [s] after its time a question must have had its default
FOYER = ((8.0, 10.5), (2.2, 4.2))  # [m] where the robot starts: x and y


class Run:
    """One run: its report, its events in order of time, what the mission said of its health, and what the scenario wished for."""

    def __init__(self, report, events, health, scenario):
        self.report, self.health, self.scenario = report, health, scenario
        self.wishes = re.findall(r"request: \{kind: (\w+), target: ([\w-]+)", scenario)
        self.rows = [dict(row, time=float(row["time"]), value=float(row["value"]), x=float(row["x"]), y=float(row["y"]))
                     for row in events]

    def all(self, kind, after=0.0, subject="", source="event"):
        return [row for row in self.rows if row["source"] == source and row["kind"] == kind and row["time"] >= after
                and (not subject or row["subject"] == subject)]

    def first(self, kind, after=0.0, subject="", source="event"):
        """Time of the first such row; None where there is none."""
        return next((row["time"] for row in self.all(kind, after, subject, source)), None)

    def struck(self, kind, number=0):
        """When the scenario did it; None where it never came to that."""
        rows = self.all(kind, source="scenario")
        return rows[number]["time"] if number < len(rows) else None

    def ends(self, target):
        """[(time, how)] of the requests for an exhibit or tour, each as often as it ended."""
        ids = {row["subject"] for row in self.all("request_queued") if row["detail"] == target}
        return [(row["time"], row["kind"][len("request_"):]) for row in self.rows if row["source"] == "event" and row["subject"] in ids
                and row["kind"] in ("request_fulfilled", "request_failed", "request_cancelled", "request_refused")]

    def served(self, target):
        return next((when for when, how in self.ends(target) if how == "fulfilled"), None)

    def at_charger(self, after):
        """When it said to be at its charger, and truly was where that charges."""
        return next((row["time"] for row in self.all("charger", after)
                     if (row["x"] - CHARGER[0]) ** 2 + (row["y"] - CHARGER[1]) ** 2 <= 0.4 ** 2), None)


def since(later, earlier):
    """[s] from one to the other; None where either never came, or the later one came first."""
    return None if later is None or earlier is None or later < earlier else later - earlier


# What must happen in a scenario: a function of the run that gives the seconds it took; None: it did not happen.

def gives_way_to_the_battery(run):
    """Shortens the tour, or breaks it off with a word to the visitors: an announcement of the drive to the charger."""
    low = run.struck("battery")
    if low is None:
        return None
    shortened, broken = run.first("plan_shortened", low), run.first("tour_broken_off", low)
    if broken is None:
        return since(shortened, low)
    has_word = any(row["source"] == "say" and row["subject"].endswith("/must_charge") and broken - 1 <= row["time"] <= broken + 15
                   for row in run.rows)
    return broken - low if has_word else None


def serves_beside_the_charger(run):
    """Explains something after it found its charger occupied, while people still stand there."""
    failed = run.first("charger_failed")
    explained = None if failed is None else run.first("explained", failed)
    return explained if explained is not None and explained <= 640 else None


def charges_after_people_left(run, left=640.0):
    """At its charger; at once where it found room between them, and stayed."""
    before = max((row["time"] for row in run.all("charger") if row["time"] < left and run.at_charger(row["time"]) == row["time"]), default=None)
    gone = before is not None and any(before < row["time"] < left for row in run.all("visit_started") + run.all("charger_failed"))
    return 0.0 if before is not None and not gone else since(run.at_charger(left), left)


def tour_goes_on(run, tour, after):
    """Gives the tour to its end, in one piece."""
    if after is None or len(run.all("tour_started", subject=tour)) != 1:
        return None
    return since(run.first("tour_completed", after, tour), after)


def goes_on_at_its_stop(run, tour):
    """What it shows first, after it was broken off, is the first that it had not shown. Where nothing was broken off: at once."""
    broken, begun = run.first("tour_broken_off", subject=tour), run.all("tour_started", subject=tour)
    if broken is None:
        return 0.0 if begun else None
    shown = [(row["time"], row["subject"]) for row in run.all("explained") if row["detail"] == tour]
    ahead = [one for one in begun[0]["detail"].split() if one not in {name for at, name in shown if at <= broken}]
    return next((at - broken for at, name in shown if at > broken and [name] == ahead[:1]), None)


def longest_question(run):
    """[s] of the question that stood longest, each answered by its default; None where one stood for ever or none was asked."""
    asked, waited = run.all("prompt_shown"), []
    for row in asked:
        answer = next((other for other in run.all("choice", row["time"])), None)
        if answer is None or "default" not in answer["detail"]:
            return None
        waited.append(answer["time"] - row["time"] - row["value"])
    return max(waited) if waited else None


def health_of(run, state, after=0.0):
    return next((float(row["time"]) for row in run.health if row["module"] == "mission" and row["state"] == state
                 and float(row["time"]) >= after), None)


@dataclass
class Duty:
    what: str
    bound: float  # [s]
    seconds: object  # of a Run


@dataclass
class Exceptional:
    """One scenario. `fails`: what may be asked for in vain, and must be told to have failed."""
    minutes: float
    duties: list
    exposure: dict  # name: (of a run, its least mean over the seeds)
    crippled: dict  # name: settings
    planners: tuple = ("plans", "golog")
    fails: tuple = ()
    breaks_off: int = 0  # how often a tour may be broken off, and so begin anew
    once: tuple = ()  # (name, of a run whether it is so): in one of the seeds at least
    crowd: str = "quiet"
    programs: tuple = ()  # files that stand in the place of the program's main, one seed after the other


def count(kind, source="event"):
    return lambda run: len(run.all(kind, source=source))


def each_kill_struck(run):
    """Each kill waits for a phase of the mission: all of them strike only where every phase came."""
    return len(run.all("kill", source="scenario")) == run.scenario.count("kill:") > 0


BEYOND, FREE = "lithotripter", 650.0  # the exhibit whose ways are closed, and when [s] they are free again


def explained_while_closed(run):
    """When something else was explained before the ways were free."""
    return next((row["time"] for row in run.all("explained") if row["subject"] != BEYOND and row["time"] < FREE), None)


def vain_visits(run):
    """To the exhibit beyond, before the ways were free."""
    return sum(row["time"] < FREE for row in run.all("visit_failed", subject=BEYOND))


MEANWHILE = Duty("something else is explained meanwhile, after the first request", FREE - 60.0,
                 lambda run: since(explained_while_closed(run), 60.0))
TOUR_BEYOND = Duty("the tour's wish comes true, after it was made", 1500, lambda run: since(run.served("for-your-health"), 100.0))
GIVES_UP = {"never gives up": ["evaluation.never_gives_up=true"]}
NO_WATCH = {"without the battery watch": ["evaluation.without_battery_watch=true"]}

SCENARIOS = {
    "battery-low": Exceptional(60, [
        Duty("shortens the tour or breaks it off with a word, after the charge fell", 400, gives_way_to_the_battery),
        Duty("at its charger, after the charge fell", 900, lambda run: since(run.at_charger(run.struck("battery") or 1e9), run.struck("battery"))),
        Duty("the tour's wish comes true, after it was made", 3300, lambda run: since(run.served("on-the-move"), 60.0)),
        Duty("goes on at the stop at which it was, after it was broken off", 3000, lambda run: goes_on_at_its_stop(run, "on-the-move")),
    ], {"tours under way when the charge fell": (lambda run: sum(row["time"] < (run.struck("battery") or 0) for row in run.all("tour_started")), 1),
        "charges": (lambda run: run.report["battery"]["charges"], 1)}, NO_WATCH, breaks_off=1),
    "tour-left": Exceptional(60, [
        Duty("the tour is let go, after it was broken off", 2300, lambda run: since(run.first("tour_cancelled"), run.first("tour_broken_off"))),
        Duty("another one is given, after its wish", 1100, lambda run: since(run.served("small-things"), 2400.0)),
    ], {"tours broken off": (count("tour_broken_off"), 1)}, NO_WATCH, fails=("on-the-move",), crowd="empty"),
    "charger-occupied": Exceptional(60, [
        Duty("finds its charger occupied, after the charge fell", 400, lambda run: since(run.first("charger_failed"), 60.0)),
        Duty("serves meanwhile, by the time of the run", 640, serves_beside_the_charger),
        Duty("at its charger, after people have left", 420, charges_after_people_left),
    ], {"vain ways to the charger": (count("charger_failed"), 1), "charges": (lambda run: run.report["battery"]["charges"], 1)}, NO_WATCH),
    "lost": Exceptional(25, [
        Duty("explains the tour's next exhibit, after it was carried off", 240, lambda run: since(run.first("explained", run.struck("kidnap") or 1e9),
                                                                                               run.struck("kidnap"))),
        Duty("explains another one, after its odometry jumped", 240, lambda run: since(run.first("explained", run.struck("odometry_jump") or 1e9),
                                                                                     run.struck("odometry_jump"))),
        Duty("completes the tour, after it was carried off", 900, lambda run: tour_goes_on(run, "on-the-move", run.struck("kidnap"))),
    ], {"carried off in a tour": (count("kidnap", "scenario"), 1), "jumps of the odometry in a tour": (count("odometry_jump", "scenario"), 1)},
        {"dead reckoning": ["evaluation.dead_reckoning=true"]}),
    "way-closed": Exceptional(30, [
        MEANWHILE, TOUR_BEYOND,
        Duty(f"the {BEYOND}'s wish comes true, after the way was free", 420, lambda run: since(run.served(BEYOND), FREE)),
    ], {"s blocked": (lambda run: run.report["blocked"]["seconds"], 5), f"vain visits to the {BEYOND}": (vain_visits, 1)}, GIVES_UP),
    "way-full-of-people": Exceptional(30, [
        MEANWHILE, TOUR_BEYOND,
        # People who stand make a step now and then: a gap may open before they leave.
        Duty(f"the {BEYOND}'s wish comes true, after it was made", FREE + 420 - 60, lambda run: since(run.served(BEYOND), 60.0)),
    ], {"s blocked": (lambda run: run.report["blocked"]["seconds"], 30), "horns": (lambda run: run.report["blocked"]["horn"], 3),
        f"vain visits to the {BEYOND}": (vain_visits, 0.5)}, GIVES_UP),
    "unreachable": Exceptional(60, [
        Duty("says that mp3 cannot be reached, after its request", 3000, lambda run: since(next((t for t, how in run.ends("mp3") if how == "failed"), None), 70.0)),
        Duty("says so of the zeolite", 3000, lambda run: since(next((t for t, how in run.ends("zeolite") if how == "failed"), None), 60.0)),
        Duty("the tour with the zeolite is given, after its wish", 1800, lambda run: since(run.served("small-things"), 100.0)),
    ], {"visits that failed": (count("visit_failed"), 4)}, GIVES_UP, fails=("mp3", "zeolite")),
    "visitors-leave": Exceptional(20, [
        Duty("the longest question, over the time to answer", LATEST, longest_question),
        Duty("gives the tour to its end, after its wish", 600, lambda run: since(run.served("small-things"), 60.0)),
        Duty("goes home, after the last wish", 400, lambda run: since(run.first("home", 600.0), 600.0)),
        # The shipped GOLOG program asks nobody while anything is due, nor after a farewell.
    ], {"questions": (count("prompt_shown"), 2)}, GIVES_UP),
    "prolog-timeout": Exceptional(30, [
        Duty("reports the fault, after the first explanation", 10, lambda run: since(health_of(run, "degraded"), run.first("explained"))),
        Duty("the tour's wish comes true, after it was made", 1200, lambda run: since(run.served("small-things"), 100.0)),
    ], {"explained after the fault": (lambda run: len(run.all("explained", health_of(run, "degraded") or 1e9)), 3)},
        {"without a stand-in": ["evaluation.without_stand_in=true"]}, planners=("golog",), programs=("runaway", "restless")),
    "mission-killed": Exceptional(40, [
        Duty("gives the tour in one piece, after its wish", 1000, lambda run: tour_goes_on(run, "highlights", 60.0)),
        Duty("the last tour's wish comes true, after it was made", 1200, lambda run: since(run.served("for-your-health"), 1100.0)),
    ], {"kills": (count("kill", "scenario"), 9)}, {"forgets what it was about": ["evaluation.forgets_tasks=true"]},
        once=(("a kill in each phase", each_kill_struck),)),
}
PARTS = [*SCENARIOS, "kiosk"]


class Bonn:
    """Runs in the museum of Bonn, kept under a key of the program, the museum and the scenario."""

    def __init__(self, docent, root, cache, jobs):
        self.docent, self.root, self.jobs = docent, root, jobs
        self.scenarios = root / "scripts" / "scenarios" / "exceptions"
        self.cache = cache / "exceptions"
        self.key = key_of(*programs_of(docent), root / "museums" / "bonn", root / "prolog")

    def museum(self, program):
        """Bonn, with a tour.pl whose main is replaced by that of this file; without one as it is."""
        if not program:
            return self.root / "museums" / "bonn"
        main = "proc(main, tour_guide).\n"
        shipped = (self.root / "prolog" / "tour_guide.pl").read_text()
        if shipped.count(main) != 1:
            raise RuntimeError("prolog/tour_guide.pl no longer has the main that is to be replaced")
        text = shipped.replace(main, (self.scenarios / f"{program}.pl").read_text())
        folder = self.cache / f"bonn-{program}-{self.key}-{hashlib.sha256(text.encode()).hexdigest()[:8]}"
        if not folder.exists():
            part = folder.with_suffix(f".part{os.getpid()}-{random.randrange(10 ** 9)}")
            shutil.copytree(self.root / "museums" / "bonn", part)
            (part / "tour.pl").write_text(text)
            try:
                part.rename(folder)
            except OSError:  # another run was sooner
                shutil.rmtree(part)
        return folder

    @staticmethod
    def drawn(text, name, seed):
        """The scenario of a seed, and where the robot starts."""
        draw = random.Random(f"{name} {seed}")
        text = re.sub("DELAY", lambda _: f"{draw.uniform(0.2, 8.0):.1f}", text)
        text = re.sub("CHARGE", lambda _: f"{draw.uniform(0.085, 0.15):.3f}", text)
        return text, f"{draw.uniform(*FOYER[0]):.2f},{draw.uniform(*FOYER[1]):.2f},{draw.uniform(-180, 180):.0f}"

    def run(self, name, planner, seed, settings):
        what = SCENARIOS[name]
        text, start = self.drawn((self.scenarios / f"{name}.yaml").read_text(), name, seed)
        museum = self.museum(what.programs[seed % len(what.programs)] if what.programs else "")
        settings = PLANNERS[planner] + settings
        key = hashlib.sha256(json.dumps([self.key, text, start, museum.name, what.minutes, what.crowd, seed, settings]).encode()).hexdigest()[:16]
        self.cache.mkdir(parents=True, exist_ok=True)
        path = self.cache / f"{name}-{planner}-seed{seed}-{key}.json"
        log, health = path.with_suffix(".csv"), path.with_suffix(".health.csv")
        if not (path.exists() and log.exists() and health.exists()):
            part = path.with_suffix(f".part{os.getpid()}")
            scenario, part_log, part_health = (part.with_suffix(part.suffix + end) for end in (".yaml", ".csv", ".health"))
            scenario.write_text(text)
            began = time.monotonic()
            done = subprocess.run([program_for(self.docent, settings), "simulate", "--museum", museum, "--scenario", scenario, "--hours",
                                   f"{what.minutes / 60:.6f}",
                                   "--seed", str(seed), "--crowd", what.crowd, "--requests-per-hour", "0", f"--start={start}", "--report", part,
                                   "--event-log", part_log, "--health-log", part_health, "--quiet",
                                   *(word for setting in settings for word in ("--set", setting))],
                                  capture_output=True, text=True, check=False)
            scenario.unlink()
            if done.returncode != 0:
                raise RuntimeError(f"{name}, {planner}, seed {seed}: docent simulate exited {done.returncode}: {done.stderr.strip()[-400:]}")
            part_health.rename(health)
            part_log.rename(log)
            part.rename(path)
            print(f"   {name} {planner} seed {seed}: {time.monotonic() - began:.0f} s", file=sys.stderr)
        rows = [list(csv.DictReader(open_lines(file))) for file in (log, health)]
        return Run(json.loads(path.read_text()), *rows, text)


def open_lines(path):
    return path.read_text(encoding="utf-8").splitlines()


def faults_of(name, run):
    """What a run did not do in time, or did and must not."""
    what, report = SCENARIOS[name], run.report
    faults = []
    for bad, how_often in (("touched", contacts_of(report)), ("left its area", report["area_violations"]),
                           ("explained in a wrong place", report["explained_in_wrong_place"]),
                           ("battery empty", report["battery"]["depleted"])):
        if how_often:
            faults.append(f"{bad}: {how_often}")
    for kind, target in sorted(set(run.wishes)):
        ends, wished = [how for _, how in run.ends(target)], run.wishes.count((kind, target))
        expected = ["failed" if target in what.fails else "fulfilled"] * wished
        if ends != expected:
            faults.append(f"{target}: wished for {wished} times, ended as {', '.join(ends) or 'nothing'}")
    faults += twice(run, what.breaks_off)
    for duty in what.duties:
        seconds = duty.seconds(run)
        if seconds is None or seconds > duty.bound:
            faults.append(f"{duty.what}: {'never' if seconds is None else f'{seconds:.0f} s'}")
    return faults


def twice(run, breaks_off):
    """What was begun, explained or said more often than anybody wished for. A tour that was broken off is given anew, as often as the
    scenario makes the robot break one off."""
    faults = []
    for tour in sorted({row["subject"] for row in run.all("tour_started")}):
        begun, anew = len(run.all("tour_started", subject=tour)), min(breaks_off, len(run.all("tour_broken_off", subject=tour)))
        if begun > run.wishes.count(("tour", tour)) + anew:
            faults.append(f"{tour} begun {begun} times")
    for exhibit in sorted({row["subject"] for row in run.all("explained")}):
        often = len(run.all("explained", subject=exhibit))
        of_tours = sum(exhibit in row["detail"].split() for row in run.all("tour_started"))
        if often > run.wishes.count(("exhibit", exhibit)) + of_tours:
            faults.append(f"{exhibit} explained {often} times")
    farewells = {row["subject"] for row in run.rows if row["source"] == "say" and row["subject"].endswith("/farewell")}
    ended = len(run.all("tour_completed")) + len(run.all("tour_failed"))
    if len(farewells) > ended:
        faults.append(f"{len(farewells)} farewells after {ended} tours")
    return faults


def rows_of(name, planner, runs):
    rows = []
    for duty in SCENARIOS[name].duties:
        times = sorted(float("inf") if (s := duty.seconds(run)) is None else s for run in runs)
        text = lambda s: "never" if s == float("inf") else f"{s:.0f}"
        rows.append([name, planner, duty.what, f"{duty.bound:g}", text(statistics.median_low(times)), text(times[-1]),
                     f"{sum(s <= duty.bound for s in times)}/{len(times)}"])
    return rows


def exposure_of(name, planner, runs):
    reports = [run.report for run in runs]
    return [name, planner, f"{sum(r['distance_m'] for r in reports) / 1000:.2f}", f"{sum(r['virtual_seconds'] for r in reports) / 3600:.1f}",
            sum(len(run.wishes) for run in runs), sum(r["requests"]["fulfilled"] for r in reports), sum(r["exhibits_explained"] for r in reports),
            sum(map(contacts_of, reports)), sum(r["passes_within_1m"] for r in reports), sum(r["bumped_by_people"] for r in reports)]


def want_exposure(name, planner, runs, verdict):
    """Each exception did happen; else nothing was shown."""
    for what, (seen_in, least) in SCENARIOS[name].exposure.items():
        mean = statistics.mean(seen_in(run) for run in runs)
        verdict.want(f"{name}, {planner}: {what}, a seed on average ({least:g})", f"{mean:.1f}", mean >= least)
    for what, is_so in SCENARIOS[name].once:
        seeds = sum(map(is_so, runs))
        verdict.want(f"{name}, {planner}: {what}, with one seed at least", f"{seeds} of {len(runs)} seeds", seeds > 0)


def judge(name, planner, seeds, runs, verdict):
    bad = {seed: faults for seed, run in zip(seeds, runs) if (faults := faults_of(name, run))}
    exposure = touched([run.report for run in runs])[1]
    verdict.want(f"{name}, {planner}: all it must, nothing lost, nothing twice", f"{len(runs) - len(bad)} of {len(runs)} seeds; touched {exposure}"
                 + "".join(f"; seed {seed}: {', '.join(faults)}" for seed, faults in bad.items()), not bad)
    want_exposure(name, planner, runs, verdict)


def judge_crippled(name, planner, how, runs, verdict):
    """It must fail what the whole robot passes, with most of the seeds."""
    failed = [faults_of(name, run) for run in runs]
    first = next((", ".join(faults) for faults in failed if faults), "nothing")
    verdict.want(f"{name}, {planner}, crippled: {how} (must fail)", f"fails {sum(map(bool, failed))} of {len(runs)}: {first}",
                 2 * sum(map(bool, failed)) > len(runs))


def kiosk(simulations, options, verdict):
    """A robot of real processes whose screen's server or buttons are killed while a visitor has an open question."""
    trials = kill.trials_of(simulations, options.first_seed, False, kill.KIOSK)["trials"]
    print_table(["module", "when", "back s", "goes on s", "contacts", "fault"],
                [[t["module"], t["situation"], t["back_s"], t["went_on_s"], t["contacts"], t["fault"] or "none"] for t in trials])
    print()
    bad = [f"{t['module']}: {t['fault']}" for t in trials if t["fault"]]
    modules = {t["module"] for t in trials}
    verdict.want("kiosk, real processes: killed while a question is open, it is back and the robot goes on",
                 f"{len(trials) - len(bad)} of {len(trials)}" + "".join(f"; {fault}" for fault in bad), not bad and modules == {"web", "buttons"})


def protocol(simulations, options):
    bonn = Bonn(simulations.docent, simulations.root, simulations.cache, options.jobs)
    parts = [options.part] if options.part else list(SLICE) if options.slice else PARTS
    names = [part for part in parts if part in SCENARIOS]
    how_many = options.seeds or (1 if options.slice else SEEDS)
    seeds = list(range(options.first_seed, options.first_seed + how_many))
    verdict = Verdict()
    of_slice = lambda number, planners: [planners[number % len(planners)]]  # they take turns
    cells = [(name, planner, "", []) for number, name in enumerate(names)
             for planner in (of_slice(number, SCENARIOS[name].planners) if options.slice else SCENARIOS[name].planners)]
    if not options.no_crippled:
        cells += [(name, SCENARIOS[name].planners[0], how, settings) for name in names for how, settings in SCENARIOS[name].crippled.items()]
    calls = [(name, planner, seed, settings) for name, planner, how, settings in cells for seed in (seeds[:CRIPPLED_SEEDS] if how else seeds)]
    made = dict(zip([(name, planner, tuple(settings), seed) for name, planner, seed, settings in calls], simulations.each(bonn.run, calls)))
    runs = {(name, planner, how): [made[name, planner, tuple(settings), seed] for seed in (seeds[:CRIPPLED_SEEDS] if how else seeds)]
            for name, planner, how, settings in cells}
    whole = {(name, planner): found for (name, planner, how), found in runs.items() if not how}
    if whole:
        print(f"\n## what the robot must do, {how_many} seed{'s' if how_many > 1 else ''} each\n")
        print_table(["scenario", "planner", "what", "by s", "median", "worst", "in time"], [row for key, found in whole.items() for row in rows_of(*key, found)])
        print("\n## exposure\n")
        print_table(["scenario", "planner", "km", "h", "wishes", "fulfilled", "explained", "contacts", "passes", "bumped"],
                    [exposure_of(*key, found) for key, found in whole.items()])
        print()
    for (name, planner), found in whole.items():
        judge(name, planner, seeds, found, verdict)
    for (name, planner, how), found in runs.items():
        if how:
            judge_crippled(name, planner, how, found, verdict)
    if "kiosk" in parts:
        kiosk(simulations, options, verdict)
    for planner in PLANNERS:
        hashes = {run.report["config_hash"] for (_, other), found in whole.items() if other == planner for run in found}
        if hashes:
            verdict.want_one_configuration(hashes, of=planner)
    verdict.print()
    return verdict
