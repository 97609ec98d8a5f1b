"""A day of requests in each museum ([Rhino1999] 4.3 and Table 6): people in the hall press the screen's buttons, Web visitors send
requests so that about a hundred are pending, the battery runs down, and modules die. What became of each request is taken from the
run's record: what was asked, what the board said, what was heard, and where the robot truly stood."""
import collections
import csv
import math
import os
import random
import statistics
import subprocess

from evaluation import ways
from evaluation.keys import key_of
from evaluation.reports import contacts_of
from evaluation.simulations import ONLY_SCENARIO
from evaluation.tables import Verdict, print_table
from evaluation.tours import LEAST_EXHIBITS

MUSEUMS = ["bonn", "smithsonian"]
ITEMS = 49  # exhibits and viewpoints that may be asked for; a museum with fewer gets more viewpoints
HOURS, LAST_HOURS = 20.0, 2.0  # in the last ones nobody asks any more, so that every request may end
SLICE_HOURS, SLICE_LAST = 1.1, 0.5
CRIPPLED_HOURS, CRIPPLED_LAST = 3.0, 1.5
SLICE_CRIPPLED_HOURS, SLICE_CRIPPLED_LAST = 0.9, 0.4  # beyond the first kill
RUSH, RUSH_EVERY, RUSH_FOR = 100, 2.0, 180.0  # Web visitors who ask within so many seconds [h, s]
SLICE_RUSH = 30
PENDING = 90  # at once, at least: the rush is served while it comes
HALL, HALL_TOURS, WEB = 10.0, 2.0, 15.0  # requests an hour: exhibits and tours in the hall, between the rushes from the Web
KILLED = ["mission", "executive", "sound", "plan"]  # in turn,
KILL_EVERY = 1.3  # [h]
FIRST_KILL = 0.4  # [h]: during the first rush
# How far from the place asked for the robot may stand, where no other place of the exhibit is nearer, and turned how far.
NEAR, TURNED = 0.7, 30.0  # [m, deg]
SERVED, AIM = 0.9975, 0.9995  # [Rhino1999] Table 6
REFUSED = 0.01
MAY_REFUSE = ("closed", "web_only_now")  # words of ReasonWord
TRAVEL = 1.05
MOST_VISITS = 15
FINAL = {"fulfilled", "failed", "refused", "cancelled"}
CRIPPLED = {"forgets requests when it starts": ["--set", "evaluation.forgets_requests=true"],
            "serves in the order of arrival": ["--set", "evaluation.serves_by_arrival=true"]}


def with_items(museum, folder):
    """The museum, or a copy of it whose exhibits may be seen from enough viewpoints: at the same distance from what they show,
    to the left and to the right of the exhibit's own place, where the robot can stand and drive to."""
    known = ways.Museum(museum)
    if len([item for item in known.items() if not known.exhibits[item[0]].web_only]) >= ITEMS:
        return museum
    copy = folder / f"{museum.name}-{key_of(museum)[:16]}-{ITEMS}"
    if not copy.exists():
        part = copy.with_suffix(f".part{os.getpid()}")
        subprocess.run(["cp", "-r", museum, part], check=True)
        found = viewpoints_of(known)
        lines = []
        for line in (museum / "museum.yaml").read_text(encoding="utf-8").splitlines():
            lines.append(line)
            if line.startswith("  - id:"):
                name = line.split(":")[1].strip()
            if line.startswith("    look_at:") and found.get(name):
                lines.append("    viewpoints:")
                lines += [f"      - {{x: {x:.2f}, y: {y:.2f}, heading: {heading:.0f}}}" for x, y, heading in found[name]]
        (part / "museum.yaml").write_text("\n".join(lines) + "\n", encoding="utf-8")
        part.rename(copy)
    return copy


def viewpoints_of(museum):
    """By exhibit: so many as bring the museum to ITEMS, of one exhibit after the other."""
    floor = ways.Floor(museum)
    from_home = floor.lengths_from(*museum.home[:2])
    found = collections.defaultdict(list)
    missing = ITEMS - len(museum.items())
    for turn in (35.0, -35.0, 70.0, -70.0):
        for exhibit in museum.exhibits.values():
            if missing == 0 or exhibit.viewpoints:
                continue
            at_x, at_y = exhibit.look_at[:2]
            away, bearing = math.hypot(exhibit.pose[0] - at_x, exhibit.pose[1] - at_y), \
                math.atan2(exhibit.pose[1] - at_y, exhibit.pose[0] - at_x) + math.radians(turn)
            x, y = at_x + away * math.cos(bearing), at_y + away * math.sin(bearing)
            around = [(x + 0.35 * math.cos(k), y + 0.35 * math.sin(k)) for k in range(7)]
            cells = [floor.cell_of(*point) for point in [(x, y), *around]]
            stands = all(math.hypot(floor.x0 + column * floor.cell - a, floor.y0 + row * floor.cell - b) < floor.cell
                         for (row, column), (a, b) in zip(cells, [(x, y), *around]))
            if not stands or not math.isfinite(from_home[cells[0]]) or 2 * away * math.sin(math.radians(17.5)) < 0.7:
                continue
            found[exhibit.name].append((x, y, math.degrees(math.atan2(at_y - y, at_x - x))))
            missing -= 1
    if missing > 0:
        raise RuntimeError(f"{museum.folder.name}: {missing} viewpoints too few")
    return found


