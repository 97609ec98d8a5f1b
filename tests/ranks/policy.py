"""Who may do what on the Web: the one place where it is declared. The verbs themselves come from what the program says of itself (docs/openapi.json,
tests/web_contract/client.json, docs/web-protocol.md); one that is not here has no expectation, and the test fails."""

RANKS = ["viewer", "visitor", "moderator", "operator"]

# /api/v1: the least rank, by operationId.
CALLS = {
    "who_am_i": "viewer", "login": "viewer", "logout": "viewer", "name_oneself": "viewer", "list_threads": "viewer", "list_posts": "viewer",
    "begin_thread": "visitor", "write_post": "visitor", "report_post": "visitor",
    "moderation_queue": "moderator", "judge_post": "moderator", "send_away": "moderator", "statistics": "moderator",
    "list_accounts": "operator", "audit": "operator",
    "read_museum": "operator", "check_museum": "operator", "try_museum": "operator", "end_trial": "operator", "publish_museum": "operator",
    "keep_picture": "operator", "read_recordings": "operator",
    "read_setup": "operator", "name_museum": "operator", "order_exploration": "operator", "keep_map": "operator", "map_again": "operator",
    "go_to_step": "operator",
    "read_robot": "operator", "send_robot": "operator", "withdraw_goal": "operator", "read_office": "operator", "order_office": "operator",
}
# What writes under the caller's name: a visitor whose name an account has taken since may not.
UNDER_A_NAME = {"begin_thread", "write_post"}
# Where a rank begins, which is for nearer than a gateway far away.
NEAR = {"login"}

# Messages on a WebSocket: who may say them.
ALL, SCREEN, STAFF = {"viewer", "screen", "far viewer"}, {"screen"}, {"operator"}
MESSAGES = {
    "request": ALL | STAFF, "cancel": ALL | STAFF, "choice": ALL | STAFF, "vote": ALL | STAFF, "watch": ALL | STAFF,
    "lamps": SCREEN, "help": SCREEN, "skip": SCREEN, "answer": SCREEN,
    "lease": STAFF, "steer": STAFF, "stop": STAFF | {"screen with a stop button"}, "set_hours": STAFF,
}
# What a screen may say, one with a stop button may, too.
SAME_AS = {"screen with a stop button": "screen", "key holder": "far viewer"}

# What can be fetched, by everybody; `far`: also from a gateway far away.
DOCUMENTS = {
    "/": "far", "/operate": "far", "/setup": "far", "/kiosk": "far", "/face": "far", "/api/pictures/EXHIBIT.png": "far", "/api/museum.json": "far",
    "/api/map.png": "far", "/api/growing.png": "near", "/camera/robot.jpg": "far", "/camera/scene.jpg": "far", "/api/health": "near",
    "/audio/HASH.wav": "near", "/metrics": "far",
}

# Doors that open a line, and the names of those who may.
DOORS = {
    "/live": {"viewer", "far viewer"},
    "/live?thin": {"viewer", "far viewer"},
    "/live?screen=KEY": {"screen"},
    "/operate": {"operator"},
    "/foxglove": {"program of this computer"},
    "/uplink": {"key holder"},
}


def is_allowed(rank, least):
    return RANKS.index(rank) >= RANKS.index(least)


def of_call(name, is_change, caller):
    """What /api/v1 says to a caller: "yes", or the word of its refusal. `caller`: rank; refused (whatever they ask); has_csrf; is_far; is_sent_away;
    has_lost_name."""
    if caller.refused:
        return caller.refused
    if caller.is_far and (name in NEAR or not is_allowed("visitor", CALLS[name])):
        return "not_allowed"
    if not is_allowed(caller.rank, CALLS[name]):
        return "not_allowed"
    if caller.is_sent_away and name == "name_oneself":
        return "sent_away"
    if is_change and not caller.has_csrf:
        return "wrong_csrf"
    if caller.has_lost_name and name in UNDER_A_NAME:
        return "name_taken"
    return "yes"


def of_message(kind, speaker):
    """Whether whoever has that line may say it."""
    allowed = MESSAGES[kind]
    return speaker in allowed or SAME_AS.get(speaker) in allowed
