"""Strangers on the Web beside an operator: a robot of real processes on a slow disk, whose gateway is crowded by a thousand sockets that wish, vote, post,
guess passwords and hold bodies back, from one address and from two hundred, while its database is stopped and cut off. The operator's stop must act, they
must be let in, and the hall's screen must get every wish in. The same at a gateway far away; and a gateway that begins while there is no database."""
import os
import random
import signal
import threading
import time

from evaluation.programs import program_for
from evaluation.strangers_stage import PASSWORD, SYNC_MS, Stage, until
from evaluation.tables import Verdict, print_table
from evaluation.web_caller import Caller, Line, uuid7

PARTS = ["file", "server", "far", "gone", "crippled"]
SOCKETS, ADDRESSES = 1000, 200
SLICE_SOCKETS, SLICE_ADDRESSES = 300, 60
ACTS, ACTS_ALWAYS, ACTS_SHARE = 0.3, 1.0, 0.99  # [s]
LOGIN, ENDS, ANSWERED, BEGINS = 3.0, 3.0, 5.0, 5.0  # [s]
POSE_GAP = 1.0  # [s] between two poses of a visitor at the far gateway, at 99 %: every third comes
MINUTES, PRESSES, FAR_MINUTES = 30.0, 300, 5.0
PAUSE = 12.0  # [s] between two logins of the operator: five a minute
WISHES = 3.0  # [s] between two wishes at the hall's screen
OPERATOR, HALL, VISITOR = "127.0.1.1", "127.0.0.1", "127.0.2.{}"


def addresses_of(count):
    return [f"127.0.0.{i}" for i in range(2, 3 + count)]


def share(values, part):
    values = sorted(values)
    return values[min(len(values) - 1, int(part * len(values)))] if values else float("nan")


class Outages:
    """When the database was stopped or cut off."""

    def __init__(self):
        self.all, self.kinds = [], {}

    def begin(self, kind):
        self.kinds[kind] = self.kinds.get(kind, 0) + 1
        self.all.append([time.monotonic(), None])

    def finish(self):
        self.all[-1][1] = time.monotonic()

    def overlaps(self, since, until_when, after=2.0):
        """A gateway tries a lost database again after a second."""
        return any(begin <= until_when and (end is None or since <= end + after) for begin, end in self.all)


class Operator:
    """Logs in, holds the knob to the left, and presses the stop button again and again."""

    def __init__(self, stage, outages):
        self.stage, self.outages, self.caller = stage, outages, Caller(stage.port, OPERATOR)
        self.logins, self.presses, self.unseen, self.thrown_out, self.faults = [], [], 0, 0, []
        self.line, self.is_over = None, threading.Event()
        self.draw = random.Random(7)

    def log_in(self, caller=None):
        caller = caller or Caller(self.stage.port, OPERATOR)
        begin = time.monotonic()
        status, document, seconds = caller.call("POST", "/login", {"name": "ada", "password": PASSWORD})
        self.logins.append((begin, status, seconds, self.outages.overlaps(begin, begin + seconds), document.get("reason")))
        return status == 200

    def take_the_knob(self):
        if self.line is not None:
            self.thrown_out += 1
            self.line.close()
        self.line = Line(self.stage.port, "/operate", OPERATOR, self.caller.cookie)
        ask = uuid7()
        self.line.say({"type": "lease", "id": ask, "wants": True})
        self.line.answer_to(ask, 3.0)

    def begin(self):
        if not self.log_in(self.caller):
            raise RuntimeError(f"the operator cannot log in: {self.logins[-1]}")
        self.take_the_knob()
        self.threads = [threading.Thread(target=work, daemon=True) for work in (self.hold, self.log_in_again)]
        for thread in self.threads:
            thread.start()

    def hold(self):
        while not self.is_over.wait(0.1):
            try:
                self.line.say({"type": "steer", "pressed": True, "forward": 0.0, "turn": 0.6})
            except OSError:
                try:
                    self.take_the_knob()
                except OSError as why:
                    self.faults.append(f"not let in again: {why}")
                    time.sleep(0.5)

    def log_in_again(self):
        while not self.is_over.wait(PAUSE):
            self.log_in()

    def press(self):
        """One press, and the release. Whether the base was driven before."""
        stage, end = self.stage, time.monotonic() + 20.0
        while not stage.watch.is_driven():
            if time.monotonic() > end or self.is_over.is_set():
                self.unseen += 1
                return False
            time.sleep(0.02)
        time.sleep(self.draw.uniform(0.0, 0.3))
        ask, line = uuid7(), self.line
        try:
            pressed = line.say({"type": "stop", "id": ask, "stopped": True})
            answer = line.answer_to(ask, 3.0)
            until_when = max(time.monotonic(), pressed + 1.2)
            time.sleep(max(0.0, until_when - time.monotonic()))
            acted = stage.watch.stood_after(pressed, until_when)
            if not stage.watch.moved_at(pressed):
                self.unseen += 1  # it stood by itself
                return self.let_go(line)
            self.presses.append((acted, answer[0] - pressed if answer and answer[1]["type"] == "ack" else None, self.outages.overlaps(pressed, until_when)))
            return self.let_go(line)
        except OSError as why:
            self.faults.append(f"pressing: {why}")
            self.presses.append((None, None, False))
            time.sleep(0.5)
            return True

    def let_go(self, line):
        for _ in range(5):
            line.wait(lambda one: one.newest.get("operation", {}).get("stopped"), 3.0)
            ask = uuid7()
            line.say({"type": "stop", "id": ask, "stopped": False, "number": line.newest.get("operation", {}).get("stop_number", 0)})
            answer = line.answer_to(ask, 3.0)
            if answer and answer[1]["type"] == "ack":
                return True
        self.faults.append(f"not released: {answer}")
        return True

    def finish(self):
        self.is_over.set()
        for thread in self.threads:
            thread.join()
        self.line.close()


