"""Eight kinds of scanners as they are sold, each as all that a base has, in two museums: how soon the robot is here, how exact, and what
it touches; the same from recordings made with them; scanners that hang and of which nobody says so, which must be named; and a robot that holds
far readings against near expectations, which must get lost."""
import csv
import json
import math
import subprocess

from evaluation.bounds import bounded
from evaluation.reports import contacts_of
from evaluation.scan_twins import Twins
from evaluation.tables import Verdict, print_table

# field [deg], beams, rate [Hz], reach [m], the rest as in robot.yaml.
KINDS = {
    "4 m, 240 deg, writes 0": "field: 240, beams: 682, rate: 10, max_range: 4, no_return: zero",
    "8 m, 360 deg, 90 beams, 5 Hz": "field: 360, beams: 90, rate: 5, max_range: 8, no_return: infinity",
    "10 m, 180 deg": "field: 180",
    "12 m, 360 deg, clockwise, posts": "field: 360, beams: 360, rate: 5.5, max_range: 12, clockwise: true, no_return: infinity",
    "20 m, 270 deg, 25 Hz": "field: 270, beams: 541, rate: 25, max_range: 20",
    "30 m, 270 deg, 40 Hz, hangs": "field: 270, beams: 1081, rate: 40, max_range: 30, upside_down: true, no_return: infinity",
    "30 m, 360 deg, 2880 beams, clockwise, writes 0":
        "field: 360, beams: 2880, rate: 10, max_range: 30, clockwise: true, no_return: zero",
    "80 m, 190 deg, 25 Hz": "field: 190, beams: 1141, rate: 25, max_range: 80",
}
POSTS = "body.posts=[[0.15, 0.12, 0.03], [0.15, -0.12, 0.03], [-0.2, 0.0, 0.02]]"
SLICE = ["4 m, 240 deg, writes 0", "12 m, 360 deg, clockwise, posts", "80 m, 190 deg, 25 Hz"]
SLICE_RECORDED = ["12 m, 360 deg, clockwise, posts", "30 m, 270 deg, 40 Hz, hangs"]
SHORT = {"4 m, 240 deg, writes 0": 4.0, "8 m, 360 deg, 90 beams, 5 Hz": 8.0}  # [m] of which one turn may tell too little
HANGS = ["20 m, 270 deg, 25 Hz", "30 m, 270 deg, 40 Hz, hangs", "8 m, 360 deg, 90 beams, 5 Hz"]  # otherwise than is said
NAMED_M, SAYS_MIRRORED = 10.0, "mirrors left and right"  # of way within which it is named
FAR = ["20 m, 270 deg, 25 Hz", "80 m, 190 deg, 25 Hz"]  # what the crippled robot is given
MUSEUMS = ["bonn", "smithsonian"]
MINUTES, SEEDS, SLICE_MINUTES, MIRRORED_MINUTES = 6, 5, 1.5, 1
# As exact as a scanner that ends where the model does: at most 5 cm, or one and a half times its error in that museum.
ORDINARY = "10 m, 180 deg"
HERE_S, ERROR_M, ERROR_TIMES, LOST_SHARE = 10.0, 0.05, 1.5, 0.05
CRIPPLED = ["--set", "evaluation.ignores_reach=true"]
HEADER = ["scanner", "museum", "runs", "here after s", "worst", "error cm", "lost s", "wrong s", "driven m", "contacts", "area"]


def settings_of(kind):
    scanner = f"body.scanners=[{{name: front, frame: laser_front, {KINDS[kind]}}}]"
    base = [scanner, "body.sonars=0", "body.infrareds=0", "body.tactile=false", *([POSTS] if "posts" in kind else [])]
    return [word for setting in base for word in ("--set", setting)]


def here_after(report):
    """[s]; a robot that never is, was not for the whole run."""
    after = report["localization"]["localized_after_s"]
    return report["virtual_seconds"] if after is None else after


def row_of(kind, museum, reports):
    after = [here_after(r) for r in reports]
    errors = [r["localization"]["mean_error_m"] for r in reports if r["localization"]["mean_error_m"] is not None]
    return [kind, museum, len(reports), f"{sum(after) / len(after):.1f}", f"{max(after):.1f}",
            f"{100 * sum(errors) / len(errors):.1f}" if errors else "none", f"{sum(r['localization']['lost_s'] for r in reports):.0f}",
            f"{sum(r['localization']['wrong_but_sure_s'] for r in reports):.1f}", f"{sum(r['distance_m'] for r in reports):.0f}",
            sum(map(contacts_of, reports)), sum(r["area_violations"] for r in reports)]


