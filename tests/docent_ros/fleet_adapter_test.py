#!/usr/bin/env python3
"""The fleet adapter against a stand-in for Docent's REST API over HTTP, and its glue to RMF against a stand-in for that."""
import importlib.util
import json
import math
import os
import re
import sys
import tempfile
import threading
import time
import types
import unittest
import unittest.mock
from pathlib import Path

sys.dont_write_bytecode = True
from docent_stand_in import PASSWORD, Robot, StandIn  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "packaging" / "docent_ros"
_spec = importlib.util.spec_from_file_location("docent_fleet_adapter", PACKAGE / "scripts" / "docent_fleet_adapter.py")
adapter = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(adapter)


class Execution:
    """Of RMF: what a fleet adapter gets with each command."""

    class Identifier:
        def is_same(self, other):
            return self is other

    def __init__(self):
        self.identifier = self.Identifier()
        self.is_finished = False

    def finished(self):
        self.is_finished = True


class Destination:
    def __init__(self, x, y, heading, dock=None):
        self.position, self.map, self.dock = [x, y, heading], "L1", dock


class OverHttp(unittest.TestCase):
    def setUp(self):
        self.docent = StandIn()
        self.addCleanup(self.docent.close)
        self.now = 0.0
        self.lines = []
        client = adapter.DocentClient(self.docent.address + "/", "fleet", PASSWORD)
        self.robot = adapter.DocentRobot(client, clock=lambda: self.now, log=self.lines.append)

    def rounds(self, seconds):
        seen = None
        for _ in range(round(2 * seconds)):
            self.now += 0.5
            seen = self.robot.update()
        return seen

    @property
    def said(self):
        return [method for method, _ in self.docent.robot.said]


class Driving(OverHttp):
    def test_tells_where_the_robot_is_and_its_charge(self):
        self.assertEqual(self.robot.update(), {"position": [1.0, 2.0, 0.5], "battery": 0.8})
        self.docent.robot.state["pose"] = None
        self.assertIsNone(self.robot.update(), "it does not know its place")

    def test_a_drive_is_said_until_it_is_on_the_board_and_done_when_fulfilled(self):
        self.docent.robot.is_deaf = True
        self.robot.navigate(3.0, 4.0, 1.5)
        self.rounds(6)
        self.assertEqual(self.said, ["PUT", "PUT", "PUT"], "every 2.5 s")
        self.assertEqual(len({goal for _, goal in self.docent.robot.said}), 1, "the same goal")
        self.docent.robot.is_deaf = False
        self.rounds(5)
        self.assertEqual(self.said, ["PUT"] * 4)
        self.assertEqual(list(self.docent.robot.poses.values()), [(3.0, 4.0, 1.5)])
        self.assertIsNone(self.robot.result())
        self.docent.robot.set("fulfilled")
        self.rounds(1)
        self.assertEqual(self.robot.result(), "done")

    def test_a_failure_has_its_reason(self):
        self.robot.navigate(3.0, 4.0, 1.5)
        self.rounds(1)
        self.docent.robot.set("failed", "way_blocked")
        self.rounds(1)
        self.assertEqual(self.robot.result(), "way_blocked")

    def test_a_newer_drive_withdraws_the_one_before(self):
        self.robot.navigate(3.0, 4.0, 1.5)
        self.rounds(1)
        self.robot.navigate(5.0, 4.0, 1.5)
        self.rounds(1)
        self.assertEqual(self.said, ["PUT", "DELETE", "PUT"])
        self.assertEqual([goal["state"] for goal in self.docent.robot.goals.values()], ["cancelled", "queued"])
        self.assertIsNone(self.robot.result())

    def test_a_stop_is_said_until_the_robot_has_heard(self):
        self.robot.navigate(3.0, 4.0, 1.5)
        self.rounds(1)
        self.docent.robot.is_deaf = True
        self.robot.stop()
        self.rounds(4)
        self.assertEqual(self.said, ["PUT", "DELETE", "DELETE"])
        self.docent.robot.is_deaf = False
        self.rounds(4)
        self.assertEqual(self.said, ["PUT"] + 3 * ["DELETE"], "and then no more")

    def test_a_robot_that_never_hears_it_is_given_up(self):
        self.docent.robot.is_deaf = True
        self.robot.navigate(3.0, 4.0, 1.5)
        self.rounds(14)
        self.assertIsNone(self.robot.result())
        self.rounds(2)
        self.assertEqual(self.robot.result(), "the robot does not answer")
        self.assertEqual(self.said[-1], "DELETE", "what comes late must not move it")