class Hall:
    """The robot's own screen: a wish every few seconds, taken back once it is on the board, as the Web leaves few places there."""

    def __init__(self, stage, outages, port=None, path=None, address=HALL, every=WISHES, cancels=True):
        self.stage, self.outages, self.every, self.cancels = stage, outages, every, cancels
        self.where = (port or stage.port, path or stage.screen_path(), address)
        self.exhibits = [one["id"] for one in stage.museum()["exhibits"] if not one.get("web_only")]
        self.wishes, self.refusals, self.lost_lines, self.gaps, self.last_pose = [], {}, 0, [], None
        self.is_over, self.draw = threading.Event(), random.Random(11)
        self.line = None
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def heard(self, now, message):
        if message["type"] in ("pose", "live"):
            if self.last_pose is not None:
                self.gaps.append(now - self.last_pose)
            self.last_pose = now

    def ask(self, message, patience):
        """As the page does: again every three seconds with the same id. (seconds, answer)"""
        begin, answer = time.monotonic(), None
        while time.monotonic() < begin + patience and not (answer and answer[1]["type"] == "ack"):
            try:
                if self.line is None or not self.line.is_open:
                    self.lost_lines += self.line is not None
                    self.last_pose = None
                    self.line = Line(*self.where, heard=self.heard)
                self.line.answers.pop(message["id"], None)
                self.line.say(message)
            except OSError:
                time.sleep(0.3)
                continue
            answer = self.line.answer_to(message["id"], 3.0)
            if answer and answer[1]["type"] == "refused":
                word = answer[1]["reason"]["word"]
                self.refusals[word] = self.refusals.get(word, 0) + 1
                break
        return time.monotonic() - begin, answer

    def run(self):
        while not self.is_over.is_set():
            wish, begin = uuid7(), time.monotonic()
            seconds, answer = self.ask({"type": "request", "id": wish, "kind": "exhibit", "target": self.draw.choice(self.exhibits), "viewpoint": -1,
                                        "name": "Hall", "language": "en"}, 20.0)
            is_taken = bool(answer) and answer[1]["type"] == "ack"
            is_seen = is_taken and bool(self.line.wait(lambda line: any(entry["key"] == wish[-8:] for some in ("open", "closed")
                                                                        for entry in line.newest.get("board", {}).get(some, [])), 10.0))
            self.wishes.append((is_taken, seconds, is_seen, self.outages.overlaps(begin, begin + seconds), answer[1].get("reason") if answer else None))
            if is_taken and self.cancels:
                self.ask({"type": "cancel", "id": uuid7(), "request": wish}, 20.0)
            self.is_over.wait(max(0.0, begin + self.every - time.monotonic()))

    def finish(self):
        self.is_over.set()
        self.thread.join()
        if self.line:
            self.line.close()


