"""What has no row of its own: names that look like others, things said twice, a second holder of a key. {attempt: (expected, seen)}."""
import policy
from lines import uuid7
from stage import PASSWORD, Browser, log_in, visit
from wire import KeyHolder

LOOK_ALIKES = ["ada", "ADA", "Ada", "a d a", "аda", "adа", "ada.", "a-d-a", "a\u200bda", "ａｄａ", "𝒶𝒹𝒶", "ádа".replace("á", "a"), " ada ", "a\u00adda"]


def names(stage):
    cells = {}
    seen = {Browser(stage.port).call("POST", "/api/v1/visitor", {"name": name}).json().get("reason", "taken") for name in LOOK_ALIKES}
    cells[f"a visitor takes a name that looks like `ada` ({len(LOOK_ALIKES)} ways)"] = ("name_taken", ", ".join(sorted(seen)))
    others = [name for name in LOOK_ALIKES if name != "ada"]
    seen = {Browser(stage.port).call("POST", "/api/v1/login", {"name": name, "password": PASSWORD}).json().get("reason", "logged in") for name in others}
    cells[f"a login with the password of `ada` and a name that looks like it ({len(others)} ways)"] = ("wrong_password", ", ".join(sorted(seen)))
    wrong = Browser(stage.port).call("POST", "/api/v1/login", {"name": "ada", "password": "a short way from Bonn"})
    nobody = Browser(stage.port).call("POST", "/api/v1/login", {"name": "nobody-at-all", "password": PASSWORD})
    is_same = (wrong.status, wrong.body) == (nobody.status, nobody.body)
    cells["a wrong password tells whether there is such an account"] = ("no", "no" if is_same else "yes")
    return cells


def cookies(stage):
    chosen = "5e6f" * 16
    browser = Browser(stage.port, f"docent_login={chosen}").come("/login", {"name": "ada", "password": PASSWORD})
    cells = {"a cookie that somebody else chose is good after the login": ("no", "yes" if browser.cookie.endswith(chosen) else "no")}
    old = log_in(stage.port, "ada")
    renewed = old.like()
    renewed.come("/login", {"name": "ada", "password": PASSWORD})
    cells["an operator's cookie from before their next login with it"] = ("viewer", old.call("GET", "/api/v1/login").json().get("rank"))
    forged = Browser(stage.port, lies={"X-Forwarded-For": "192.0.2.7", "Forwarded": "for=192.0.2.7"})
    forged.come("/login", {"name": "ada", "password": PASSWORD})
    newest = forged.call("GET", "/api/v1/audit").json()["lines"][0]
    cells["an address that somebody says who is no proxy of ours, in the audit log"] = ("127.0.0.1", newest["address"])
    return cells


def stops(stage):
    first, second = log_in(stage.port, "ada").open("/operate"), log_in(stage.port, "ada").open("/operate")
    first.read(lambda _, message: message.get("type") == "operation")
    first.say({"type": "stop", "id": uuid7(), "stopped": True})
    first.read(lambda _, message: message.get("type") == "operation" and message["stopped"])
    number = first.newest["operation"]["stop_number"]
    second.say({"type": "stop", "id": uuid7(), "stopped": True})
    first.read(lambda _, message: message.get("type") == "operation" and message["stop_number"] > number)
    answer = first.ask({"type": "stop", "id": uuid7(), "stopped": False, "number": number})
    cells = {"a release of an earlier stop": ("another_stop", word_of(answer))}
    release = {"type": "stop", "id": uuid7(), "stopped": False, "number": first.newest["operation"]["stop_number"]}
    first.ask(release)  # nobody else keeps it here: it goes unconfirmed
    second.ask({"type": "stop", "id": uuid7(), "stopped": True})
    cells["that release said again after the next stop"] = ("another_stop", word_of(first.ask({**release, "id": uuid7()})))
    second.ask({"type": "lease", "id": uuid7(), "wants": True})
    first.say({"type": "steer", "pressed": True, "forward": 1.0, "turn": 0.0})
    first.read(lambda _, message: message.get("type") == "error")
    cells["steering while somebody else holds the lease"] = ("no_lease", first.newest.get("error", {}).get("reason", {}).get("word"))
    first.close(), second.close()
    return cells


def word_of(answer):
    return "closed" if answer is None else "yes" if answer["type"] == "ack" else answer["reason"]["word"]


def second_holder(stage):
    said = stage.one_more_far(stage.key)
    cells = {"a second gateway far away with the key": ("sent away", "sent away" if "another gateway holds the line" in said else said[-200:])}
    said = stage.one_more_far("0" * 32)
    cells["a gateway far away with another key"] = ("sent away", "sent away" if "another key" in said else said[-200:])
    line = KeyHolder(stage.uplink_port, stage.key)
    cells["a second holder of the key who speaks the line themselves"] = ("sent away", "in" if line.is_in else "sent away")
    line.close()
    return cells


def key_holder(line, operator):
    """What only the line itself can say. `line`: the one holder of the key."""
    token = operator.cookie.partition("=")[2]
    cells = {}
    for target in ("/operate", "/live?screen=", "/foxglove", "/etc/passwd", "/../../etc/passwd", "/audio/../web.sqlite", "/api/v1", "/api/v1x/audit", "//api/v1/audit"):
        status = line.call("GET", target, token, operator.csrf).status
        is_page = target == "/operate"  # the page itself, which everybody may read
        cells[f"`{target}` by the line"] = ("200" if is_page else "404", str(status))
    line.envelope({"is": "message", "n": 1 << 41}, b'{"type":"cancel","id":"018f3a6c-5b2e-7c3d-9a4b-0123456789ab","request":"018f3a6c-5b2e-7c3d-9a4b-ba9876543210"}')
    line.call("GET", "/api/map.png")
    answer = line.call("GET", "/api/v1/audit", token, operator.csrf, address="127.0.0.1", far=False, local=True, role="staff")
    cells["a call by the line that says it is not far"] = ("not_allowed", answer.json().get("reason", str(answer.status)))
    return cells


def documents(stage):
    """Everything that can be fetched: by anybody, and by nobody who calls the robot by another name. Rows of (expected, seen)."""
    exhibits = Browser(stage.port).call("GET", "/api/museum.json").json()["exhibits"]
    picture = next(one["picture"] for one in exhibits if one.get("picture"))
    (stage.state / "audio").mkdir(exist_ok=True)
    (stage.state / "audio" / "00ff.wav").write_bytes(b"RIFF")
    rows = {}
    for path, reach in policy.DOCUMENTS.items():
        target = picture if "EXHIBIT" in path else path.replace("HASH", "00ff")
        near, far = Browser(stage.port), Browser(stage.far_port)
        foreign = near.like(lies={"Host": "museum.example"})
        rows[f"`{path}`"] = {"anybody": ("yes", fetched(near, target)), "anybody, far away": ("yes" if reach == "far" else "404", fetched(far, target)),
                             "whoever calls the robot `museum.example`": ("421", fetched(foreign, target)),
                             "whoever would write there": ("405", ", ".join(sorted({fetched(near, target, method) for method in ("POST", "PUT", "DELETE", "PATCH")})))}
    return rows


def fetched(browser, target, method="GET"):
    status = browser.call(method, target).status
    return "yes" if status in (200, 204) else str(status)


def visitor_of(stage):
    return visit(stage.port, "Eve by the line")
