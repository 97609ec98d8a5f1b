"""The store under kill -9 and damage: a small process stores wishes, audit lines and passwords as fast as it can and says what it has stored; it is
killed, its files are spoiled, cut, removed, the disk is full, while it runs and while it is down. Whatever it had said and whose bytes are still on the
disk (or in a file that it has open) must be there when the store is opened again; the account must be usable; the store must say what happened.
A store that begins anew, as it did before, is the crippled one."""
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from evaluation.tables import Verdict, print_table

PARTS = ["kills", "damages"]
KILLS = 200
DAMAGES = 60
ROW = 260  # [bytes] a row and what says how to read it: a spoiled byte that is nearer may have spoiled the row
NOTICED = 60.0  # [s]
TOKEN = re.compile(rb"(?:wish|line)<[^<>]{1,60}>")
KINDS = ["flipped bytes", "flipped bytes, down", "flipped WAL, down", "page of zeros, down", "first page, down", "cut file", "cut file, down", "cut WAL, down",
         "emptied", "emptied, down", "no WAL", "no WAL, down", "no file, down", "folder removed", "disk full"]


class Writer:
    """A process that stores."""

    def __init__(self, program, file, name, most_bytes=None):
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (most_bytes, most_bytes))
        self.log = tempfile.TemporaryFile()  # beside the store, whose folder may go
        self.process = subprocess.Popen([program, file, "write", name], stdout=self.log, stderr=subprocess.STDOUT,
                                        preexec_fn=limit if most_bytes else None)

    def lines(self):
        return [line.decode(errors="replace") for line in os.pread(self.log.fileno(), 1 << 28, 0).split(b"\n")[:-1]]

    def wait_for(self, wanted, seconds):
        """Until `wanted` of the lines is so. Whether it came to it."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if wanted(self.lines()):
                return True
            if self.process.poll() is not None:
                return wanted(self.lines())
            time.sleep(0.02)
        return False

    def kill(self):
        self.process.kill()
        self.process.wait()
        return self.lines()


def of(lines, word):
    return [line[len(word) + 1:] for line in lines if line.startswith(word + " ")]


def ask(program, file, *what):
    done = subprocess.run([program, file, *what], capture_output=True, text=True, timeout=120)
    lines = done.stdout.splitlines()
    for line in of(lines, "refused") + done.stderr.splitlines()[:3] + ([f"signal {-done.returncode}"] if done.returncode < 0 else []):
        print(f"  {what[0]}: {line}", flush=True)
    return lines


def may_log_in(program, file, said):
    """With the last password that was said to be stored, or with one that was being stored when the end came."""
    candidates = []
    for line in said:
        word, _, rest = line.partition(" ")
        if word in ("password", "trying"):
            candidates = candidates * (word == "trying") + [rest.partition(" ")[2]]
    return any(ask(program, file, "login", "ada", one) == ["right"] for one in candidates)


def tokens_left(folder, name, spoiled):
    """Those of the folder whose row is not near a spoiled byte. `spoiled`: file name -> offsets."""
    left = set()
    for file in (name, name + "-wal"):
        path = folder / file
        if not path.exists():
            continue
        content = path.read_bytes()
        near = sorted(spoiled.get(file, []))
        for match in TOKEN.finditer(content):
            if not any(abs(match.start() - at) < ROW for at in near):
                left.add(match[0].decode())
    return left


def hit(contents, spoiled):
    """The tokens whose row had a byte spoiled: with a wrong byte in a text it is a row like others, which nothing tells from a right one."""
    return {match[0].decode() for file, places in spoiled.items() for match in TOKEN.finditer(contents.get(file, b""))
            if any(abs(match.start() - at) < ROW for at in places)}


def flip(path, draw, count, first=0, last=None):
    """Spoils bytes. Returns where."""
    places = []
    with open(path, "r+b") as file:
        size = os.fstat(file.fileno()).st_size
        last = min(last or size, size)
        for _ in range(count if last > first else 0):
            at = draw.randrange(first, last)
            file.seek(at)
            old = file.read(1)[0]
            file.seek(at)
            file.write(bytes([old ^ draw.randrange(1, 256)]))
            places.append(at)
    return places


def damage(kind, folder, draw):
    """Returns the spoiled places by file, and whether anything was done at all."""
    file, wal = folder / "web.sqlite", folder / "web.sqlite-wal"
    if kind.startswith("flipped bytes"):
        return {"web.sqlite": flip(file, draw, draw.randint(1, 40))}, True
    if kind.startswith("flipped WAL"):
        return {"web.sqlite-wal": flip(wal, draw, draw.randint(10, 60))}, wal.stat().st_size > 0
    if kind.startswith("page of zeros"):
        page = draw.randrange(1, max(2, file.stat().st_size // 4096))
        with open(file, "r+b") as opened:
            opened.seek(4096 * page)
            opened.write(bytes(4096))
        return {}, True
    if kind.startswith("first page"):
        return {"web.sqlite": flip(file, draw, 400, 0, 4096)}, True
    if kind.startswith(("cut file", "cut WAL")):
        what = wal if "WAL" in kind else file
        os.truncate(what, int(what.stat().st_size * draw.uniform(0.2, 0.95)))
        return {}, True
    if kind.startswith("emptied"):
        os.truncate(file, 0)
    elif kind.startswith("no WAL"):
        wal.unlink()
    elif kind.startswith("no file"):
        file.unlink()
    elif kind.startswith("folder removed"):
        for _ in range(20):  # the store makes it anew meanwhile
            shutil.rmtree(folder, ignore_errors=True)
            if not folder.exists():
                break
    return {}, True


def one_damage(program, kind, seed, most=1500, crippled=False):
    """Returns what became of it: stored, whose bytes are left, lost, login, said, seconds until it was said."""
    draw = random.Random(f"store/{kind}/{seed}")
    base = Path(tempfile.mkdtemp(prefix="docent-store-trial-"))
    folder = base / "state"
    folder.mkdir()
    file = str(folder / "web.sqlite")
    wanted = draw.randint(150, most)
    try:
        writer = Writer(program, file, f"a{seed}", 4096 * draw.randint(60, 150) if kind == "disk full" else None)
        stored_enough = writer.wait_for(lambda lines: len(of(lines, "stored")) >= wanted or any("disk is full" in line for line in lines), 60)
        is_down = kind.endswith(", down")
        begun = time.monotonic()
        if is_down:
            said = writer.kill()
        else:
            said = writer.lines()
        before = set(of(said, "stored"))
        if kind in ("folder removed", "no WAL", "disk full"):
            left = set(before)  # what it has open is there still
            damage(kind, folder, draw)
        else:
            contents = {name: (folder / name).read_bytes() for name in ("web.sqlite", "web.sqlite-wal")}
            spoiled, was_done = damage(kind, folder, draw)
            if not was_done:
                return None
            left = before & tokens_left(folder, "web.sqlite", spoiled) - hit(contents, spoiled)
        seconds = None
        if not is_down:
            told = (lambda lines: any("disk is full" in line for line in lines)) if kind == "disk full" else (lambda lines: bool(of(lines, "notice")))
            # Spoiled bytes of a file in use are found when they are read.
            if writer.wait_for(told, 3 if kind == "flipped bytes" else NOTICED):
                seconds = time.monotonic() - begun
            time.sleep(draw.uniform(0.1, 0.5))
            said = writer.kill()
            if kind == "flipped bytes":  # SQLite went on writing into spoiled pages: what it has overwritten is gone
                left = set(of(said, "stored")) & tokens_left(folder, "web.sqlite", spoiled) - hit(contents, spoiled)
            else:  # what was acknowledged after it was noticed is there
                left |= set(of(said, "stored")) - before
        if crippled:
            for one in folder.glob("web.sqlite*"):
                one.unlink()
            shutil.rmtree(folder / "backups", ignore_errors=True)
        found = ask(program, file, "read")
        has = set(of(found, "has"))
        lost = left - has
        is_said = bool(of(found, "notice")) or seconds is not None
        result = {"kind": kind, "seed": seed, "stored": len(before), "left": len(left), "lost": sorted(lost), "missing": len(before - has), "login": may_log_in(program, file, said), "said": is_said,
                  "seconds": seconds, "notice": (of(found, "notice") or ["-"])[0], "enough": stored_enough}
        if lost or not result["login"]:
            result["refused"] = (of(found, "refused") or of(said, "refused") or ["-"])[-1]
        return result
    finally:
        shutil.rmtree(base, ignore_errors=True)


def kills(program, count, seed):
    """One store, killed again and again."""
    draw = random.Random(f"store/kills/{seed}")
    stored, all_lost, refused_logins, said, passwords = set(), set(), 0, [], []
    with tempfile.TemporaryDirectory(prefix="docent-store-trial-") as folder:
        file = folder + "/web.sqlite"
        for number in range(count):
            writer = Writer(program, file, f"k{seed}-{number}")
            writer.wait_for(lambda lines: of(lines, "stored"), 30)
            time.sleep(draw.uniform(0.0, 0.06))
            lines = writer.kill()
            stored |= set(of(lines, "stored"))
            said += of(lines, "notice")
            for line in of(lines, "refused"):
                print(f"  run {number}: {line}", flush=True)
            passwords += [line for line in lines if line.startswith(("password ", "trying "))]
            if number % 10 == 9 or number == count - 1:
                found = ask(program, file, "read")
                all_lost |= stored - set(of(found, "has"))
                said += of(found, "notice")
                refused_logins += not may_log_in(program, file, passwords)
    return stored, all_lost, refused_logins, said


def killed(program, count, seed, verdict):
    stored, lost, refused, said = kills(program, count, seed)
    verdict.want(f"killed {count} times: of what was said to be stored, lost 0", f"{len(lost)} of {len(stored)}", not lost and len(stored) > count)
    verdict.want("killed: the account cannot be used, 0 times", str(refused), refused == 0)
    # A frame of the WAL that was being written looks like a spoiled one; a notice holds the ones before it. Of 20 kills one says nothing of the rate.
    alarms = {one for notice in said for one in re.split(r"; (?=\d{4}-)", notice)}
    verdict.want("killed: a damage is said though there is none, at most once in 100", f"{len(alarms)} of {count}", len(alarms) <= max(1, count // 100))


def damaged(program, options, verdict):
    count = len(KINDS) if options.slice else options.seeds or DAMAGES
    most = 400 if options.slice else 1500
    trials = [(KINDS[i % len(KINDS)], options.first_seed + i // len(KINDS)) for i in range(count)]
    with ThreadPoolExecutor(options.jobs) as pool:
        results = [one for one in pool.map(lambda trial: one_damage(program, *trial, most), trials) if one]
    rows = []
    for kind in KINDS:
        some = [one for one in results if one["kind"] == kind]
        slowest = max((one["seconds"] for one in some if one["seconds"] is not None), default=None)
        rows.append([kind, len(some), sum(one["stored"] for one in some), sum(one["left"] for one in some), sum(len(one["lost"]) for one in some),
                     sum(one["missing"] for one in some), sum(one["login"] for one in some), sum(one["said"] for one in some),
                     f"{slowest:.1f}" if slowest is not None else "-"])
    print_table(["damage", "trials", "stored", "bytes left", "of these lost", "missing", "may log in", "is said", "after s"], rows)
    for one in results:
        if one["lost"] or not one["login"] or (one["missing"] and not one["said"]) or not one["enough"]:
            print({**one, "lost": one["lost"][:5]})
    print("  " + "\n  ".join(sorted({one["kind"] + ": " + one["notice"] for one in results if one["seed"] == options.first_seed})))
    left = sum(one["left"] for one in results)
    kinds = {one["kind"] for one in results}
    verdict.want("damages tried, each kind", f"{len(results)}, {len(kinds)} of {len(KINDS)} kinds", kinds >= set(KINDS) and all(one["enough"] for one in results))
    verdict.want("damaged: of what was stored and whose bytes are there, lost 0", f"{sum(len(one['lost']) for one in results)} of {left}", left > 0 and not any(one["lost"] for one in results))
    verdict.want("damaged: the account is usable", f"{sum(one['login'] for one in results)} of {len(results)}", all(one["login"] for one in results))
    missing = [one for one in results if one["missing"]]
    unsaid = [one for one in missing if not one["said"]]
    verdict.want("damaged: what is missing is said", f"{len(missing) - len(unsaid)} of {len(missing)} stores that miss anything", not unsaid)
    noticed = [one for one in results if not one["kind"].endswith(", down") and one["kind"] != "flipped bytes"]
    verdict.want(f"damaged while it runs: said within {NOTICED:.0f} s", f"{sum(one['seconds'] is not None for one in noticed)} of {len(noticed)}",
                 bool(noticed) and all(one["seconds"] is not None for one in noticed))
    if not options.no_crippled:
        worse = one_damage(program, "first page, down", options.first_seed, most, crippled=True)
        verdict.want("a store that begins anew (must lose rows and the account)", f"{len(worse['lost'])} of {worse['left']}, login {worse['login']}",
                     len(worse["lost"]) > 0 and not worse["login"])


def protocol(program, options):
    verdict = Verdict()
    if options.part != "damages":
        killed(program, 20 if options.slice else KILLS, options.first_seed, verdict)
    if options.part != "kills":
        damaged(program, options, verdict)
    print()
    verdict.print()
    return verdict