def trouble(stage, outages, is_over, is_slice):
    """Stops and cuts, one after the other, each some seconds long, with as much between them."""
    kinds = [("hangs", lambda: stage.postgres.hang(True), lambda: stage.postgres.hang(False)),
             ("cut", lambda: stage.cable.say("cut"), lambda: stage.cable.say("mend")),
             ("silent cable", lambda: stage.cable.say("hang"), lambda: stage.cable.say("cut") or stage.cable.say("mend")),
             ("ended", stage.postgres.stop, stage.postgres.start)]
    length, pause = (2.5, 4.0) if is_slice else (6.0, 14.0)
    while not is_over.wait(pause):
        kind, begin, end = kinds[len(outages.all) % len(kinds)]
        outages.begin(kind)
        begin()
        is_over.wait(length)
        end()
        time.sleep(0.1)
        outages.finish()


def play(stage, sockets, addresses, seconds, presses, is_slice, port=None, with_trouble=True):
    """A crowd beside an operator, the hall's screen, and what happens to the database. Returns all that was seen."""
    outages, is_over = Outages(), threading.Event()
    operator = Operator(stage, outages)
    operator.begin()
    until("the robot obeys the knob", stage.watch.is_driven, 180)
    hall = Hall(stage, outages)
    crowd = stage.crowd(port or stage.port, sockets, addresses_of(addresses))
    worker = None
    if stage.postgres and with_trouble:
        worker = threading.Thread(target=trouble, args=(stage, outages, is_over, is_slice), daemon=True)
        worker.start()
    begin = time.monotonic()
    try:
        while len(operator.presses) < presses and time.monotonic() < begin + 1.5 * seconds + 60:
            time.sleep(max(0.0, begin + seconds * len(operator.presses) / presses - time.monotonic()))
            operator.press()
    finally:
        is_over.set()
        if worker:
            worker.join()
        lasted = time.monotonic() - begin
        hall.finish()
        operator.finish()
    seen = stage.crowd_ends(crowd)
    return {"operator": operator, "hall": hall, "outages": outages, "crowd": seen, "seconds": lasted, "silence": stage.watch.silence(begin)}


