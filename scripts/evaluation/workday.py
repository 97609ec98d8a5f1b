"""Days of six hours, as a museum has them: few people in the morning, most at noon, and wishes up to the last minute. How many were refused,
how many still wait when the day ends, and how long people waited. Part `six-hours` of `day`."""
import collections
import random
import statistics

from evaluation.day import Record, read_rows, waits
from evaluation.reports import contacts_of
from evaluation.simulations import ONLY_SCENARIO
from evaluation.tables import Verdict, print_table
from evaluation import ways

HOURS, DAYS = 6, 10  # days in each museum
BEGINS = "10:00"
CROWD = [0.6, 0.9, 1.3, 1.5, 1.1, 0.6]  # of the mean, hour by hour
HALL, TOURS, WEB = 7.0, 4.0, 5.0  # wishes an hour in the mean: exhibits and tours in the hall, exhibits from the Web
WAITING = 0.02  # of a day's wishes may still wait at its end
MUSEUMS = ["bonn", "smithsonian"]
FULL = {"charges whenever a quarter is missing": ["mission.charging.in_gaps=false"]}  # shown beside, not judged


def events_of(museum, seed):
    draw = random.Random(f"six hours {museum.folder.name} {seed}")
    shown = [name for name, exhibit in museum.exhibits.items() if not exhibit.web_only]
    events = []
    for rate, kind, source, targets in ((HALL, "exhibit", "kiosk", shown), (TOURS, "tour", "kiosk", list(museum.tours)),
                                        (WEB, "exhibit", "web", shown)):
        at = 0.0
        while True:  # a Poisson process, thinned by the hour
            at += draw.expovariate(rate * max(CROWD) / 3600.0)
            if at >= HOURS * 3600.0:
                break
            if draw.random() < CROWD[int(at / 3600.0)] / max(CROWD):
                events.append((at, f"request: {{kind: {kind}, target: {draw.choice(targets)}, source: {source}, language: {draw.choice(['en', 'de'])}}}"))
    return sorted(events)


def run(simulations, museum, seed, arguments):
    scenario = "events:\n" + "".join(f"  - {{at: {at:.1f}, {event}}}\n" for at, event in events_of(ways.Museum(museum), seed))
    kept, report = simulations.run_logged("six-hours", museum, seed, HOURS, [*ONLY_SCENARIO, "--time-of-day", BEGINS, *arguments],
                                          {"--request-log": "requests.csv", "--event-log": "events.csv"}, scenario)
    return Record(read_rows(kept["requests.csv"]), read_rows(kept["events.csv"])), report


def waiting(record):
    """Asked for, and not ended when the day was over."""
    return sum(not request.end for request in record.requests.values())


def row_of(museum, how, days):
    records = [record for record, _ in days]
    reports = [report for _, report in days]
    ends = collections.Counter(request.end for record in records for request in record.requests.values())
    asked = sum(len(record.requests) for record in records)
    hall, web = ([wait for record in records for wait in waits(record, source)] for source in ("kiosk", "web"))
    minutes = [f"{statistics.median(some) / 60:.1f}" if some else "-" for some in (hall, web)]
    return [museum, how, len(days), f"{sum(r['distance_m'] for r in reports) / 1000:.1f}", sum(r["battery"]["charges"] for r in reports), asked,
            ends["refused"], ends["fulfilled"], ends["failed"] + ends["cancelled"], ends[""], max(map(waiting, records)),
            f"{100 * ends[''] / max(1, asked):.1f}", *minutes, f"{max(hall + web, default=0.0) / 60:.0f}", sum(map(contacts_of, reports))]


def protocol(simulations, options):
    seeds = list(range(options.first_seed, options.first_seed + (options.seeds or DAYS)))
    museums = options.museums.split(",") if options.museums else MUSEUMS
    kinds = {"whole": [], **({} if options.no_crippled else FULL)}
    cells = [(museum, how) for how in kinds for museum in museums]
    calls = [(simulations, simulations.museums / museum, seed, [word for setting in kinds[how] for word in ("--set", setting)])
             for museum, how in cells for seed in seeds]
    made = simulations.each(run, calls)
    days = {cell: made[i * len(seeds):(i + 1) * len(seeds)] for i, cell in enumerate(cells)}
    print("\n## Days of six hours, busy\n")
    print_table(["museum", "robot", "days", "km", "charges", "asked", "refused", "served", "failed", "waiting", "most", "waiting %",
                 "wait hall min", "wait Web min", "longest", "contacts"], [row_of(museum, how, found) for (museum, how), found in days.items()])
    print("\nwaiting: asked for and not ended when the day was over; most: on one day; wait: median, from the wish to its end.\n")
    verdict = Verdict()
    for museum in museums:
        records = [record for record, _ in days[museum, "whole"]]
        asked = sum(len(record.requests) for record in records)
        refused = sum(request.end == "refused" for record in records for request in record.requests.values())
        left = sum(map(waiting, records))
        verdict.want(f"{museum}: refused (none)", f"{refused} of {asked}", asked > 0 and refused == 0)
        verdict.want(f"{museum}: still waiting at the end, at most {100 * WAITING:g} %", f"{left} of {asked}, {100 * left / max(1, asked):.1f} %",
                     asked > 0 and left <= WAITING * asked)
        empty = sum(report["battery"]["depleted"] for _, report in days[museum, "whole"])
        verdict.want(f"{museum}: the battery never empty", f"{empty} times", empty == 0)
    verdict.want_one_configuration(report["config_hash"] for (_, how), found in days.items() if how == "whole" for _, report in found)
    verdict.print()
    return verdict