class Trouble(OverHttp):
    def test_a_login_that_has_ended_is_begun_anew(self):
        self.robot.update()
        self.docent.logins.clear()
        self.robot.navigate(3.0, 4.0, 1.5)
        self.assertIsNotNone(self.robot.update())
        self.assertEqual(self.said, ["PUT"])

    def test_a_wrong_password_is_named_and_ends_nothing(self):
        self.robot.client.account["password"] = "wrong"
        self.assertIsNone(self.robot.update())
        self.assertIn("401 wrong_password", self.lines[-1])

    def test_nobody_there_is_no_state_until_somebody_is(self):
        address, self.robot.client.address = self.robot.client.address, "http://127.0.0.1:9"
        self.robot.navigate(3.0, 4.0, 1.5)
        self.assertIsNone(self.rounds(3))
        self.robot.client.address = address
        self.assertIsNotNone(self.rounds(3))
        self.assertEqual(self.said, ["PUT"])


class Charging(OverHttp):
    def test_is_done_when_it_charges(self):
        self.docent.robot.state.update(battery=0.4, phase="going_home")
        self.robot.charge()
        self.rounds(2)
        self.assertIsNone(self.robot.result())
        self.docent.robot.state.update(phase="charging", is_charging=True)
        self.rounds(1)
        self.assertEqual(self.robot.result(), "done")
        self.assertEqual(self.said, [], "the robot goes by itself")

    def test_a_full_battery_has_nothing_to_fetch(self):
        self.docent.robot.state.update(battery=0.6)
        self.robot.charge()
        self.rounds(2)
        self.assertIsNone(self.robot.result(), "idle, but about to go")
        self.docent.robot.state.update(battery=0.9)
        self.rounds(1)
        self.assertEqual(self.robot.result(), "done")

    def test_takes_a_drive_back_first(self):
        self.robot.navigate(3.0, 4.0, 1.5)
        self.rounds(1)
        self.robot.charge()
        self.rounds(1)
        self.assertEqual(self.said, ["PUT", "DELETE"])


class OfRmf(OverHttp):
    def setUp(self):
        super().setUp()
        self.command = adapter.Command(self.robot, self.lines.append)
        self.execution = Execution()

    def test_an_execution_is_finished_when_the_robot_has_arrived(self):
        self.command.navigate(Destination(3.0, 4.0, 1.5), self.execution)
        self.rounds(1)
        self.assertIs(self.command.update(), self.execution.identifier)
        self.docent.robot.set("fulfilled")
        self.rounds(1)
        self.assertIsNone(self.command.update())
        self.assertTrue(self.execution.is_finished)

    def test_a_drive_that_failed_asks_for_another_plan(self):
        self.command.navigate(Destination(3.0, 4.0, 1.5), self.execution)
        self.rounds(1)
        self.docent.robot.set("failed", "no_way")
        self.rounds(1)
        self.assertEqual(self.command.update(), "replan")
        self.assertFalse(self.execution.is_finished)
        self.assertIn("no_way", self.lines[-1])

    def test_only_the_activity_under_way_is_stopped(self):
        self.command.navigate(Destination(3.0, 4.0, 1.5), self.execution)
        self.rounds(1)
        self.command.stop(Execution().identifier)
        self.rounds(1)
        self.assertEqual(self.said, ["PUT"])
        self.command.stop(self.execution.identifier)
        self.rounds(1)
        self.assertEqual(self.said, ["PUT", "DELETE"])
        self.assertIsNone(self.command.update())

    def test_a_dock_and_the_action_charge_are_docents_charger(self):
        self.docent.robot.state.update(phase="charging")
        self.command.navigate(Destination(3.0, 4.0, 1.5, dock="charger"), self.execution)
        self.rounds(1)
        self.command.update()
        self.assertTrue(self.execution.is_finished)
        again = Execution()
        self.command.act("charge", {}, again)
        self.rounds(1)
        self.command.update()
        self.assertTrue(again.is_finished)
        self.assertEqual(self.said, [])
        unknown = Execution()
        self.command.act("dance", {}, unknown)
        self.assertTrue(unknown.is_finished, "RMF does not wait for ever")


