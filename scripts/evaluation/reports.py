"""What the protocols read in deployment reports (architecture 9)."""
from evaluation.bounds import bounded

SPEEDUP = 30.0  # virtual over real time, on one core
KINDS = ["people", "furniture", "walls", "hazards"]


def contacts_of(report):
    return sum(report["contacts"].values())


def touches_of(report):
    """Contacts and area violations."""
    return contacts_of(report) + report["area_violations"]


def touched(reports):
    """How often, and the same with its exposure."""
    km = sum(report["distance_m"] for report in reports) / 1000
    count = sum(map(touches_of, reports))
    hours = sum(report["virtual_seconds"] for report in reports) / 3600
    return count, f"{bounded(count, km, hours)}; {sum(report['passes_within_1m'] for report in reports)} passes within 1 m"


def mean_speed(reports):
    """[m/s] of the way made while there was a goal, blocked time included."""
    seconds = sum(report["travel_seconds"] for report in reports)
    return sum(report["mean_speed_mps"] * report["travel_seconds"] for report in reports) / seconds if seconds else 0.0


def computed_of(report):
    """[s] of one core that a run took. One thread makes it all; what others do on the machine meanwhile is not in it, but that
    they share its caches. A report without it is taken at the wall's time, which is never less."""
    return report.get("cpu_seconds", report["wall_seconds"])


def speedup_of(reports):
    """Virtual seconds of all over the seconds of one core."""
    return sum(report["virtual_seconds"] for report in reports) / max(1e-9, sum(map(computed_of, reports)))


def want_speedup(verdict, name, reports, is_judged=True):
    """Always shown; a bound only where the run is a whole one."""
    wall = sum(report["virtual_seconds"] for report in reports) / max(1e-9, sum(report["wall_seconds"] for report in reports))
    seen = (f"{speedup_of(reports):.1f}: {sum(report['virtual_seconds'] for report in reports):.0f} s in "
            f"{sum(map(computed_of, reports)):.0f} s of one core; by the wall {wall:.1f}")
    if is_judged:
        verdict.want(f"{name}: times faster than real time ({SPEEDUP:g})", seen, speedup_of(reports) >= SPEEDUP)
    else:
        verdict.note(f"{name}: times faster than real time", seen)
