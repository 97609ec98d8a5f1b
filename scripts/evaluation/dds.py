"""A tour over DDS, in wall time: the bounds of a tour, and what its sensors recorded played again in one process."""
import json
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from evaluation.programs import laboratory
from evaluation.reports import contacts_of

DOMAIN, PORT = 61, 18061
SETTLE = 60.0  # [s] that the processes have to stop and the recording to be closed


def drive(docent, museum, minutes, seed, record):
    """The robot of processes, for so long; stopped as a person stops it."""
    state = Path(tempfile.mkdtemp(prefix="docent-dds-"))
    with open(state / "up.log", "w", encoding="utf-8") as log:
        up = subprocess.Popen([docent, "up", "--sim", "--museum", museum, "--crowd", "busy", "--seed", str(seed), "--state", state,
                               "--domain", str(DOMAIN), "--port", str(PORT), "--record", record], stdout=log, stderr=log)
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


def protocol(docent, root, cache, minutes, seed, verdict):
    folder = cache / "dds"
    folder.mkdir(parents=True, exist_ok=True)
    record, report = folder / f"seed{seed}.mcap", folder / f"seed{seed}.json"
    record.unlink(missing_ok=True)
    print(f"\n## bonn, busy, {minutes:g} minutes of wall time, every module a process over DDS, seed {seed}\n", flush=True)
    drive(docent, root / "museums/bonn", minutes, seed, record)
    started = time.monotonic()
    subprocess.run([laboratory(docent), "evaluate", record, "--report", report], check=True, stdout=subprocess.DEVNULL)
    replay = subprocess.run([docent, "replay", record, "--check"], capture_output=True, text=True, check=False)
    print("\n".join(replay.stdout.strip().splitlines()[-6:] + replay.stderr.strip().splitlines()[-3:]))
    print(f"   evaluated and replayed in {time.monotonic() - started:.0f} s\n")
    result = json.loads(report.read_text())
    contacts = contacts_of(result)
    requests = result["requests"]
    localized = result["localization"]["localized_after_s"]
    verdict.want("ran", f"{result['virtual_seconds']:.0f} s", result["virtual_seconds"] >= 0.95 * 60 * minutes)
    verdict.want("contacts", f"{contacts} in {result['distance_m']:.0f} m, {result['passes_within_1m']} passes within 1 m",
                 contacts == 0 and result["distance_m"] > 5.0 * minutes)
    verdict.want("area violations", f"{result['area_violations']}", result["area_violations"] == 0)
    verdict.want("localized within 5 minutes", f"{localized} s", localized is not None and localized <= 300)
    verdict.want("requests served (95 %)", f"{requests['counted_served']} of {requests['counted']}",
                 requests["counted"] > 0 and requests["counted_served"] >= 0.95 * requests["counted"])
    verdict.want("exhibits explained", f"{result['exhibits_explained']}", result["exhibits_explained"] >= minutes / 4)
    latency = result["scan_to_command"]
    verdict.want("from a sweep of the lasers to the command that knows it: p50 10 ms, p99 30 ms",
                 f"{latency['p50_ms']:.1f} and {latency['p99_ms']:.1f} ms, {latency['sweeps']} sweeps, {latency['unanswered']} unanswered",
                 latency["p50_ms"] <= 10.0 and latency["p99_ms"] <= 30.0 and latency["unanswered"] <= 0.001 * latency["sweeps"])
    verdict.want("the same mission events in the same order when replayed", f"exit {replay.returncode}", replay.returncode == 0)
    verdict.print()
    return verdict
