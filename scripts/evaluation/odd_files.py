"""Maps and recordings of others, as odd as their formats allow: is any read wrongly without a word?

Each kind makes files of which it knows what a reader must find (odd_maps, odd_recordings); `docent_read_odd_files` reads them as the program does. A crippled
reader, which shows pictures as screens do or takes the first topics of a recording, must be found out.
"""
import json
import random
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from . import odd_drive, odd_map_faults, odd_maps, odd_recordings
from .tables import Verdict, print_table

PARTS = ["maps", "recordings"]
OUTCOMES = ["right", "noted", "refused", "needlessly refused", "silently wrong", "crashed"]
CRIPPLED = {"gamma": ("maps", "PNG, gamma and profile"), "first-topics": ("recordings", "ground truth")}


class Reader:
    """The process that reads; begun anew where a file ends it."""

    def __init__(self, program, crippled=""):
        self.command, self.process = [str(program), *([crippled] if crippled else [])], None

    def read(self, request):
        """None: it ended."""
        if self.process is None:
            self.process = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.process.stdin.write(json.dumps(request) + "\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        if line:
            return json.loads(line)
        self.close()
        return None

    def close(self):
        if self.process is not None:
            self.process.stdin.close()
            self.process.wait()
            self.process = None


def judged(case, answer):
    """(outcome, why)."""
    if answer is None:
        return "crashed", "the reader ended"
    if "error" in answer:
        right = case.get("refusal") and re.search(case["refusal"], answer["error"])
        return ("refused", "") if right else ("needlessly refused", answer["error"] + (f"; expected /{case['refusal']}/" if case.get("refusal") else ""))
    notes = "\n".join(answer["notes"])
    says = lambda key: bool(case.get(key) and re.search(case[key], notes))  # noqa: E731
    value = case["cells"] if case["what"] == "map" else case["robots"]
    if value is None:
        return ("noted", "") if says("say") else ("silently wrong", "was read; expected " + (case.get("refusal") or case.get("say")) + "; notes: " + notes)
    fault = (odd_map_faults if case["what"] == "map" else odd_drive).fault_of(case, answer)
    if fault:
        return ("noted", "") if says("excuse") else ("silently wrong", fault + "; notes: " + notes)
    if case.get("say") and not says("say"):
        return "silently wrong", f"right, but without a word of /{case['say']}/; notes: {notes}"
    return ("noted" if notes else "right"), ""


def trial(reader, kind, make, numbers, folder, keep=None):
    """Counts by outcome, and (number, why) of those that are wrong."""
    counts, wrong = dict.fromkeys(OUTCOMES, 0), []
    for number in numbers:
        inside = folder / "case"
        inside.mkdir()
        case = make(inside, random.Random(f"{kind} {number}"))
        if case is not None:
            outcome, why = judged(case, reader.read({"what": case["what"], "path": case["path"], "image": case.get("image", ""), **case.get("ask", {})}))
            counts[outcome] += 1
            if outcome in OUTCOMES[3:]:
                wrong.append((number, why))
                if keep:
                    shutil.copytree(inside, Path(keep) / f"{kind.replace(' ', '-').replace(',', '')}-{number}", dirs_exist_ok=True)
        shutil.rmtree(inside)
    return counts, wrong


def part_of(reader, part, kinds, count, first, folder, keep):
    rows, told = [], []
    for kind, make in kinds.items():
        counts, wrong = trial(reader, kind, make, range(first, first + count), folder, keep)
        rows.append([kind, *[str(counts[o]) for o in OUTCOMES]])
        told += [f"{kind} {number}: {outcome}" for number, outcome in wrong[:3]]
    print_table([part, *OUTCOMES], rows)
    for line in told:
        print("  " + line)
    files = sum(int(v) for row in rows for v in row[1:])
    wrong = sum(int(v) for row in rows for v in row[4:])
    return files, wrong


def protocol(program, options):
    verdict = Verdict()
    if not program.exists():
        sys.exit(f"{program} is missing: ninja docent_read_odd_files")
    count, every = options.count or (10 if options.slice else 500), {"maps": odd_maps.KINDS, "recordings": odd_recordings.KINDS}
    kept = tempfile.mkdtemp(prefix="docent-odd-", dir="/dev/shm" if Path("/dev/shm").is_dir() else None)
    try:
        folder, reader = Path(kept), Reader(program)
        for part in [options.part] if options.part else PARTS:
            kinds = {k: m for k, m in every[part].items() if not options.cases or k in options.cases.split(";")}
            files, wrong = part_of(reader, part, kinds, count, options.first_seed, folder, options.pictures)
            verdict.want(f"{part}: none silently wrong, needlessly refused or crashed", f"{wrong} of {files} files of {len(kinds)} kinds", wrong == 0 and files > 0)
        reader.close()
        for crippled, (part, kind) in CRIPPLED.items():
            if options.no_crippled or options.cases or options.part not in (None, part):
                continue
            broken = Reader(program, crippled)
            counts, _ = trial(broken, kind, every[part][kind], range(options.first_seed, options.first_seed + max(20, count // 10)), folder)
            broken.close()
            found = counts["silently wrong"]
            verdict.want(f"a reader crippled by {crippled} is found out", f"wrong in {found} of {sum(counts.values())} files of '{kind}'", found > 0)
    finally:
        shutil.rmtree(kept)
    print()
    verdict.print()
    return verdict
