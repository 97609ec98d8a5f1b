"""Whether a map was read as odd_maps made it."""
import math

import numpy as np

UNKNOWN = -1


def cells_of(answer):
    raw = np.frombuffer(bytes.fromhex(answer["cells"]), np.int8).astype(int)
    return raw.reshape(answer["rows"], answer["columns"])


def fault_of(case, answer):
    """What is wrong with a map that was read; empty: nothing."""
    got, truth = cells_of(answer), case["cells"][::-1]
    if abs(answer["resolution"] - case["resolution"]) > 1e-9:
        return f"resolution {answer['resolution']} for {case['resolution']}"
    if "yaw" in case:
        return turned_fault(case, answer, got, truth)
    if "part" in case:
        return part_fault(case, answer, got, truth)
    if got.shape != truth.shape:
        return f"{got.shape} cells for {truth.shape}"
    if abs(answer["x"] - case["x"]) + abs(answer["y"] - case["y"]) > 1e-6:
        return f"origin {answer['x']}, {answer['y']} for {case['x']}, {case['y']}"
    off = np.abs(got - truth) > case["near"]
    off |= (got < 0) != (truth < 0)
    return f"{off.sum()} of {off.size} cells are wrong, the first {got[off][0]} for {truth[off][0]}" if off.any() else ""


def turned_fault(case, answer, got, truth):
    rows, columns = truth.shape
    wrong = checked = 0
    for row in range(2, rows - 2):
        for column in range(2, columns - 2):
            around = truth[row - 2:row + 3, column - 2:column + 3]
            if (around != truth[row, column]).any():
                continue
            x, y = (column + 0.5) * case["resolution"], (row + 0.5) * case["resolution"]
            c, s = math.cos(case["yaw"]), math.sin(case["yaw"])
            j = math.floor((case["x"] + c * x - s * y - answer["x"]) / answer["resolution"])
            i = math.floor((case["y"] + s * x + c * y - answer["y"]) / answer["resolution"])
            value = got[i, j] if 0 <= i < got.shape[0] and 0 <= j < got.shape[1] else UNKNOWN
            checked, wrong = checked + 1, wrong + int(value != truth[row, column])
    return f"{wrong} of {checked} places are wrong" if wrong else ""


def part_fault(case, answer, got, truth):
    column = round((answer["x"] - case["x"]) / case["resolution"])
    row = round((answer["y"] - case["y"]) / case["resolution"])
    whole = np.full(got.shape, UNKNOWN)
    known = np.argwhere(truth != UNKNOWN)
    for i, j in known:
        a, b = i + case["part"][1] - row, j + case["part"][0] - column
        if not (0 <= a < got.shape[0] and 0 <= b < got.shape[1]):
            return "what is known is left out"
        whole[a, b] = truth[i, j]
    off = (got != whole).sum()
    return f"{off} cells are wrong" if off else ""
