#!/usr/bin/env python3
"""The fleet adapter's client and a simulated robot of `docent up`, over real HTTP and DDS: driven, replaced, stopped, refused, charged."""
import importlib.util
import math
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parents[2]
DOCENT = os.environ.get("DOCENT_BINARY", str(ROOT / "build/dev/bin/docent"))
DOMAIN = int(os.environ.get("DOCENT_TEST_DOMAIN", 60 + os.getpid() % 20))
PASSWORD = "a long way from Bonn"
SETTINGS = ["mission.goes_home=false", "mission.mingles=false"]
_spec = importlib.util.spec_from_file_location(
    "docent_fleet_adapter", ROOT / "packaging/docent_ros/scripts/docent_fleet_adapter.py")
adapter = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(adapter)

passed = failed = 0


def expect(what, is_so, seen=""):
    global passed, failed
    passed, failed = passed + bool(is_so), failed + (not is_so)
    print(f"{'ok    ' if is_so else 'FAILED'} {what}" + ("" if is_so else f": {seen}"), flush=True)


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


class Trial:
    def __init__(self, folder):
        state, self.log, port = Path(folder) / "state", Path(folder) / "log", free_port()
        environment = os.environ | {"HOME": folder, "XDG_STATE_HOME": folder, "XDG_CACHE_HOME": folder}
        subprocess.run([DOCENT, "web-account", "add", "fleet", "--role", "operator", "--state", str(state)],
                       input=PASSWORD + "\n", text=True, check=True, env=environment, stdout=subprocess.DEVNULL)
        words = [DOCENT, "up", "--sim", "--museum", str(ROOT / "museums/bonn"), "--crowd", "empty", "--requests-per-hour", "0",
                 "--state", str(state), "--domain", str(DOMAIN), "--port", str(port)]
        for setting in SETTINGS:
            words += ["--set", setting]
        with open(self.log, "wb") as log:
            self.child = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT,
                                          env=environment)
        self.client = adapter.DocentClient(f"http://127.0.0.1:{port}", "fleet", PASSWORD)
        self.robot = adapter.DocentRobot(self.client, log=lambda line: None)
        self.seen = None

    def end(self):
        self.child.send_signal(signal.SIGTERM)
        try:
            self.child.wait(20)
        except subprocess.TimeoutExpired:
            self.child.kill()
            self.child.wait()

    def until(self, is_so, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end and self.child.poll() is None:
            self.seen = self.robot.update() or self.seen
            if is_so():
                return True
            time.sleep(0.4)
        return False

    def distance_to(self, x, y):
        return math.dist(self.seen["position"][:2], (x, y))

    def goal_on_board(self):
        return self.robot.goal is not None and self.robot.goal["is_known"]


def drive(trial):
    expect("the robot finds itself, and the client sees where", trial.until(lambda: trial.seen is not None, 90), "no pose")
    if trial.seen is None:
        return
    x, y, heading = trial.seen["position"]
    # Somewhere free: of the places 2 m around the first that the robot does not refuse.
    for step in range(8):
        goal = (x + 2.0 * math.cos(heading + step * math.pi / 4), y + 2.0 * math.sin(heading + step * math.pi / 4))
        trial.robot.navigate(*goal, 1.0)
        trial.until(lambda: trial.robot.result() is not None or trial.goal_on_board(), 20)
        if trial.robot.result() is None:
            break
    expect("a place near by is taken", trial.robot.result() is None, trial.robot.result())
    expect("the robot drives there", trial.until(lambda: trial.robot.result() is not None, 60), trial.seen)
    expect("and says so", trial.robot.result() == "done", trial.robot.result())
    expect("it stands there", trial.distance_to(*goal) < 0.4, trial.seen)
    turned = abs(math.remainder(trial.seen["position"][2] - 1.0, math.tau))
    expect("and looks as it was told", turned < 0.25, trial.seen)
    time.sleep(5.0)
    trial.until(lambda: True, 5)
    expect("it stays there when nobody wants anything", trial.distance_to(*goal) < 0.4, trial.seen)

    trial.robot.navigate(x, y, heading)
    trial.until(trial.goal_on_board, 10)
    first = trial.robot.goal["id"]
    trial.robot.navigate(*goal, -1.0)
    trial.until(lambda: trial.robot.result() is not None, 60)
    states = {each["id"]: each["state"] for each in trial.client.state()["goals"]}
    expect("a newer goal takes the older one's place", states.get(first) == "cancelled", states)
    expect("and is reached", trial.robot.result() == "done", trial.robot.result())

    trial.robot.navigate(x, y, heading)
    expect("it sets out again", trial.until(lambda: trial.distance_to(*goal) > 0.5, 30), trial.seen)
    trial.robot.stop()
    trial.until(lambda: not trial.robot.withdrawn, 10)
    time.sleep(2.0)
    trial.until(lambda: True, 5)
    there = trial.seen["position"]
    time.sleep(2.0)
    trial.until(lambda: True, 5)
    expect("a stop ends the way", math.dist(there[:2], trial.seen["position"][:2]) < 0.1, (there, trial.seen))
    expect("before the robot was there", trial.distance_to(x, y) > 0.4, trial.seen)

    trial.robot.navigate(9000.0, 9000.0, 0.0)
    trial.until(lambda: trial.robot.result() is not None, 10)
    expect("a place that is none is refused with its reason", trial.robot.result() == "not_on_free_floor", trial.robot.result())
    trial.robot.charge()
    trial.until(lambda: trial.robot.result() is not None, 10)
    expect("a robot with a full battery has nothing to charge", trial.robot.result() == "done", trial.client.state())


def main():
    with tempfile.TemporaryDirectory(prefix="docent-fleet-") as folder:
        trial = Trial(folder)
        try:
            drive(trial)
        finally:
            trial.end()
            if failed:
                print(trial.log.read_text(errors="replace")[-3000:])
    print(f"{passed} passed, {failed} failed")
    sys.exit(failed > 0 or passed == 0)


if __name__ == "__main__":
    main()