def judge(verdict, name, seen, presses, sockets, must_hold=True):
    operator, hall, crowd, outages = seen["operator"], seen["hall"], seen["crowd"], seen["outages"]
    print(f"\n## {name}: {seen['seconds']:.0f} s, {crowd['open']} of {crowd['sockets']} sockets open in the median, from {crowd['addresses']} addresses\n")
    print_table(["what strangers did", "times"], [[what, number] for what, number in crowd["count"].items()])
    print(f"\noutages: {outages.kinds or 'none'}; thrown out {operator.thrown_out} times; pressed {operator.unseen} times while it stood by itself; faults: {operator.faults[:3] or 'none'}; longest without a command "
          f"{seen['silence']:.2f} s; the hall's line lost {hall.lost_lines} times, refusals {hall.refusals or 'none'}\n")
    acted = [acts if acts is not None else float("inf") for acts, _, _ in operator.presses]
    answered = [answer for _, answer, _ in operator.presses if answer is not None]
    late = sum(acts > ACTS for acts in acted)
    up = [login for login in operator.logins if not login[3]]
    down = [login for login in operator.logins if login[3]]
    bad_logins = [login for login in up if login[1] != 200 or login[2] > LOGIN]
    slow_answers = [login for login in down if login[2] > LOGIN or login[1] == 0]
    not_in = [wish for wish in hall.wishes if not wish[0] or not wish[2]]
    stops_hold = len(acted) >= presses and late <= (1.0 - ACTS_SHARE) * len(acted) and max(acted, default=float("inf")) <= ACTS_ALWAYS
    if not must_hold:
        return {"stops": stops_hold, "late": late, "worst": max(acted, default=float("inf")), "not_in": len(not_in), "wishes": len(hall.wishes), "presses": len(acted)}
    verdict.want(f"{name}: strangers are there, 90 % of {sockets} sockets", f"{crowd['open']}", crowd["open"] >= 0.9 * sockets)
    verdict.want(f"{name}: a stop acts on the base within {ACTS} s in {100 * ACTS_SHARE:.0f} %, {ACTS_ALWAYS:g} s always",
                 f"{len(acted) - late} of {len(acted)} presses, median {share(acted, 0.5):.3f} s, 99 % {share(acted, 0.99):.3f} s, worst {max(acted, default=0):.3f} s",
                 stops_hold)
    verdict.note(f"{name}: a stop is confirmed", f"{len(answered)} of {len(acted)}, median {share(answered, 0.5):.3f} s, worst {max(answered, default=0):.3f} s")
    verdict.want(f"{name}: login within {LOGIN:g} s", f"{len(up) - len(bad_logins)} of {len(up)}, worst {max((login[2] for login in up), default=0):.2f} s"
                 + (f"; not so: {[(login[1], round(login[2], 2), login[4]) for login in bad_logins[:3]]}" if bad_logins else ""), bool(up) and not bad_logins)
    if down:
        verdict.want(f"{name}: a login without a database is answered within {LOGIN:g} s",
                     f"{len(down) - len(slow_answers)} of {len(down)}, of which {sum(login[1] == 200 for login in down)} let in", not slow_answers)
    verdict.want(f"{name}: the hall's screen gets every wish in and onto the board",
                 f"{len(hall.wishes) - len(not_in)} of {len(hall.wishes)}, of which {sum(wish[3] for wish in hall.wishes)} without a database; median "
                 f"{share([wish[1] for wish in hall.wishes], 0.5):.2f} s, worst {max((wish[1] for wish in hall.wishes), default=0):.2f} s"
                 + (f"; not so: {[(wish[0], wish[2], wish[4]) for wish in not_in[:3]]}" if not_in else ""), len(hall.wishes) >= 3 and not not_in)
    return {}


def crowded(root, docent, options, verdict, store, sockets, addresses, minutes, presses):
    stage = Stage(root, docent, store)
    try:
        seen = play(stage, sockets, addresses, 60 * minutes, presses, options.slice)
        judge(verdict, {"file": "a file", "server": "PostgreSQL"}[store], seen, presses, sockets)
        if store == "server":
            if options.part in (None, "server"):
                verdict.want("PostgreSQL: it hung, was cut off, fell silent and ended", f"{seen['outages'].kinds}", len(seen["outages"].kinds) >= (3 if options.slice else 4))
            if options.part in (None, "far") or (options.slice and options.part != "server"):
                far(stage, options, verdict, sockets, addresses)
            if options.part in (None, "gone") or (options.slice and options.part != "server"):
                gone(stage, verdict)
    except RuntimeError as why:
        verdict.want("nobody waits in vain", str(why), False)
    finally:
        stage.end()


