"""What a count says of its rate: nothing seen is not nothing there. A zero is quoted with the rate that it leaves open."""
import math

CONFIDENCE = 0.95  # one-sided


def most(count, confidence=CONFIDENCE):
    """The largest mean of a Poisson distribution that gives `count` or fewer with 1 - confidence; 3.0 where nothing was seen."""
    low, high = float(count), count + 10.0 * math.sqrt(count + 1.0) + 10.0
    for _ in range(60):
        mean = 0.5 * (low + high)
        term = total = math.exp(-mean)
        for k in range(1, count + 1):
            term *= mean / k
            total += term
        low, high = (mean, high) if total > 1.0 - confidence else (low, mean)
    return high


def rate(count, exposure, unit):
    """"at most 8.1 a km (95 %)", for a count seen in so much exposure."""
    if exposure <= 0.0:
        return f"no {unit} to tell by"
    return f"at most {most(count) / exposure:.2g} {'an' if unit == 'hour' else 'a'} {unit} ({100 * CONFIDENCE:.0f} %)"


def bounded(count, km, hours=None):
    """"0 in 0.37 km: at most 8.1 a km (95 %)", and by the hour where that is told."""
    said = f"{count} in {km:.2f} km: {rate(count, km, 'km')}"
    return said if hours is None else f"{said}, {rate(count, hours, 'hour')}"
