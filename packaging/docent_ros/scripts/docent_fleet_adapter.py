"""Open-RMF fleet adapter for robots that Docent drives, over Docent's REST API (docs/openapi.json, /robot).

ros2 run docent_ros docent_fleet_adapter.py -c fleet.yaml -n nav_graph.yaml

Each robot of rmf_fleet in fleet.yaml has an address and an operator's account there. RMF's easy full control decides where
a robot goes; this script says it to Docent, and says to RMF where the robot is and when it has arrived. All of RMF is in
`run`; what is above it needs Python alone.
"""
import argparse
import http.cookiejar
import json
import math
import os
import pathlib
import secrets
import sys
import threading
import time
import urllib.error
import urllib.request

API = "/api/v1"
TIMEOUT_S = 3.0
# Docent refuses more than one write every two seconds of the same login in the long run (web.api.writes_per_second).
RESEND_S = 2.5
# What is then not on the robot's board has not reached it.
UNHEARD_S = 15.0
# Above it a robot that stands has nothing to fetch at its charger: Docent sends an idle one there when mission.battery_gain
# is missing of mission.battery_full.
CHARGED = 0.70
OPEN = ("queued", "active")


class Refused(Exception):
    """Docent has answered, and not with what was asked for."""

    def __init__(self, status, reason, about=""):
        super().__init__(f"{status} {reason} {about}".strip())
        self.status = status
        self.reason = reason


def uuid7(now_s=None):
    """RFC 9562, 5.7."""
    now_ms = int((time.time() if now_s is None else now_s) * 1000)
    value = (now_ms & (2**48 - 1)) << 80 | secrets.randbits(80)
    value = value & ~(0xF << 76) | 7 << 76
    value = value & ~(0x3 << 62) | 2 << 62
    text = f"{value:032x}"
    return "-".join((text[:8], text[8:12], text[12:16], text[16:20], text[20:]))


class DocentClient:
    """Docent's REST API, for one robot. Logs in when it must, and again when the login has ended."""

    def __init__(self, address, name, password):
        self.address = address.rstrip("/")
        self.account = {"name": name, "password": password}
        self.csrf = ""
        self.lock = threading.Lock()
        self.opener = urllib.request.build_opener(
            urllib.request.HTTPCookieProcessor(http.cookiejar.CookieJar()))

    def _call(self, method, path, body=None):
        request = urllib.request.Request(self.address + API + path, method=method)
        if body is not None:
            request.data = json.dumps(body).encode()
            request.add_header("Content-Type", "application/json")
        if self.csrf:
            request.add_header("Docent-Csrf", self.csrf)
        try:
            with self.opener.open(request, timeout=TIMEOUT_S) as reply:
                return json.load(reply)
        except urllib.error.HTTPError as refusal:
            try:
                why = json.load(refusal)
            except ValueError:
                why = {}
            raise Refused(refusal.code, why.get("reason", ""), why.get("about", "")) from None

    def call(self, method, path, body=None):
        """The answer's document. Refused: Docent's no. OSError: nobody answers."""
        with self.lock:
            if not self.csrf:
                self._log_in()
            try:
                return self._call(method, path, body)
            except Refused as no:
                if no.reason not in ("not_allowed", "wrong_csrf"):
                    raise
            self._log_in()
            return self._call(method, path, body)

    def _log_in(self):
        self.csrf = ""
        self.csrf = self._call("POST", "/login", self.account)["csrf"]

    def state(self):
        return self.call("GET", "/robot")

    def drive(self, goal, x, y, heading):
        self.call("PUT", "/robot/goal", {"id": goal, "x": x, "y": y, "heading": heading})

    def withdraw(self, goal):
        self.call("DELETE", "/robot/goal/" + goal)


