#!/usr/bin/python3
"""What the protocols of scripts/evaluate must not let pass: idle robots, empty worlds, missing rows, other configurations."""
import json
import os
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "scripts"))
from evaluation import attract, benchmarks, coastal, crippled, exceptions, faults, ledger, localization, reports, safety, scenarios, stop, tours  # noqa: E402
from evaluation.programs import laboratory, program_for, programs_of  # noqa: E402
from evaluation.tables import Verdict  # noqa: E402


def report(lost=0.0, people=0, area=0, km=1.0, passes=50, virtual=1200.0, cpu=30.0, wall=60.0, blocked=100.0, horns=20, bumped=0):
    return {"contacts": {"people": people, "furniture": 0, "walls": 0, "hazards": 0}, "area_violations": area,
            "distance_m": 1000 * km, "passes_within_1m": passes, "virtual_seconds": virtual, "cpu_seconds": cpu,
            "wall_seconds": wall, "localization": {"lost_s": lost}, "bumped_by_people": bumped,
            "blocked": {"seconds": blocked, "horn": horns}}


class Programs(unittest.TestCase):
    def test_what_cripples_is_the_laboratory_beside_docent(self):
        with tempfile.TemporaryDirectory() as folder:
            docent, lab = Path(folder) / "docent", Path(folder) / "docent-lab"
            docent.touch()
            self.assertEqual(programs_of(docent), [docent])
            with self.assertRaisesRegex(RuntimeError, "docent-lab is missing"):
                laboratory(docent)
            lab.touch()
            self.assertEqual(programs_of(docent), [docent, lab])
            self.assertEqual(laboratory(docent), lab)
            self.assertEqual(program_for(docent, ["--set", "avoid.method=window"]), docent)
            self.assertEqual(program_for(docent, ["--set", "evaluation.blind_to_people=true"]), lab)


class Reports(unittest.TestCase):
    def test_the_speedup_is_of_all_seconds_of_one_core(self):
        self.assertAlmostEqual(reports.speedup_of([report(cpu=30.0), report(cpu=50.0)]), 30.0)
        for cpu, holds in ((40.0, True), (41.0, False)):
            verdict = Verdict()
            reports.want_speedup(verdict, "bonn", [report(cpu=cpu)])
            self.assertEqual(verdict.good, holds)

    def test_what_is_only_shown_is_neither_good_nor_bad(self):
        verdict = Verdict()
        reports.want_speedup(verdict, "bonn", [report(cpu=600.0)], is_judged=False)
        self.assertEqual(len(verdict.rows), 1)
        verdict.want("something", "seen", True)
        self.assertTrue(verdict.good)

    def test_nothing_judged_is_not_good(self):
        self.assertFalse(Verdict().good)


class Crippled(unittest.TestCase):
    def test_who_only_stands_idle_does_not_fail_as_it_must(self):
        for touches, good in ((dict(km=0.0, passes=0), False), (dict(people=1), True), (dict(area=2), True)):
            verdict = Verdict()
            crippled.want_touches("blind to people", "bonn", [report(**touches)], verdict)
            self.assertEqual(verdict.good, good)

    def test_only_who_reckons_dead_may_be_lost_instead_and_must_drive(self):
        for how, km, good in (("dead reckoning", 0.2, True), ("dead reckoning", 0.0, False), ("blind to people", 0.2, False)):
            verdict = Verdict()
            crippled.want_touches(how, "bonn", [report(lost=600.0, km=km)], verdict)
            self.assertEqual(verdict.good, good)


