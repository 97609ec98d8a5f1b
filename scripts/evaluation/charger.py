"""The charger is of no use: something stands on it for a while or for good, or it gives no current, which its battery says, hides or
never mentions. The robot finds out, tries other ways, calls the staff in time and with the true reason, and charges once it can."""
import csv
import math
import random
import statistics

from evaluation import ways
from evaluation.exceptions import Run
from evaluation.reports import contacts_of
from evaluation.tables import Verdict, print_table

SEEDS, CRIPPLED_SEEDS = 5, 2
MUSEUMS = ["bonn", "smithsonian"]
STRUCK = 30.0  # [s]
CHARGE = (0.17, 0.24)
LEFT = 0.10  # the staff are told while more is left
STAYS, MINUTES = 1500.0, 50.0  # [s] until somebody mends it; of a run
FREE_BY = 600.0  # [s] from then until it charges
AT_CHARGER = 3.0  # [m] from it: whoever is asked for way farther off stands in a way


class Case:
    """@param event  what strikes, with {x}, {y} of the charger and `for` as it is needed; @param reason  that must be told"""

    def __init__(self, event, reason, mended=True):
        self.event, self.reason, self.mended = event, reason, mended


CASES = {
    "stool": Case("stool: {{at: [{x:.2f}, {y:.2f}], radius: {radius:.2f}, height: 0.5, for: {stays:.0f}}}", "charger_occupied"),
    "low-stool": Case("stool: {{at: [{x:.2f}, {y:.2f}], radius: {radius:.2f}, height: 0.3, for: {stays:.0f}}}", "charger_occupied"),
    "stool-for-good": Case("stool: {{at: [{x:.2f}, {y:.2f}], radius: {radius:.2f}, height: 0.5}}", "charger_occupied", mended=False),
    "dead": Case("charger: {{kind: dead, for: {stays:.0f}}}", "charger_no_current"),
    "claims": Case("charger: {{kind: claims, for: {stays:.0f}}}", "charger_no_current"),
    "mute": Case("charger: {{kind: mute, for: {stays:.0f}}}", "charger_no_current"),
}
CRIPPLED = {"takes things for people": ("stool", ["evaluation.takes_things_for_people=true"]),
            "calls nobody": ("dead", ["evaluation.calls_nobody=true"])}


def scenario_of(name, museum, seed):
    draw = random.Random(f"charger {museum.folder.name} {name} {seed}")
    x, y = museum.charger[:2]
    off, bearing = draw.uniform(0.0, 0.12), draw.uniform(-math.pi, math.pi)
    event = CASES[name].event.format(x=x + off * math.cos(bearing), y=y + off * math.sin(bearing), radius=draw.uniform(0.15, 0.28),
                                     stays=STAYS - STRUCK)
    shown = [exhibit for exhibit, what in museum.exhibits.items() if not what.web_only]
    wishes = "".join(f"  - {{at: {at + draw.uniform(0.0, 60.0):.0f}, request: {{kind: exhibit, target: {draw.choice(shown)}, language: en}}}}\n"
                     for at in (60.0, 240.0, 2000.0))
    return f"events:\n  - {{at: {STRUCK:.0f}, {event}}}\n  - {{at: {STRUCK:.0f}, battery: {{charge: {draw.uniform(*CHARGE):.3f}}}}}\n{wishes}"


def run(simulations, museum, seed, name, settings):
    known = ways.Museum(museum)
    scenario = scenario_of(name, known, seed)
    x, y, heading = known.home
    arguments = ["--crowd", "quiet", "--requests-per-hour", "0", f"--start={x:.2f},{y:.2f},{heading:.0f}"]
    arguments += [word for setting in settings for word in ("--set", setting)]
    kept, report = simulations.run_logged("charger", museum, seed, MINUTES / 60, arguments,
                                          {"--event-log": "events.csv", "--health-log": "health.csv"}, scenario)
    rows = []
    for kind in ("events.csv", "health.csv"):
        with open(kept[kind], newline="", encoding="utf-8") as file:
            rows.append(list(csv.DictReader(file)))
    return Run(report, *rows, scenario)


def told(one, name):
    """(seconds since it struck, charge left) when the staff were first told the true reason; None: never."""
    call = next((row for row in one.all("staff_called") if row["subject"] == CASES[name].reason), None)
    return None if call is None else (call["time"] - STRUCK, call["value"])


