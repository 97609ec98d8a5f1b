#!/usr/bin/python3
"""What scripts/evaluate day must not let pass, and the exact optimum that it measures with; the intervals of scripts/evaluate moods."""
import itertools
import random
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "scripts"))
from evaluation import day, moods, ways  # noqa: E402
from evaluation.tables import Verdict  # noqa: E402

BONN = ways.Museum(ROOT / "museums" / "bonn")
REPORT = {"distance_m": 100.0, "passes_within_1m": 5, "contacts": {"people": 0, "furniture": 0, "walls": 0, "hazards": 0}}


def row(time, what, id="", kind="exhibit", target="airbus", viewpoint=-1, state="", detail="", pose=(0.0, 0.0, 0.0)):
    return {"time": str(time), "what": what, "id": id, "source": "web", "kind": kind, "target": target, "viewpoint": str(viewpoint),
            "state": state, "detail": detail, **dict(zip(("x", "y", "heading"), map(str, pose)))}


def story(viewpoint=3, pose=None, end="fulfilled", task="t-1", detail=""):
    """A request for a viewpoint, served where `pose` says."""
    place = BONN.exhibits["airbus"].places()[3]
    rows = [row(0, "asked", "r", viewpoint=viewpoint)]
    rows += [row(at, "board", "r", viewpoint=viewpoint, state=state) for at, state in ((1, "queued"), (2, "active"))]
    rows.append(row(20, "heard", task, state="short", pose=pose or place))
    if end:
        rows.append(row(40, "board", "r", viewpoint=viewpoint, state=end, detail=detail))
    return rows


def holds(rows):
    verdict = Verdict()
    day.judge(verdict, "bonn", BONN, day.Record(rows), REPORT, True)
    return verdict.good


