"""People with legs, bags, prams and wheelchairs beside people who are discs down to the floor, in the same halls.

The lasers see legs; a touch counts against the whole body. Both worlds have the same museums, crowds and seeds, and a share of
people who do not evade. Nothing may be touched among legs; how fast the robot is there, and how much a simulation costs, is
held against the discs. Crippled robots run among the legs: one that is blind to people, and one without a margin for what its
lasers do not see of them. The first must be at fault; of the second it is shown what it crept on to.
"""
import csv

from evaluation.bounds import bounded
from evaluation.reports import KINDS, computed_of, contacts_of, mean_speed
from evaluation.safety import made_museum
from evaluation.tables import Verdict, print_table

MUSEUMS = ["bonn", "smithsonian", "collection"]
CROWDS = ["busy", "packed"]
HEEDLESS = 0.1  # share of people who do not evade
BODIES = ["legs", "discs"]
CREEPS = 0.02  # [m/s] a touch with more of the robot's own speed is one that it made, harmless as it may be
MOST_TIME = 1.1  # of the discs' processor time
KM_AN_HOUR = 0.2
SLOWER = 0.9  # of the speed among discs, least (an aim)
HEADER = ["museum", "crowd", "people", "km", "passes", *KINDS, "crept on", "bumped", "at most a km", "m/s", "km/h", "core s/h"]
BLIND = "blind to people"
CRIPPLED = {
    BLIND: ["--set", "evaluation.blind_to_people=true"],
    "no margin for bodies": ["--set", "avoid.body.ahead=0", "--set", "avoid.body.aside=0"],
}
LOGS = {"--event-log": "events.csv"}


def crept_on(path):
    """Touches of people in which the robot itself moved towards them."""
    with open(path, newline="", encoding="utf-8") as file:
        return sum(row["source"] == "contact" and row["kind"] == "people" and float(row["value"]) > CREEPS for row in csv.DictReader(file))


class Cell:
    """Runs of one museum, crowd and kind of people."""

    def __init__(self, runs):
        self.reports = [report for _, report in runs]
        self.crept = sum(crept_on(kept["events.csv"]) for kept, _ in runs)
        self.km = sum(report["distance_m"] for report in self.reports) / 1000
        self.hours = sum(report["virtual_seconds"] for report in self.reports) / 3600
        self.contacts = sum(map(contacts_of, self.reports))
        self.passes = sum(report["passes_within_1m"] for report in self.reports)
        self.speed = mean_speed(self.reports)
        self.computed = sum(map(computed_of, self.reports))

    def row(self, *names):
        return [*names, f"{self.km:.2f}", self.passes, *(sum(r["contacts"][kind] for r in self.reports) for kind in KINDS), self.crept,
                sum(r["bumped_by_people"] for r in self.reports), bounded(self.contacts, self.km).split("at most ")[-1].split(" a ")[0],
                f"{self.speed:.3f}", f"{self.km / self.hours:.3f}", f"{self.computed / self.hours:.1f}"]


def run_cells(simulations, cells, seeds, minutes):
    """@param cells  (museum, crowd, what follows in the command)"""
    runs = simulations.each(simulations.run_logged, [
        ("bodies", museum, seed, minutes / 60, ["--crowd", crowd, "--heedless", HEEDLESS, *arguments], LOGS)
        for museum, crowd, arguments in cells for seed in seeds])
    return [Cell(runs[i * len(seeds):(i + 1) * len(seeds)]) for i in range(len(cells))]


def total(cells):
    whole = Cell([])
    for cell in cells:
        whole.reports += cell.reports
        for name in ("crept", "km", "hours", "contacts", "passes", "computed"):
            setattr(whole, name, getattr(whole, name) + getattr(cell, name))
    whole.speed = mean_speed(whole.reports)
    return whole


def protocol(simulations, options):
    minutes = options.minutes or (3 if options.slice else 10)
    count = options.seeds or (1 if options.slice else 10)
    seeds = list(range(options.first_seed, options.first_seed + count))
    names = options.museums.split(",") if options.museums else MUSEUMS[:1] if options.slice else MUSEUMS
    crowds = options.crowds.split(",") if options.crowds else CROWDS[-1:] if options.slice else CROWDS
    verdict = Verdict()
    museums = [made_museum(simulations, verdict, options.slice) if name == "collection" else simulations.museums / name for name in names]
    places = [(museum, crowd) for museum in museums if museum is not None for crowd in crowds]
    print(f"\n## {count} seeds x {minutes:g} minutes, {100 * HEEDLESS:.0f} % of the people evade nothing\n")
    cells = [(museum, crowd, ["--bodies", bodies]) for museum, crowd in places for bodies in BODIES]
    results = run_cells(simulations, cells, seeds, minutes)
    rows = [cell.row(museum.name, crowd, arguments[-1]) for (museum, crowd, arguments), cell in zip(cells, results)]
    sums = {bodies: total(results[i::len(BODIES)]) for i, bodies in enumerate(BODIES)}
    print_table(HEADER, rows + [sums[bodies].row("all", "", bodies) for bodies in BODIES])
    print()
    legs, discs = sums["legs"], sums["discs"]
    share = 0.2 if options.slice else 1.0  # a short run must only not be idle
    verdict.want("legs: contacts", f"{bounded(legs.contacts, legs.km, legs.hours)}; {legs.passes} passes within 1 m",
                 legs.contacts == 0 and legs.passes > 0)
    verdict.note("legs: touches that the robot crept on to", bounded(legs.crept, legs.km))
    verdict.note("discs: contacts", bounded(discs.contacts, discs.km, discs.hours))
    verdict.want(f"legs: driven in an hour ({KM_AN_HOUR} km)", f"{legs.km / legs.hours:.2f} km", legs.km / legs.hours >= share * KM_AN_HOUR)
    speeds = f"{legs.speed:.3f} m/s, {discs.speed:.3f} among discs"
    times = f"{legs.computed / legs.hours:.1f} s of one core an hour, {discs.computed / discs.hours:.1f} with discs: {legs.computed / discs.computed:.2f}"
    if options.slice:
        verdict.note("legs: speed", speeds)
        verdict.note("legs: processor time", times)
    else:
        verdict.want(f"legs: speed (aim, {SLOWER:g} of that among discs)", speeds, legs.speed >= SLOWER * discs.speed)
        verdict.want(f"legs: processor time (at most {MOST_TIME} of the discs')", times, legs.computed <= MOST_TIME * discs.computed)
    verdict.want_one_configuration(report["config_hash"] for cell in results for report in cell.reports)
    verdict.print()
    if not options.no_crippled:
        verdict.add(crippled(simulations, places[:1], seeds[:3], minutes))
    return verdict


def crippled(simulations, places, seeds, minutes):
    verdict = Verdict()
    names = list(CRIPPLED)
    cells = [(museum, crowd, [*CRIPPLED[name]]) for museum, crowd in places for name in names]
    print("\n## crippled, among legs\n")
    results = run_cells(simulations, cells, seeds, minutes)
    print_table(["robot", *HEADER[:2], *HEADER[3:]],
                [cell.row(name, museum.name, crowd) for (museum, crowd, _), name, cell in zip(cells, names * len(places), results)])
    print()
    for name, cell in zip(names * len(places), results):
        seen = f"{cell.contacts} contacts, {cell.crept} crept on to, in {cell.km:.2f} km"
        if name == BLIND:
            verdict.want(f"crippled, {name} (must touch)", seen, cell.contacts > 0)
        else:
            verdict.note(f"crippled, {name}", seen)
    verdict.print()
    return verdict