class Exceptions(unittest.TestCase):
    """Events as in `--event-log`; the report of a run in which nothing bad happened."""

    def run_of(self, rows, wishes=(), kills=0, **other):
        events = [dict(zip(("time", "source", "kind", "subject", "detail"), row), value="5", x="7.0", y="1.5") for row in rows]
        quiet = {**report(), "battery": {"depleted": 0, "charges": 1}, "explained_in_wrong_place": 0, **other}
        scenario = "".join(f"request: {{kind: {kind}, target: {target}}}\n" for kind, target in wishes) + kills * "kill: {module: mission}\n"
        return exceptions.Run(quiet, events, [], scenario)

    def test_each_request_ends_once_and_as_it_should(self):
        queued = (1, "event", "request_queued", "a", "zuse")
        fulfilled, failed = (9, "event", "request_fulfilled", "a", ""), (9, "event", "request_failed", "a", "")
        for rows, good in (([queued], False), ([queued, fulfilled], True), ([queued, failed], False), ([queued, fulfilled, fulfilled], False),
                           ([], False)):
            lost = [fault for fault in exceptions.faults_of("battery-low", self.run_of(rows, [("exhibit", "zuse")])) if "wished for" in fault]
            self.assertEqual(not lost, good, rows)
        asked = [("exhibit", "mp3")]
        for end, good in ((failed, True), (fulfilled, False)):
            faults = exceptions.faults_of("unreachable", self.run_of([(1, "event", "request_queued", "a", "mp3"), end], asked))
            self.assertEqual(not [fault for fault in faults if "wished for" in fault], good)

    def test_nothing_is_explained_more_often_than_asked_for(self):
        explained = (5, "event", "explained", "zuse", "")
        tour = (1, "event", "tour_started", "highlights", "zuse transrapid")
        for rows, wishes, good in (([explained], [("exhibit", "zuse")], True), ([explained, explained], [("exhibit", "zuse")], False),
                                   ([tour, explained, explained], [("exhibit", "zuse")], True), ([tour, explained, explained], [], False)):
            wishes = [*wishes, ("tour", "highlights")]
            self.assertEqual(not exceptions.twice(self.run_of(rows, wishes), 0), good)

    def test_a_tour_begins_anew_only_where_the_scenario_breaks_it_off(self):
        began, broken = (1, "event", "tour_started", "t", "zuse"), (50, "event", "tour_broken_off", "t", "battery_low")
        for rows, breaks_off, good in (([began], 0, True), ([began, began], 0, False), ([began, broken, began], 0, False),
                                       ([began, broken, began], 1, True), ([began, began], 1, False),
                                       ([began, broken, began, broken, began], 1, False)):
            self.assertEqual(not exceptions.twice(self.run_of(rows, [("tour", "t")]), breaks_off), good, (rows, breaks_off))
        self.assertTrue(exceptions.twice(self.run_of([began]), 0), "nobody wished for it")

    def test_a_tour_has_one_farewell(self):
        began, ended = (1, "event", "tour_started", "t", "zuse"), (60, "event", "tour_completed", "t", "")
        one, other = ((at, "say", "happy", f"d-{at}/farewell", "Goodbye!") for at in (61, 90))
        for said, good in (([one], True), ([one, other], False)):
            self.assertEqual(not exceptions.twice(self.run_of([began, ended, *said], [("tour", "t")]), 0), good)

    def test_what_came_before_its_cause_did_not_come_of_it(self):
        self.assertEqual(exceptions.since(70.0, 60.0), 10.0)
        self.assertIsNone(exceptions.since(50.0, 60.0))

    def test_a_way_that_was_never_closed_shows_nothing(self):
        def faults(at, meanwhile):
            rows = [(1, "event", "request_queued", "a", "lithotripter"), (90, "event", "explained", meanwhile, ""),
                    (at, "event", "explained", "lithotripter", ""), (at + 9, "event", "request_fulfilled", "a", "")]
            found = exceptions.faults_of("way-closed", self.run_of(rows, [("exhibit", "lithotripter"), ("exhibit", "zuse")]))
            return [fault for fault in found if "meanwhile" in fault or "was free" in fault]

        self.assertEqual(faults(700, "zuse"), [])
        self.assertEqual(len(faults(700, "lithotripter")), 1, "nothing else was explained")
        self.assertEqual(len(faults(200, "zuse")), 1, "the robot got there while the ways were closed")
        for at, good in ((200, True), (700, False)):
            verdict = Verdict()
            failed = [(at, "event", "visit_failed", "lithotripter", "way_blocked"), (200, "event", "visit_failed", "zuse", "way_blocked")]
            exceptions.want_exposure("way-full-of-people", "plans", [self.run_of(failed, blocked={"seconds": 50, "horn": 5})], verdict)
            self.assertEqual(verdict.good, good)

    def test_a_report_that_does_not_say_where_it_explained_is_no_good(self):
        run = self.run_of([])
        del run.report["explained_in_wrong_place"]
        with self.assertRaises(KeyError):
            exceptions.faults_of("lost", run)

    def test_a_tour_that_began_anew_was_not_given_in_one_piece(self):
        began, ended = (1, "event", "tour_started", "t", "zuse"), (60, "event", "tour_completed", "t", "")
        self.assertEqual(exceptions.tour_goes_on(self.run_of([began, ended]), "t", 10.0), 50.0)
        self.assertIsNone(exceptions.tour_goes_on(self.run_of([began, began, ended]), "t", 10.0))
        self.assertIsNone(exceptions.tour_goes_on(self.run_of([began]), "t", 10.0))

    def test_a_tour_is_broken_off_with_a_word(self):
        low, broken = (100, "scenario", "battery", "", ""), (120, "event", "tour_broken_off", "t", "")
        word = (121, "say", "sad", "d-7/must_charge", "I must charge.")
        self.assertEqual(exceptions.gives_way_to_the_battery(self.run_of([low, broken, word])), 20.0)
        self.assertIsNone(exceptions.gives_way_to_the_battery(self.run_of([low, broken])))

    def test_a_question_without_an_answer_stands_for_ever(self):
        asked, other = (10, "event", "prompt_shown", "zuse", "d-1/more"), (30, "event", "prompt_shown", "wankel", "d-2/more")
        default = (15.5, "event", "choice", "zuse", "next (default)")
        self.assertAlmostEqual(exceptions.longest_question(self.run_of([asked, default])), 0.5)
        self.assertIsNone(exceptions.longest_question(self.run_of([asked, default, other])))
        self.assertIsNone(exceptions.longest_question(self.run_of([])))

    def test_where_nothing_went_wrong_nothing_was_shown(self):
        for kills, planned, good in (([9], 9, True), ([0], 9, False), ([10], 11, False), ([11, 9], 11, True), ([0], 0, False)):
            verdict = Verdict()
            runs = [self.run_of([(5, "scenario", "kill", "mission", "")] * struck, kills=planned) for struck in kills]
            exceptions.want_exposure("mission-killed", "plans", runs, verdict)
            self.assertEqual(verdict.good, good, (kills, planned))

    def test_each_seed_draws_moments_of_its_own(self):
        text = "{at: 1, during: idle, after: DELAY, battery: {charge: CHARGE}}"
        first, again, other = (exceptions.Bonn.drawn(text, "x", seed) for seed in (1, 1, 2))
        self.assertEqual(first, again)
        self.assertNotEqual(first, other)
        self.assertNotIn("DELAY", first[0])


