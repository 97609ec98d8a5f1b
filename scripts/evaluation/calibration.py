"""Learns the weights of P(lost) (src/docent/localization/judgement/verdict.cpp) from recordings in which the robot is carried off
again and again, and from tours on which it stands amid people: a logistic regression of "was it lost?" on what the robot itself knew, by Newton's method.

Seeds differ from those of `scripts/evaluate localization`, which holds the result against other recordings."""
import math

from . import claims, localization

FIRST_SEED = 5000
NAMES = ["bias", "mass", "youth", "contradiction", "surprise", "hidden", "unmapped", "spread"]
LEAST = {"mass": 0.2}  # weights: a robot with hardly any mass anywhere is never sure of it; the others 0
ODDS_OF_OTHERS = 0.4  # as in verdict.cpp
TOUR_WEIGHT = 0.1  # of an update on a tour: nobody is lost there


def features(row):
    """As Verdict::p_lost has them."""
    left = min(max(1.0 - row["mass"], 1e-4), 1.0 - 1e-4)
    return [1.0, math.log(left / (1.0 - left)), 1.0 - row["confirmation"], row["contradiction"], row["surprise"],
            row["hidden"], row["unmapped"] * (1.0 - row["agreement"]) ** 2, min(row["spread"], 1.0)]


def logistic(weights, values):
    z = sum(w * v for w, v in zip(weights, values))
    return 1.0 / (1.0 + math.exp(-max(-30.0, min(30.0, z))))


def share_of_best(row):
    """Another factor of Verdict::p_lost: what tracks leave to the best place, their odds for others weighed."""
    return row["share"] / (row["share"] + ODDS_OF_OTHERS * (1.0 - row["share"]))


def probability(weights, values, best):
    return 1.0 - (1.0 - logistic(weights, values)) * best


def solve(matrix, right):
    """Gauss-Jordan with pivots."""
    n = len(right)
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(n):
            if k != i:
                factor = rows[k][i] / rows[i][i]
                rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    return [rows[i][n] / rows[i][i] for i in range(n)]


def fit(data, ridge=0.1):
    """Weights of the likeliest P(lost) over (features, was lost, how much it counts, share of the best mode), none below 0
    but the bias: more evidence of being lost never makes it less likely."""
    held = {}
    while True:
        weights = fit_holding(held, data, ridge)
        off = {i: weights[i] - LEAST.get(NAMES[i], 0.0) for i in range(1, len(NAMES)) if i not in held}
        worst = min(off, key=off.get)
        if off[worst] >= 0.0:
            return weights
        held[worst] = LEAST.get(NAMES[worst], 0.0)


def fit_holding(held, data, ridge):
    """A lost update may be one because another place was right: it counts as far as the logistic function explains it
    (EM, a step of Newton's method in each round)."""
    n = len(NAMES)
    weights = [held.get(i, 0.0) for i in range(n)]
    for _ in range(200):
        gradient = [-ridge * w for w in weights]
        hessian = [[ridge if i == j else 0.0 for j in range(n)] for i in range(n)]
        for values, lost, share, best in data:
            p = logistic(weights, values)
            due = lost * p / max(1e-12, 1.0 - (1.0 - p) * best)
            curve = share * (p * (1.0 - p) + 1e-9)
            for i in range(n):
                gradient[i] += share * (due - p) * values[i]
                for j in range(n):
                    hessian[i][j] += curve * values[i] * values[j]
        for i in held:
            gradient[i] = 0.0
            hessian[i] = [float(i == j) for j in range(n)]
        step = solve(hessian, gradient)
        weights = [w + s for w, s in zip(weights, step)]
        if max(map(abs, step)) < 1e-4:
            return weights
    raise RuntimeError("the weights of P(lost) do not converge")


def rows_of(bench, museums, count, method, settings):
    carried_off = localization.honesty_claims(bench, museums, count, method, FIRST_SEED, settings)
    tours = localization.tour_claims(bench, museums, count, method, FIRST_SEED, settings)
    return [[(features(row), float(claims.is_lost(row)), share, share_of_best(row), row["localized"]) for row in run if row["has_pose"]]
            for some, share in ((carried_off, 1.0), (tours, TOUR_WEIGHT)) for run in some]


def learn(bench, museums, count, method):
    """Prints the weights, and what those of one half of the runs are worth on the other half."""
    print("// " + ", ".join(NAMES))
    # A robot that takes "here" back when in doubt leaves few examples of being wrong and sure of it.
    for name, said, settings in (("kWhenSure", 1.0, ["localize.verdict.no_longer_here=1", "localize.verdict.given_up=1"]), ("kWhenNot", 0.0, [])):
        runs = [[row[:4] for row in run if row[4] == said] for run in rows_of(bench, museums, count, method, settings)]
        half = fit([row for run in runs[::2] for row in run])
        other = [(probability(half, values, best), lost) for run in runs[1::2] for values, lost, _, best in run]
        weights = fit([row for run in runs for row in run])
        print(f"constexpr DoubtWeights {name}{{{', '.join(f'{w:.3f}' for w in weights)}}};")
        print(f"// Brier score of one half's weights on the other half: {localization.brier(other):.4f} over {len(other)} updates")