class Day(unittest.TestCase):
    def test_what_was_asked_heard_and_fulfilled_holds(self):
        self.assertTrue(holds(story()))
        self.assertTrue(holds(story(viewpoint=-1)), "from anywhere")

    def test_what_is_lost_or_ends_twice_does_not(self):
        self.assertFalse(holds(story(end="")))
        self.assertFalse(holds(story() + [row(50, "board", "r", viewpoint=3, state="queued")]))
        self.assertFalse(holds(story() + [row(50, "board", "r", viewpoint=3, state="failed")]))

    def test_another_viewpoint_or_nothing_heard_does_not(self):
        x, y, heading = BONN.exhibits["airbus"].places()[3]
        self.assertFalse(holds(story(pose=BONN.exhibits["airbus"].places()[4])))
        self.assertFalse(holds(story(pose=(x - 0.8, y - 0.1, heading))))
        self.assertFalse(holds(story(pose=(x, y, heading + 90.0))))
        self.assertFalse(holds([r for r in story() if r["what"] != "heard"]))

    def test_what_is_explained_again_does_not(self):
        again = row(60, "heard", "t-2", state="short", pose=BONN.exhibits["airbus"].places()[3])
        self.assertFalse(holds(story() + [again]), "the request was fulfilled before")
        self.assertFalse(holds(story()[:4] + story()[3:]), "one task, heard twice")

    def test_a_stop_of_a_tour_is_explained_once_for_whoever_is_on_it(self):
        def told(at, task):
            return row(at, "heard", task, state="short", detail="highlights")

        def joins(name, at):
            return [row(at, "asked", name, "tour", "highlights"), row(at + 1, "board", name, "tour", "highlights", state="active")]

        self.assertEqual(day.done_twice(day.Record([*joins("a", 0), told(10, "t-1")])), [])
        self.assertEqual(len(day.done_twice(day.Record([*joins("a", 0), told(10, "t-1"), told(50, "t-2")]))), 1)
        late = [*joins("a", 0), told(10, "t-1"), *joins("b", 20), told(50, "t-2")]
        self.assertEqual(day.done_twice(day.Record(late)), [], "somebody came later and missed it")

    def test_a_composed_tour_shows_more_than_one_exhibit(self):
        def served(names):
            steps = [row(0, "asked", "r", "tour", "six-minutes"), row(1, "board", "r", "tour", "six-minutes", state="active")]
            told = [row(10 * i, "heard", f"t-{i}", "", name, state="short", detail="six-minutes", pose=BONN.exhibits[name].pose)
                    for i, name in enumerate(names, 1)]
            return holds([*steps, *told, row(90, "board", "r", "tour", "six-minutes", state="fulfilled")])

        self.assertTrue(served(["zuse", "airbus", "mp3"]))
        self.assertFalse(served(["zuse", "airbus"]))
        self.assertFalse(served([]))

    def test_every_module_dies_that_was_to(self):
        planned = [(10.0, "request: {kind: exhibit}"), (20.0, "kill: {module: mission}"), (30.0, "kill: {module: plan}")]
        for killed, events, good in ((["mission", "plan"], planned, True), (["mission"], planned, False), ([], planned, False),
                                     ([], planned[:1], False)):
            rows = [{"source": "scenario", "kind": "kill", "subject": module} for module in killed]
            verdict = Verdict()
            day.judge_kills(verdict, "bonn", events, day.Record([], [*rows, {"source": "event", "kind": "home", "subject": ""}]))
            self.assertEqual(verdict.good, good, killed)

    def test_refusals_and_failures_do_not(self):
        self.assertFalse(holds(story(end="failed", detail="The way was blocked for too long.")))
        many = [r for i in range(200) for r in ([{**r, "id": f"{r['id']}-{i}"} for r in story()])]
        refused = [row(0, "asked", "x", viewpoint=3), row(1, "board", "x", viewpoint=3, state="refused", detail="closed")]
        self.assertTrue(holds(many + refused))
        for reason in ("too_many_wait", "not_reached"):
            refused[1]["detail"] = reason
            self.assertFalse(holds(many + refused), reason)

    def test_orders_are_compared_with_the_optimum(self):
        at = {"zuse": 1.0, "airbus": 2.0, "mp3": 3.0}  # [m] on a line

        def of_route(start, places):
            return sum(abs(a - b) for a, b in itertools.pairwise([start[0], *[at[name] for name, _ in places]]))

        def optimum(start, stops):
            return min(of_route(start, order) for order in itertools.permutations([stop[0] for stop in stops]))

        lengths = SimpleNamespace(of_route=of_route, optimum=optimum)
        asked = [step for name in ("zuse", "airbus") for step in (row(0, "asked", name, target=name),
                                                                  row(1, "board", name, target=name, state="queued"))]
        for detail, good in (("zuse airbus", True), ("airbus zuse", False)):
            compared, longer, wrong = day.decisions_of(day.Record([*asked, row(5, "chosen", detail=detail)]), BONN, lengths)
            self.assertEqual((len(compared), longer, wrong), (1, 0, []))
            self.assertEqual(day.travel(compared)[1], good)
        for detail in ("zuse", "zuse airbus mp3"):
            self.assertEqual(len(day.decisions_of(day.Record([*asked, row(5, "chosen", detail=detail)]), BONN, lengths)[2]), 1)
        self.assertFalse(day.travel([])[1], "nothing was compared")

    def test_a_museum_with_too_few_items_gets_viewpoints_where_the_robot_can_stand(self):
        museum = ways.Museum(ROOT / "museums" / "smithsonian")
        found = day.viewpoints_of(museum)
        self.assertEqual(len(museum.items()) + sum(map(len, found.values())), day.ITEMS)
        floor = ways.Floor(museum)
        for x, y, _ in (pose for poses in found.values() for pose in poses):
            row_, column = floor.cell_of(x, y)
            self.assertLess(abs(floor.x0 + column * floor.cell - x), 0.1)
            self.assertLess(abs(floor.y0 + row_ * floor.cell - y), 0.1)


class Ways(unittest.TestCase):
    def test_the_optimum_is_the_best_of_all_orders_and_places(self):
        draw = random.Random(1)
        for _ in range(20):
            stops, count = [], 0
            for _ in range(4):
                stops.append(list(range(count, count + draw.randint(1, 3))))
                count += len(stops[-1])
            points = [(draw.random(), draw.random()) for _ in range(count + 1)]
            between = numpy.array([[((a - c) ** 2 + (b - d) ** 2) ** 0.5 for c, d in points] for a, b in points])
            best = min(sum(between[a, b] for a, b in itertools.pairwise((count, *choice)))
                       for order in itertools.permutations(stops) for choice in itertools.product(*order))
            self.assertAlmostEqual(ways.optimum(between[count, :count], between[:count, :count], stops), best)

    def test_ways_lead_round_walls_and_hazards(self):
        floor = ways.Floor(BONN)
        home = floor.lengths_from(*BONN.home[:2])
        for exhibit in BONN.exhibits.values():
            for x, y, _ in exhibit.places().values():
                straight = ((x - BONN.home[0]) ** 2 + (y - BONN.home[1]) ** 2) ** 0.5
                self.assertGreater(home[floor.cell_of(x, y)], 0.97 * straight)
                self.assertLess(home[floor.cell_of(x, y)], 3.0 * straight + 5.0)
        stairs = next(hazard for hazard in BONN.hazards if (20.96, 2.78) in hazard)
        self.assertFalse(any(floor.free[floor.cell_of(x, y)] and abs(floor.x0 + floor.cell_of(x, y)[1] * floor.cell - x) < 0.1
                             and abs(floor.y0 + floor.cell_of(x, y)[0] * floor.cell - y) < 0.1 for x, y in stairs))


