"""Runs of the whole robot in a museum, kept under a key of everything that decides them."""
import concurrent.futures
import hashlib
import json
import os
import subprocess
import sys
import threading
import time

from evaluation.keys import key_of
from evaluation.programs import program_for, programs_of


def side_by_side(jobs, threads):
    """Results of functions that run beside each other, in the order of the functions; says now and then how far it is."""
    results = []
    started = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(threads) as pool:
        for i, future in enumerate([pool.submit(job) for job in jobs]):
            results.append(future.result())
            if (i + 1) % 20 == 0:
                print(f"   {i + 1} of {len(jobs)}, {time.monotonic() - started:.0f} s", file=sys.stderr)
    return results


ONLY_SCENARIO = ["--crowd", "busy", "--requests-per-hour", "0"]  # arguments of a run whose requests are those of its scenario alone


class Simulations:
    def __init__(self, docent, root, cache, jobs):
        self.docent, self.root, self.cache, self.jobs = docent, root, cache, jobs

    @property
    def museums(self):
        return self.root / "museums"

    def key(self, museum, *programs):
        """Of everything that decides a run: the programs as they are built, scenarios, the museum."""
        return key_of(*programs_of(self.docent), *programs, self.root / "scripts" / "scenarios", self.root / "prolog", museum)

    def run(self, name, museum, seed, minutes, arguments):
        """One run; its report, from the cache when it was made before."""
        return self.run_logged(name, museum, seed, minutes / 60, arguments, {})[1]

    def run_logged(self, name, museum, seed, hours, arguments, logs, scenario=""):
        """One run with its logs and the text of a scenario, if it has one; from the cache when it was made before.

        logs: option of `docent simulate` to the end of a file's name. Returns the paths by those ends, and the report."""
        arguments = [str(argument) for argument in arguments]
        key = hashlib.sha256(json.dumps([self.key(museum), seed, scenario, hours, arguments]).encode()).hexdigest()[:16]
        folder = self.cache / name
        folder.mkdir(parents=True, exist_ok=True)
        stem = f"{museum.name}-seed{seed}-{key}"
        kept = {kind: folder / f"{stem}.{kind}" for kind in (*logs.values(), "json")}
        if not all(path.exists() for path in kept.values()):  # a run without these logs may have been made before
            part = {kind: folder / f"{stem}.part{os.getpid()}-{threading.get_ident()}.{kind}" for kind in (*kept, "yaml")}
            command = [program_for(self.docent, arguments), "simulate", "--museum", museum, "--hours", f"{hours:.6f}", "--seed", str(seed),
                       "--report", part["json"], "--quiet", *arguments]
            for option, kind in logs.items():
                command += [option, part[kind]]
            if scenario:
                part["yaml"].write_text(scenario)
                command += ["--scenario", part["yaml"]]
            started = time.monotonic()
            done = subprocess.run(command, capture_output=True, text=True, timeout=3600 * max(1.0, hours), check=False)
            part["yaml"].unlink(missing_ok=True)
            if done.returncode != 0 or not part["json"].exists():
                raise RuntimeError(f"seed {seed}: docent simulate exited {done.returncode}: {done.stderr.strip()[-500:]}")
            for kind, path in kept.items():  # the report last: it says that all are there
                part[kind].rename(path)
            print(f"   {museum.name} seed {seed}, {hours:.1f} h: {time.monotonic() - started:.0f} s", file=sys.stderr)
        return kept, json.loads(kept["json"].read_text())

    def of_seeds(self, name, museum, seeds, minutes, arguments):
        return self.all([(name, museum, seed, minutes, arguments) for seed in seeds])

    def all(self, runs):
        """Reports of many runs, in their order; each what `run` takes."""
        return self.each(self.run, runs)

    def each(self, function, calls):
        """What a function gives for each of many calls, in their order, some at a time."""
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            futures = [pool.submit(function, *call) for call in calls]
            return [future.result() for future in futures]
