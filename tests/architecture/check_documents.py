#!/usr/bin/env python3
"""What the documents say of the code: every name in them exists, every paper that is cited is defined, every folder has a README."""
import re
import subprocess
import sys
from functools import cache
from pathlib import Path

sys.dont_write_bytecode = True  # the work tree stays as it was
from findings import check, report  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "src" / "docent"
PUBLIC = ROOT / "include" / "docent"  # its folders are those of SOURCE
PAPERS = ROOT / "docs" / "papers.md"
KEY = r"[A-Z][A-Za-z]+(?:19|20)\d\d"
CODE = {".h", ".cpp", ".inc"}
FILES = CODE | {".md", ".py", ".yaml", ".html", ".json", ".pgm", ".sqlite"}


def git_files(*paths):
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "--", *paths], cwd=ROOT,
                            capture_output=True, text=True, check=True)
    return [ROOT / line for line in listed.stdout.splitlines() if (ROOT / line).is_file()]


def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


@cache
def sources():
    """The code of each file of src/docent and include/docent that is no test, without comments."""
    return {path: without_comments(path.read_text()) for path in [*sorted(SOURCE.rglob("*")), *sorted(PUBLIC.rglob("*"))]
            if path.suffix in CODE and not path.stem.endswith("_test")}


@cache
def words():
    return set(re.findall(r"\w+", "\n".join(sources().values())))


@cache
def strings():
    return set(re.findall(r'"([^"\n]*)"', "\n".join(sources().values())))


@cache
def laboratory_commands():
    """The commands that only docent-lab has."""
    return set(re.findall(r'"([^"]+)"', sources()[SOURCE / "apps/shared/laboratory_commands.h"]))


def is_defined_with(type_name, member):
    """Whether a file that defines the type also has the member."""
    definition = re.compile(rf"\b(?:class|struct|concept|using|namespace|enum(?: class)?)\s+{type_name}\b")
    return any(re.search(rf"\b{member}\b", text) for text in sources().values() if definition.search(text))


def names_something(name, folder=SOURCE):
    """Whether a name in backticks stands for something: a file, a folder, a command, a parameter, a symbol."""
    program, *arguments = name.split()
    if program.removeprefix("scripts/") in ("docent", "docent-lab"):
        command = arguments[0] if arguments else ""
        options = [argument for argument in arguments if argument.startswith("--")]
        is_right_program = program.endswith("-lab") or command not in laboratory_commands()
        return is_right_program and command in strings() and all(option in strings() for option in options)
    if program.startswith("scripts/"):
        script = ROOT / program
        if not script.is_file():
            return False
        text = script.read_text() + "".join(path.read_text() for path in (ROOT / "scripts/evaluation").glob("*.py"))
        return all(f'"{argument}"' in text for argument in arguments if not argument.isdigit() and argument.isascii())
    pair = re.fullmatch(r"([\w.]+): (\w+)", name)
    if pair:  # a parameter and one of its values
        return names_something(pair[1]) and pair[2] in strings()
    if re.fullmatch(r"[a-z]\w*(\.[a-z]\w*)+", name) and not Path(name).suffix in CODE | {".md", ".py", ".yaml", ".html"}:
        return all(part in strings() for part in name.split(".")[1:])  # the first part is a module of robot.yaml
    if "/" in name or Path(name).suffix:
        return any((base / name).exists() for base in (folder, SOURCE, PUBLIC, ROOT)) or any(path.name == name for path in sources())
    if re.fullmatch(r"\w+(::\w+)+", name):
        *_, type_name, member = name.split("::")
        return is_defined_with(type_name, member)
    return name in words() or name in strings() or (folder / name).exists()


def check_papers():
    text = PAPERS.read_text()
    keys_table, table = text.split("| where in the paper |")
    rows = re.findall(rf"^\| \[({KEY})\] \|", keys_table, flags=re.M)
    check(len(rows) == len(set(rows)), f"docs/papers.md: a key is defined twice: {rows}")
    check(len(rows) >= 4 and table.count("\n|") > 40, "docs/papers.md: its tables are gone")
    for number, line in enumerate(table.splitlines(), keys_table.count("\n") + 1):
        for name in re.findall(r"`([^`]+)`", line):
            check(names_something(name), f"docs/papers.md:{number}: `{name}` is nothing in this project")
    used = set()
    for path in git_files("include", "src", "tests", "scripts", "docs", "web", "README.md", "CONTRIBUTING.md"):
        if path.suffix in {".svg", ".png", ".webp", ".gz", ".json"}:
            continue
        try:
            lines = path.read_text().splitlines()
        except UnicodeDecodeError:
            continue
        for number, line in enumerate(lines, 1):
            where = f"{path.relative_to(ROOT)}:{number}"
            for key, end in re.findall(rf"\[({KEY})\b(.?)", line):
                used.add(key)
                check(key in rows, f"{where}: [{key}] is not defined in docs/papers.md")
                check(end == "]", f"{where}: [{key}] takes its section or equation behind the bracket")
    for key in rows:
        check(key in used, f"docs/papers.md: nothing cites [{key}]")