class DocentRobot:
    """What RMF wants of one robot, said to Docent until Docent has heard it.

    Commands only note what is wanted and return at once; `update`, called about twice a second, does the talking.
    """

    def __init__(self, client, clock=time.monotonic, log=print):
        self.client = client
        self.clock = clock
        self.log = log
        self.lock = threading.Lock()
        self.state = None        # as Docent said last; None: it has never answered, or does not know its place
        self.goal = None         # {"id", "pose", "began", "sent", "is_known"}
        self.withdrawn = {}      # goals that nobody wants any more: id, and when that was said last
        self.charges = False     # it is to charge
        self.outcome = None      # of the command under way: None, "done", or why it was not done

    # What RMF says.

    def navigate(self, x, y, heading):
        with self.lock:
            self._forget()
            self.goal = {"id": uuid7(), "pose": (x, y, heading), "began": self.clock(), "sent": None, "is_known": False}

    def charge(self):
        """Docent drives to its charger and docks there by itself, once nobody wants anything else."""
        with self.lock:
            self._forget()
            self.charges = True

    def stop(self):
        with self.lock:
            self._forget()

    def result(self):
        """None while the command is under way; "done"; or the reason why not."""
        with self.lock:
            return self.outcome

    def _forget(self):
        if self.goal is not None:
            self.withdrawn[self.goal["id"]] = None
        self.goal, self.charges, self.outcome = None, False, None

    # What Docent says.

    def update(self):
        """One round: what is wanted goes to the robot, and how it is comes back. Returns {map pose, battery}, or None."""
        with self.lock:
            try:
                self._tell()
                state = self.client.state()
            except (Refused, OSError, ValueError) as fault:
                self.log(f"Docent: {fault}")
                self.state = None
                self._give_up()
                return None
            self._hear(state)
            known = state["pose"] is not None and state["battery"] is not None
            self.state = state if known else None
            return None if not known else {"position": list(state["pose"]), "battery": float(state["battery"])}

    def _is_due(self, said):
        return said is None or self.clock() - said >= RESEND_S

    def _tell(self):
        for goal, said in list(self.withdrawn.items()):
            if self._is_due(said):
                self.withdrawn[goal] = self.clock()
                self.client.withdraw(goal)
        if self.goal is not None and not self.goal["is_known"] and self._is_due(self.goal["sent"]):
            self.goal["sent"] = self.clock()
            self.client.drive(self.goal["id"], *self.goal["pose"])

    def _hear(self, state):
        goals = {goal["id"]: goal for goal in state["goals"]}
        # One that the robot has never heard of, or that has ended, needs no withdrawal.
        for goal, said in list(self.withdrawn.items()):
            if said is not None and goals.get(goal, {"state": ""})["state"] not in OPEN:
                del self.withdrawn[goal]
        if self.goal is not None:
            standing = goals.get(self.goal["id"])
            self.goal["is_known"] = standing is not None
            if standing is None:
                self._give_up()
            elif standing["state"] not in OPEN:
                done = standing["state"] == "fulfilled"
                self.outcome = "done" if done else standing["reason"] or standing["state"]
                self.goal = None
        elif self.charges:
            battery = state["battery"]
            rests = state["phase"] == "idle" and battery is not None and battery >= CHARGED
            if state["phase"] == "charging" or state["is_charging"] or rests:
                self.outcome = "done"
                self.charges = False

    def _give_up(self):
        if self.goal is not None and not self.goal["is_known"] and self.clock() - self.goal["began"] >= UNHEARD_S:
            self._forget()
            self.outcome = "the robot does not answer"


class Frame:
    """RMF's coordinates of a level in Docent's map and back: a rotation, a scale and a translation, fitted to pairs of
    points by least squares."""

    def __init__(self, rmf, robot):
        if len(rmf) != len(robot) or len(rmf) < 2:
            raise ValueError("reference_coordinates: rmf and robot need as many points, two at least")
        a = [complex(*point) for point in rmf]
        b = [complex(*point) for point in robot]
        mean_a, mean_b = sum(a) / len(a), sum(b) / len(b)
        spread = sum(abs(p - mean_a) ** 2 for p in a)
        if spread < 1e-12:
            raise ValueError("reference_coordinates: all points of rmf are one")
        self.turn = sum((q - mean_b) * (p - mean_a).conjugate() for p, q in zip(a, b)) / spread
        if abs(self.turn) < 1e-12:
            raise ValueError("reference_coordinates: all points of robot are one")
        self.shift = mean_b - self.turn * mean_a
        self.error_m = max(abs(self.turn * p + self.shift - q) for p, q in zip(a, b))

    @property
    def rotation(self):
        return math.atan2(self.turn.imag, self.turn.real)

    @property
    def scale(self):
        return abs(self.turn)

    @property
    def translation(self):
        return [self.shift.real, self.shift.imag]


def read_config(path):
    """fleet.yaml. ValueError names what is missing."""
    import yaml
    with open(path, encoding="utf-8") as file:
        config = yaml.safe_load(file)
    robots = config.get("docent", {}).get("robots", {})
    for name in config.get("rmf_fleet", {}).get("robots", {}):
        for key in ("address", "account"):
            if key not in robots.get(name, {}):
                raise ValueError(f"{path}: docent.robots.{name}.{key} is missing")
    return config


