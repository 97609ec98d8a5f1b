"""Ways through a museum as the evaluation measures them, without the robot's planner: lengths between places on the map, and the
exact optimum of visiting them (Held and Karp), one place a stop."""
import heapq
import math
import re

import numpy

CELL = 0.1  # [m] of the grid on which ways are measured
REACH = 0.3  # [m] the robot's centre keeps from what the map has: its radius and a margin
NUMBER = r"(-?[\d.]+)"
POSE = re.compile(rf"\{{x: {NUMBER}, y: {NUMBER}(?:, heading: {NUMBER})?\}}")
POINT = re.compile(rf"\[{NUMBER}, {NUMBER}\]")
# A step to a neighbour, as a knight moves too: lengths are at most 3 % too long, in all directions alike.
STEPS = [(i, j) for i in range(-2, 3) for j in range(-2, 3) if math.gcd(i, j) == 1]


def pose_of(text):
    x, y, heading = POSE.search(text).groups()
    return float(x), float(y), float(heading or 0.0)


def polygon_of(text):
    return [(float(x), float(y)) for x, y in POINT.findall(text)]


class Exhibit:
    def __init__(self, name):
        self.name, self.pose, self.look_at, self.viewpoints, self.web_only = name, None, None, [], False

    def places(self):
        """Poses to show it from, by viewpoint; -1 is its own."""
        return {-1: self.pose, **dict(enumerate(self.viewpoints))}


class Museum:
    """What museum.yaml says, as far as ways and requests care."""

    def __init__(self, folder):
        self.folder, self.exhibits, self.tours, self.hazards = folder, {}, {}, []
        exhibit = None
        for line in (folder / "museum.yaml").read_text(encoding="utf-8").splitlines():
            key = line.strip().removeprefix("- ").split(":")[0]
            if line.startswith("area:"):
                self.area = polygon_of(line)
            elif line.startswith("home:"):
                self.home = pose_of(line)
            elif line.startswith("charger:"):
                self.charger = pose_of(line)
            elif "kind:" in line and "polygon:" in line:
                self.hazards.append(polygon_of(line.split("polygon:")[1]))
            elif line.startswith("  - id:"):
                exhibit = Exhibit(line.split(":")[1].strip())
                self.exhibits[exhibit.name] = exhibit
            elif line.startswith("    pose:"):
                exhibit.pose = pose_of(line)
            elif line.startswith("    look_at:"):
                exhibit.look_at = pose_of(line)
            elif line.startswith("      - {x:"):
                exhibit.viewpoints.append(pose_of(line))
            elif key == "web_only" and line.startswith("    "):
                exhibit.web_only = line.split(":")[1].strip() == "true"
            elif line.startswith("  - {id:") and "title:" in line:
                name = line.split("id:")[1].split(",")[0].strip()
                stops = re.search(r"exhibits: \[([^\]]*)\]", line)
                self.tours[name] = [stop.strip() for stop in stops.group(1).split(",")] if stops else []

    def items(self):
        """What a visitor may ask for: (exhibit, viewpoint), -1 for the exhibit from anywhere."""
        return [(exhibit.name, viewpoint) for exhibit in self.exhibits.values() for viewpoint in exhibit.places()]


def inside(polygon, x, y):
    """[rows, columns] of booleans for arrays of points."""
    result = numpy.zeros(numpy.broadcast(x, y).shape, bool)
    for (x0, y0), (x1, y1) in zip(polygon, polygon[1:] + polygon[:1]):
        if y0 != y1:
            result ^= ((y0 > y) != (y1 > y)) & (x < (x1 - x0) * (y - y0) / (y1 - y0) + x0)
    return result


