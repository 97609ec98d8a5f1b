"""A stand-in for Docent's REST API over real HTTP: logins, tokens against other sites, and a robot with a board.

It answers as docs/openapi.json says; check_contract in fleet_adapter_test.py holds it to that file.
"""
import http.server
import json
import re
import secrets
import threading

PASSWORD = "a long way from Bonn"


class Robot:
    """What the mission would do with staff requests; a test sets how they go."""

    def __init__(self):
        self.goals = {}  # id: {"id", "state", "reason"}
        self.poses = {}
        self.state = {"t": 1.0, "pose": [1.0, 2.0, 0.5], "battery": 0.8, "is_charging": False, "phase": "idle",
                      "is_stopped": False, "remaining_m": 0.0}
        self.is_deaf = False
        self.said = []   # (method, goal)

    def drive(self, goal):
        self.said.append(("PUT", goal["id"]))
        if not self.is_deaf and goal["id"] not in self.goals:
            self.goals[goal["id"]] = {"id": goal["id"], "state": "queued", "reason": ""}
            self.poses[goal["id"]] = (goal["x"], goal["y"], goal["heading"])

    def withdraw(self, goal):
        self.said.append(("DELETE", goal))
        if not self.is_deaf and self.goals.get(goal, {}).get("state") in ("queued", "active"):
            self.goals[goal].update(state="cancelled", reason="cancelled")

    def set(self, state, reason=""):
        for goal in self.goals.values():
            if goal["state"] in ("queued", "active"):
                goal.update(state=state, reason=reason)

    def document(self):
        return {**self.state, "goals": list(self.goals.values())}


class StandIn:
    def __init__(self):
        self.robot = Robot()
        self.logins = {}  # cookie: csrf
        stand_in = self

        class Handler(http.server.BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def log_message(self, *words):
                pass

            def answer(self, status, document, cookie=None):
                body = json.dumps(document).encode()
                self.send_response(status)
                self.send_header("Content-Type", "application/json")
                self.send_header("Content-Length", str(len(body)))
                if cookie:
                    self.send_header("Set-Cookie", f"docent_login={cookie}; Path=/; HttpOnly; SameSite=Strict")
                self.end_headers()
                self.wfile.write(body)

            def do(self):
                length = int(self.headers.get("Content-Length") or 0)
                body = json.loads(self.rfile.read(length)) if length else None
                stand_in.handle(self, body)

            do_GET = do_PUT = do_POST = do_DELETE = do

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.address = f"http://127.0.0.1:{self.server.server_port}"
        self.thread = threading.Thread(target=self.server.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True)
        self.thread.start()

    def close(self):
        self.server.shutdown()
        self.server.server_close()

    def handle(self, to, body):
        path = to.path.removeprefix("/api/v1")
        if (to.command, path) == ("POST", "/login"):
            if body != {"name": "fleet", "password": PASSWORD}:
                return to.answer(401, {"reason": "wrong_password", "about": ""})
            cookie, csrf = secrets.token_hex(32), secrets.token_hex(32)
            self.logins[cookie] = csrf
            return to.answer(200, {"name": "fleet", "rank": "operator", "csrf": csrf, "expires": 2e9}, cookie)
        found = re.search(r"docent_login=(\w+)", to.headers.get("Cookie") or "")
        csrf = self.logins.get(found.group(1)) if found else None
        if csrf is None:
            return to.answer(403, {"reason": "not_allowed", "about": ""})
        if to.command != "GET" and to.headers.get("Docent-Csrf") != csrf:
            return to.answer(403, {"reason": "wrong_csrf", "about": ""})
        if (to.command, path) == ("GET", "/robot"):
            return to.answer(200, self.robot.document())
        if (to.command, path) == ("PUT", "/robot/goal"):
            if sorted(body) != ["heading", "id", "x", "y"] or to.headers["Content-Type"] != "application/json":
                return to.answer(400, {"reason": "not_understood", "about": "the body"})
            self.robot.drive(body)
            return to.answer(200, {})
        if to.command == "DELETE" and path.startswith("/robot/goal/"):
            self.robot.withdraw(path.rpartition("/")[2])
            return to.answer(200, {})
        return to.answer(404, {"reason": "not_found", "about": ""})
