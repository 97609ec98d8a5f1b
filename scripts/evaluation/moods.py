"""Moods and asking on against off: the same crowds and seeds in Bonn ([Minerva2000] 6 and 7: people cleared the path of a robot with
a face and moods much faster). How the simulated crowd answers is our own model (simulator/crowd/crowd_params.h): the effect shows
what the robot makes of such people, and is no evidence about people."""
import csv
import math
import statistics
from pathlib import Path

from evaluation.bounds import bounded
from evaluation import figures
from evaluation.reports import contacts_of
from evaluation.tables import Verdict, print_table

SEEDS, MINUTES = 20, 20
SLICE_SEEDS, SLICE_MINUTES = 2, 6
CROWDS = ["busy", "packed"]
WITHOUT = ["--set", "evaluation.without_moods=true"]
WISHES = 40  # an hour: it is seldom idle, and so often among people
SURE = 0.95
HEADER = ["crowd", "moods", "runs", "h", "km", "m/s", "standing s/h", "blocked s/h", "blockages/h", "s a blockage", "asked/h", "horn/h",
          "contacts", "passes < 1 m"]
# What is compared: name, unit, value of a report, whether more of it is better, and how well the difference must be known: half its
# interval as a share of the mean without moods. Where it is known worse, "no harm" would say nothing.
FIGURES = [
    ("mean speed", "m/s", lambda report: report["mean_speed_mps"], True, 0.1),
    ("standing, of the time on the way", "%", lambda report: 100 * report["standing_seconds"] / report["travel_seconds"], False, 0.5),
    ("blocked by its own word, of the time on the way", "%",
     lambda report: 100 * report["blocked"]["seconds"] / report["travel_seconds"], False, 0.5),
]


def run(simulations, museum, seed, minutes, arguments):
    """The report of a run, and in it how often the robot asked somebody to make way."""
    kept, report = simulations.run_logged("moods", museum, seed, minutes / 60, arguments, {"--event-log": "events.csv"})
    with open(kept["events.csv"], newline="", encoding="utf-8") as file:
        asked = sum(row["source"] == "event" and row["kind"] == "asked_for_way" for row in csv.DictReader(file))
    return {**report, "asked_for_way": asked}


def student(share, freedom):
    """The quantile of Student's t of a two-sided interval, by Cornish and Fisher's expansion (within 0.001 from 9 degrees on)."""
    z = statistics.NormalDist().inv_cdf(0.5 + share / 2)
    return (z + (z**3 + z) / (4 * freedom) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * freedom**2)
            + (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / (384 * freedom**3))


def interval(values):
    """Mean and half the width of its confidence interval."""
    mean = statistics.mean(values)
    if len(values) < 2:
        return mean, math.inf
    return mean, student(SURE, len(values) - 1) * statistics.stdev(values) / math.sqrt(len(values))


def compare(with_moods, without, value):
    """Means with, without, and of the differences seed by seed, each with half its interval."""
    on, off = [value(report) for report in with_moods], [value(report) for report in without]
    return interval(on), interval(off), interval([a - b for a, b in zip(on, off)])


def row_of(crowd, moods, reports):
    hours = sum(report["virtual_seconds"] for report in reports) / 3600
    blocked = sum(report["blocked"]["seconds"] for report in reports)
    events = sum(report["blocked"]["events"] for report in reports)
    travel = sum(report["travel_seconds"] for report in reports)
    metres = sum(report["mean_speed_mps"] * report["travel_seconds"] for report in reports)
    return [crowd, moods, len(reports), f"{hours:.1f}", f"{sum(report['distance_m'] for report in reports) / 1000:.2f}",
            f"{metres / travel:.3f}", f"{sum(report['standing_seconds'] for report in reports) / hours:.0f}", f"{blocked / hours:.0f}",
            f"{events / hours:.0f}", f"{blocked / max(1, events):.1f}", f"{sum(report['asked_for_way'] for report in reports) / hours:.0f}",
            f"{sum(report['blocked']['horn'] for report in reports) / hours:.0f}", sum(map(contacts_of, reports)),
            sum(report["passes_within_1m"] for report in reports)]


def pm(pair, digits):
    return f"{pair[0]:.{digits}f} ± {pair[1]:.{digits}f}"