def far(stage, options, verdict, sockets, addresses):
    """The same crowd at a gateway far away; visitors there, and the operator at the museum."""
    seconds, presses, visitors = (8.0, 4, 3) if options.slice else (60 * (options.minutes or FAR_MINUTES), 40, 10)
    stage.start_far()
    people = [Hall(stage, Outages(), stage.far_port, "/live?thin", VISITOR.format(i + 1), every=5.0) for i in range(visitors)]
    pages, is_over = [], threading.Event()

    def read_pages():
        while not is_over.wait(1.0):
            for path in ("/", "/api/museum.json"):
                begin = time.monotonic()
                try:
                    status = Caller(stage.far_port, VISITOR.format(100), timeout=10.0).get(path)[0]
                except OSError:
                    status = 0
                pages.append((status, time.monotonic() - begin))
    reader = threading.Thread(target=read_pages, daemon=True)
    reader.start()
    seen = play(stage, sockets, addresses, seconds, presses, options.slice, stage.far_port, with_trouble=False)
    is_over.set()
    reader.join()
    # Once more, so that it is crowded when it is told to end.
    crowd = stage.crowd(stage.far_port, sockets, addresses_of(addresses), seed=2)
    time.sleep(4.0)
    ended = stage.far.end(signal.SIGTERM)
    stage.crowd_ends(crowd)
    for person in people:
        person.is_over.set()
    gaps = [gap for person in people for gap in person.gaps]
    answered = [wish for person in people for wish in person.wishes]
    late = [wish for wish in answered if wish[1] > ANSWERED or (not wish[0] and wish[4] is None)]
    judge(verdict, "crowded far away", seen, presses, sockets)
    verdict.want(f"far away: visitors get a pose within {POSE_GAP:g} s in 99 %", f"99 % {share(gaps, 0.99):.2f} s, worst {max(gaps, default=9):.2f} s of {len(gaps)}",
                 len(gaps) > 10 * len(people) and share(gaps, 0.99) <= POSE_GAP)
    verdict.want("far away: pages come within 2 s", f"{sum(status == 200 and took <= 2.0 for status, took in pages)} of {len(pages)}, worst {max((took for _, took in pages), default=9):.2f} s",
                 len(pages) >= 4 and all(status == 200 and took <= 2.0 for status, took in pages))
    verdict.want(f"far away: a visitor's wish is answered within {ANSWERED:g} s",
                 f"{len(answered) - len(late)} of {len(answered)}, of which {sum(wish[0] for wish in answered)} taken; refused: "
                 f"{ {word: sum(person.refusals.get(word, 0) for person in people) for person in people for word in person.refusals} or 'none'}", bool(answered) and not late)
    verdict.want(f"far away: SIGTERM ends it within {ENDS:g} s", f"{ended:.2f} s" if ended is not None else "killed", ended is not None and ended <= ENDS)


def gone(stage, verdict):
    """The gateway is killed while its database hangs; docent up starts it again."""
    operator = Caller(stage.port, OPERATOR)
    is_in = operator.call("POST", "/login", {"name": "ada", "password": PASSWORD})[0] == 200
    stage.postgres.hang(True)
    stage.cable.say("cut")
    try:
        pid = stage.web_pid()
        begin = time.monotonic()
        os.kill(pid, signal.SIGKILL)
        until("the old gateway is gone", lambda: stage.web_pid() != pid, 5, 0.01)
        until("the gateway is back", lambda: stage.web_pid() and stage.is_up(stage.port), 60)
        back = time.monotonic() - begin
        said = until("it says why", lambda: stage.health() if "PostgreSQL" in stage.health().get("reason", "") else None, 10)
        screen = Line(stage.port, stage.screen_path(), HALL)
        until("it shows the robot", lambda: screen.newest.get("operation"), 10)
        ask = uuid7()
        pressed = screen.say({"type": "stop", "id": ask, "stopped": True})
        answer = screen.answer_to(ask, 3.0)
        visitor, vote, wish = Line(stage.port, "/live", VISITOR.format(1)), uuid7(), uuid7()
        museum = stage.museum()
        target = next(one["id"] for one in museum["exhibits"] if not one.get("web_only"))
        visitor.say({"type": "vote", "id": vote, "voter": uuid7(), "tour": museum["tours"][0]["id"]})
        screen.say({"type": "request", "id": wish, "kind": "exhibit", "target": target, "viewpoint": -1, "name": "", "language": "en"})
        told, hall = visitor.answer_to(vote, 5.0), screen.answer_to(wish, 8.0)
        forum = Caller(stage.port, VISITOR.format(1)).call("GET", "/forum")
        try:
            Line(stage.port, "/operate", OPERATOR, operator.cookie).close()
            refused = "let in"
        except ConnectionError as why:
            refused = str(why).split("\r\n")[0]
    finally:
        stage.postgres.hang(False)
        stage.cable.say("mend")
    mended, reader = time.monotonic(), Caller(stage.port, VISITOR.format(2))
    until("the gateway has its database", lambda: reader.call("GET", "/forum")[0] == 200, 20, 0.3)
    well = time.monotonic() - mended
    status, _, seconds = Caller(stage.port, OPERATOR).call("POST", "/login", {"name": "ada", "password": PASSWORD})
    until("health is well again", lambda: not stage.health().get("reason"), 30, 0.5)
    verdict.note("begun without a database: health is well again", f"{time.monotonic() - mended:.1f} s after the database is there")
    verdict.want(f"begun without a database: it is there within {BEGINS:g} s", f"{back:.2f} s", back <= BEGINS)
    verdict.want("begun without a database: health says the reason", f"{' '.join(said['reason'].split())[:120]}", True)
    verdict.want("begun without a database: the stop of the hall's screen is confirmed", f"{answer and answer[0] - pressed:.3f} s" if answer else "never",
                 bool(answer) and answer[1]["type"] == "ack" and answer[0] - pressed <= 1.0)
    verdict.want("begun without a database: a visitor is told", f"{told and told[1].get('reason')}, forum {forum[0]} {forum[1].get('reason')}",
                 bool(told) and told[1]["type"] == "refused" and told[1]["reason"]["word"] == "not_stored" and forum[0] == 503 and forum[2] <= LOGIN)
    verdict.want("begun without a database: the hall's wish is taken", f"{hall and hall[1]['type']}", bool(hall) and hall[1]["type"] == "ack")
    verdict.want("begun without a database: an operator who was in is let in, or told why not", refused, is_in and ("let in" in refused or "503" in refused))
    verdict.want(f"begun without a database: it takes the database up within {BEGINS:g} s, and login works", f"{well:.1f} s, {status} after {seconds:.2f} s",
                 well <= BEGINS and status == 200 and seconds <= LOGIN)