def client_of(name, robot, environment=os.environ):
    """The password stands in a file, or in DOCENT_PASSWORD_NAME."""
    if "password_file" in robot:
        password = pathlib.Path(robot["password_file"]).read_text(encoding="utf-8").strip()
    else:
        variable = "DOCENT_PASSWORD_" + name.upper()
        if variable not in environment:
            raise ValueError(f"docent.robots.{name} has no password_file, and {variable} is not set")
        password = environment[variable]
    return DocentClient(robot["address"], robot["account"], password)


class Command:
    """Between RMF's executions and a DocentRobot: says when one is finished."""

    def __init__(self, robot, log=print):
        self.robot = robot
        self.log = log
        self.execution = None

    def navigate(self, destination, execution):
        self.execution = execution
        x, y, heading = destination.position
        # A dock of the navigation graph is the charger: Docent knows the way into it.
        if getattr(destination, "dock", None):
            self.robot.charge()
        else:
            self.robot.navigate(x, y, heading)

    def stop(self, activity):
        if self.execution is not None and self.execution.identifier.is_same(activity):
            self.execution = None
            self.robot.stop()

    def act(self, category, description, execution):
        self.execution = execution
        if category == "charge":
            self.robot.charge()
        else:
            self.log(f"Docent does not know the action {category}: {description}")
            execution.finished()
            self.execution = None

    def update(self):
        """Returns the identifier of what is under way, or None. A drive that failed asks RMF for another plan."""
        if self.execution is None:
            return None
        outcome = self.robot.result()
        if outcome is None:
            return self.execution.identifier
        execution, self.execution = self.execution, None
        if outcome == "done":
            execution.finished()
        else:
            self.log(f"the robot did not get there: {outcome}")
            return "replan"
        return None


def run(arguments):
    """All that needs RMF."""
    import rclpy
    import rclpy.node
    import rmf_adapter
    import rmf_adapter.easy_full_control as easy
    from rclpy.parameter import Parameter
    from rmf_adapter import Adapter, Transformation

    config = read_config(arguments.config_file)
    rclpy.init(args=sys.argv)
    rmf_adapter.init_rclcpp()
    fleet = easy.FleetConfiguration.from_config_files(arguments.config_file, arguments.nav_graph)
    assert fleet, f"{arguments.config_file}: RMF does not understand it"
    node = rclpy.node.Node(f"{fleet.fleet_name}_command_handle")
    adapter = Adapter.make(f"{fleet.fleet_name}_fleet_adapter")
    assert adapter, "no fleet adapter: does the RMF schedule node run?"
    if arguments.use_sim_time:
        node.set_parameters([Parameter("use_sim_time", Parameter.Type.BOOL, True)])
        adapter.node.use_sim_time()
    log = node.get_logger().info
    for level, points in config.get("reference_coordinates", {}).items():
        frame = Frame(points["rmf"], points["robot"])
        log(f"level {level}: the reference points fit to {frame.error_m:.2f} m")
        fleet.add_robot_coordinates_transformation(
            level, Transformation(frame.rotation, frame.scale, frame.translation))
    fleet.server_uri = arguments.server_uri or None
    adapter.start()
    handle = adapter.add_easy_fleet(fleet)

    def serve(name):
        settings = config["docent"]["robots"][name]
        robot = DocentRobot(client_of(name, settings), log=log)
        command = Command(robot, log)
        updater = None
        callbacks = easy.RobotCallbacks(command.navigate, command.stop, command.act)
        period = 1.0 / float(config["rmf_fleet"].get("robot_state_update_frequency", 2.0))
        while rclpy.ok():
            began = time.monotonic()
            seen = robot.update()
            if seen is not None:
                state = easy.RobotState(settings.get("map", "L1"), seen["position"], seen["battery"])
                if updater is None:
                    updater = handle.add_robot(name, state, fleet.get_known_robot_configuration(name), callbacks)
                else:
                    activity = command.update()
                    if activity == "replan":
                        updater.more().replan()
                        activity = None
                    updater.update(state, activity)
            time.sleep(max(0.0, period - (time.monotonic() - began)))

    threads = [threading.Thread(target=serve, args=(name,), daemon=True) for name in fleet.known_robots]
    for thread in threads:
        thread.start()
    rclpy.spin(node)
    node.destroy_node()
    rclpy.shutdown()


def main():
    parser = argparse.ArgumentParser(description="Open-RMF fleet adapter for Docent")
    parser.add_argument("-c", "--config_file", required=True, help="fleet.yaml")
    parser.add_argument("-n", "--nav_graph", required=True, help="RMF's navigation graph")
    parser.add_argument("-s", "--server_uri", default="", help="of RMF's API server")
    parser.add_argument("-sim", "--use_sim_time", action="store_true")
    arguments, _ = parser.parse_known_args()
    run(arguments)


if __name__ == "__main__":
    main()