def draw(path, found, title):
    """Each seed as a line from off to on, and the means with their intervals."""

    def fill(figure):
        panel = figures.under_legend(figure)
        axes = panel.subplots(len(FIGURES), len(found), squeeze=False)
        for row, (name, unit, value, *_) in enumerate(FIGURES):
            for column, (crowd, (with_moods, without)) in enumerate(found.items()):
                here = axes[row][column]
                on, off = [value(report) for report in with_moods], [value(report) for report in without]
                for pair in zip(off, on):
                    seed, = here.plot([0, 1], pair, color=figures.LIGHT_BLUE, linewidth=0.8)
                means = [interval(off), interval(on)]
                mean = here.errorbar([0, 1], [m for m, _ in means], yerr=[half for _, half in means], color=figures.ORANGE,
                                     capsize=4, marker="o", markersize=4)
                here.set_xticks([0, 1], ["off", "on"])
                here.set_xlim(-0.4, 1.4)
                here.set_ylim(bottom=0.0)
                here.grid(axis="y")
                if row == 0:
                    here.set_title(f"Bonn, {crowd}")
                if column == 0:
                    here.set_ylabel(f"{name.replace(', ', ',' + chr(10))} [{unit}]")
        seed.set_label("a seed")
        mean.set_label(f"mean, {100 * SURE:.0f} % confidence")
        figures.legend(figure, title, [seed, mean])

    figures.draw(path, (figures.WIDTH, 1.1 * figures.WIDTH), fill)


def judge(verdict, crowd, with_moods, without, is_slice=False):
    for name, unit, value, more_is_better, known_to in FIGURES:
        on, off, difference = compare(with_moods, without, value)
        is_sure = abs(difference[0]) > difference[1]
        is_better = (difference[0] > 0) == more_is_better
        said = ("better" if is_better else "WORSE") if is_sure else "no difference that is more than chance"
        digits = 3 if unit == "m/s" else 1
        verdict.note(f"{crowd}: {name} [{unit}], {len(with_moods)} seeds", f"on {pm(on, digits)}, off {pm(off, digits)}, on - off "
                     f"{pm(difference, digits)}: {said}")
        if is_slice:  # two seeds tell nothing about a difference
            continue
        verdict.want(f"{crowd}: {name}, moods and asking do no harm that is more than chance", said, is_better or not is_sure)
        share = difference[1] / off[0] if off[0] > 0 else math.inf
        verdict.want(f"{crowd}: {name}, the difference is known to {100 * known_to:g} % of the mean", f"{100 * share:.1f} %", share <= known_to)
    for moods, reports in (("on", with_moods), ("off", without)):
        km = sum(report["distance_m"] for report in reports) / 1000
        contacts = sum(map(contacts_of, reports))
        verdict.want(f"{crowd}, {moods}: contacts", f"{bounded(contacts, km)}; {sum(r['passes_within_1m'] for r in reports)} passes "
                     "within 1 m", contacts == 0)
        asked = sum(report["asked_for_way"] for report in reports)
        least = 1 if is_slice else len(reports)
        verdict.want(f"{crowd}, {moods}: times it asked people to make way, {f'at least {least}' if moods == 'on' else 'none'}", asked,
                     asked >= least if moods == "on" else asked == 0)
        events = sum(report["blocked"]["events"] for report in reports)
        verdict.want(f"{crowd}, {moods}: blockages, so that there is something to compare", events, events >= len(reports))


def protocol(simulations, options):
    count = options.seeds or (SLICE_SEEDS if options.slice else SEEDS)
    seeds = [options.first_seed + i for i in range(count)]
    minutes = SLICE_MINUTES if options.slice else options.minutes or MINUTES
    crowds = options.crowds.split(",") if options.crowds else CROWDS[-1:] if options.slice else CROWDS
    museum = simulations.museums / "bonn"
    found = {}
    for crowd in crowds:
        both = simulations.each(run, [(simulations, museum, seed, minutes, ["--crowd", crowd, "--requests-per-hour", WISHES, *arguments])
                                      for seed in seeds for arguments in ([], WITHOUT)])
        found[crowd] = (both[0::2], both[1::2])
    title = f"Moods and asking on and off, {count} seeds x {minutes:g} minutes"
    print(f"\n## {title}, bonn\n")
    print_table(HEADER, [row_of(crowd, moods, reports) for crowd, pair in found.items() for moods, reports in zip(("on", "off"), pair)])
    print(f"\n±: half of the {100 * SURE:.0f} % confidence interval over the seeds; on - off: of the differences seed by seed. The crowd's "
          "answer is our own model and no evidence about people.\n")
    verdict = Verdict()
    for crowd, (with_moods, without) in found.items():
        judge(verdict, crowd, with_moods, without, options.slice)
    verdict.want_one_configuration(report["config_hash"] for with_moods, _ in found.values() for report in with_moods)
    crippled = {report["config_hash"] for _, without in found.values() for report in without}
    verdict.want("one configuration, off", ", ".join(sorted(crippled)), len(crippled) == 1 and not crippled & verdict.hashes)
    if options.pictures:
        Path(options.pictures).mkdir(parents=True, exist_ok=True)
        draw(Path(options.pictures) / "moods.svg", found, title)
    verdict.print()
    return verdict