def crippled(root, docent, options, verdict, sockets, addresses):
    """A gateway that stores on the thread that takes the stop, and one without limits by address."""
    seconds, presses = (15.0, 6) if options.slice else (60.0, 20)
    lab = program_for(docent, ["evaluation."])
    bound = ["--set", "evaluation.stores_at_once=true", *unlimited()]
    stage = Stage(root, docent, "file", crippled=(lab, bound))
    try:
        seen = play(stage, sockets, addresses, seconds, presses, options.slice)
        found = judge(verdict, "stores at once, without limits by address", seen, presses, sockets, must_hold=False)
    finally:
        stage.end()
    verdict.want(f"a gateway that stores on the bus's thread (must be late: {ACTS_ALWAYS:g} s)", f"{found['late']} of {found['presses']} late, worst {found['worst']:.2f} s",
                 not found["stops"] and found["worst"] > ACTS_ALWAYS)
    verdict.want("without limits by address (the hall's screen must lose wishes)", f"{found['not_in']} of {found['wishes']}", found["not_in"] > 0)


def unlimited():
    words = ["web.connections_of_address=100000", "web.messages_of_address=100000", "web.message_burst_of_address=100000", "web.max_open_of_address=500",
             "web.kept_places=0"]
    return [word for setting in words for word in ("--set", setting)]


def protocol(root, docent, options):
    verdict = Verdict()
    sockets, addresses = (SLICE_SOCKETS, SLICE_ADDRESSES) if options.slice else (SOCKETS, ADDRESSES)
    minutes = 22.0 / 60 if options.slice else options.minutes or MINUTES
    presses = 12 if options.slice else max(20, round(PRESSES * minutes / MINUTES)) if options.seeds is None else options.seeds
    print(f"a commit takes {SYNC_MS} ms")
    if options.part in ("far", "gone"):  # without the long part before it
        minutes, presses = 0.2, 6
    if options.part in (None, "server", "far", "gone"):
        crowded(root, docent, options, verdict, "server", sockets, addresses, minutes, presses)
    if options.part == "file" or (options.part is None and not options.slice):
        crowded(root, docent, options, verdict, "file", sockets, addresses, minutes, presses)
    if not options.no_crippled and options.part in (None, "crippled"):
        crippled(root, docent, options, verdict, sockets, addresses)
    print()
    verdict.print()
    return verdict