class Pieces(unittest.TestCase):
    def test_ids_are_as_docent_wants_them(self):
        pattern = r"[0-9a-f]{8}-[0-9a-f]{4}-7[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}"
        self.assertRegex(adapter.uuid7(1764489600.123), "^" + pattern + "$")
        self.assertTrue(adapter.uuid7(1764489600.123).startswith("019ad3c6-9c7b-7"))
        self.assertNotEqual(adapter.uuid7(), adapter.uuid7())

    def test_a_frame_is_fitted_to_its_points(self):
        # A quarter turn, twice as large, moved by (10, 20).
        rmf = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]
        robot = [[10.0, 20.0], [10.0, 22.0], [8.0, 20.0]]
        frame = adapter.Frame(rmf, robot)
        self.assertAlmostEqual(frame.rotation, math.pi / 2)
        self.assertAlmostEqual(frame.scale, 2.0)
        self.assertAlmostEqual(frame.translation[0], 10.0)
        self.assertAlmostEqual(frame.translation[1], 20.0)
        self.assertAlmostEqual(frame.error_m, 0.0)
        robot[2][0] = 7.0
        self.assertGreater(adapter.Frame(rmf, robot).error_m, 0.1)
        for points in ([[1.0, 1.0]], [[1.0, 1.0], [1.0, 1.0]]):
            with self.assertRaises(ValueError):
                adapter.Frame(points, points)

    def test_the_example_can_be_read_and_what_is_missing_is_named(self):
        config = adapter.read_config(PACKAGE / "config" / "fleet.yaml")
        robot = config["docent"]["robots"]["minerva"]
        with tempfile.TemporaryDirectory() as folder:
            password = Path(folder) / "password"
            password.write_text("secret\n")
            client = adapter.client_of("minerva", {**robot, "password_file": str(password)})
            self.assertEqual(client.account, {"name": "fleet", "password": "secret"})
            broken = Path(folder) / "fleet.yaml"
            broken.write_text("rmf_fleet: {robots: {minerva: {}}}\ndocent: {robots: {minerva: {address: x}}}\n")
            with self.assertRaisesRegex(ValueError, "docent.robots.minerva.account is missing"):
                adapter.read_config(broken)
        del robot["password_file"]
        self.assertEqual(adapter.client_of("minerva", robot, {"DOCENT_PASSWORD_MINERVA": "x"}).account["password"], "x")
        with self.assertRaisesRegex(ValueError, "DOCENT_PASSWORD_MINERVA is not set"):
            adapter.client_of("minerva", robot, {})


class Contract(unittest.TestCase):
    def test_the_stand_in_says_what_docent_says(self):
        api = json.loads((ROOT / "docs" / "openapi.json").read_text())
        schemas = api["components"]["schemas"]
        self.assertEqual(sorted(schemas["RobotState"]["properties"]), sorted(["goals", *Robot().state]))
        self.assertEqual(sorted(schemas["RobotGoalState"]["properties"]), ["id", "reason", "state"])
        self.assertEqual(sorted(schemas["RobotGoal"]["properties"]), ["heading", "id", "x", "y"])
        self.assertIn("csrf", schemas["Me"]["properties"])
        paths = {(path, method) for path, methods in api["paths"].items() for method in methods}
        for wanted in (("/robot", "get"), ("/robot/goal", "put"), ("/robot/goal/{goal}", "delete"), ("/login", "post")):
            self.assertIn(wanted, paths)


