"""/api/v1: every verb of docs/openapi.json by everybody."""
import json

import callers
import policy
from stage import ROOT, uuid7

METHODS = ["GET", "HEAD", "POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE"]
REFUSALS = {"not_allowed", "other_site", "wrong_csrf", "sent_away", "name_taken"}


class Verb:
    def __init__(self, method, path, described):
        self.method, self.path, self.name = method.upper(), path, described["operationId"]
        self.least = described["description"].rstrip(".").split()[-1]
        self.has_body = "requestBody" in described

    @property
    def changes(self):
        return self.method != "GET"

    @property
    def target(self):
        parts = ["none-such" if part.startswith("{") else part for part in self.path.split("/")]
        return "/api/v1" + "/".join(parts)

    def body(self):
        """Something harmless that gets as far as the rank does."""
        if self.name in policy.UNDER_A_NAME:
            return {"id": uuid7(), "title": "A title", "text": "A text"}
        if self.name == "name_oneself":
            return {"name": " "}
        return {} if self.has_body else None


def verbs():
    paths = json.loads((ROOT / "docs/openapi.json").read_text())["paths"]
    found = [Verb(method, path, described) for path, methods in paths.items() for method, described in methods.items()]
    return sorted(found, key=lambda verb: (verb.name == "logout", policy.RANKS.index(verb.least), verb.path, verb.method))


def word_of(verb, caller, answer):
    """What the answer says: "yes", the word of a refusal, or what should not be."""
    if answer.status == 421:
        return "421"
    reason = answer.json().get("reason")
    if reason in REFUSALS:
        return reason
    if answer.status not in (200, 400, 404, 409):
        return f"{answer.status} {reason}"
    if verb.name == "who_am_i" and answer.json().get("rank") != caller.rank:
        return f"yes, as {answer.json().get('rank')}"
    return "yes"


def ask(verb, caller, line):
    body = verb.body()
    if caller.is_key_holder:
        return line.call(verb.method, verb.target, caller.browser.cookie.partition("=")[2], caller.browser.csrf, b"" if body is None else json.dumps(body).encode())
    return caller.browser.call(verb.method, verb.target, body)


def everybody(stage):
    """All callers but the holder of the key, ready to call."""
    stage.account("add", "ada", "--role", "operator")
    stage.account("add", "grace", "--role", "moderator")
    found = callers.people(stage)
    moderator, operator = found[3].browser, found[4].browser
    found += callers.sent_away(stage, write)
    found += callers.ended(stage) + callers.names(stage) + callers.forged(stage, operator, moderator) + callers.far(stage, operator, moderator)
    return found


def write(browser):
    post = uuid7()
    answer = browser.call("POST", "/api/v1/forum", {"id": post, "title": "A title", "text": "A text"})
    if answer.status != 200:
        raise RuntimeError(f"POST /forum: {answer.status} {answer.body}")
    return post


def rows_of(some, line=None):
    """{verb: {caller's name: (expected, seen)}}."""
    for caller in some:
        if caller.after:
            caller.after()
    rows = {}
    for verb in verbs():
        cells = {}
        expected = {caller.name: policy.of_call(verb.name, verb.changes, caller) if verb.name in policy.CALLS else "no expectation" for caller in some}
        # Whoever logs out does it after those who may not with the same cookie.
        for caller in sorted(some, key=lambda one: verb.name == "logout" and expected[one.name] == "yes"):
            cells[caller.name] = (expected[caller.name], word_of(verb, caller, ask(verb, caller, line)))
        rows[f"`{verb.method} {verb.path}`"] = {caller.name: cells[caller.name] for caller in some}
    return rows


def faults_of_policy():
    """Where the declared policy and what the program says of itself are apart."""
    named = {verb.name: verb.least for verb in verbs()}
    faults = [f"{name} has no expectation" for name in sorted(named.keys() - policy.CALLS.keys())]
    faults += [f"{name} is expected and does not exist" for name in sorted(policy.CALLS.keys() - named.keys())]
    faults += [f"{name} is for a {least}, expected for a {policy.CALLS[name]}" for name, least in named.items() if policy.CALLS.get(name, least) != least]
    return faults


def what_is_not_there(browser):
    """Calls of methods and paths that the table has not, by an operator: (number, those that were answered)."""
    known = {}
    for verb in verbs():
        known.setdefault(verb.target, set()).add(verb.method)
    asked = [(method, target) for target, methods in known.items() for method in METHODS if method not in methods]
    asked += [("GET", target + "/") for target in known] + [(method, "/api/v1/none-such") for method in METHODS]
    wrong = [f"{method} {target}: {status}" for method, target in asked if (status := browser.call(method, target).status) not in (404, 405)]
    return len(asked), wrong
