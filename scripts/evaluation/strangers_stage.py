"""What the protocol `strangers` is played on: a robot of real processes, its database on a slow disk behind a cable that can be cut, a gateway far away,
and somebody who sees what the base is told. All of it ends with the stage."""
import json
import os
import resource
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from evaluation.web_caller import Caller

SYNC_MS = 20  # [ms] that a commit takes
DESCRIPTORS = 1024  # that a process may open before it asks for more, as on most systems
HERE = Path(__file__).parent
PASSWORD = "a long way from Bonn"
POSTGRES = sorted(Path("/usr/lib/postgresql").glob("*/bin"))


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def few_descriptors():
    resource.setrlimit(resource.RLIMIT_NOFILE, (DESCRIPTORS, resource.getrlimit(resource.RLIMIT_NOFILE)[1]))


def until(what, wanted, seconds, step=0.05):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found = wanted()
        if found:
            return found
        time.sleep(step)
    raise RuntimeError(f"{what}: not within {seconds:g} s")


class Process:
    """A program that ends with the stage; what it prints is kept in a file."""

    def __init__(self, stage, name, command, env=None, limited=False):
        self.name, self.path = name, stage.folder / f"{name}.log"
        self.log = open(self.path, "wb")
        self.process = subprocess.Popen([str(word) for word in command], stdin=subprocess.PIPE, stdout=self.log, stderr=subprocess.STDOUT,
                                        env={**os.environ, **(env or {})}, preexec_fn=few_descriptors if limited else None)
        stage.processes.append(self)

    def say(self, word):
        self.process.stdin.write((word + "\n").encode())
        self.process.stdin.flush()

    def output(self):
        return self.path.read_text(errors="replace")

    def end(self, sign=signal.SIGTERM, patience=15):
        """[s] until it was gone, or None: it had to be killed."""
        begin = time.monotonic()
        if self.process.poll() is None:
            self.process.send_signal(sign)
        try:
            self.process.wait(patience)
            return time.monotonic() - begin
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            return None