class Attract(unittest.TestCase):
    @staticmethod
    def runs(taste, claim, count=20, friendly=0.5, phases=201, hash="a"):
        return [{"taste": taste, "claim": claim, "friendly_at_end": friendly, "phases": phases, "config_hash": hash}] * count

    def verdict(self, **other):
        found = {"friendly": self.runs("friendly", attract.MORE, friendly=0.9), "upset": self.runs("upset", attract.FEWER, friendly=0.1),
                 "neither": self.runs("neither", attract.NONE)}
        crippled = {"never explores": self.runs("friendly", attract.NONE)}
        return attract.judge({**found, **other.get("found", {})}, {**crippled, **other.get("crippled", {})}, other.get("many", [])).good

    def test_a_learner_that_finds_everything_holds(self):
        self.assertTrue(self.verdict())
        self.assertTrue(self.verdict(many=self.runs("neither", attract.MORE, 10) + self.runs("neither", attract.NONE, 190)))

    def test_a_learner_that_finds_too_little_or_the_contrary_does_not(self):
        for claim, count in ((attract.NONE, 3), (attract.FEWER, 1)):
            some = self.runs("friendly", attract.MORE, 20 - count, 0.9) + self.runs("friendly", claim, count, 0.9)
            self.assertFalse(self.verdict(found={"friendly": some}), claim)
        self.assertFalse(self.verdict(found={"friendly": self.runs("friendly", attract.MORE, friendly=0.25)}))

    def test_more_than_one_false_claim_of_twenty_does_not(self):
        for count, good in ((1, True), (2, False)):
            some = self.runs("neither", attract.FEWER, count) + self.runs("neither", attract.NONE, 20 - count)
            self.assertEqual(self.verdict(found={"neither": some}), good)
        self.assertFalse(self.verdict(many=self.runs("neither", attract.MORE, 11) + self.runs("neither", attract.NONE, 189)))

    def test_a_crippled_learner_that_finds_it_shows_that_nothing_was_tested(self):
        self.assertFalse(self.verdict(crippled={"ignores the reward": self.runs("friendly", attract.MORE)}))

    def test_phases_that_nobody_saw_and_two_configurations_do_not(self):
        self.assertFalse(self.verdict(found={"neither": self.runs("neither", attract.NONE, phases=100)}))
        self.assertFalse(self.verdict(found={"neither": self.runs("neither", attract.NONE, hash="b")}))


