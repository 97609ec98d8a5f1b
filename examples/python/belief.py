"""Finds a robot in a museum, and draws what it believes on the way.

    python3 examples/python/belief.py [MUSEUM] [PICTURE]

The robot does not know where it begins. It drives about, a laser looks at the walls of the map (the ray caster makes its
scans, with noise from a seed), and grid localization weighs all poses. The cells below are those of a notebook.
"""
# %% What the robot knows: the map, and where it cannot stand
import sys

import matplotlib.colors
import matplotlib.patches
import matplotlib.pyplot as plt
import numpy as np

import docent

SEED = 7
MAX_RANGE = 3.0  # [m]: a simple sensor, which sees little of a hall at a time
museum = docent.load_museum(sys.argv[1] if len(sys.argv) > 1 else "museums/bonn")
picture = sys.argv[2] if len(sys.argv) > 2 else "belief.png"
caster = docent.RayCaster(museum.map)
random = np.random.default_rng(SEED)

# %% A drive: from home past the exhibit that is farthest by way, as the planner leads
planner = docent.RoutePlanner(museum.map, museum.hazard_polygons(), museum.area)
home = museum.home.position()
planner.set_goals([(home.x, home.y)])
planner.iterate()
exhibits = [exhibit.pose.position() for exhibit in museum.exhibits]
start = max(exhibits, key=lambda at: planner.cost_from(at) if np.isfinite(planner.cost_from(at)) else 0.0)
way = planner.way(start)[::2]  # [n, 2] [m], map
heading = np.arctan2(*np.diff(way, axis=0).T[::-1])
truth = np.column_stack([way[:-1], heading])  # [n, 3]: x, y [m], theta [rad]


# %% What its laser reads there: 181 beams over 180 degrees
def scan_at(pose):
    """A sweep at a true pose: 2 cm of noise, and every tenth beam ends on somebody who is not in the map."""
    bearings = np.radians(np.arange(-90.0, 91.0))
    ranges = caster.cast(tuple(pose[:2]), pose[2] + bearings, MAX_RANGE)
    ranges += random.normal(0.0, 0.02, ranges.size)
    people = random.random(ranges.size) < 0.1
    ranges[people] *= random.uniform(0.2, 1.0, people.sum())
    sweep = docent.RangeSweep()
    sweep.append(docent.LaserReading(ranges.astype(np.float32), bearings[0], np.radians(1.0), max_range=MAX_RANGE))
    return sweep


def drift(before, after):
    """What odometry says of a step: 3 % of noise on its length, 1 degree on its turn."""
    step = docent.inverse(docent.Pose2(*before)) * docent.Pose2(*after)
    return docent.Pose2(step.x * random.normal(1.0, 0.03), step.y, step.theta + random.normal(0.0, 0.017))


# %% Grid localization, scan by scan, from "I do not know"
params = docent.LocalizerParams(sensor=docent.ProximityModelParams(max_range=MAX_RANGE))
localizer = docent.MarkovLocalizer(museum.map, params, closed=museum.hazard_polygons(), seed=SEED)
odom = docent.Pose2()
found_after, p_lost, error, beliefs = None, [], [], []
for i, pose in enumerate(truth):
    if i > 0:
        odom = odom * drift(truth[i - 1], pose)
    localizer.observe(scan_at(pose), odom, docent.time_from_seconds(0.3 * i))
    verdict, best = localizer.verdict(), localizer.map_from_robot(odom)
    p_lost.append(verdict.p_lost())
    error.append(np.hypot(best.x - pose[0], best.y - pose[1]) if best else np.nan)
    if found_after is None and verdict.localized():
        found_after = i
    beliefs.append((localizer.density(), localizer.summary()))

driven = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(truth[:, :2], axis=0).T))])  # [m]
if found_after is None:
    print(f"not found after {driven[-1]:.1f} m")
else:
    print(f"found after {driven[found_after]:.1f} m; {error[-1] * 100:.0f} cm off after {driven[-1]:.1f} m")


# %% The picture: the belief after the first scan, when it was last unsure, and when it says "here"; what it makes of that
def draw_belief(axes, i):
    density, summary = beliefs[i]
    axes.imshow(np.where(museum.map.cells >= 65, 0.35, np.nan), cmap="gray", vmin=0, vmax=1, origin="lower",
                extent=museum.map.frame.extent(), interpolation="nearest")
    shown = axes.imshow(np.ma.masked_less(density.mass, 1e-6), norm=matplotlib.colors.LogNorm(1e-6, 1.0), origin="lower",
                        extent=density.frame.extent(), cmap="viridis_r", interpolation="nearest")
    axes.plot(*truth[:i + 1, :2].T, color="tab:red", lw=1, label="way driven")
    axes.plot(*truth[i, :2], "o", color="tab:red", ms=12, mfc="none", mew=1.5, label="robot (truth)")
    for n, mode in enumerate(summary.modes[:3]):
        at = mode.map_from_robot
        axes.plot(at.x, at.y, "+", color="black", ms=10, label=None if n else "modes, with mass")
        if mode.mass > 0.01:
            axes.annotate(f"{mode.mass:.2f}", (at.x, at.y), (9 if n else -9, 6), textcoords="offset points", fontsize=9,
                          ha="left" if n else "right")
    axes.set(title=f"after {driven[i]:.1f} m, P(lost) = {p_lost[i]:.2f}", xlabel="x [m], map", ylabel="y [m], map",
             aspect="equal")
    return shown


def draw_course(axes):
    axes.plot(driven, p_lost, color="tab:blue", label="P(lost)")
    axes.set(title="What the robot makes of it", xlabel="driven [m]", ylabel="P(lost)", ylim=(0, 1.05))
    if found_after is not None:
        axes.axvline(driven[found_after], color="black", ls=":", label='says "here"')
    errors = axes.twinx()
    errors.semilogy(driven, error, color="tab:orange", label="error of the best mode")
    errors.set_ylabel("error [m]")
    lines = [*axes.get_lines(), *errors.get_lines()]
    axes.legend(lines, [line.get_label() for line in lines], loc="upper right")


end = len(truth) - 1 if found_after is None else found_after
figure, panels = plt.subplots(2, 2, figsize=(13, 10), constrained_layout=True)
unsure = max(i for i in range(end + 1) if i == 0 or p_lost[i] > 0.5)
for axes, i in zip(panels.flat, [0, unsure, end]):
    shown = draw_belief(axes, i)
panels[0, 0].legend(loc="upper left", fontsize=7, framealpha=0.9, handlelength=1.2, borderaxespad=0.2)
figure.colorbar(shown, ax=list(panels.flat), label="P(position), all headings together", shrink=0.6)
draw_course(panels[1, 1])
figure.suptitle(f"Where is the robot? {museum.name[museum.languages[0]]}, seed {SEED}")
figure.savefig(picture, dpi=110)
print(picture)
