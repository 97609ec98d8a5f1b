"""What the last whole run of each protocol said. The rows of one table hold for one configuration and one program (architecture
10.17): `scripts/evaluate report` shows both, and fails where they differ or a row is missing."""
import datetime
import hashlib
import json
import subprocess

from evaluation.tables import Verdict, print_table

ROWS = ["tour", "smithsonian", "tours", "day", "safety", "faults", "speed", "crowd", "coastal", "scenarios", "exceptions"]
# These set something of their own; all else is as in the others.
OWN = {"crowd": "avoid.method is set for each method", "coastal": "localize.sensor.max_range is set to the lasers' reach",
       "exceptions": "mission.planner is set for each planner"}


def program_hash(docent):
    return hashlib.sha256(docent.read_bytes()).hexdigest()[:16]


def commit_of(root):
    """The commit of the work tree, with `-dirty` behind it where files differ from it; empty outside of git."""
    done = subprocess.run(["git", "describe", "--always", "--dirty", "--exclude", "*"], cwd=root, capture_output=True, text=True, check=False)
    return done.stdout.strip() if done.returncode == 0 else ""


def is_whole(options):
    """A run of everything, not of a part or with other numbers."""
    return not (options.slice or options.no_crippled or options.part or options.seeds or options.minutes or options.museums or options.cases
                or options.crowds or options.reach or options.set or options.method)


def write(cache, name, docent, verdict, commit):
    folder = cache / "verdicts"
    folder.mkdir(parents=True, exist_ok=True)
    row = {"good": verdict.good, "configurations": sorted(verdict.hashes), "program": program_hash(docent),
           "commit": commit, "failed": [what for result, what, _ in verdict.rows if result == "FAIL"],
           "made": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC")}
    part = folder / f"{name}.part"
    part.write_text(json.dumps(row, indent=1) + "\n")
    part.rename(folder / f"{name}.json")


def write_report(folder, found, date):
    """A dated table of the verdicts, for docs/reports. Two reports of one day are one: the later one replaces the first."""
    lines = [f"# Verdicts of the protocols, {date}", "",
             "This page was written by `scripts/evaluate report --write`. Each row is the last whole run of a protocol, in simulation.", "",
             "| protocol | verdict | bounds that do not hold | command | configuration | program | commit | made |",
             "|---|---|---|---|---|---|---|---|"]
    for name in ROWS:
        row = found.get(name)
        cells = [f"`scripts/evaluate {name}`", *[""] * 4]
        if row:
            cells = [f"`scripts/evaluate {name}`", " ".join(row["configurations"]), row["program"], row.get("commit", ""), row["made"]]
        verdict = "no whole run yet" if not row else "holds" if row["good"] else "FAILS"
        failed = "; ".join(row["failed"]).replace("|", "\\|") if row else ""
        lines.append("| " + " | ".join([name, verdict, failed, *cells]) + " |")
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"verdicts-{date}.md"
    path.write_text("\n".join(lines) + "\n")
    return path


def protocol(cache, report_folder=None):
    """`report_folder`: where to write the table, too."""
    verdict = Verdict()
    found = {}
    for name in ROWS:
        path = cache / "verdicts" / f"{name}.json"
        if path.exists():
            found[name] = json.loads(path.read_text())
            failed = found[name]["failed"]
            verdict.want(f"{name}: all bounds hold", "; ".join(failed) or "yes", found[name]["good"])
        else:
            verdict.want(f"{name}: a whole run", "none yet", False)
    print_table(["protocol", "verdict", "configuration", "program", "made", ""],
                [[name, "holds" if row["good"] else "FAILS", " ".join(row["configurations"]), row["program"], row["made"],
                  OWN.get(name, "")] for name, row in found.items()])
    print()
    hashes = {hash for name, row in found.items() if name not in OWN for hash in row["configurations"]}
    verdict.want("one configuration for all rows, but those that set their own", ", ".join(sorted(hashes)) or "none", len(hashes) == 1)
    programs = {row["program"] for row in found.values()}
    verdict.want("one program for all rows", ", ".join(sorted(programs)) or "none", len(programs) == 1)
    verdict.print()
    if report_folder is not None:
        print(f"\nwritten: {write_report(report_folder, found, datetime.datetime.now(datetime.timezone.utc).strftime('%Y-%m-%d'))}")
    return verdict