def charges_again(one):
    """[s] after it was mended until its charge was known to rise: health says no more of it. None: never."""
    ready = [float(row["time"]) for row in one.health if row["module"] == "mission" and row["state"] == "ready" and float(row["time"]) >= STAYS]
    return ready[0] - STAYS if ready else None


def faults_of(name, one, charger):
    faults = [f"touched {contacts_of(one.report)}"] if contacts_of(one.report) else []
    call = told(one, name)
    if call is None:
        faults.append(f"never told {CASES[name].reason}")
    elif call[1] < LEFT:
        faults.append(f"told with {100 * call[1]:.0f} % left")
    wrong = [row["subject"] for row in one.all("staff_called") if row["subject"] not in (CASES[name].reason, "battery_low")]
    if wrong:
        faults.append(f"told {', '.join(sorted(set(wrong)))}")
    if CASES[name].reason == "charger_occupied" and (asked := asked_at_charger(one, charger)):
        faults.append(f"asked a thing to make way {asked} times")
    said = [row for row in one.rows if row["source"] == "say" and row["subject"].endswith("/call")]
    if not said and name != "claims" and name != "mute":
        faults.append("said nothing to anybody")
    if CASES[name].mended:
        again = charges_again(one)
        if again is None or again > FREE_BY:
            faults.append(f"charges again: {'never' if again is None else f'{again:.0f} s'}")
    return faults


def asked_at_charger(one, charger):
    """How often it asked for way on its way to the charger, while it stood before it and a thing stood on it."""
    return sum(row["subject"] == "" and row["time"] < STAYS and math.dist((row["x"], row["y"]), charger[:2]) <= AT_CHARGER
               for row in one.all("asked_for_way"))


def protocol(simulations, options):
    seeds = list(range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else SEEDS))))
    museums = options.museums.split(",") if options.museums else MUSEUMS[:1] if options.slice else MUSEUMS
    names = [options.part] if options.part else ["stool", "claims"] if options.slice else list(CASES)
    cells = [(museum, name, "", []) for museum in museums for name in names]
    if not options.no_crippled:
        cells += [(museums[0], name, how, settings) for how, (name, settings) in CRIPPLED.items() if name in names]
    of = lambda how: seeds[:CRIPPLED_SEEDS] if how else seeds
    calls = [(simulations, simulations.museums / museum, seed, name, settings) for museum, name, how, settings in cells for seed in of(how)]
    made = iter(simulations.each(run, calls))
    runs = {(museum, name, how): [next(made) for _ in of(how)] for museum, name, how, _ in cells}
    rows = []
    for (museum, name, how), found in runs.items():
        calls_of = [told(one, name) for one in found]
        known = [call for call in calls_of if call]
        again = [charges_again(one) for one in found] if CASES[name].mended else []
        rows.append([museum, name, how or "whole", f"{len(known)}/{len(found)}", f"{statistics.median(c[0] for c in known):.0f}" if known else "-",
                     f"{100 * min(c[1] for c in known):.0f}" if known else "-",
                     f"{max(a for a in again if a is not None):.0f}" if any(a is not None for a in again) else "-",
                     sum(len(one.all('charger_failed')) for one in found), sum(len(one.all('asked_for_way')) for one in found),
                     sum(one.report["exhibits_explained"] for one in found)])
    print("\n## The charger is of no use\n")
    print_table(["museum", "case", "robot", "told", "after s", "least left %", "charges again s", "failures", "asked", "explained"], rows)
    print()
    verdict = Verdict()
    for (museum, name, how), found in runs.items():
        charger = ways.Museum(simulations.museums / museum).charger
        faults = {seed: bad for seed, one in zip(of(how), found) if (bad := faults_of(name, one, charger))}
        seen = f"{len(found) - len(faults)} of {len(found)} seeds" + "".join(f"; seed {seed}: {', '.join(bad)}" for seed, bad in faults.items())
        if how:
            verdict.want(f"{museum}, {name}, crippled: {how} (must fail)", seen, 2 * len(faults) > len(found))
        else:
            verdict.want(f"{museum}, {name}: found, told in time and truly, used again", seen, not faults)
    verdict.want_one_configuration(one.report["config_hash"] for (_, _, how), found in runs.items() if not how for one in found)
    verdict.print()
    return verdict
