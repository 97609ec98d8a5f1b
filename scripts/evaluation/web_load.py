"""How many viewers one core serves with a pose every 0.3 s, while 150 others read slowly or not at all; and python3-tornado under
the same load. Server and viewers are processes of their own, each on one core."""
import json
import os
import resource
import subprocess
import sys
from pathlib import Path

from evaluation.tables import Verdict, print_table

OWED, AIM = 5000, 10000  # viewers
LATEST = 100.0  # [ms] at 99 %, from the moment when the server's process has a value to its arrival
MOST_KB = 10.0  # of memory a viewer: what the process has more of its own, and the kernel's buffers
STALLED, SLOW = 100, 50  # who never read; who read 200 bytes a second
OFTEN = 3.2  # values a second that each viewer gets at least: one every 0.3 s is 3.33
LADDER = {"docent": [1000, 2500, OWED, AIM, 14000], "tornado": [500, 1000, 2500, OWED]}
SECONDS, SLICE_SECONDS, SLICE_VIEWERS = 30.0, 8.0, 1000
TORNADO = Path(__file__).with_name("tornado_server.py")


def one(root, name, viewers, bad, seconds):
    """What the viewers of one server saw."""
    programs = root / "build/dev/tests/web_load"
    command = [programs / "docent_pose_server"] if name == "docent" else [sys.executable, TORNADO]
    cores = sorted(os.sched_getaffinity(0))
    server = subprocess.Popen(["taskset", "-c", str(cores[0]), *command], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, text=True)  # tornado tells of every viewer who leaves
    try:
        port = server.stdout.readline().strip()
        seen = subprocess.run(["taskset", "-c", str(cores[-1]), programs / "docent_web_load", "--port", port, "--process", str(server.pid),
                               "--path", "/live?thin" if name == "docent" else "/live", "--viewers", str(viewers), "--seconds", str(seconds),
                               "--stalled", str(STALLED if bad else 0), "--slow", str(SLOW if bad else 0)],
                              capture_output=True, text=True, check=True)
    finally:
        server.stdin.close()
        try:
            server.wait(timeout=20)
        except subprocess.TimeoutExpired:
            server.kill()
            server.wait()
    return {"server": name, "bad": bad, **json.loads(seen.stdout)}


def holds(row):
    """All have come, and each gets its values in time."""
    return row["open"] >= row["viewers"] + (STALLED + SLOW if row["bad"] else 0) and row["values_per_viewer_s"] >= OFTEN and row["p99_ms"] <= LATEST


def protocol(simulations, options):
    root, is_slice = simulations.root, options.slice
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))
    ladder = {"docent": [SLICE_VIEWERS], "tornado": [SLICE_VIEWERS // 2]} if is_slice else LADDER
    seconds = SLICE_SECONDS if is_slice else SECONDS
    rows = []
    for name, numbers in ladder.items():
        for viewers in numbers:
            if viewers + 500 > hard:
                print(f"   {name} {viewers}: the limit of open files is {hard}", flush=True)
            rows.append(one(root, name, viewers, True, seconds))
            print(f"   {name} {viewers}: p99 {rows[-1]['p99_ms']:.0f} ms", flush=True)
            if not is_slice and not holds(rows[-1]):
                break
    alone = None
    if not is_slice:
        some = min(OWED, max(row["viewers"] for row in rows if row["server"] == "docent"))
        alone = one(root, "docent", some, False, seconds)
        rows.append(alone)
    print(f"\n## Viewers with a pose every 0.3 s, {seconds:g} s each, server and viewers on a core each\n")
    print_table(["server", "viewers", "stalled, slow", "values/s each", "bytes", "median ms", "p99 ms", "worst ms", "kB own", "kB sockets", "of a core"],
                [[r["server"], r["viewers"], f"{STALLED}, {SLOW}" if r["bad"] else "none", f"{r['values_per_viewer_s']:.2f}", f"{r['bytes']:.0f}",
                  f"{r['median_ms']:.1f}", f"{r['p99_ms']:.1f}", f"{r['worst_ms']:.1f}", f"{r['resident_kb']:.1f}", f"{r['socket_kb']:.1f}",
                  f"{r['core']:.2f}"] for r in rows])
    print("\nkB: of memory a viewer, the process's own (without pages of its program) and the kernel's buffers of both ends.\n")
    verdict = Verdict()
    of = {name: [row for row in rows if row["server"] == name and row["bad"]] for name in ladder}
    best = {name: max((row["viewers"] for row in of[name] if holds(row)), default=0) for name in ladder}
    wanted = SLICE_VIEWERS if is_slice else OWED
    at = next((row for row in of["docent"] if row["viewers"] == wanted), None)
    if is_slice:  # other tests run beside it: no times are judged
        verdict.want(f"{wanted} viewers get their values, at least {OFTEN} a second", f"{at['values_per_viewer_s']:.2f}",
                     at["open"] == wanted + STALLED + SLOW and at["values_per_viewer_s"] >= OFTEN)
    else:
        verdict.want(f"viewers served within {LATEST:g} ms at 99 % (at least {OWED}, aim {AIM})", f"{best['docent']}", best["docent"] >= OWED)
        verdict.note("python3-tornado serves so", f"{best['tornado']}")
    memory = at["resident_kb"] + at["socket_kb"] if at else float("inf")
    verdict.want(f"memory a viewer, with {wanted} of them (under {MOST_KB:g} kB)", f"{memory:.1f} kB", memory < MOST_KB)
    if alone and at:
        verdict.want(f"{STALLED} stalled and {SLOW} slow ones: nobody else notices, p99 within 10 ms or a quarter of what it is without them",
                     f"{at['p99_ms']:.1f} ms, {alone['p99_ms']:.1f} ms without them",
                     at["p99_ms"] <= alone["p99_ms"] + max(10.0, 0.25 * alone["p99_ms"]))
    verdict.print()
    return verdict