def check_readmes():
    folders = [SOURCE, *sorted(path for path in SOURCE.rglob("*") if path.is_dir())]
    check(len(folders) > 40, "src/docent has lost its folders")
    for folder in folders:
        where = folder.relative_to(ROOT)
        readme = folder / "README.md"
        check(readme.is_file(), f"{where}: no README.md")
        if not readme.is_file():
            continue
        text = readme.read_text()
        named = set(re.findall(r"`([^`\n]+)`", re.sub(r"```.*?```", "", text, flags=re.S)))
        stems = {name.rstrip("/").split("/")[-1].split(".")[0] for name in named}
        public = PUBLIC / folder.relative_to(SOURCE)
        for path in [*sorted(folder.iterdir()), *(sorted(public.glob("*.h")) if public.is_dir() else [])]:
            if path.is_dir() or path.suffix == ".h":
                check(path.stem in stems, f"{where}/README.md does not name {path.name}")
        for name in sorted(named):
            # Only what can be nothing else than a command, a symbol or a file of the code.
            is_command = re.fullmatch(r"(scripts/)?docent(-lab)? [a-z-]+", name)
            if is_command or re.fullmatch(r"[A-Z][a-z]+\w*(::\w+)*|\w+(::\w+)+|[\w/]+\.(h|cpp|inc|py)", name) and "_msgs::" not in name:
                check(names_something(name, folder), f"{where}/README.md: `{name}` is nothing in this project")


def check_agreements():
    """Comments cite the architecture by number: "architecture 10.7" is item 7 of section 10."""
    numbers = set()
    section = ""
    for line in (ROOT / "docs/architecture.md").read_text().splitlines():
        if heading := re.match(r"## (\d+) ", line):
            section = heading[1]
            numbers.add(section)
        elif item := re.match(r"(\d+)\. ", line):
            numbers.add(f"{section}.{item[1]}")
    check([str(i) for i in range(1, 11)] == sorted((n for n in numbers if "." not in n), key=int),
          "docs/architecture.md: its sections are not numbered from 1 to 10")
    for path in git_files("include", "src", "tests", "scripts", "docs", "web"):
        if path.suffix not in CODE | {".md", ".py", ".ts", ".svelte", ""}:
            continue
        for number, line in enumerate(path.read_text(errors="ignore").splitlines(), 1):
            for cited in re.findall(r"\barchitecture (\d+(?:\.\d+)?)", line):
                check(cited in numbers, f"{path.relative_to(ROOT)}:{number}: there is no architecture {cited}")


def check_links():
    for path in git_files("*.md"):
        text = re.sub(r"```.*?```", "", path.read_text(), flags=re.S)
        for target in re.findall(r"\]\(\s*([^)\s]+)\s*\)", text):
            if re.match(r"[a-z]+:|#", target):
                continue
            check((path.parent / target.split("#")[0]).exists(), f"{path.relative_to(ROOT)}: the link {target} leads nowhere")


@cache
def parameters():
    """Every section of docs/robot.yaml and every parameter in it, as section.part.key."""
    found = set()
    path = []
    for line in (ROOT / "docs/robot.yaml").read_text().splitlines():
        if key := re.match(r"( *)(\w+):(?: |$)", line):
            path = [*path[:len(key[1]) // 2], key[2]]
            found.add(".".join(path))
    return found


def check_parameters():
    """A document names a parameter as `section.key`, perhaps with its value behind a colon."""
    check(len(parameters()) > 300, "docs/robot.yaml has lost its parameters")
    for path in git_files("*.md"):
        if path.name == "CHANGELOG.md" or path.parent.name == "decisions":  # they speak of what was, too
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            for name in re.findall(r"`([a-z]\w*(?:\.[a-z]\w*)+)(?:: [^`]*)?`", line):
                if name.split(".")[0] in parameters() and not Path(name).suffix in FILES:
                    check(name in parameters(), f"{path.relative_to(ROOT)}:{number}: docs/robot.yaml has no `{name}`")


check_papers()
check_readmes()
check_parameters()
check_agreements()
check_links()
sys.exit(report())