class Rmf:
    """A stand-in for rclpy and RMF with the names that RMF's own template uses."""

    def __init__(self):
        self.updates, self.added, self.transforms, self.replans = [], [], [], 0
        self.done = threading.Event()

    def update(self, state, activity):
        self.updates.append((state, activity))

    def more(self):
        def replan():
            self.replans += 1
        return types.SimpleNamespace(replan=replan)

    def add_robot(self, name, state, configuration, callbacks):
        self.added.append((name, state, configuration, callbacks))
        return types.SimpleNamespace(update=self.update, more=self.more)

    def configuration(self, config, graph):
        return types.SimpleNamespace(
            fleet_name="docent", known_robots=["minerva"], server_uri=None,
            add_robot_coordinates_transformation=lambda level, how: self.transforms.append((level, how)),
            get_known_robot_configuration=lambda name: "configuration of " + name)

    def modules(self):
        names = ("rclpy", "rclpy.node", "rclpy.parameter", "rmf_adapter", "rmf_adapter.easy_full_control")
        rclpy, node, parameter, rmf, easy = made = [types.ModuleType(name) for name in names]
        logger = types.SimpleNamespace(info=lambda line: None)
        rclpy.init, rclpy.ok, rclpy.shutdown = (lambda args: None), (lambda: not self.done.is_set()), (lambda: None)
        rclpy.spin = lambda _: self.done.wait(20)
        rclpy.node, rclpy.parameter, parameter.Parameter = node, parameter, None
        node.Node = lambda name: types.SimpleNamespace(get_logger=lambda: logger, destroy_node=lambda: None)
        rmf.init_rclcpp, rmf.easy_full_control = (lambda: None), easy
        rmf.Transformation = lambda rotation, scale, translation: (rotation, scale, translation)
        rmf.Adapter = types.SimpleNamespace(make=lambda name: types.SimpleNamespace(
            start=lambda: None, add_easy_fleet=lambda configuration: self))
        easy.FleetConfiguration = types.SimpleNamespace(from_config_files=self.configuration)
        easy.RobotState = lambda level, position, battery: (level, position, battery)
        easy.RobotCallbacks = lambda *callbacks: callbacks
        return dict(zip(names, made))


class Glue(unittest.TestCase):
    """`run`, between a stand-in for RMF and one for Docent."""

    def setUp(self):
        self.docent, self.rmf = StandIn(), Rmf()
        self.addCleanup(self.docent.close)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        config = Path(folder.name) / "fleet.yaml"
        text = (PACKAGE / "config" / "fleet.yaml").read_text()
        text = text.replace("http://127.0.0.1:8080", self.docent.address).replace("frequency: 2.0", "frequency: 50.0")
        config.write_text(re.sub(r"\n +password_file: .*", "", text))
        for patch in (unittest.mock.patch.dict(sys.modules, self.rmf.modules()),
                      unittest.mock.patch.dict(os.environ, {"DOCENT_PASSWORD_MINERVA": PASSWORD})):
            patch.start()
            self.addCleanup(patch.stop)
        arguments = types.SimpleNamespace(config_file=str(config), nav_graph="graph.yaml", server_uri="", use_sim_time=False)
        self.thread = threading.Thread(target=adapter.run, args=(arguments,), daemon=True)
        self.thread.start()
        self.addCleanup(self.rmf.done.set)

    def wait_for(self, is_so):
        end = time.monotonic() + 10
        while not is_so():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)

    def test_a_fleet_drives(self):
        self.wait_for(lambda: self.rmf.added)
        name, state, configuration, (navigate, _stop, _act) = self.rmf.added[0]
        self.assertEqual((name, configuration), ("minerva", "configuration of minerva"))
        self.assertEqual(state, ("L1", [1.0, 2.0, 0.5], 0.8))
        self.assertEqual(self.rmf.transforms[0][0], "L1")
        execution = Execution()
        navigate(Destination(3.0, 4.0, 1.5), execution)
        self.wait_for(lambda: self.docent.robot.goals and self.rmf.updates and
                      self.rmf.updates[-1][1] is execution.identifier)
        self.docent.robot.set("fulfilled")
        self.wait_for(lambda: execution.is_finished)
        navigate(Destination(9.0, 4.0, 1.5), Execution())
        self.wait_for(lambda: len(self.docent.robot.goals) == 2)
        self.docent.robot.set("failed", "no_way")
        self.wait_for(lambda: self.rmf.replans == 1)
        self.rmf.done.set()
        self.thread.join(5)
        self.assertFalse(self.thread.is_alive())


if __name__ == "__main__":
    unittest.main()
