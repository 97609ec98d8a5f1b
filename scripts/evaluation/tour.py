"""Tours in a busy museum: nothing touched, localized, requests served, at thirty times real time; and the crippled robots."""
from evaluation.bounds import bounded
from evaluation import crippled
from evaluation.reports import contacts_of, want_speedup
from evaluation.tables import Verdict, print_table

HEADER = ["seed", "km", "m/s", "explained", "offered", "served", "contacts", "bumped", "area", "passes", "localized s",
          "error cm", "lost", "speedup"]
MINUTES, SLICE_MINUTES = 30, 25
PARTS = ["one-scanner", "golog"]
SCANNER_SEEDS = 5  # of the robot with one scanner in front, and of the full robot beside it


def served_of(report):
    """Requests served and requests that count: what was offered in the last ten minutes does not, either way."""
    return report["requests"]["counted_served"], report["requests"]["counted"]


def row_of(seed, report):
    served, counted = served_of(report)
    localization = report["localization"]
    return [seed, f"{report['distance_m'] / 1000:.2f}", f"{report['mean_speed_mps']:.2f}", report["exhibits_explained"],
            report["requests"]["offered"], f"{served}/{counted}", contacts_of(report), report["bumped_by_people"],
            report["area_violations"], report["passes_within_1m"],
            "-" if localization["localized_after_s"] is None else f"{localization['localized_after_s']:.0f}",
            f"{100 * localization['mean_error_m']:.1f}", localization["lost_events"],
            f"{report['speedup']:.1f}"]


def judge(reports, minutes, floors):
    """The bounds of a tour: nothing touched, localized, requests served, and enough of everything to mean something."""
    verdict = Verdict()
    hours = len(reports) * minutes / 60
    km = sum(r["distance_m"] for r in reports) / 1000
    explained = sum(r["exhibits_explained"] for r in reports)
    offered = sum(r["requests"]["offered"] for r in reports)
    served = [served_of(r) for r in reports]
    total = sum(c for _, c in served)
    rates = [s / c if c else 0.0 for s, c in served]
    localized = [r["localization"]["localized_after_s"] for r in reports]
    early = sum(1 for t in localized if t is not None and t <= 300)
    contacts = sum(map(contacts_of, reports))
    verdict.want("contacts", f"{bounded(contacts, km, hours)}; {sum(r['passes_within_1m'] for r in reports)} passes within 1 m",
                 contacts == 0)
    violations = sum(r["area_violations"] for r in reports)
    verdict.want("area violations", f"{violations}", violations == 0)
    verdict.want("localized within 5 minutes", f"{early} of {len(reports)}", early >= 0.8 * len(reports))
    verdict.want("localized by the end", f"{sum(t is not None for t in localized)} of {len(reports)}", None not in localized)
    pooled = sum(s for s, _ in served) / total if total else 0.0
    verdict.want("requests served, pooled", f"{100 * pooled:.1f} % of {total}", pooled >= 0.95)
    verdict.want("requests served, worst seed", f"{100 * min(rates):.1f} %", min(rates) >= 0.85)
    verdict.want("requests offered an hour", f"{offered / hours:.1f}", offered / hours >= floors["offered"])
    verdict.want("driven", f"{km:.2f} km", km >= floors["km"])
    verdict.want("exhibits explained", f"{explained}", explained >= floors["explained"])
    return verdict


def one_scanner(simulations, seeds, minutes):
    """A robot with one scanner in front beside the full robot: nothing touched, tours given. What the full robot must
    do besides, its own part says; here it is shown."""
    museum = simulations.museums / "bonn"
    print(f"\n## {museum.name}, busy, {len(seeds)} seeds x {minutes:g} minutes, unknown start: one scanner in front, and "
          "the full robot\n")
    robots = {"one scanner": ["--robot", simulations.root / "robots" / "one-scanner.yaml"], "full robot": []}
    made = {name: simulations.of_seeds("tour", museum, seeds, minutes, ["--crowd", "busy", *arguments])
            for name, arguments in robots.items()}
    print_table(["robot", *HEADER], [[name, *row_of(seed, report)] for name, reports in made.items()
                                     for seed, report in zip(seeds, reports)])
    print()
    verdict = Verdict()
    reports = made["one scanner"]
    km = sum(r["distance_m"] for r in reports) / 1000
    contacts, violations = sum(map(contacts_of, reports)), sum(r["area_violations"] for r in reports)
    verdict.want("one scanner: contacts", f"{contacts} in {km:.2f} km, {sum(r['passes_within_1m'] for r in reports)} "
                 "passes within 1 m", contacts == 0)
    verdict.want("one scanner: area violations", f"{violations}", violations == 0)
    tours = [r["tours"]["completed"] for r in reports]
    verdict.want("one scanner: tours completed, every seed", f"{sum(tours)}, the worst seed {min(tours)}", min(tours) >= 1)
    served, counted = (sum(part) for part in zip(*map(served_of, reports)))
    verdict.want("one scanner: requests served, pooled", f"{100 * served / max(1, counted):.1f} % of {counted}",
                 counted > 0 and served >= 0.95 * counted)
    # A robot that turns to look drives less; one that stands gives no tours.
    full_km = sum(r["distance_m"] for r in made["full robot"]) / 1000
    verdict.want("one scanner: driven, at least half of the full robot", f"{km:.2f} of {full_km:.2f} km", km >= 0.5 * full_km)
    verdict.want_one_configuration(r["config_hash"] for r in reports)
    verdict.print()
    return verdict


