"""Everybody who may call /api/v1, and what they say of themselves that is not so."""
import time
from dataclasses import dataclass, field

from stage import Browser, log_in, visit
from wire import HOST

# Names that a stranger's page could be reached by, and that look like ours.
FOREIGN_HOSTS = ["museum.example", "localhost.museum.example", "127.0.0.1.museum.example", "xn--lcalhost-6bh.example", "localhost@museum.example",
                 "[::1].museum.example", "[::1]museum.example:80", "127.0.0.1 .museum.example", "0x7f000001", "127.1", "localhost:80@museum.example"]


@dataclass
class Caller:
    name: str
    browser: Browser
    rank: str = "viewer"
    refused: str = ""  # whatever they ask
    has_csrf: bool = True
    is_far: bool = False
    has_lost_name: bool = False
    is_sent_away: bool = False
    is_key_holder: bool = False
    after: object = field(default=None, repr=False)  # () -> None: makes them what they are, before they call


def people(stage):
    """Those with a right to their rank: what they may do is tried with each verb."""
    moderator, operator = log_in(stage.port, "grace"), log_in(stage.port, "ada")
    visitor = visit(stage.port, "Eve")
    return [Caller("nobody", Browser(stage.port)), Caller("a cookie of one's own making", Browser(stage.port, "docent_login=" + "5e6f" * 16)),
            Caller("a visitor", visitor, "visitor"), Caller("a moderator", moderator, "moderator"), Caller("an operator", operator, "operator")]


def ended(stage):
    """Cookies that were good once, replayed."""
    found = []
    for name in ("leaver", "removed", "changed", "lowered"):
        stage.account("add", name, "--role", "operator")
    for rank, name in (("operator", "leaver"), ("moderator", "grace")):
        browser = log_in(stage.port, name)
        browser.call("DELETE", "/api/v1/login")
        found.append(Caller(f"a {rank} who has logged out" if rank == "moderator" else f"an {rank} who has logged out", browser))
    removed, changed, lowered = (log_in(stage.port, name) for name in ("removed", "changed", "lowered"))
    stage.account("remove", "removed")
    stage.account("passwd", "changed", password="another long password")
    stage.account("remove", "lowered")
    stage.account("add", "lowered", "--role", "moderator")
    found += [Caller("an operator whose account is gone", removed), Caller("an operator with a new password", changed),
              Caller("an operator who is a moderator now", lowered),
              Caller("the same, logged in again", log_in(stage.port, "lowered"), "moderator")]
    stage.account("add", "ada", "--role", "operator", state="hasty")
    hasty = log_in(stage.hasty_port, "ada")
    found.append(Caller("an operator whose login is over", hasty, after=lambda: time.sleep(1.6)))
    renamed = visit(stage.port, "Mallory")
    old = renamed.like()
    renamed.come("/visitor", {"name": "Mallory the second"})
    found.append(Caller("a visitor's cookie from before another name", old))
    return found


def sent_away(stage, write):
    """A visitor whom a moderator sends away."""
    stage.account("add", "grace", "--role", "moderator", state="third")
    browser = visit(stage.third_port, "Trudy")
    post = write(browser)
    moderator = log_in(stage.third_port, "grace")
    done = moderator.call("POST", f"/api/v1/posts/{post}/send_away")
    if done.status != 200:
        raise RuntimeError(f"send_away: {done.status} {done.body}")
    return [Caller("a visitor who was sent away", browser, is_sent_away=True)]


def names(stage):
    """A name that an account has taken since."""
    browser = visit(stage.port, "newcomer")
    stage.account("add", "newcomer", "--role", "moderator")
    return [Caller("a visitor whose name an account has taken since", browser, "visitor", has_lost_name=True)]


def forged(stage, operator, moderator):
    """An operator's own cookie, sent by somebody else's page, or without what only a page of ours can read."""
    earlier = log_in(stage.port, "ada")
    found = [Caller("an operator's cookie without its token", operator.like(csrf=""), "operator", has_csrf=False),
             Caller("an operator's cookie with a moderator's token", operator.like(csrf=moderator.csrf), "operator", has_csrf=False),
             Caller("an operator's cookie with the token of an earlier login", operator.like(csrf=earlier.csrf), "operator", has_csrf=False)]
    origins = [("another site", "https://museum.example"), ("a frame without a site", "null"), ("another port", f"http://{HOST}:1"),
               ("a name that begins like ours", f"http://{HOST}:{stage.port}.museum.example"), ("a name with ours as a user", f"http://{HOST}:{stage.port}@museum.example")]
    found += [Caller(f"an operator's page of {name}", operator.like(lies={"Origin": origin}), "operator", refused="other_site") for name, origin in origins]
    for host in FOREIGN_HOSTS:
        found.append(Caller(f"an operator who calls the robot `{host}`", operator.like(lies={"Host": host}), "operator", refused="421"))
        found[-1].browser.lies["Origin"] = "http://" + host
    return found


def far(stage, operator, moderator):
    """Through the far gateway, and by its key without it. One line at a time: see the second holder."""
    visitor = visit(stage.far_port, "Far Eve")
    found = [Caller("nobody, far away", Browser(stage.far_port), is_far=True), Caller("a visitor, far away", visitor, "visitor", is_far=True)]
    # Whoever has an account counts as nobody there.
    for name, browser in (("a moderator", moderator), ("an operator", operator)):
        found.append(Caller(f"{name}, far away", browser.like(port=stage.far_port), is_far=True))
    return found


def key_holders(operator, visitor):
    """The far line spoken by somebody who has its key, and says whatever they like of the caller."""
    return [Caller("the holder of the line's key", Browser(0), is_far=True, is_key_holder=True),
            Caller("the holder of the line's key with a visitor's cookie", visitor, "visitor", is_far=True, is_key_holder=True),
            Caller("the holder of the line's key with an operator's cookie", operator, is_far=True, is_key_holder=True)]