class Tours(unittest.TestCase):
    @staticmethod
    def row(at, kind, subject="six-minutes", detail=""):
        return {"time": str(at), "kind": kind, "subject": subject, "detail": detail}

    def tour(self, at, seconds, end="farewell"):
        shown = [self.row(at + 60 * i, "explained", name, "six-minutes") for i, name in enumerate(("zuse", "wankel", "mp3"), 1)]
        return [self.row(at, "request_queued", "r", "six-minutes"), self.row(at, "tour_started"), *shown, self.row(at + seconds, end)]

    def test_a_tour_without_an_end_is_counted_and_not_completed(self):
        rows = self.tour(0, 350) + self.tour(1000, 200, "tour_failed") + self.tour(2000, 200, "tour_broken_off") + self.tour(3000, 370)
        found = tours.tours_of(rows, "six-minutes", 0.0)
        self.assertEqual([tour["seconds"] for tour in found], [350.0, None, None, 370.0])
        self.assertEqual([tour["exhibits"] for tour in tours.completed(found)], [3, 3])
        self.assertEqual(len(tours.tours_of(rows, "six-minutes", 1500.0)), 2)
        for some, counts in ((found, [4, 2]), (found[1:3], [2, 0])):
            cells = tours.row_of("bonn", "composed", some)
            self.assertEqual(cells[2:4], counts)
            self.assertEqual(len(cells), len(tours.HEADER))

    def good(self, learned, fixed, is_slice=False):
        verdict = Verdict()
        of = [tours.tours_of([row for i, s in enumerate(some) for row in self.tour(600 * i, s)], "six-minutes", 0.0) for some in (learned, fixed)]
        tours.judge(verdict, "bonn", *of, 4, is_slice)
        return verdict.good

    def test_a_robot_that_learns_is_nearer_to_the_target(self):
        near, far = [350, 370, 355, 365], [320, 380, 335, 395]
        self.assertTrue(self.good(near, far))
        self.assertFalse(self.good(near, near), "learning changes nothing")
        self.assertFalse(self.good(near, []), "nothing to compare with")
        self.assertTrue(self.good(near, [], is_slice=True))
        self.assertFalse(self.good(near[:3], far), "one is missing")
        self.assertFalse(self.good(far, [200, 600, 250, 500]))