def golog(simulations, museum, seeds, minutes, floors):
    """The museum's GOLOG program instead of the plan controller: the same service."""
    print(f"\n## {museum.name}, busy, {len(seeds)} seeds x {minutes:g} minutes, unknown start: GOLOG program\n")
    reports = simulations.of_seeds("tour", museum, seeds, minutes, ["--crowd", "busy", "--set", "mission.planner=golog"])
    print_table(HEADER, [row_of(seed, report) for seed, report in zip(seeds, reports)])
    print()
    verdict = judge(reports, minutes, floors)
    verdict.want_one_configuration(r["config_hash"] for r in reports)
    verdict.print()
    return verdict


def protocol(simulations, options):
    is_bonn = options.name == "tour"
    if options.part == "one-scanner":
        count = options.seeds or (1 if options.slice else SCANNER_SEEDS)
        return one_scanner(simulations, list(range(options.first_seed, options.first_seed + count)),
                           SLICE_MINUTES if options.slice else options.minutes or MINUTES)
    museum = simulations.museums / ("bonn" if is_bonn else "smithsonian")
    count = options.seeds or (1 if options.slice else 10 if is_bonn else 5)
    seeds = list(range(options.first_seed, options.first_seed + count))
    minutes = SLICE_MINUTES if options.slice else options.minutes or MINUTES
    share = count * minutes / 300  # floors are for ten seeds of thirty minutes
    # A single short run may fall short of its share of the exposure: it must only not be idle.
    idle = 0.3 if count * minutes < 60 else 1.0
    floors = {"offered": 12 * idle, "km": 2 * share * idle, "explained": 100 * share * idle}
    if options.part == "golog":
        return golog(simulations, museum, seeds, minutes, floors)
    print(f"\n## {museum.name}, busy, {count} seeds x {minutes:g} minutes, unknown start\n")
    reports = simulations.of_seeds("tour", museum, seeds, minutes, ["--crowd", "busy"])
    print_table(HEADER, [row_of(seed, report) for seed, report in zip(seeds, reports)])
    print()
    verdict = judge(reports, minutes, floors)
    want_speedup(verdict, f"{museum.name}, busy", reports, not options.slice)
    verdict.want_one_configuration(r["config_hash"] for r in reports)
    verdict.note("instruction set", reports[0]["simd"])
    verdict.print()
    if options.slice:
        return verdict
    verdict.add(golog(simulations, museum, seeds, minutes, floors))
    if options.no_crippled:
        return verdict
    for name, arguments in crippled.CRIPPLED.items():
        verdict.add(run_crippled(simulations, museum, name, arguments, seeds[:crippled.CRIPPLED_SEEDS], minutes))
    if is_bonn:
        verdict.add(crippled.hazards(simulations))
        verdict.add(one_scanner(simulations, seeds[:SCANNER_SEEDS], minutes))
    return verdict


def run_crippled(simulations, museum, name, arguments, seeds, minutes):
    print(f"\n## {museum.name}, crippled: {name}, {len(seeds)} seeds (must touch)\n")
    reports = simulations.of_seeds("tour", museum, seeds, minutes, ["--crowd", "busy", *arguments])
    print_table(HEADER, [row_of(seed, report) for seed, report in zip(seeds, reports)])
    print()
    fails = Verdict()
    crippled.want_touches(name, f"{museum.name}, busy", reports, fails)
    fails.print()
    return fails