def events_of(museum, seed, hours, last, rush):
    """What is asked for, and which modules die: (seconds, event of a scenario)."""
    draw = random.Random(f"{museum.folder.name}/{seed}/{hours}")
    end = (hours - last) * 3600
    languages = ["en", "de"]
    events = []

    def ask(at, kind, target, source, viewpoint=-1):
        events.append((at, f"request: {{kind: {kind}, target: {target}, viewpoint: {viewpoint}, source: {source}, "
                           f"language: {draw.choice(languages)}}}"))

    def every(per_hour, do):
        at = draw.expovariate(per_hour / 3600)
        while at < end:
            do(at)
            at += draw.expovariate(per_hour / 3600)

    hall = [name for name, exhibit in museum.exhibits.items() if not exhibit.web_only]
    every(HALL, lambda at: ask(at, "exhibit", draw.choice(hall), "kiosk"))
    every(HALL_TOURS, lambda at: ask(at, "tour", draw.choice(list(museum.tours)), "kiosk"))

    def from_web(at):
        name, viewpoint = draw.choice(museum.items())
        ask(at, "exhibit", name, "web", viewpoint)

    every(WEB, from_web)
    rush_at = 0.3 * 3600
    while rush_at < end:
        for _ in range(rush):
            from_web(rush_at + draw.uniform(0.0, RUSH_FOR))
        rush_at += RUSH_EVERY * 3600
    kill_at, i = FIRST_KILL * 3600, 0
    while kill_at < end:
        events.append((kill_at + draw.uniform(0.0, 60.0), f"kill: {{module: {KILLED[i % len(KILLED)]}}}"))
        kill_at, i = kill_at + KILL_EVERY * 3600, i + 1
    return sorted(events)


def run(simulations, museum, seed, events, hours, arguments):
    """The record of a run and its report; from the cache when it was made before."""
    scenario = "events:\n" + "".join(f"  - {{at: {at:.1f}, {event}}}\n" for at, event in events)
    kept, report = simulations.run_logged("day", museum, seed, hours, ONLY_SCENARIO + arguments,
                                          {"--request-log": "requests.csv", "--event-log": "events.csv"}, scenario)
    return Record(read_rows(kept["requests.csv"]), read_rows(kept["events.csv"])), report


def read_rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Request:
    def __init__(self, row):
        self.id, self.source, self.kind, self.target = row["id"], row["source"], row["kind"], row["target"]
        self.viewpoint, self.asked = int(row["viewpoint"]), float(row["time"])
        self.steps = []  # (time, state, reason) as the board said

    def state_at(self, at):
        """Before whatever the board said at that very moment."""
        return next((state for when, state, _ in reversed(self.steps) if when < at), "")

    def began_before(self, at):
        """When it became active last, before then."""
        return next((when for when, state, _ in reversed(self.steps) if state == "active" and when < at), math.inf)

    def began(self, state):
        return next((when for when, is_now, _ in reversed(self.steps) if is_now == state), None)

    @property
    def end(self):
        return self.steps[-1][1] if self.steps and self.steps[-1][1] in FINAL else ""

    def was_tried(self, at):
        """A visit for it came to nothing: it waits for a while."""
        states = [state for when, state, _ in self.steps if when < at]
        return states[-1:] == ["queued"] and "active" in states

    def is_open_at(self, at):
        return self.state_at(at) in ("queued", "active")


