#!/usr/bin/python3
"""The bounds that scripts/evaluate prints beside zeros, and what it counts among people with legs."""
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "scripts"))
from evaluation import bodies, bounds  # noqa: E402


def report(people):
    return {"contacts": {"people": people, "furniture": 0, "walls": 0, "hazards": 0}, "area_violations": 0, "distance_m": 200.0, "passes_within_1m": 50,
            "virtual_seconds": 1200.0, "cpu_seconds": 30.0, "wall_seconds": 60.0, "localization": {"lost_s": 0.0}, "bumped_by_people": 0,
            "blocked": {"seconds": 100.0, "horn": 20}}


class Bounds(unittest.TestCase):
    def test_a_count_leaves_a_rate_open(self):
        for count, most in ((0, 2.996), (1, 4.744), (2, 6.296), (10, 16.962)):  # tables of the Poisson distribution
            self.assertAlmostEqual(bounds.most(count), most, places=3)
        self.assertEqual(bounds.bounded(0, 0.37), "0 in 0.37 km: at most 8.1 a km (95 %)")
        self.assertEqual(bounds.bounded(0, 0.5, 2.0), "0 in 0.50 km: at most 6 a km (95 %), at most 1.5 an hour (95 %)")
        self.assertIn("no km", bounds.bounded(0, 0.0))

    def test_bodies_are_judged_by_what_was_touched_among_legs(self):
        def run(folder, people, own_speed):
            log = Path(folder) / f"{people}-{own_speed}.csv"
            log.write_text(f"time,source,kind,subject,detail,value,x,y,gaze,bearing\n1.0,contact,people,person-3,excused,{own_speed},0,0,,0\n"
                           "2.0,contact,walls,w,counts,0.3,0,0,,0\n")
            return {"events.csv": log}, {**report(people), "travel_seconds": 600.0, "mean_speed_mps": 0.25}

        with tempfile.TemporaryDirectory() as folder:
            crept = bodies.Cell([run(folder, 0, 0.05), run(folder, 1, 0.0)])
            self.assertEqual((crept.crept, crept.contacts), (1, 1))
            whole = bodies.total([crept, bodies.Cell([run(folder, 0, 0.01)])])
            self.assertEqual((whole.crept, whole.contacts), (1, 1))
            self.assertAlmostEqual(whole.km, 0.6)
            self.assertAlmostEqual(whole.speed, 0.25)
            self.assertEqual(len(whole.row("all", "", "legs")), len(bodies.HEADER))


if __name__ == "__main__":
    unittest.main()
