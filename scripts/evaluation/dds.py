"""A tour over DDS, in wall time: the bounds of a tour, and what its sensors recorded played again in one process.

Then once more while another program computes on every processor: from a scan to the command that knows it, and how old belief and
hazards are when they are told. A robot whose modules are in no real-time class runs beside it, for comparison. All figures are of the
clock: nothing else should run on the computer."""
import contextlib
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from evaluation.bounds import bounded
from evaluation.programs import laboratory
from evaluation.reports import contacts_of

DOMAIN, PORT = 61, 18061
SETTLE = 60.0  # [s] that the processes have to stop and the recording to be closed


NOT_URGENT = ["--set", "processes.urgent=normal"]
MOST_MS = {"scan_to_command": (5.0, 30.0), "belief_age": (None, 50.0), "hazards_age": (None, 100.0)}  # p50, p99
NAMES = {"scan_to_command": "from a sweep of the lasers to the command that knows it", "belief_age": "age of the belief when it is told",
         "hazards_age": "age of the virtual measurements of hazards"}


@contextlib.contextmanager
def busy_processors(is_busy):
    """Another program: one process for each processor, which never waits."""
    count = os.cpu_count() if is_busy else 0
    others = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(count)]
    try:
        yield
    finally:
        for other in others:
            other.kill()
            other.wait()


def drive(docent, museum, minutes, seed, record, more=()):
    """The robot of processes, for so long; stopped as a person stops it."""
    state = Path(tempfile.mkdtemp(prefix="docent-dds-"))
    with open(state / "up.log", "w", encoding="utf-8") as log:
        up = subprocess.Popen([docent, "up", "--sim", "--museum", museum, "--crowd", "busy", "--seed", str(seed), "--state", state,
                               "--domain", str(DOMAIN), "--port", str(PORT), "--record", record, *more], stdout=log, stderr=log)
        try:
            up.wait(timeout=60.0 * minutes)
        except subprocess.TimeoutExpired:
            up.send_signal(signal.SIGTERM)
            up.wait(timeout=SETTLE)
        else:
            raise RuntimeError(f"docent up ended by itself: {(state / 'up.log').read_text()[-400:]}")
        finally:
            if up.poll() is None:
                up.kill()
                up.wait()
    shutil.rmtree(state)


def run(docent, root, cache, minutes, seed, name, is_busy=False, more=()):
    """What a tour over DDS was worth, and its recording."""
    folder = cache / "dds"
    folder.mkdir(parents=True, exist_ok=True)
    record, report = folder / f"{name}{seed}.mcap", folder / f"{name}{seed}.json"
    record.unlink(missing_ok=True)
    beside = ", another program computes on every processor" if is_busy else ""
    print(f"\n## bonn, busy, {minutes:g} minutes of wall time, every module a process over DDS, seed {seed}{beside}; {' '.join(more)}\n", flush=True)
    with busy_processors(is_busy):
        drive(docent, root / "museums/bonn", minutes, seed, record, more)
    subprocess.run([laboratory(docent), "evaluate", record, "--report", report], check=True, stdout=subprocess.DEVNULL)
    return json.loads(report.read_text()), record


def want_in_time(result, when, verdict):
    """The bounds of what comes in time, each with its exposure."""
    for key, (most_p50, most_p99) in MOST_MS.items():
        seen = result[key]
        count = seen.get("sweeps", seen.get("messages"))
        holds = count > 60 and seen["p99_ms"] <= most_p99 and (most_p50 is None or seen["p50_ms"] <= most_p50)
        bound = f"p50 {most_p50:g} ms, p99 {most_p99:g} ms" if most_p50 else f"p99 {most_p99:g} ms"
        verdict.want(f"{when}: {NAMES[key]} ({bound})", f"{seen['p50_ms']:.1f} and {seen['p99_ms']:.1f} ms of {count}", holds)
    answers = result["scan_to_command"]
    verdict.want(f"{when}: sweeps upon which nothing was commanded (0.1 %)", f"{answers['unanswered']} of {answers['sweeps']}",
                 answers["unanswered"] <= 0.001 * answers["sweeps"])


def protocol(docent, root, cache, minutes, seed, verdict):
    result, record = run(docent, root, cache, minutes, seed, "seed")
    started = time.monotonic()
    replay = subprocess.run([docent, "replay", record, "--check"], capture_output=True, text=True, check=False)
    print("\n".join(replay.stdout.strip().splitlines()[-6:] + replay.stderr.strip().splitlines()[-3:]))
    print(f"   replayed in {time.monotonic() - started:.0f} s\n")
    contacts = contacts_of(result)
    requests = result["requests"]
    localized = result["localization"]["localized_after_s"]
    verdict.want("ran", f"{result['virtual_seconds']:.0f} s", result["virtual_seconds"] >= 0.95 * 60 * minutes)
    verdict.want("contacts", f"{bounded(contacts, result['distance_m'] / 1000)}; {result['passes_within_1m']} passes within 1 m",
                 contacts == 0 and result["distance_m"] > 5.0 * minutes)
    verdict.want("area violations", f"{result['area_violations']}", result["area_violations"] == 0)
    verdict.want("localized within 5 minutes", f"{localized} s", localized is not None and localized <= 300)
    if minutes >= 10:  # requests of the last ten minutes do not count
        verdict.want("requests served (95 %)", f"{requests['counted_served']} of {requests['counted']}",
                     requests["counted"] > 0 and requests["counted_served"] >= 0.95 * requests["counted"])
    verdict.want("exhibits explained", f"{result['exhibits_explained']}", result["exhibits_explained"] >= minutes / 4)
    verdict.want("the same mission events in the same order when replayed", f"exit {replay.returncode}", replay.returncode == 0)
    want_in_time(result, "alone", verdict)
    beside, _ = run(docent, root, cache, minutes, seed, "beside", is_busy=True)
    verdict.want("beside another program: contacts", bounded(contacts_of(beside), beside["distance_m"] / 1000),
                 contacts_of(beside) == 0 and beside["distance_m"] > 5.0 * minutes)
    want_in_time(beside, "beside another program", verdict)
    plain, _ = run(docent, root, cache, min(minutes, 4), seed, "plain", is_busy=True, more=NOT_URGENT)
    print(f"   in no real-time class: from a sweep to the command p50 {plain['scan_to_command']['p50_ms']:.1f}, p99 {plain['scan_to_command']['p99_ms']:.1f} ms")
    verdict.print()
    return verdict