class Record:
    """The rows of a request log in their order, and the modules that an event log says were killed."""

    def __init__(self, rows, events=()):
        self.requests, self.heard, self.chosen = {}, [], []
        self.killed = [row["subject"] for row in events if (row["source"], row["kind"]) == ("scenario", "kill")]
        for row in rows:
            at = float(row["time"])
            if row["what"] == "asked":
                self.requests[row["id"]] = Request(row)
            elif row["what"] == "board" and row["id"] in self.requests:
                self.requests[row["id"]].steps.append((at, row["state"], row["detail"]))
            elif row["what"] == "heard":
                self.heard.append({**row, "time": at, "pose": tuple(float(row[key]) for key in ("x", "y", "heading"))})
            elif row["what"] == "chosen":
                stops = [name.split("/") for name in row["detail"].split()]
                self.chosen.append((at, (float(row["x"]), float(row["y"])),
                                    [(stop[0], int(stop[1]) if len(stop) > 1 else -1) for stop in stops]))

    def explanations(self):
        return [row for row in self.heard if row["state"] == "short"]


def far(pose, place):
    return math.hypot(pose[0] - place[0], pose[1] - place[1])


def is_at(pose, places, viewpoint):
    """Whether the robot stands at this place of an exhibit, and at no other."""
    turned = (pose[2] - places[viewpoint][2] + 180.0) % 360.0 - 180.0
    return far(pose, places[viewpoint]) <= NEAR and abs(turned) <= TURNED and \
        all(far(pose, other) >= far(pose, places[viewpoint]) for key, other in places.items() if key >= 0)


def is_at_any(pose, places):
    return any(is_at(pose, places, viewpoint) for viewpoint in places)


def heard_by(record, request):
    """Explanations that a fulfilled request had a part in: of its exhibit, or of its tour, since it became active."""
    begin, end = request.began("active"), request.began("fulfilled")
    if begin is None or end is None:
        return []
    key = "target" if request.kind == "exhibit" else "detail"
    return [row for row in record.explanations() if row[key] == request.target and begin <= row["time"] <= end]


def is_shown(record, museum, request):
    """People heard what the request asked for while the robot truly stood where it asked for."""
    heard = heard_by(record, request)
    if request.kind == "tour":
        stops, told = museum.tours[request.target], {row["target"] for row in heard}
        is_whole = len(set(stops) - told) <= 1 if stops else len(told) >= LEAST_EXHIBITS  # one that is composed names none
        return bool(heard) and is_whole and \
            all(is_at_any(row["pose"], museum.exhibits[row["target"]].places()) for row in heard)
    places = museum.exhibits[request.target].places()
    return any(is_at_any(row["pose"], places) if request.viewpoint < 0 else is_at(row["pose"], places, request.viewpoint)
               for row in heard)


def done_twice(record):
    """Explanations that were begun twice, or for nobody: each request for them was fulfilled before."""
    seen, twice = set(), []
    shown = collections.defaultdict(list)  # (tour, exhibit): times
    for row in record.explanations():
        at, exhibit, tour = row["time"], row["target"], row["detail"]
        singles = any(r.kind == "exhibit" and r.target == exhibit and r.is_open_at(at) for r in record.requests.values())
        of_tour = any(r.kind == "tour" and r.target == tour and r.state_at(at) == "active"
                      and not any(r.began_before(at) <= when for when in shown[tour, exhibit]) for r in record.requests.values())
        if row["id"] in seen or not (singles or of_tour):
            twice.append(row)
        seen.add(row["id"])
        shown[tour, exhibit].append(at)
    return twice


def most_pending(record):
    changes = []
    for request in record.requests.values():
        if not request.steps or request.end == "refused":
            continue
        changes.append((request.steps[0][0], 1))
        if request.end:
            changes.append((request.steps[-1][0], -1))
    pending = most = 0
    for _, change in sorted(changes):
        pending += change
        most = max(most, pending)
    return most


def decisions_of(record, museum, lengths):
    """Of each order of single visits: its length and the shortest one's [m], or why it cannot be compared."""
    compared, longer, wrong = [], 0, []
    for at, start, order in record.chosen:
        waiting = [r for r in record.requests.values() if r.kind == "exhibit" and r.state_at(at) == "queued"]
        due = [r for r in waiting if not r.was_tried(at)]
        # What the board told at that very moment may have come just before the choice, or just after.
        just_now = [r for r in record.requests.values() if r.kind == "exhibit" and any(when == at and state in ("queued", "active")
                                                                                              for when, state, _ in r.steps)]
        asked = {(r.target, r.viewpoint) for r in waiting + just_now}
        left_out = [r for r in due if not any(name == r.target and (r.viewpoint in (-1, viewpoint)) for name, viewpoint in order)]
        unasked = [stop for stop in order if stop not in asked and (stop[0], -1) not in asked]
        if left_out or unasked:
            wrong.append((at, left_out, unasked))
        if len(order) < 2:
            continue
        if len(order) > MOST_VISITS:
            longer += 1
            continue
        stops = [[(name, viewpoint)] if viewpoint >= 0 and (name, viewpoint) in asked
                 else [(name, v) for v in museum.exhibits[name].places()] for name, viewpoint in order]
        compared.append((lengths.of_route(start, order), lengths.optimum(start, stops), len(order)))
    return compared, longer, wrong