def mean_error(reports):
    known = [r["localization"]["mean_error_m"] for r in reports]
    return math.inf if None in known else sum(known) / len(known)


def judge(verdict, kind, museum, reports, ordinary, twins):
    """@param ordinary  reports of ORDINARY in that museum, or none
    @param twins  of each run's first place, how many others look the same to this scanner in a whole turn without people"""
    late = [(here_after(r), t) for r, t in zip(reports, twins) if here_after(r) > HERE_S]
    name = f"{kind}, {museum}"
    owed = [t for t in twins if t == 0]
    verdict.want(f"{name}: here within {HERE_S:g} s (nine of ten, of those whose first place has no twin)",
                 f"{len(owed) - sum(t == 0 for _, t in late)} of {len(owed)}, the last of all after {max(map(here_after, reports)):.1f} s",
                 10 * sum(t == 0 for _, t in late) <= len(owed))
    if len(owed) < len(twins):
        verdict.note(f"{name}: begun where a turn cannot tell", f"{len(twins) - len(owed)} of {len(twins)}, here within {HERE_S:g} s: "
                     f"{len(twins) - len(owed) - sum(t > 0 for _, t in late)}")
    seconds = sum(r["virtual_seconds"] for r in reports)
    most = max([ERROR_M, *([ERROR_TIMES * mean_error(ordinary)] if ordinary else [])])
    verdict.want(f"{name}: mean error (at most {100 * most:.1f} cm)", f"{100 * mean_error(reports):.1f} cm in {seconds:.0f} s", mean_error(reports) <= most)
    lost, wrong = (sum(r["localization"][key] for r in reports) for key in ("lost_s", "wrong_but_sure_s"))
    verdict.want(f"{name}: sure but wrong (1 %)", f"{wrong:.1f} of {seconds:.0f} s", wrong <= 0.01 * seconds)
    verdict.note(f"{name}: lost later, among people", f"{lost:.0f} of {seconds:.0f} s")
    driven, touched = sum(r["distance_m"] for r in reports), sum(map(contacts_of, reports))
    verdict.want(f"{name}: contacts and area violations", bounded(touched + sum(r["area_violations"] for r in reports), driven / 1000),
                 touched == 0 and driven >= 2 * len(reports))


def twins_of(kind, museum, logged):
    """[runs] how many places look like the first one, see scan_twins."""
    if kind not in SHORT:
        return [0] * len(logged)
    plan = Twins(museum, SHORT[kind])
    firsts = [next(csv.DictReader(kept["csv"].read_text().splitlines())) for kept, _ in logged]
    return [plan.of(float(row["true_x"]), float(row["true_y"]))[1] for row in firsts]


def mirrored(simulations, kinds, museum, minutes, seeds, verdict):
    """Scanners that hang and are said to stand, or the reverse, and the same as they are said."""
    for kind in kinds:
        for is_wrong in (True, False):
            scenario = f"build: {{mirrored: [{'front' if is_wrong else ''}]}}\nevents: []\n"
            run = lambda seed: simulations.run_logged("scanners", simulations.museums / museum, seed, minutes / 60, ["--crowd", "busy", *settings_of(kind)],
                                                      {"--claims": "csv", "--health-log": "health.csv"}, scenario)
            named, worst, touched, driven = 0, 0.0, 0, 0.0
            for kept, report in simulations.each(run, [(seed,) for seed in seeds]):
                touched, driven = touched + contacts_of(report), driven + report["distance_m"]
                said = [row for row in csv.DictReader(kept["health.csv"].read_text().splitlines()) if SAYS_MIRRORED in row["reason"]]
                if said:
                    beliefs = csv.DictReader(kept["csv"].read_text().splitlines())
                    ways = [float(row["distance"]) for row in beliefs if float(row["time"]) <= float(said[0]["time"])]
                    named, worst = named + 1, max([worst, *ways[-1:]])
            what = f"mirrored unsaid: named (within {NAMED_M:g} m), contacts" if is_wrong else "as it is said: named (never), contacts"
            verdict.want(f"{kind}, {museum}, {what}", f"{named} of {len(seeds)} after {worst:.1f} m, contacts: {bounded(touched, driven / 1000)}",
                         touched == 0 and (named == len(seeds) and worst <= NAMED_M if is_wrong else named == 0))


