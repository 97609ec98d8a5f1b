#!/usr/bin/python3
"""The figures of scripts/evaluate: they say what is drawn, with units, and the same data make the same file."""
import re
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "scripts"))
from evaluation import people, reliability, speed  # noqa: E402


def profile(nearest):
    return [{"time": 5.0 + 0.1 * i, "speed": min(1.2, 0.1 * i), "nearest_solid": nearest} for i in range(100)]


def share(recall, precision):
    return SimpleNamespace(recall=recall, precision=precision)


class Figures(unittest.TestCase):
    def drawn(self, plot, *arguments):
        """The file, and its texts, which matplotlib names beside their outlines."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "figure.svg"
            plot(path, *arguments)
            self.assertEqual([file.name for file in Path(folder).iterdir()], ["figure.svg"], "nothing else is left")
            svg = path.read_text(encoding="utf-8")
        return svg, re.findall(r"<!-- (.*?) -->", svg)

    def assert_says(self, words, plot, *arguments):
        svg, texts = self.drawn(plot, *arguments)
        for word in words:
            self.assertIn(word, texts)
        self.assertNotIn("<dc:date>", svg)
        self.assertEqual(svg, self.drawn(plot, *arguments)[0], "drawn again it is another file")
        return texts

    def test_reliability(self):
        curve = [(0.01, 0.0), (0.5, 0.4), (0.99, 0.97)]
        self.assert_says(["P(lost) as the robot says it, mean of the bin [1]", "share of the updates that were lost [1]",
                          "bound: at most 0.1 off", "bin of the updates", "12 updates"], reliability.plot, curve, 0.1, ["12 updates"])

    def test_people(self):
        rows = [("robot driving", share(0.98, 0.9), [share(0.97, 0.88), share(0.99, 0.92)]),
                ("nobody was there", share(float("nan"), float("nan")), [share(float("nan"), float("nan"))])]
        texts = self.assert_says(["share of the seconds [%]", "recall", "precision", "from the worst to the best seed", "bonn",
                                  "robot driving", "nobody was there", "98.0 %", "90.0 %"],
                                 people.plot, [("bonn", rows)], "2 seeds x 1 minutes a museum")
        self.assertEqual(sum(text.endswith(".0 %") for text in texts), 2, "who was not there has no share")

    def test_speed(self):
        self.assert_says(["time since it first drove [s]", "speed [m/s]", "office 1", "office 2", "0.9 m/s",
                          "speed with something solid within 1 m of the outline"],
                         speed.plot, [("office 1", profile(0.5)), ("office 2", profile(5.0))])

    def test_speed_is_dark_near_things_alone(self):
        near, far = (self.drawn(speed.plot, [("office", profile(distance))])[0] for distance in (0.5, 5.0))
        longest = [max(len(path) for path in re.findall(r'<path d="([^"]*)"[^>]*stroke: #2662b4', svg)) for svg in (near, far)]
        self.assertGreater(longest[0], 10 * longest[1])


if __name__ == "__main__":
    unittest.main(verbosity=1)