def waits(record, source):
    return sorted(r.steps[-1][0] - r.asked for r in record.requests.values() if r.end == "fulfilled" and r.source == source)


HEADER = ["museum", "robot", "h", "km", "charges", "killed", "asked", "refused", "served", "failed", "lost", "pending", "explained", "contacts",
          "wait hall min", "wait Web min", "longest"]


def row_of(name, robot, hours, record, report):
    ends = collections.Counter(r.end for r in record.requests.values())
    hall, web = waits(record, "kiosk"), waits(record, "web")
    return [name, robot, f"{hours:g}", f"{report['distance_m'] / 1000:.1f}", report["battery"]["charges"], len(record.killed),
            len(record.requests), ends["refused"],
            ends["fulfilled"], ends["failed"] + ends["cancelled"], ends[""], most_pending(record), len(record.explanations()),
            contacts_of(report), *[f"{statistics.median(some) / 60:.0f}" if some else "-" for some in (hall, web)],
            f"{max(hall + web, default=0.0) / 60:.0f}"]


def judge(verdict, name, museum, record, report, is_slice):
    """Nothing lost, nothing twice, nothing at the wrong place; refusals and requests served."""
    requests = list(record.requests.values())
    ends = collections.Counter(r.end for r in requests)
    twice_ended = [r for r in requests if sum(state in FINAL for _, state, _ in r.steps) > 1]
    verdict.want(f"{name}: requests without exactly one end", f"{ends[''] + len(twice_ended)} of {len(requests)}",
                 bool(requests) and ends[""] == 0 and not twice_ended)
    twice = done_twice(record)
    verdict.want(f"{name}: explanations done twice or for nobody", f"{len(twice)} of {len(record.explanations())}",
                 bool(record.explanations()) and not twice)
    served = [r for r in requests if r.end == "fulfilled"]
    wrong = [r for r in served if not is_shown(record, museum, r)]
    of_viewpoint = sum(r.viewpoint >= 0 for r in served)
    verdict.want(f"{name}: called served, but not heard where it was asked for", f"{len(wrong)} of {len(served)}, {of_viewpoint} of "
                 "which asked for a viewpoint", bool(served) and not wrong)
    for request in wrong[:5]:
        verdict.note(f"{name}: wrong", f"{request.id} {request.kind} {request.target}/{request.viewpoint}: "
                     f"{[(row['time'], row['target'], row['pose']) for row in heard_by(record, request)]}")
    reasons = collections.Counter(r.steps[-1][2] for r in requests if r.end == "refused")
    bad = {reason: count for reason, count in reasons.items() if reason.split(" ")[0] not in MAY_REFUSE}
    verdict.want(f"{name}: refused, at most {100 * REFUSED:g} %, only when closed or at night",
                 f"{ends['refused']} of {len(requests)} {dict(reasons) or ''}", ends["refused"] <= REFUSED * len(requests) and not bad)
    accepted = len(requests) - ends["refused"]
    right = len(served) - len(wrong)
    verdict.want(f"{name}: accepted requests served, at least {100 * SERVED:g} % (aim {100 * AIM:g} %)",
                 f"{right} of {accepted}, {100 * right / max(1, accepted):.2f} %", accepted > 0 and right >= SERVED * accepted)
    for reason, count in collections.Counter(r.steps[-1][2] for r in requests if r.end in ("failed", "cancelled")).items():
        verdict.note(f"{name}: failed", f"{count}: {reason}")
    verdict.note(f"{name}: contacts (the protocol safety judges them)", f"{contacts_of(report)} in {report['distance_m'] / 1000:.2f} km, "
                 f"{report['passes_within_1m']} passes within 1 m")
    items = {(r.target, r.viewpoint) for r in requests if r.kind == "exhibit"}
    if is_slice:
        return
    verdict.want(f"{name}: items asked for, at least {ITEMS}", len(items), len(items) >= ITEMS)
    verdict.want(f"{name}: most pending at once, at least {PENDING}", most_pending(record), most_pending(record) >= PENDING)
    charges = report["battery"]["charges"]
    verdict.want(f"{name}: charges, at least 4, and the battery never empty", f"{charges}, {report['battery']['depleted']} times empty",
                 charges >= 4 and report["battery"]["depleted"] == 0)


