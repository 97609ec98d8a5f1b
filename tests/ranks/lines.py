"""WebSockets: every door by everybody, every message on every line that can be had, and lines that outlive their right."""
import json
import time

import policy
from stage import ROOT, Browser, log_in, uuid7, visit
from wire import HOST

ENDS_WITHIN = 4.0  # [s] of `docent web-account`; a gateway asks every second


def samples():
    """One message of each kind, as the page says it."""
    found = {}
    for message in json.loads((ROOT / "tests/web_contract/client.json").read_text()):
        found.setdefault(message["type"], message)
    return found


def faults_of_policy():
    named = set(samples())
    return [f"the message {kind} has no expectation" for kind in sorted(named - policy.MESSAGES.keys())] + [
        f"the message {kind} is expected and does not exist" for kind in sorted(policy.MESSAGES.keys() - named)]


def fresh(message):
    message = {**message, **({"id": uuid7()} if "id" in message else {})}
    # A hand that is not on the knob, and no stop that the next one would have to release.
    return {**message, **({"pressed": False} if message["type"] == "steer" else {}), **({"wants": False} if message["type"] == "lease" else {})}


def says(socket, message):
    """Whether whoever is at the other end took it."""
    if not socket.is_open:
        return "no line"
    if "id" in message:
        answer = socket.ask(message)
        if answer is None:
            return "1008" if socket.frames.closed == 1008 else "closed"
        return "yes"
    socket.say(message)
    return "yes" if socket.settle() else str(socket.frames.closed)


def message_rows(stage):
    """{message: {speaker: (expected, seen)}}: each on a line of its own, for one that is refused is closed."""
    operator = log_in(stage.port, "ada")
    visitor, moderator = visit(stage.port, "Eve on a line"), log_in(stage.port, "grace")
    openings = [("a viewer", "viewer", lambda: Browser(stage.port).open("/live")),
                ("a visitor", "viewer", lambda: visitor.open("/live")),
                ("a moderator on /live", "viewer", lambda: moderator.open("/live")),
                ("an operator on /live", "viewer", lambda: operator.open("/live")),
                ("the robot's own screen", "screen", lambda: Browser(stage.port).open(f"/live?screen={stage.screen_key()}")),
                ("one with a stop button", "screen with a stop button", lambda: Browser(stage.hasty_port).open(f"/live?screen={stage.screen_key('hasty')}")),
                ("an operator on /operate", "operator", lambda: operator.open("/operate")),
                ("a viewer, far away", "far viewer", lambda: Browser(stage.far_port).open("/live")),
                ("an operator on /live, far away", "far viewer", lambda: operator.like(port=stage.far_port).open("/live"))]
    rows = {}
    for kind, sample in samples().items():
        cells = rows.setdefault(f"`{kind}`", {})
        for name, speaker, opening in openings:
            socket = opening()
            expected = "yes" if policy.MESSAGES.get(kind) and policy.of_message(kind, speaker) else "1008"
            cells[name] = (expected, says(socket, fresh(sample)))
            socket.close()
    return rows


def key_holder_rows(stage, line):
    """Likewise of whoever holds the key of the far line and speaks it without a gateway."""
    rows = {}
    for kind, sample in samples().items():
        before = refused(stage)
        line.envelope({"is": "message", "n": 7}, json.dumps(fresh(sample)).encode())
        line.call("GET", "/api/map.png")  # behind it
        seen = "1008" if refused(stage) > before else "yes"
        expected = "yes" if policy.MESSAGES.get(kind) and policy.of_message(kind, "key holder") else "1008"
        rows[f"`{kind}`"] = {"the holder of the line's key": (expected, seen)}
    return rows


def refused(stage):
    text = Browser(stage.port).call("GET", "/metrics").body.decode()
    return int(float(next(line.split()[-1] for line in text.splitlines() if line.startswith("docent_web_messages_refused_total"))))


def opens(browser, target):
    try:
        socket = browser.open(target)
    except OSError:
        return "closed"
    status = socket.status
    socket.close()
    return "yes" if status == 101 else str(status) if status else "closed"


def door_rows(stage, gone):
    """{door: {caller: (expected, seen)}}. `gone`: browsers whose login is over."""
    operator, key = log_in(stage.port, "ada"), stage.screen_key()
    forwarded = {"X-Forwarded-For": "192.0.2.7"}
    callers = [("nobody", Browser(stage.port), {"viewer", "program of this computer"}), ("a visitor", visit(stage.port, "Eve at a door"), {"viewer", "program of this computer"}),
               ("a moderator", log_in(stage.port, "grace"), {"viewer", "program of this computer"}), ("an operator", operator, {"viewer", "operator", "program of this computer"}),
               ("whoever has the screen's key", Browser(stage.port), {"viewer", "screen", "program of this computer"}),
               ("an operator, handed on by a proxy", operator.like(lies=forwarded), {"viewer", "operator"}),
               ("an operator's page of another site", operator.like(lies={"Origin": "https://museum.example"}), set()),
               ("an operator who calls the robot `museum.example`", operator.like(lies={"Host": "museum.example", "Origin": "http://museum.example"}), "421"),
               ("an operator, far away", operator.like(port=stage.far_port), {"far viewer"})]
    callers += [(name, browser, {"viewer", "program of this computer"}) for name, browser in gone]
    rows = {}
    for door, allowed in policy.DOORS.items():
        cells = rows.setdefault(f"`{door}`", {})
        for name, browser, is_one_of in callers:
            target = door.replace("KEY", key if "screen's key" in name else "5e6f" * 8)
            port = stage.uplink_port if door == "/uplink" else browser.port
            expected = "421" if is_one_of == "421" else "yes" if allowed & is_one_of else "no"
            if door == "/uplink":
                expected = "no"
            seen = opens(browser.like(port=port), target)
            cells[name] = (expected, seen if seen in ("yes", "421") else "no")
    return rows


def lines_that_end(stage):
    """An operator's open line, when their right to it ends: {what happened: (expected, seen)}. It is closed, and what is said on it is not heard."""
    cells = {}

    def leaves(name, end):
        stage.account("add", name, "--role", "operator")
        browser = log_in(stage.port, name)
        socket = browser.open("/operate")
        socket.ask({"type": "lease", "id": uuid7(), "wants": True})
        end(browser)
        begun = time.monotonic()
        is_closed = not socket.read(lambda *_: time.monotonic() > begun + ENDS_WITHIN) and socket.frames.closed == 1008
        socket.say({"type": "set_hours", "id": uuid7(), "mode": "closed"})
        socket.close()
        return "closed" if is_closed else "open"
    ends = [("logs out", lambda browser: browser.call("DELETE", "/api/v1/login")), ("gets a new password", lambda _: stage.account("passwd", "gone-2", password="another long one")),
            ("loses the account", lambda _: stage.account("remove", "gone-3")),
            ("becomes a moderator", lambda _: (stage.account("remove", "gone-4"), stage.account("add", "gone-4", "--role", "moderator"))),
            ("logs in as somebody else", lambda browser: browser.come("/login", {"name": "ada", "password": "a long way from Bonn"}))]
    for number, (name, end) in enumerate(ends, 1):
        cells[f"an operator who {name}: their open line"] = ("closed", leaves(f"gone-{number}", end))
    return cells


def operation(stage):
    """What operators are shown."""
    socket = log_in(stage.port, "ada").open("/operate")
    socket.read(lambda _, message: message.get("type") == "operation")
    socket.close()
    return socket.newest.get("operation", {})


def host_of(stage):
    return f"{HOST}:{stage.port}"
