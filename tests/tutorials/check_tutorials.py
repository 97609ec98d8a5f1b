#!/usr/bin/env python3
"""Runs every command of the tutorials, each page in a folder of its own, and compares what they print.

    tests/tutorials/check_tutorials.py [--write] [PAGE...]

A page's ```sh blocks are run in their order by one bash each, with the repository's folders beside them and `docent` and
`docent-lab` on the PATH. A ```output block holds what the ```sh block before it prints; "…" in it stands for anything. --write puts today's output
there. An HTML comment in the line before a block changes how it is tested:

    <!-- test instead: COMMAND -->      COMMAND is run instead, for what runs for ever or for hours
    <!-- test needs DOCENT_DATA -->     the page's rest is skipped where there are no recorded data
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = ROOT / "docs/tutorials"
PATIENCE_S = 300
BESIDE = ("docs", "museums", "prolog", "scripts", "src", "tests")


def binary():
    return Path(os.environ.get("DOCENT_BINARY", ROOT / "build/dev/bin/docent"))


def data():
    folder = Path(os.environ.get("DOCENT_DATA", ROOT.parent / "shared/data"))
    return folder.resolve() if folder.is_dir() else None


class Block:
    """A fenced block: lines[first:last] are its inside."""

    def __init__(self, kind, first, last, notes):
        self.kind, self.first, self.last, self.notes = kind, first, last, notes


def blocks_of(lines):
    blocks, notes, fence = [], [], None
    for number, line in enumerate(lines):
        if fence is not None:
            if line.startswith("```"):
                blocks.append(Block(fence[0], fence[1], number, fence[2]))
                fence, notes = None, []
        elif line.startswith("```"):
            fence = (line[3:].strip(), number + 1, notes)
        elif line.startswith("<!-- test "):
            notes = notes + [line.removeprefix("<!-- test ").removesuffix(" -->")]
        elif line.strip():
            notes = []
    return blocks


def matches(shown, printed):
    """Whether a line of the page stands for a line of the output."""
    return re.fullmatch(".*".join(re.escape(part) for part in shown.split("…")), printed) is not None


def merged(shown, printed):
    """The output as the page should show it: a line of the page that still matches stays as it is, with its "…"."""
    return [shown[i] if i < len(shown) and matches(shown[i], line) else line for i, line in enumerate(printed)]


class Folder:
    """Where a page is tried: the repository's folders beside what its commands write."""

    def __init__(self, path):
        self.path = Path(path)
        for name in BESIDE:
            (self.path / name).symlink_to(ROOT / name)
        (self.path / "bin").mkdir()
        (self.path / "bin/docent").symlink_to(binary())
        (self.path / "bin/docent-lab").symlink_to(binary().parent / "docent-lab")
        self.env = dict(os.environ, DOCENT_BINARY=str(binary()), XDG_STATE_HOME=str(self.path / "state"),
                        DOCENT_CACHE=str(self.path / "cache"),
                        PATH=f"{self.path / 'bin'}:{os.environ['PATH']}")
        if data() is not None:
            self.env["DOCENT_DATA"] = str(data())

    def run(self, command):
        return subprocess.run(["bash", "-euo", "pipefail", "-c", command], cwd=self.path, env=self.env, text=True,
                              capture_output=True, timeout=PATIENCE_S, stdin=subprocess.DEVNULL)


class PageCheck:
    def __init__(self, page, write):
        self.page, self.write = page, write
        self.lines = page.read_text().split("\n")
        self.faults, self.commands, self.figures, self.is_skipped = [], 0, 0, False

    def at(self, block):
        return f"{self.page.relative_to(ROOT)}:{block.first}"

    def run(self):
        replacements = []
        with tempfile.TemporaryDirectory() as path:
            folder, printed = Folder(path), ""
            for block in blocks_of(self.lines):
                text = "\n".join(self.lines[block.first:block.last])
                if block.kind == "sh":
                    if "needs DOCENT_DATA" in block.notes and data() is None:
                        print(f"skipped: {self.at(block)} and what follows: no recorded data (DOCENT_DATA)")
                        self.is_skipped = True
                        break
                    instead = [note.removeprefix("instead: ") for note in block.notes if note.startswith("instead: ")]
                    printed = self.run_command(folder, block, instead[0] if instead else text)
                    if printed is None:
                        break
                elif block.kind == "output":
                    self.figures += 1
                    shown, output = text.split("\n"), printed.rstrip("\n").split("\n")
                    if merged(shown, output) != shown:
                        replacements.append((block, merged(shown, output)))
        for block, output in reversed(replacements):
            if self.write:
                self.lines[block.first:block.last] = output
            else:
                self.faults.append(f"{self.at(block)}: the commands print\n    " + "\n    ".join(output))
        if self.write and replacements:
            self.page.write_text("\n".join(self.lines))

    def run_command(self, folder, block, command):
        """What it prints; None: it failed."""
        self.commands += 1
        start = time.monotonic()
        try:
            result = folder.run(command)
        except subprocess.TimeoutExpired:
            self.faults.append(f"{self.at(block)}: not done after {PATIENCE_S} s")
            return None
        print(f"{time.monotonic() - start:6.1f} s  {self.at(block)}", flush=True)
        if result.returncode != 0:
            self.faults.append(f"{self.at(block)}: exit code {result.returncode}\n{result.stderr[-2000:]}")
            return None
        return result.stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="*", help="names of pages; without, all")
    parser.add_argument("--write", action="store_true", help="write today's output into the pages")
    options = parser.parse_args()
    pages = [PAGES / f"{Path(name).stem}.md" for name in options.pages] or sorted(PAGES.glob("*.md"))
    checks = [PageCheck(page, options.write) for page in pages]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(PageCheck.run, checks))
    passed = failed = 0
    for check in checks:
        failed += len(check.faults)
        passed += check.commands + check.figures - len(check.faults)
        if check.commands == 0 and not check.is_skipped:
            failed += 1
            print(f"{check.page.name}: no command to run")
        for fault in check.faults:
            print(fault)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
