"""Stamps of recordings as clocks make them that are simulated, set, stand, wrap or are two: for odd_recordings, whose cases these are."""
from .odd_bags import Scan, Transforms
from .odd_drive import FIRST
from .odd_forms import case_of, one, written


def of_clock(folder, rng, clock, form=None, **more):
    drive, _, messages = one(rng, clock=clock)
    return case_of(written(folder, rng, messages, form), [drive], **more)


def clock_simulated(folder, rng):
    """Stamps from zero on, slower or faster than the file's time."""
    pace = rng.choice([1.0, 0.3, 0.7, 2.0, 5.0])
    begin = rng.choice([0.0, 0.0, 12.5, 3600.0])
    return of_clock(folder, rng, lambda t: begin + t * pace, pace=pace, times=0.002 if begin else 1.0)


def clock_jump(folder, rng):
    """Set by more than any line is late: a computer that began in 1970, a counter that wraps, a clock that is set."""
    at, wrong = rng.uniform(1, 5), rng.choice([-1_700_000_000.0 + 5, 3600.0, -3600.0, -4294.967296, 12.0, 86400.0])
    is_first = rng.random() < 0.5

    def clock(t):
        return FIRST / 1e9 + t + (wrong if (t < at) == is_first else 0.0)
    return of_clock(folder, rng, clock, say="clock", times=0.02, way=0.03, turn=0.03)


def clock_stands(folder, rng):
    """Stamps that are all zero, or stand from some time on."""
    if rng.random() < 0.5:
        return of_clock(folder, rng, lambda t: 0.0, times=0.02, way=0.03, turn=0.03)
    at = rng.uniform(0.5, 4)
    return of_clock(folder, rng, lambda t: FIRST / 1e9 + min(t, at), say="stands", times=0.02, way=0.03, turn=0.03)


def clock_mixed(folder, rng):
    """Scans by another clock than odometry; two clocks in one topic."""
    drive, _, messages = one(rng)
    ahead = rng.choice([5, -30, 3600, -1_699_999_000]) * 10**9
    odd = rng.choice(["topics", "topics", "alternating", "close"])
    if odd == "close":
        ahead = rng.choice([2, -3, 6]) * 10**9
    mixed, k = [], 0
    for t, kind, time, c in messages:
        if isinstance(c, Scan):
            k += 1
            if odd == "topics" or rng.random() < 0.5:
                c = c._replace(stamp=c.stamp + ahead)
        mixed.append((t, kind, time, c))
    return case_of(written(folder, rng, mixed), [drive], say="clock", times=0.02, way=0.03, turn=0.03)


def clock_back(folder, rng):
    """Set back by a few seconds, as by the network."""
    at, back = rng.uniform(2, 5), rng.choice([0.5, 1.5, 4.0, 8.0])
    return of_clock(folder, rng, lambda t: FIRST / 1e9 + t - (back if t >= at else 0.0), say="clock", excuse="set back")


def file_times(folder, rng):
    """Times of the file that tell nothing: the stamps do."""
    drive, _, messages = one(rng)
    same = rng.choice([0, FIRST])
    return case_of(written(folder, rng, [(t, k, same, c) for t, k, _, c in messages], rng.choice(["mcap", "db3", "bag"])), [drive])


def by_index(folder, rng):
    """Clocks that are of no use at all: the order of the messages is asked for."""
    drive, _, messages = one(rng)
    mad = [(t, k, time, c._replace(stamp=rng.randrange(FIRST)) if not isinstance(c, Transforms) else c) for t, k, time, c in messages]
    return case_of(written(folder, rng, mad), [drive], ask={"times": "index"}, say="order", times=60.0, way=0.05, turn=0.05)


KINDS = {"simulated clocks": clock_simulated, "clocks that jump": clock_jump, "clocks that stand": clock_stands, "two clocks": clock_mixed,
         "clocks set back": clock_back, "times of the file": file_times, "times by index": by_index}