class Postgres:
    """A server of its own on a slow disk, at a port of its own."""

    def __init__(self, stage, slow):
        self.place, self.port, self.programs = stage.folder / "postgres", free_port(), POSTGRES[-1]
        self.place.mkdir()
        shim = self.place / "slow.so"
        shutil.copy(slow, shim)
        self.slow = {**os.environ, "LD_PRELOAD": str(shim), "DOCENT_SYNC_MS": str(SYNC_MS)}
        is_root = os.geteuid() == 0
        self.as_them = ["setpriv", "--reuid", "postgres", "--regid", "postgres", "--clear-groups"] if is_root else []
        if is_root:
            os.chmod(stage.folder, 0o711)
            shutil.chown(self.place, "postgres")
            shutil.chown(shim, "postgres")
        self.run("initdb", "-A", "trust", "-U", "docent", "--no-sync", env=os.environ)
        self.start()

    def run(self, program, *words, env=None):
        done = subprocess.run([*self.as_them, self.programs / program, "-D", self.place / "data", *words], env=env or self.slow,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, cwd="/", check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{program}: {done.stderr}")

    def start(self):
        self.run("pg_ctl", "-w", "-l", self.place / "log", "-o", f"-c listen_addresses=127.0.0.1 -c port={self.port} -c unix_socket_directories={self.place}", "start")

    def stop(self):
        self.run("pg_ctl", "-m", "immediate", "stop")

    def hang(self, stands):
        """All its processes stand, or go on: nobody is told, and nothing is closed."""
        server = int((self.place / "data/postmaster.pid").read_text().split()[0])
        others = subprocess.run(["ps", "-o", "pid=", "--ppid", str(server)], capture_output=True, text=True, check=False).stdout.split()
        for pid in [server, *map(int, others)]:
            try:
                os.kill(pid, signal.SIGSTOP if stands else signal.SIGCONT)
            except ProcessLookupError:
                pass


class Watch:
    """What the base is told and what it does, by the clock of time.monotonic()."""

    def __init__(self, program, domain):
        self.process = subprocess.Popen([program, str(domain)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.commands, self.motions, self.lock = [], [], threading.Lock()
        threading.Thread(target=self.listen, daemon=True).start()

    def listen(self):
        for line in self.process.stdout:
            what, at, linear, angular = line.split()
            row = (float(at), abs(float(linear)) + abs(float(angular)))
            with self.lock:
                (self.commands if what == "command" else self.motions).append(row)

    def is_driven(self, seconds=0.15):
        """The base has been told to move all the time for so long."""
        with self.lock:
            lately = [row for row in self.commands[-40:] if row[0] > time.monotonic() - seconds]
        return len(lately) >= 2 and all(size > 0.05 for _, size in lately)

    def moved_at(self, pressed):
        """Whether the last word before was to move: else there was nothing to stop."""
        with self.lock:
            before = [row for row in self.commands[-400:] if pressed - 0.15 <= row[0] <= pressed]
        return bool(before) and before[-1][1] > 0.05

    def stood_after(self, pressed, until_when):
        """[s] from the press until the base was told to stand, and told nothing else any more. None: it was told to move on."""
        with self.lock:
            rows = [row for row in self.commands[-2000:] if pressed <= row[0] <= until_when]
        last_moving = max((at for at, size in rows if size > 1e-6), default=pressed)
        standing = [at for at, size in rows if size <= 1e-6 and at >= last_moving]
        return standing[0] - pressed if standing else None

    def silence(self, since):
        """[s] the longest time without a command."""
        with self.lock:
            times = [at for at, _ in self.commands if at >= since]
        return max((b - a for a, b in zip(times, times[1:])), default=0.0)

    def end(self):
        self.process.stdin.close()
        self.process.wait()


class Stage:
    def __init__(self, root, docent, store, settings=(), crippled=None):
        """store: file or server. crippled: a program and settings for the gateway that is attacked, instead of the robot's own."""
        self.root, self.docent = root, docent
        self.folder = Path(tempfile.mkdtemp(prefix="docent-strangers-"))
        self.processes, self.postgres, self.cable, self.watch, self.far = [], None, None, None, None
        tests = root / "build/dev/tests/strangers"
        slow = {"LD_PRELOAD": str(tests / "libdocent_slow_sync.so"), "DOCENT_SYNC_MS": str(SYNC_MS)}
        self.state, self.domain = self.folder / "state", int(os.environ.get("DOCENT_TEST_DOMAIN", "83"))
        self.port, self.door = free_port(), free_port()
        try:
            database = []
            if store == "server":
                self.postgres = Postgres(self, tests / "libdocent_slow_sync.so")
                cable_port = free_port()
                self.cable = Process(self, "cable", [sys.executable, HERE / "cable.py", cable_port, self.postgres.port])
                self.where = f"postgresql://docent@127.0.0.1:{cable_port}/postgres"
                until("the cable", lambda: self.reaches(cable_port), 10)
                database = ["--set", f"web.database={self.where}"]
            self.make_account(["--database", self.where] if database else ["--state", self.state])
            self.settings = [*database, "--set", "web.screen_stops=true", "--set", f"web.uplink_port={self.door}", *settings]
            self.robot = Process(self, "robot", [docent, "up", "--sim", "--museum", root / "museums/bonn", "--crowd", "quiet", "--requests-per-hour", "0",
                                                 "--no-cameras", "--mode", "open", "--domain", self.domain, "--port", self.port, "--state", self.state,
                                                 "--start=9,3.6,90", *self.settings], slow, limited=True)
            until("the page", lambda: self.is_up(self.port), 60)
            if crippled:
                program, more = crippled
                self.port, self.state = free_port(), self.folder / "crippled"
                if not database:
                    self.make_account(["--state", self.state])
                self.crippled = Process(self, "crippled", [program, "run", "web", "--museum", root / "museums/bonn", "--domain", self.domain, "--state",
                                                           self.state, "--set", f"web.port={self.port}", *database, "--set",
                                                           "web.screen_stops=true", *more], slow, limited=True)
                until("the crippled gateway", lambda: self.is_up(self.port), 60)
            self.watch = Watch(tests / "docent_command_watch", self.domain)
        except BaseException:
            self.end()
            raise

    def make_account(self, where):
        subprocess.run([self.docent, "web-account", "add", "ada", "--role", "operator", *where], input=PASSWORD + "\n", text=True, check=True,
                       stdout=subprocess.DEVNULL)

    @staticmethod
    def reaches(port):
        try:
            socket.create_connection(("127.0.0.1", port), 1).close()
            return True
        except OSError:
            return False

    def is_up(self, port):
        if self.robot.process.poll() is not None:
            raise RuntimeError("docent up ended: " + self.robot.output()[-2000:])
        try:
            return Caller(port, timeout=1.0).get("/metrics")[0] == 200
        except OSError:
            return False

    def web_pid(self):
        """Of the robot's own gateway."""
        for path in Path("/proc").glob("[0-9]*/cmdline"):
            try:
                words = path.read_bytes().split(b"\0")
                parent = int((path.parent / "stat").read_text().rpartition(")")[2].split()[1])
            except (OSError, ValueError, IndexError):
                continue
            if parent == self.robot.process.pid and b"web" in words:
                return int(path.parent.name)
        return None

    def health(self, port=None):
        """Of the module web, as the gateway shows it."""
        try:
            status, text = Caller(port or self.port, "127.0.0.253", timeout=2.0).get("/api/health")
            return next((one for one in json.loads(text)["modules"] if one["name"] == "web"), {}) if status == 200 else {}
        except (OSError, ValueError, KeyError):
            return {}

    def screen_path(self):
        return "/live?screen=" + (self.state / "screen.key").read_text().strip()

    def museum(self):
        return json.loads(Caller(self.port).get("/api/museum.json")[1])

    def start_far(self):
        self.far_port = free_port()
        self.far = Process(self, "far", [self.docent, "gateway", "--from", f"127.0.0.1:{self.door}", "--key", self.state / "uplink.key", "--port",
                                         self.far_port], limited=True)
        until("the far gateway", lambda: self.far.process.poll() is not None or self.is_up(self.far_port), 30)
        if self.far.process.poll() is not None:
            raise RuntimeError("docent gateway ended: " + self.far.output()[-500:])

    def crowd(self, port, sockets, addresses, posts=(), seed=1):
        known = self.museum()
        wish = {"port": port, "sockets": sockets, "addresses": addresses, "account": "ada", "posts": list(posts), "seed": seed,
                "exhibits": [one["id"] for one in known["exhibits"] if not one.get("web_only")], "tours": [one["id"] for one in known["tours"]]}
        return Process(self, f"crowd{len(self.processes)}", [sys.executable, HERE / "stranger_crowd.py", json.dumps(wish)])

    def crowd_ends(self, crowd):
        crowd.process.stdin.close()
        crowd.process.wait(30)
        return json.loads(crowd.output().strip().splitlines()[-1])

    def end(self):
        if self.watch:
            self.watch.end()
        if self.postgres and self.cable:
            self.postgres.hang(False)
        for process in reversed(self.processes):
            process.end()
        if self.postgres:
            try:
                self.postgres.stop()
            except RuntimeError:
                pass
        if os.environ.get("DOCENT_KEEP"):
            print(f"kept: {self.folder}")
        else:
            shutil.rmtree(self.folder, ignore_errors=True)
