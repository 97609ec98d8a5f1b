"""What the scans of one turn can tell: the places of a map that look alike to a scanner of short reach.

From a place a whole turn is taken without people and without noise, every 2 degrees, cut at the reach. A twin is another place, TWIN_M and more away
and turned in any way, from which all but LIKE of the directions read the same within OFF_M. In busy museums people hide as many (11 to 28 %): from the scans
of a turn alone nobody, however clever, can tell the place from its twin, and has to drive on.
"""
import re

import numpy as np

DIRECTIONS, ROUGH_DIRECTIONS = 180, 45
STEP_M = 0.2  # of the grid of places
TWIN_M = 1.0  # nearer is the same place
ROUGH_M, OFF_M = 0.4, 0.15  # between places of the grid; after the best place nearby was searched
LIKE = 0.1
CANDIDATES = 30
CLEAR_M = 0.3  # of a place where a robot can be


class Plan:
    """Walls of a map_server map, PGM."""

    def __init__(self, folder):
        said = (folder / "map.yaml").read_text()
        self.resolution = float(re.search(r"resolution:\s*([\d.e-]+)", said)[1])
        self.origin = [float(v) for v in re.search(r"origin:\s*\[(.*?)\]", said)[1].split(",")[:2]]
        data = (folder / "map.pgm").read_bytes()
        head = re.match(rb"P5\s+(?:#.*\n\s*)*(\d+)\s+(\d+)\s+(\d+)\s", data)
        self.columns, self.rows = int(head[1]), int(head[2])
        shades = np.frombuffer(data[head.end():], np.uint8)[: self.columns * self.rows].reshape(self.rows, self.columns)[::-1]
        self.walls, free = shades < 90, shades > 204
        margin = int(round(CLEAR_M / self.resolution))
        near = self.walls.copy()
        for axis in (0, 1):
            near = np.any([np.roll(near, k, axis) for k in range(-margin, margin + 1)], axis=0)
        self.places = np.argwhere((free & ~near)[:: (step := int(round(STEP_M / self.resolution))), ::step]) * step

    def ranges(self, x, y, heading, reach, directions):
        """[places, directions] m, `reach`: nothing. x, y [m] and heading [rad] of places."""
        x, y, heading = (np.atleast_1d(np.asarray(v, np.float32)) for v in (x, y, heading))
        bearing = heading[:, None] + (2 * np.pi / directions * np.arange(directions, dtype=np.float32))[None]
        dx, dy = np.cos(bearing).ravel(), np.sin(bearing).ravel()
        column = np.repeat((x - self.origin[0]) / self.resolution, directions)
        row = np.repeat((y - self.origin[1]) / self.resolution, directions)
        found, alive = np.full(len(dx), reach, np.float32), np.arange(len(dx))
        for way in np.arange(1.0, reach / self.resolution, 0.7):
            i = np.clip((row[alive] + way * dy[alive]).astype(np.int32), 0, self.rows - 1)
            j = np.clip((column[alive] + way * dx[alive]).astype(np.int32), 0, self.columns - 1)
            hit = self.walls[i, j]
            found[alive[hit]] = way * self.resolution
            alive = alive[~hit]
        return found.reshape(len(x), directions)


class Twins:
    """Of one map and one reach [m]."""

    def __init__(self, folder, reach):
        self.plan, self.reach = Plan(folder), reach
        self.y, self.x = (self.plan.places.T + 0.5) * self.plan.resolution + np.array(self.plan.origin[::-1])[:, None]
        some = [slice(k, k + 2000) for k in range(0, len(self.x), 2000)]
        self.all = np.concatenate([self.plan.ranges(self.x[k], self.y[k], 0 * self.x[k], reach, ROUGH_DIRECTIONS) for k in some])

    def _refined(self, seen, pose):
        best, step = None, np.array([0.1, 0.1, np.radians(2.0)])
        for _ in range(4):
            around = np.array([(a, b, c) for a in (-1, 0, 1) for b in (-1, 0, 1) for c in (-1, 0, 1)]) * step + pose
            off = (np.abs(self.plan.ranges(*around.T, self.reach, DIRECTIONS) - seen) > OFF_M).mean(axis=1)
            best, pose, step = off.min(), around[off.argmin()], step / 1.6
        return best

    def of(self, x, y):
        """(share of the directions that meet something, how many twins there are at least), of a place [m]."""
        seen = self.plan.ranges(x, y, 0.0, self.reach, DIRECTIONS)[0]
        rough, turns = np.ones(len(self.x)), np.zeros(len(self.x))
        for turn in range(ROUGH_DIRECTIONS):
            off = (np.abs(np.roll(self.all, turn, axis=1) - seen[:: DIRECTIONS // ROUGH_DIRECTIONS]) > ROUGH_M).mean(axis=1)
            better = off < rough
            rough[better], turns[better] = off[better], turn
        rough[np.hypot(self.x - x, self.y - y) < TWIN_M] = 1.0
        twins = []
        for _ in range(CANDIDATES):
            k = rough.argmin()
            heading = -turns[k] * 2 * np.pi / ROUGH_DIRECTIONS
            if self._refined(seen, np.array([self.x[k], self.y[k], heading])) <= LIKE:
                twins.append(k)
            rough[np.hypot(self.x - self.x[k], self.y - self.y[k]) < TWIN_M] = 1.0
        return float((seen < self.reach - 0.01).mean()), len(twins)
