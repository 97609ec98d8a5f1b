"""Recordings and runs of which the protocols of localization are made, and the rows that a robot said in them."""
import csv
import hashlib
import json
import os
import subprocess

from evaluation.claims import read_claims
from evaluation.programs import program_for
from evaluation.simulations import side_by_side


def scenario(escort, kidnaps=()):
    """`kidnaps`: pairs of a time [s] and how, as a scenario says it."""
    events = ["  - {at: 0, steering: {speed: 0.5}}"]
    if escort:
        count, near, far = escort
        events.append(f"  - {{at: 0, escort: {{count: {count}, near: {near}, far: {far}}}}}")
    events += [f"  - {{at: {at:.1f}, kidnap: {how}}}" for at, how in kidnaps]
    return "events:\n" + "\n".join(events) + "\n"


class Bench:
    """Recordings and claims, kept under a key of everything that decides them."""

    def __init__(self, docent, cache, run_key, museums, jobs, settings=()):
        """`settings`: of every run, besides those that a protocol makes."""
        self.settings = list(settings)
        self.docent, self.cache, self.museums, self.jobs = docent, cache / "localization", museums, jobs
        self.keys = {museum: run_key(museums / museum) for museum in ("bonn", "smithsonian")}
        self.cache.mkdir(parents=True, exist_ok=True)

    def path(self, museum, kind, what):
        key = hashlib.sha256(json.dumps([self.keys[museum], kind, what]).encode()).hexdigest()[:20]
        return self.cache / f"{museum}-{key}.{kind}"

    def run(self, command):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(map(str, command[:4]))} exited {done.returncode}: {done.stderr.strip()[-400:]}")

    def claims(self, museum, seed, minutes, crowd, events, settings):
        """Rows of what the robot said beside the truth: one recording of a robot that is walked through a scenario, one
        configuration. The recording itself goes when all its replays are made, see `forget`."""
        settings = settings + self.settings
        what = [seed, minutes, crowd, events]
        claims = self.path(museum, "csv", what + [settings])
        if not claims.exists():
            record = self.path(museum, "mcap", what)
            if not record.exists():
                part = record.with_suffix(f".part{os.getpid()}-{seed}.yaml")
                part.write_text(events)
                made = record.with_suffix(f".part{os.getpid()}-{seed}.mcap")
                self.run([self.docent, "simulate", "--museum", self.museums / museum, "--hours", f"{minutes / 60:.6f}",
                          "--seed", str(seed), "--crowd", crowd, "--scenario", part, "--world-only", "--record", made,
                          "--quiet"])
                made.rename(record)
                part.unlink()
            made = claims.with_suffix(f".part{os.getpid()}")
            self.run([program_for(self.docent, settings), "replay", record, "--museum", self.museums / museum, "--modules", "localize",
                      "--claims", made, *(word for setting in settings for word in ("--set", setting))])
            made.rename(claims)
        return read_claims(claims)

    def forget(self, museum, seed, minutes, crowd, events):
        self.path(museum, "mcap", [seed, minutes, crowd, events]).unlink(missing_ok=True)

    def of_tours(self, museum, seed, minutes, crowd, requests_per_hour=None, events=None, settings=()):
        """Rows of what a whole robot on its tours said beside the truth, and what its modules said of their health."""
        settings = [*settings, *self.settings]
        what = ["tours", seed, minutes, crowd, requests_per_hour, events, settings]
        claims, health = self.path(museum, "csv", what), self.path(museum, "health.csv", what)
        if not claims.exists() or not health.exists():
            part = claims.with_suffix(f".part{os.getpid()}.yaml")
            made, told = claims.with_suffix(f".part{os.getpid()}"), claims.with_suffix(f".part{os.getpid()}h")
            command = [program_for(self.docent, settings), "simulate", "--museum", self.museums / museum, "--hours",
                       f"{minutes / 60:.6f}", "--seed", str(seed), "--crowd", crowd, "--claims", made, "--health-log", told, "--quiet"]
            if requests_per_hour is not None:
                command += ["--requests-per-hour", str(requests_per_hour)]
            if events is not None:
                part.write_text(events)
                command += ["--scenario", part]
            self.run(command + [word for setting in settings for word in ("--set", setting)])
            part.unlink(missing_ok=True)
            told.rename(health)
            made.rename(claims)
        with open(health, newline="", encoding="utf-8") as file:
            return read_claims(claims), list(csv.DictReader(file))

    def each(self, jobs):
        return side_by_side(jobs, self.jobs)