class Floor:
    """Where the robot's centre may be: a grid of the museum's map, its area and its hazards."""

    def __init__(self, museum):
        image, resolution, origin = self._read_map(museum.folder)
        keep = max(1, round(CELL / resolution))
        rows, columns = image.shape
        centres_x = origin[0] + (numpy.arange(columns) + 0.5) * resolution
        centres_y = origin[1] + (numpy.arange(rows) + 0.5) * resolution
        taken = (image < 250) | ~inside(museum.area, centres_x[None, :], centres_y[:, None])
        for hazard in museum.hazards:
            taken |= inside(hazard, centres_x[None, :], centres_y[:, None])
        blocked = taken.copy()
        reach = math.ceil(REACH / resolution)
        for i in range(-reach, reach + 1):
            for j in range(-reach, reach + 1):
                if math.hypot(i, j) * resolution <= REACH:
                    blocked |= numpy.roll(taken, (i, j), (0, 1))
        self.free = ~blocked[keep // 2::keep, keep // 2::keep]
        self.cell = keep * resolution
        self.x0, self.y0 = centres_x[keep // 2], centres_y[keep // 2]

    @staticmethod
    def _read_map(folder):
        told = dict(line.split(":", 1) for line in (folder / "map.yaml").read_text().splitlines() if ":" in line)
        origin = [float(value) for value in told["origin"].strip(" []").split(",")]
        data = (folder / told["image"].strip()).read_bytes()
        header = re.match(rb"P5\s+(?:#.*\s+)*(\d+)\s+(\d+)\s+(\d+)\s", data)
        columns, rows = int(header.group(1)), int(header.group(2))
        image = numpy.frombuffer(data, numpy.uint8, columns * rows, header.end()).reshape(rows, columns)
        return image[::-1], float(told["resolution"]), origin

    def cell_of(self, x, y):
        """The nearest free cell."""
        row, column = round((y - self.y0) / self.cell), round((x - self.x0) / self.cell)
        for reach in range(12):
            near = [(math.hypot(row + i - (y - self.y0) / self.cell, column + j - (x - self.x0) / self.cell), row + i, column + j)
                    for i in range(-reach, reach + 1) for j in range(-reach, reach + 1) if max(abs(i), abs(j)) == reach
                    if 0 <= row + i < self.free.shape[0] and 0 <= column + j < self.free.shape[1] and self.free[row + i, column + j]]
            if near:
                return min(near)[1:]
        raise RuntimeError(f"no free floor near {x:.2f}, {y:.2f}")

    def lengths_from(self, x, y):
        """[rows, columns] of the shortest way to each cell [m]; Dijkstra."""
        rows, columns = self.free.shape
        wide = columns + 4  # a border of two cells that nobody may enter
        free = numpy.pad(self.free, 2).ravel().tolist()
        steps = [(i * wide + j, math.hypot(i, j) * self.cell) for i, j in STEPS]
        row, column = self.cell_of(x, y)
        start = (row + 2) * wide + column + 2
        best = [math.inf] * len(free)
        best[start] = 0.0
        heap = [(0.0, start)]
        while heap:
            length, at = heapq.heappop(heap)
            if length > best[at]:
                continue
            for step, far in steps:
                to = at + step
                if free[to] and length + far < best[to]:
                    best[to] = length + far
                    heapq.heappush(heap, (best[to], to))
        return numpy.array(best, numpy.float32).reshape(rows + 4, wide)[2:-2, 2:-2]


class Lengths:
    """Ways from anywhere to the places of a museum [m]; kept in a file, for they take a minute to compute."""

    def __init__(self, museum, path):
        self.floor = Floor(museum)
        self.index = {place: i for i, place in enumerate(museum.items())}
        if path.exists():
            self.fields = numpy.load(path)
        else:
            self.fields = numpy.stack([self.floor.lengths_from(*museum.exhibits[name].places()[viewpoint][:2])
                                       for name, viewpoint in self.index])
            with open(path.with_suffix(".part"), "wb") as file:
                numpy.save(file, self.fields)
            path.with_suffix(".part").rename(path)
        cells = [self.floor.cell_of(*museum.exhibits[name].places()[viewpoint][:2]) for name, viewpoint in self.index]
        self.between = numpy.array([[field[cell] for field in self.fields] for cell in cells])

    def from_point(self, x, y):
        return self.fields[(slice(None), *self.floor.cell_of(x, y))]

    def of_route(self, start, places):
        """[m] from a point through places in their order."""
        indices = [self.index[place] for place in places]
        return float(self.from_point(*start)[indices[0]] + sum(self.between[a, b] for a, b in zip(indices, indices[1:])))

    def optimum(self, start, stops):
        """[m] of the shortest way from a point through all stops, each a list of places of which one is visited."""
        return optimum(self.from_point(*start), self.between, [[self.index[place] for place in stop] for stop in stops])


def optimum(from_start, between, stops):
    """Held and Karp over sets of stops: O(2^n p^2). `stops`: lists of indices into the lengths."""
    n = len(stops)
    places = [place for stop in stops for place in stop]
    first = numpy.cumsum([0, *map(len, stops)])
    ways = numpy.asarray(between)[numpy.ix_(places, places)]
    start = numpy.asarray(from_start)[places]
    best = numpy.full((1 << n, len(places)), numpy.inf)
    for j in range(n):
        best[1 << j, first[j]:first[j + 1]] = start[first[j]:first[j + 1]]
    sets = numpy.arange(1 << n)
    size = sum((sets >> j) & 1 for j in range(n))
    for k in range(1, n):
        layer = sets[size == k]
        for j in range(n):
            without = layer[(layer >> j) & 1 == 0]
            mine = slice(first[j], first[j + 1])
            best[without | (1 << j), mine] = (best[without][:, :, None] + ways[None, :, mine]).min(axis=1)
    return float(best[-1].min())