class Safety(unittest.TestCase):
    def test_without_the_third_museum_only_a_slice_holds(self):
        before = os.environ.get("DOCENT_DATA")
        os.environ["DOCENT_DATA"] = "/nowhere"
        try:
            for is_slice, failed in ((False, 1), (True, 0)):
                verdict = Verdict()
                self.assertIsNone(safety.made_museum(SimpleNamespace(root=ROOT), verdict, is_slice))
                self.assertEqual(sum(row[0] == "FAIL" for row in verdict.rows), failed)
        finally:
            del os.environ["DOCENT_DATA"]
            if before is not None:
                os.environ["DOCENT_DATA"] = before


class Scenarios(unittest.TestCase):
    def test_an_empty_world_falls_short(self):
        crowded, empty = SimpleNamespace(report=report(bumped=5)), SimpleNamespace(report=report(passes=0, blocked=0.0, horns=0))
        for name in ("people-wall", "closed-passage", "staircase", "children"):
            for share in (1.0, scenarios.SLICE_FLOORS):
                self.assertTrue(scenarios.exposures_of(name, [crowded], share)[1], name)
                self.assertFalse(scenarios.exposures_of(name, [empty], share)[1], name)

    def test_the_share_is_of_the_floors(self):
        half = SimpleNamespace(report=report(blocked=0.5 * scenarios.SCENARIOS["staircase"].floors["s blocked"], bumped=5))
        self.assertFalse(scenarios.exposures_of("staircase", [half], 1.0)[1])
        self.assertTrue(scenarios.exposures_of("staircase", [half], 0.5)[1])

    def test_the_crowds_that_are_left_out_are_in_the_files(self):
        for name, scenario in scenarios.SCENARIOS.items():
            if scenario.crowd:
                self.assertIn(f" {scenario.crowd}:", (ROOT / "scripts" / "scenarios" / f"{name}.yaml").read_text())


class Faults(unittest.TestCase):
    def test_every_sensor_breaks_in_every_way(self):
        names = [fault.name for fault in faults.all_faults()]
        for sensor in ("laser_front", "laser_rear", "sonar", "infrared", "odom", "tactile"):
            for kind in ("dead", "frozen", "half", "late"):
                self.assertIn(f"{sensor} {kind}", names)

    def test_an_infrared_ring_freezes_where_it_sees_something(self):
        row = {"speed": 0.5, "nearest_solid": 2.0, "nearest_person": 3.0}
        open_floor = [dict(row) for _ in range(500)]
        beside = [dict(row, nearest_solid=0.4) for _ in range(500)]
        self.assertTrue(faults.moments(open_floor))
        self.assertFalse(faults.moments(open_floor, is_near=True))
        self.assertTrue(faults.moments(beside, is_near=True))


class Coastal(unittest.TestCase):
    def test_noise_does_not_count_as_not_higher(self):
        for fewer, span, good in ((0.0, 0.02, True), (0.0, 0.2, False), (-0.1, 0.2, False), (-0.1, 0.1, True)):
            verdict = Verdict()
            coastal.want_not_lost(verdict, "lasers", fewer, span)
            self.assertEqual(verdict.good, good)


