"""Tours in Bonn with other bases than the papers': one scanner in front and nothing else, and sonars alone; the full robot beside
them; and crippled ones."""
from evaluation.bounds import bounded
from evaluation.reports import contacts_of
from evaluation.tables import Verdict, print_table
from evaluation.tour import served_of

MINUTES, SEEDS = 20, 10
BASES = ["turtlebot", "sonars-only"]
CROWDS = ["quiet", "busy"]
CRIPPLED_SEEDS = 3
BLIND = {"blind to whatever stands there": ["--set", "evaluation.blind_to_people=true", "--set", "evaluation.ignores_live_map=true"]}
HEADER = ["base", "crowd", "km", "m/s", "explained", "offered", "served", "contacts", "bumped", "area", "passes", "error cm",
          "lost", "blocked s"]


def row_of(base, crowd, reports):
    served, counted = (sum(part) for part in zip(*map(served_of, reports)))
    errors = [r["localization"]["mean_error_m"] for r in reports]
    return [base, crowd, f"{sum(r['distance_m'] for r in reports) / 1000:.2f}",
            f"{sum(r['mean_speed_mps'] for r in reports) / len(reports):.2f}", sum(r["exhibits_explained"] for r in reports),
            sum(r["requests"]["offered"] for r in reports), f"{served}/{counted}", sum(map(contacts_of, reports)),
            sum(r["bumped_by_people"] for r in reports), sum(r["area_violations"] for r in reports),
            sum(r["passes_within_1m"] for r in reports), f"{100 * sum(errors) / len(errors):.1f}",
            sum(r["localization"]["lost_events"] for r in reports), f"{sum(r['blocked']['seconds'] for r in reports):.0f}"]


def protocol(simulations, options):
    museum = simulations.museums / "bonn"
    minutes = options.minutes or (6 if options.slice else MINUTES)
    seeds = range(options.first_seed, options.first_seed + (options.seeds or (1 if options.slice else SEEDS)))
    crowds = CROWDS[-1:] if options.slice else CROWDS
    runs = lambda base, crowd, some, more=(), long=minutes: simulations.of_seeds(
        "bases", museum, some, long, ["--crowd", crowd, "--robot", simulations.root / "robots" / f"{base}.yaml", *more])
    print(f"\n## Bonn, {len(seeds)} seeds x {minutes:g} minutes for each line\n")
    made = {(base, crowd): runs(base, crowd, seeds) for base in ["b21", *BASES] for crowd in crowds}
    print_table(HEADER, [row_of(base, crowd, reports) for (base, crowd), reports in made.items()])
    print()
    verdict = Verdict()
    for (base, crowd), reports in made.items():
        if base not in BASES:
            continue
        km, passes = sum(r["distance_m"] for r in reports) / 1000, sum(r["passes_within_1m"] for r in reports)
        contacts, violations = sum(map(contacts_of, reports)), sum(r["area_violations"] for r in reports)
        verdict.want(f"{base}, {crowd}: contacts", f"{bounded(contacts, km)}; {passes} passes within 1 m", contacts == 0)
        verdict.want(f"{base}, {crowd}: area violations", f"{violations}", violations == 0)
        explained = [r["exhibits_explained"] for r in reports]
        verdict.want(f"{base}, {crowd}: driven (0.02 km a run)", f"{km:.2f} km", km >= 0.02 * len(reports))
        if not options.slice:
            verdict.want(f"{base}, {crowd}: exhibits explained (1 a run)", f"{sum(explained)}, the worst run {min(explained)}",
                         sum(explained) >= len(reports))
    if not options.no_crippled:
        some = seeds[:CRIPPLED_SEEDS]
        for base in BASES[:1] if options.slice else BASES:
            for how, settings in BLIND.items():
                reports = runs(base, "busy", some, settings, options.minutes or MINUTES)
                touched = sum(contacts_of(r) > 0 for r in reports)
                verdict.want(f"{base}, crippled: {how} (must touch)", f"{touched} of {len(some)} seeds", 2 * touched > len(some))
    verdict.print()
    return verdict
