"""What a robot said beside the truth: the rows of `--claims`."""
import csv
import math

LOST_M, LOST_DEG = 0.5, 20.0


def read_claims(path):
    with open(path, newline="", encoding="ascii") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def error_m(row):
    return math.hypot(row["x"] - row["true_x"], row["y"] - row["true_y"])


def is_lost(row):
    turned = abs((row["heading"] - row["true_heading"] + 180.0) % 360.0 - 180.0)
    return row["has_pose"] == 0 or error_m(row) > LOST_M or turned > LOST_DEG


def mean(values):
    values = list(values)
    return sum(values) / len(values) if values else float("nan")


def since_known(claims):
    """From the first "here" on."""
    known = next((i for i, row in enumerate(claims) if row["localized"]), len(claims))
    return claims[known:]