def judge_kills(verdict, name, events, record):
    """Every module died that was to die, in this order."""
    planned = [event.split("module: ")[1].rstrip("}") for _, event in events if event.startswith("kill:")]
    verdict.want(f"{name}: modules killed, as planned", f"{', '.join(record.killed) or 'none'}; planned {len(planned)}",
                 bool(planned) and record.killed == planned)


def judge_travel(verdict, name, record, museum, lengths):
    compared, longer, wrong = decisions_of(record, museum, lengths)
    verdict.want(f"{name}: orders that left out or invented a visit", f"{len(wrong)} of {len(record.chosen)}", not wrong)
    for at, left_out, unasked in wrong[:5]:
        verdict.note(f"{name}: order at {at:.0f} s", f"left out {[(r.target, r.viewpoint) for r in left_out]}, invented {unasked}")
    seen, good = travel(compared)
    verdict.want(f"{name}: planned travel, at most {100 * TRAVEL - 100:.0f} % above the optimum", f"{seen}; {longer} with more visits than "
                 f"{MOST_VISITS} are not compared", good)


def travel(compared):
    """What was seen, and whether it is good."""
    planned, least = (sum(row[i] for row in compared) for i in (0, 1))
    above = sum(row[0] > TRAVEL * row[1] for row in compared)
    seen = (f"{100 * (planned / least - 1):.2f} % ({planned / 1000:.2f} of {least / 1000:.2f} km) in {len(compared)} decisions between 2 "
            f"to {max(row[2] for row in compared)} visits, {above} of them more than 5 % above") if compared else "no decision"
    return seen, bool(compared) and planned <= TRAVEL * least


def must_fail(verdict, how, name, record, museum, lengths):
    """A crippled robot fails where it is crippled."""
    lost = sum(not r.end for r in record.requests.values())
    compared, _, _ = decisions_of(record, museum, lengths)
    seen, is_short = travel(compared)
    if how == "forgets requests when it starts":
        verdict.want(f"{name}, crippled: {how} (must lose some)", f"{lost} of {len(record.requests)} lost", lost > 0)
    else:
        verdict.want(f"{name}, crippled: {how} (must travel too far)", seen, bool(compared) and not is_short)


def protocol(simulations, options):
    is_slice = options.slice
    folder = simulations.cache / "day"
    folder.mkdir(parents=True, exist_ok=True)
    seeds = [options.first_seed + i for i in range(options.seeds or 1)]
    hours, last = (SLICE_HOURS, SLICE_LAST) if is_slice else (HOURS, LAST_HOURS)
    names = options.museums.split(",") if options.museums else MUSEUMS[:1] if is_slice else MUSEUMS
    museums = {name: with_items(simulations.museums / name, folder) for name in names}
    known = {name: ways.Museum(path) for name, path in museums.items()}
    crippled = {} if options.no_crippled else dict(list(CRIPPLED.items())[: 1 if is_slice else None])
    jobs = [(name, "whole", seed, hours, last, SLICE_RUSH if is_slice else RUSH, []) for name in names for seed in seeds]
    if crippled:
        short = (SLICE_CRIPPLED_HOURS, SLICE_CRIPPLED_LAST, SLICE_RUSH) if is_slice else (CRIPPLED_HOURS, CRIPPLED_LAST, RUSH)
        jobs += [(names[0], how, seeds[0], *short, arguments) for how, arguments in crippled.items()]
    asked = [events_of(known[name], seed, hours, last, rush) for name, _, seed, hours, last, rush, _ in jobs]
    made = simulations.each(run, [(simulations, museums[name], seed, events, hours, arguments)
                                  for (name, _, seed, hours, _, _, arguments), events in zip(jobs, asked)])
    print(f"\n## A day of requests, busy, with charging, dying modules and rushes of {SLICE_RUSH if is_slice else RUSH} from the Web\n")
    print_table(HEADER, [row_of(name, how, hours, *seen) for (name, how, _, hours, *_), seen in zip(jobs, made)])
    print("\nwait: median, from the wish to the end; lost: without an end; explained: short texts that were heard.\n")
    lengths = {name: ways.Lengths(known[name], folder / f"ways-{name}-{key_of(museums[name])[:16]}.npy") for name in names}
    verdict = Verdict()
    for (name, how, *_), events, (record, report) in zip(jobs, asked, made):
        judge_kills(verdict, name if how == "whole" else f"{name}, crippled: {how}", events, record)
        if how == "whole":
            judge(verdict, name, known[name], record, report, is_slice)
            judge_travel(verdict, name, record, known[name], lengths[name])
        else:
            must_fail(verdict, how, name, record, known[name], lengths[name])
    verdict.want_one_configuration(report["config_hash"] for job, (_, report) in zip(jobs, made) if job[1] == "whole")
    verdict.print()
    return verdict
