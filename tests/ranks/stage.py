"""A gateway that runs, one far away, and people with browsers."""
import json
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import uuid
from pathlib import Path

from wire import HOST, Socket, http

ROOT = Path(__file__).resolve().parents[2]
DOCENT = os.environ.get("DOCENT_BINARY", str(ROOT / "build/dev/bin/docent"))
MUSEUM = ROOT / "museums" / "bonn"
PASSWORD = "a long way from Bonn"
# One address calls for all: what strangers may do in a while is another matter, and another test.
GENEROUS = ["web.api.reads_per_second=1000", "web.api.writes_per_second=1000", "web.api.logins_per_minute=10000", "web.messages_per_second=1000",
            "web.messages_of_address=1000", "web.message_burst=1000", "web.message_burst_of_address=1000", "web.uplink_messages_per_second=10000",
            "web.uplink_calls_per_second=1000", "web.uplink_writes_per_second=1000"]


def free_port():
    with socket.socket() as listener:
        listener.bind((HOST, 0))
        return listener.getsockname()[1]


def uuid7():
    digits = f"{int(time.time() * 1000):012x}7{uuid.uuid4().hex[13:16]}8{uuid.uuid4().hex[17:32]}"
    return str(uuid.UUID(digits))


def with_a_picture(folder):
    """The museum of Bonn, whose exhibits have pictures."""
    shutil.copytree(MUSEUM, folder)


class Process:
    def __init__(self, words, folder, name):
        self.log = Path(folder) / f"{name}.log"
        with open(self.log, "wb") as log:
            home = os.environ | {"HOME": folder, "XDG_STATE_HOME": folder, "XDG_CACHE_HOME": folder}
            self.child = subprocess.Popen([DOCENT, *words], stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, env=home)

    def output(self):
        return self.log.read_text(errors="replace")

    def wait_for(self, is_there, what, seconds=30):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if is_there():
                return
            if self.child.poll() is not None:
                raise RuntimeError(f"{what} ended: {self.output()}")
            time.sleep(0.02)
        raise RuntimeError(f"{what} does not answer: {self.output()}")

    def end(self):
        if self.child.poll() is None:
            self.child.send_signal(signal.SIGTERM)
            try:
                self.child.wait(10)
            except subprocess.TimeoutExpired:
                self.child.kill()
                self.child.wait()


class Stage:
    """Gateways of one robot that is not there: who may ask is decided before it hears."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="docent-ranks-")
        # Of nobody else on this computer: a stop of another robot would be heard here.
        self.domain = int(os.environ.get("DOCENT_TEST_DOMAIN", 150 + 3 * (os.getpid() % 25)))
        self.processes = []
        self.museum = Path(self.folder.name) / "museum"
        with_a_picture(self.museum)
        self.uplink_port = free_port()
        self.port = self.gateway("state", [f"web.uplink_port={self.uplink_port}"])
        # Of another robot, where a login is soon over and the screen has a button that stops.
        self.hasty_port = self.gateway("hasty", ["web.api.login_hours=0.0004", "web.screen_stops=true"], other=1)
        # Of a third one, from which a visitor is sent away: nobody takes a name from their address any more.
        self.third_port = self.gateway("third", [], other=2)
        self.key = (self.state / "uplink.key").read_text().strip()
        self.far_port = self.far(self.key)

    @property
    def state(self):
        return Path(self.folder.name) / "state"

    def gateway(self, name, settings, other=0):
        port = free_port()
        state = Path(self.folder.name) / name
        words = ["run", "web", "--museum", str(self.museum), "--domain", str(self.domain + other), "--state", str(state)]
        for setting in [f"web.port={port}", *GENEROUS, *settings]:
            words += ["--set", setting]
        self.start(words, name, port)
        return port

    def start(self, words, name, port, target="/metrics"):
        process = Process(words, self.folder.name, name)
        self.processes.append(process)
        process.wait_for(lambda: answers(port, target), name)
        return process

    def far(self, key):
        port = free_port()
        file = Path(self.folder.name) / "far.key"
        file.write_text(key + "\n")
        self.far_gateway = self.start(["gateway", "--from", f"{HOST}:{self.uplink_port}", "--key", str(file), "--port", str(port),
                                       "--calls-per-second", "10000", "--messages-per-second", "10000"], "far", port)
        return port

    def one_more_far(self, key):
        """What a second gateway far away says, which ends."""
        file = Path(self.folder.name) / "second.key"
        file.write_text(key + "\n")
        process = Process(["gateway", "--from", f"{HOST}:{self.uplink_port}", "--key", str(file), "--port", "0"], self.folder.name, "second")
        self.processes.append(process)
        process.child.wait(40)
        return process.output()

    def account(self, what, name, *more, state="state", password=PASSWORD):
        """docent web-account."""
        done = subprocess.run([DOCENT, "web-account", what, name, *more, "--state", str(Path(self.folder.name) / state)], input=password + "\n",
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(done.stderr)

    def screen_key(self, state="state"):
        return (Path(self.folder.name) / state / "screen.key").read_text().strip()

    def close(self):
        for process in reversed(self.processes):
            process.end()
        self.folder.cleanup()


def answers(port, target):
    try:
        return http(port, "GET", target).status == 200
    except OSError:
        return False


class Browser:
    """Somebody, with what their browser sends along. `lies`: headers that are not as they should be; None leaves one out."""

    def __init__(self, port, cookie="", csrf="", lies=None):
        self.port, self.cookie, self.csrf, self.lies = port, cookie, csrf, dict(lies or {})

    def headers(self):
        honest = {"Cookie": self.cookie or None, "Docent-Csrf": self.csrf or None}
        return {**honest, **self.lies}

    def call(self, method, target, document=None):
        body = None if document is None else json.dumps(document).encode()
        content = {} if body is None else {"Content-Type": "application/json"}
        return http(self.port, method, target, {**self.headers(), **content}, body)

    def open(self, target):
        headers = {name: value for name, value in self.headers().items() if name != "Docent-Csrf"}
        return Socket(self.port, target, headers)

    def come(self, target, document):
        """Logs in, or takes a name: from then on with another cookie."""
        answer = self.call("POST", "/api/v1" + target, document)
        if answer.status != 200:
            raise RuntimeError(f"POST {target}: {answer.status} {answer.body[:200]}")
        self.cookie, self.csrf = answer.cookie(), answer.json()["csrf"]
        return self

    def like(self, **other):
        return Browser(**{"port": self.port, "cookie": self.cookie, "csrf": self.csrf, "lies": self.lies, **other})


def log_in(port, name, password=PASSWORD):
    return Browser(port).come("/login", {"name": name, "password": password})


def visit(port, name):
    return Browser(port).come("/visitor", {"name": name})
