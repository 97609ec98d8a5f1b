#!/usr/bin/python3
"""What the protocol of starts must not let pass: robots that believe a wrong start, and bins of P(lost) that say something else than it."""
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "scripts"))
from evaluation import starts  # noqa: E402


def trial(*rows):
    """Rows (way [m], is wrong, P(lost), says so)."""
    return starts.Trial("hall", "repeated", 0.0, False, 1, list(rows))


class WrongStarts(unittest.TestCase):
    def test_a_row_from_before_anything_was_read_is_no_doubt(self):
        self.assertFalse(starts.is_doubted(trial((0.0, True, 1.0, False), (5.0, True, 0.02, True), (11.0, True, 0.02, True))))

    def test_who_has_stopped_saying_here_by_ten_metres_doubts(self):
        self.assertTrue(starts.is_doubted(trial((0.0, True, 0.1, True), (6.0, True, 0.3, True), (10.5, True, 0.9, False))))

    def test_who_has_found_the_right_place_by_then_was_not_misled(self):
        self.assertTrue(starts.is_doubted(trial((0.0, True, 0.1, True), (9.0, False, 0.1, True), (12.0, False, 0.0, True), (20.0, True, 0.0, True))))

    def test_later_doubt_comes_too_late(self):
        self.assertFalse(starts.is_doubted(trial((0.0, True, 0.1, True), (10.0, True, 0.1, True), (20.0, True, 0.9, False))))

    def test_a_shorter_trial_is_judged_at_its_end(self):
        self.assertFalse(starts.is_doubted(trial((0.0, True, 0.5, False), (4.0, True, 0.1, True))))


class Bins(unittest.TestCase):
    def test_each_bin_has_what_was_said_and_what_was_so(self):
        bins = starts.bins_of([trial((0.0, False, 0.001, True), (1.0, True, 0.3, True), (2.0, False, 0.4, True), (3.0, True, 1.0, False))])
        self.assertEqual([(least, count, wrong) for least, _, count, _, wrong in bins], [(0.0, 1, 0.0), (0.2, 2, 0.5), (0.5, 1, 1.0)])
        self.assertAlmostEqual(bins[1][3], 0.35)


class StartsInWalls(unittest.TestCase):
    def test_such_a_start_is_moved_to_where_the_program_says(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        said = Path(folder.name) / "said.txt"
        program = ("import sys; at = sys.argv[sys.argv.index('--start') + 1]; print(at); "
                   "sys.exit('docent: --start 1,2,30: this is in a wall; the nearest free place of hall.yaml is -1.25,2.00' if at[0] == '1' else 0)")
        starts.run_from_free_place([sys.executable, "-c", program, "--start", "1.000,2.000,30.00", "--seed", 3], said)
        self.assertEqual(said.read_text(encoding="utf-8").strip(), "-1.25,2.00,30.00")
        with self.assertRaises(RuntimeError):
            starts.run_from_free_place([sys.executable, "-c", "import sys; sys.exit('no map')", "--start", "1,2,30"], said)


if __name__ == "__main__":
    unittest.main()