def reference_of(claims, recording_begins):
    """What `docent localize --reference` reads: the truth of a run, at the times of its recording."""
    lines = []
    with open(claims, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            lines.append(f"{recording_begins + float(row['time']):.3f} {row['true_x']} {row['true_y']} {math.radians(float(row['true_heading'])):.5f}")
    return "\n".join(lines) + "\n"


def localized(simulations, museum, kept):
    """The report of `docent localize` over a recording, default settings, unknown start."""
    report = kept["mcap"].with_suffix(".localize.json")
    if not report.exists():
        reference = kept["mcap"].with_suffix(".reference")
        reference.write_text(reference_of(kept["csv"], 0.0))
        part = report.with_suffix(".part")
        subprocess.run([simulations.docent, "localize", "--map", museum / "map.yaml", "--log", kept["mcap"], "--reference", reference, "--wall-depth",
                        "0", "--report", part], check=True, capture_output=True, timeout=1800)
        part.rename(report)
    return json.loads(report.read_text())


def recordings(simulations, kinds, museums, minutes, seeds, verdict):
    calls = [(kind, name, seed) for kind in kinds for name in museums for seed in seeds]

    def run(kind, name, seed):
        museum = simulations.museums / name
        kept, _ = simulations.run_logged("scanners", museum, seed, minutes / 60, ["--crowd", "busy", *settings_of(kind)],
                                         {"--claims": "csv", "--record": "mcap"})
        return localized(simulations, museum, kept)

    rows = []
    for (kind, name, seed), report in zip(calls, simulations.each(run, calls)):
        # In hindsight: what was unsure then, among people, is known at the end.
        first, error = report.get("localized_after_scans"), report.get("in_hindsight", {}).get("mean_error_m")
        wrong, scans = report.get("sure_and_wrong_scans", 0), report["scans"]
        rows.append([kind, name, seed, scans, first, "none" if error is None else f"{100 * error:.1f}", report.get("lost_scans"), wrong])
        verdict.want(f"recorded, {kind}, {name}, seed {seed}: error in hindsight, sure and wrong",
                     f"{rows[-1][5]} cm, {wrong} of {scans} scans", error is not None and error <= 2 * ERROR_M and wrong <= 0.02 * scans)
    print_table(["recorded with", "museum", "seed", "scans", "here after", "error cm", "lost scans", "sure and wrong"], rows)


def crippled(simulations, kinds, museum, minutes, seeds, verdict):
    """Far views are free in an empty hall: there far readings held against near expectations are contradictions."""
    for kind in kinds:
        for how, more in (("whole", []), ("far readings held against near expectations", CRIPPLED)):
            reports = simulations.of_seeds("scanners", simulations.museums / museum, seeds, minutes, ["--crowd", "empty", *settings_of(kind), *more])
            lost = sum(here_after(r) > HERE_S or r["localization"]["lost_s"] > LOST_SHARE * r["virtual_seconds"] for r in reports)
            verdict.want(f"{kind}, {museum}, empty, {how}: not here within {HERE_S:g} s or lost for {100 * LOST_SHARE:g} % of the time"
                         f" ({'must be' if more else 'must not be'})", f"{lost} of {len(reports)} runs", 2 * lost > len(reports) if more else lost == 0)


def protocol(simulations, options):
    kinds = SLICE if options.slice else list(KINDS)
    museums = MUSEUMS[:1] if options.slice else MUSEUMS
    minutes = options.minutes or (SLICE_MINUTES if options.slice else MINUTES)
    seeds = range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else SEEDS)))
    print(f"\n## {len(kinds)} scanners in {' and '.join(museums)}, busy, {len(seeds)} seeds x {minutes:g} minutes each\n")
    calls = [(kind, museum) for kind in kinds for museum in museums]
    logged = {(kind, museum): simulations.each(simulations.run_logged, [
        ("scanners", simulations.museums / museum, seed, minutes / 60, ["--crowd", "busy", *settings_of(kind)], {"--claims": "csv"}) for seed in seeds])
        for kind, museum in calls}
    made = {call: [report for _, report in runs] for call, runs in logged.items()}
    print_table(HEADER, [row_of(kind, museum, reports) for (kind, museum), reports in made.items()])
    print()
    verdict = Verdict()
    for (kind, museum), reports in made.items():
        judge(verdict, kind, museum, reports, made.get((ORDINARY, museum)), twins_of(kind, simulations.museums / museum, logged[kind, museum]))
    recordings(simulations, SLICE_RECORDED if options.slice else kinds, museums, minutes, seeds[:2], verdict)
    mirrored(simulations, HANGS[:1] if options.slice else HANGS, MUSEUMS[0], MIRRORED_MINUTES, seeds, verdict)
    if not options.no_crippled:
        crippled(simulations, FAR[-1:] if options.slice else FAR, MUSEUMS[-1], minutes, seeds, verdict)
    verdict.print()
    return verdict