class Moods(unittest.TestCase):
    @staticmethod
    def reports(speeds, blocked=60.0, asked=0):
        return [{**REPORT, "mean_speed_mps": speed, "travel_seconds": 600.0, "passes_within_1m": 5, "standing_seconds": 2 * blocked,
                 "asked_for_way": asked, "blocked": {"seconds": blocked, "events": 3, "horn": 1}} for speed in speeds]

    def good(self, with_moods, without, is_slice=False):
        verdict = Verdict()
        moods.judge(verdict, "busy", with_moods, without, is_slice)
        return verdict.good

    def test_students_quantiles(self):
        for freedom, quantile in ((9, 2.262), (19, 2.093), (100, 1.984)):
            self.assertAlmostEqual(moods.student(0.95, freedom), quantile, places=3)

    def test_pairs_show_what_the_spread_of_seeds_hides(self):
        off = [0.20 + 0.02 * i for i in range(10)]
        on, _, difference = moods.compare(self.reports([speed + 0.01 + 0.001 * (i % 2) for i, speed in enumerate(off)]),
                                          self.reports(off), lambda report: report["mean_speed_mps"])
        self.assertGreater(on[1], 0.02)
        self.assertGreater(difference[0] - difference[1], 0.0)

    def test_harm_that_is_more_than_chance_and_an_empty_world_fail(self):
        off = [0.30 + 0.001 * i for i in range(10)]
        for speeds, blocked, good in ((off, 60.0, True), ([s + 0.02 for s in off], 50.0, True), ([s - 0.02 for s in off], 60.0, False),
                                      (off, 70.0, False)):
            self.assertEqual(self.good(self.reports(speeds, blocked, asked=2), self.reports(off)), good, (speeds, blocked))
        idle = [{**report, "standing_seconds": 0.0, "blocked": {"seconds": 0.0, "events": 0, "horn": 0}} for report in self.reports(off, asked=2)]
        self.assertFalse(self.good(idle, [{**report, "asked_for_way": 0} for report in idle]))

    def test_moods_that_do_nothing_fail(self):
        off = [0.30 + 0.001 * i for i in range(10)]
        for asked_on, asked_off, good in ((2, 0, True), (0, 0, False), (2, 2, False)):
            self.assertEqual(self.good(self.reports(off, asked=asked_on), self.reports(off, asked=asked_off)), good, (asked_on, asked_off))

    def test_a_difference_that_nobody_knows_is_no_absence_of_harm(self):
        off = [0.30 + 0.001 * i for i in range(10)]
        for spread, good in ((0.01, True), (0.1, False)):
            on = [speed + spread * (1 if i % 2 else -1) for i, speed in enumerate(off)]
            self.assertEqual(self.good(self.reports(on, asked=2), self.reports(off)), good, spread)
            self.assertTrue(self.good(self.reports(on, asked=2), self.reports(off), is_slice=True), "two seeds are not asked that")
        self.assertFalse(self.good(self.reports(off), self.reports(off), is_slice=True), "it asked nobody")

    def test_the_figure_says_what_is_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "moods.svg"
            moods.draw(path, {"busy": (self.reports([0.3, 0.32]), self.reports([0.28, 0.3]))}, "a title")
            svg = path.read_text(encoding="utf-8")
        for words in ("a title", "mean speed [m/s]", "of the time on the way [%]", "Bonn, busy", "a seed", "mean, 95 % confidence"):
            self.assertIn(words, svg)


if __name__ == "__main__":
    unittest.main(verbosity=1)