class Ledger(unittest.TestCase):
    def write(self, folder, configurations, program="a", failed=()):
        (folder / "verdicts").mkdir(exist_ok=True)
        for name in ledger.ROWS:
            row = {"good": not failed, "configurations": configurations.get(name, ["c"]), "program": program, "failed": list(failed),
                   "made": "today"}
            (folder / "verdicts" / f"{name}.json").write_text(json.dumps(row))

    def test_rows_are_of_one_configuration_and_one_program(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            self.assertFalse(ledger.protocol(folder).good, "no row")
            self.write(folder, {"crowd": ["x", "y"], "coastal": ["z"]})
            self.assertTrue(ledger.protocol(folder).good)
            self.write(folder, {"speed": ["d"]})
            self.assertFalse(ledger.protocol(folder).good)
            self.write(folder, {}, failed=["contacts"])
            self.assertFalse(ledger.protocol(folder).good)
            self.write(folder, {})
            row = json.loads((folder / "verdicts" / "tour.json").read_text())
            (folder / "verdicts" / "tour.json").write_text(json.dumps(dict(row, program="b")))
            self.assertFalse(ledger.protocol(folder).good)
            (folder / "verdicts" / "tour.json").unlink()
            self.assertFalse(ledger.protocol(folder).good)

    def test_the_report_names_every_protocol_and_what_fails(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            self.write(folder, {"speed": ["d"]}, failed=["contacts | people"])
            (folder / "verdicts" / "crowd.json").unlink()
            self.assertFalse(ledger.protocol(folder, folder / "reports").good)
            (report,) = (folder / "reports").iterdir()
            self.assertRegex(report.name, r"^verdicts-\d{4}-\d{2}-\d{2}\.md$")
            rows = {line.split(" | ")[0][2:]: line for line in report.read_text().splitlines() if line.startswith("| ")}
            self.assertEqual(sorted(rows), sorted(["protocol", *ledger.ROWS]))
            self.assertIn("| speed | FAILS | contacts \\| people | `scripts/evaluate speed` | d | a |  | today |", rows["speed"])
            self.assertIn("no whole run yet", rows["crowd"])
            self.write(folder, {})
            self.assertTrue(ledger.protocol(folder, folder / "reports").good)
            self.assertNotIn("FAILS", report.read_text(), "the later report of a day replaces the first")

    def test_a_verdict_keeps_the_commit_that_the_report_shows(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            verdict = Verdict()
            verdict.want("something", "seen", True)
            ledger.write(folder, "tour", Path(__file__), verdict, "abc1234")
            ledger.protocol(folder, folder / "reports")
            (report,) = (folder / "reports").iterdir()
            self.assertIn(" | abc1234 | ", report.read_text())
            self.assertEqual(ledger.commit_of(folder), "", "no work tree, no commit")
            self.assertRegex(ledger.commit_of(ROOT), r"^([0-9a-f]{7,}(-dirty)?)?$")

    def test_two_configurations_in_one_protocol_fail(self):
        verdict = Verdict()
        verdict.want_one_configuration(name for name in ["c", "c"])
        self.assertTrue(verdict.good)
        verdict = Verdict()
        verdict.want_one_configuration(name for name in ["a", "b", "a"])
        self.assertFalse(verdict.good)
        self.assertEqual(verdict.hashes, {"a", "b"})


class Benchmarks(unittest.TestCase):
    ROWS = [{"name": "velocity_selection/0", "times_faster": 30.0}, {"name": "velocity_selection/1", "times_faster": 120.0},
            {"name": "velocity_selection/2", "error_occurred": True, "error_message": benchmarks.NO_MATTER}]
    JOINT_ROWS = [{"name": "virtual_measurements/5000/0", "jointly_times_faster": 3.5},
                  {"name": "virtual_measurements/5000/1", "jointly_times_faster": 4.0}]

    def good(self, rows, code=0, printed="", name="collision_avoidance_dynamic_window"):
        return benchmarks.judge(name, code, {"benchmarks": rows}, printed).good

    def good_jointly(self, rows):
        return self.good(rows, name="collision_avoidance_virtual_measurements")

    def test_ratios_errors_and_the_exit_code_count(self):
        self.assertTrue(self.good(self.ROWS))
        self.assertTrue(self.good_jointly(self.JOINT_ROWS))
        self.assertFalse(self.good(self.ROWS, code=1))
        self.assertFalse(self.good([]))
        self.assertFalse(self.good(self.JOINT_ROWS), "rows of another program")
        self.assertFalse(self.good_jointly(self.JOINT_ROWS[:-1]), "a row is missing")
        self.assertFalse(self.good([dict(row, times_faster=2.0) for row in self.ROWS]))
        self.assertFalse(self.good_jointly([dict(row, jointly_times_faster=2.0) for row in self.JOINT_ROWS]))
        self.assertFalse(self.good([*self.ROWS, {"name": "more", "error_occurred": True, "error_message": "not the same decision"}]))

    def test_a_peer_in_the_same_run_is_the_measure(self):
        name = "localization_monte_carlo_mrpt"
        rows = [{"name": "step/mrpt", "cpu_time": 45.0}, {"name": "step/docent/plain", "cpu_time": 2.0},
                {"name": "step/docent/avx2", "cpu_time": 1.0}]
        self.assertTrue(self.good(rows, name=name))
        self.assertFalse(self.good(rows[:2], name=name), "22 times faster, 30 wanted")
        self.assertFalse(self.good(rows[1:], name=name), "the peer did not run")

    def test_bounds_that_a_program_prints_count(self):
        row, line = [{"name": "full_solve"}], "  full value function   12.0   >= 10.0   {}\n"
        name = "planning_value_iteration"
        self.assertTrue(self.good(row, printed=8 * line.format("pass"), name=name))
        self.assertFalse(self.good(row, printed=7 * line.format("pass"), name=name))
        self.assertFalse(self.good(row, printed=8 * line.format("pass") + line.format("FAIL"), name=name))


class Kidnaps(unittest.TestCase):
    @staticmethod
    def rows(*places):
        return [{"time": 0.5 * i, "kidnaps": float(i >= 2), "true_x": x, "true_y": 0.0, "speed": 0.5} for i, x in enumerate(places)]

    def test_a_row_of_the_place_before_is_not_one_after_the_kidnap(self):
        run = self.rows(0.0, 0.2, 0.4, 9.0, 9.2)
        self.assertEqual(localization.since_carried_off(run), run[3:])

    def test_the_first_row_counts_when_the_robot_is_elsewhere(self):
        run = self.rows(0.0, 0.2, 9.0, 9.2)
        self.assertEqual(localization.since_carried_off(run), run[2:])
        self.assertEqual(localization.since_carried_off(run[:2]), [])


class StopButton(unittest.TestCase):
    TRIAL = {"first": "web", "second": "avoid", "way_m": 0.0, "would_drive": True, "acknowledged_s": 0.3, "fault": ""}
    HOUR = {"hour": 1, "clock": "back", "full": True, "way_m": 0.0, "driven_m": 6.0, "fault": ""}

    def judged(self, full=True, control=2.0, refused=300, contacts=0, **other):
        verdict = Verdict()
        trials = [{**self.TRIAL, **other}] * 3
        stop.judge_pairs(verdict, "pairs", {"trials": trials, "controls": [{"way_m": control}], "contacts": contacts, "distance_m": 30.0,
                                            "refused_writes": refused}, full)
        return verdict.good

    def test_a_stop_that_holds_is_good_and_one_that_is_lost_or_idle_is_not(self):
        self.assertTrue(self.judged())
        self.assertTrue(self.judged(full=False, refused=0))
        for wrong in ({"way_m": 0.1}, {"would_drive": False}, {"acknowledged_s": 3.0}, {"fault": "not released everywhere"}, {"control": 0.0}, {"refused": 0},
                      {"contacts": 1}):
            self.assertFalse(self.judged(**wrong), wrong)

    def test_a_day_has_all_its_hours_and_what_is_hard_in_them(self):
        for hours, good in ((24 * [self.HOUR], True), (23 * [self.HOUR], False), (24 * [{**self.HOUR, "driven_m": 0.0}], False),
                            (24 * [{**self.HOUR, "full": False}], False), (24 * [{**self.HOUR, "fault": "not released everywhere"}], False)):
            verdict = Verdict()
            stop.judge_day(verdict, {"hours": hours, "contacts": 0, "distance_m": 144.0})
            self.assertEqual(verdict.good, good)


if __name__ == "__main__":
    unittest.main(verbosity=1)
