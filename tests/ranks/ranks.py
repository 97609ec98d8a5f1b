#!/usr/bin/python3
"""Every verb of the Web against everybody, at a gateway that runs: the table of docs/security.md.

  tests/ranks/ranks.py [--write]

The verbs come from what the program says of itself (docs/openapi.json, tests/web_contract/client.json, docs/web-protocol.md), what is expected from
policy.py. A cell that is not as expected fails, as does a verb without an expectation, and a table in docs/security.md that is not what was seen.
--write writes that table. $DOCENT_BINARY: another program than build/dev/bin/docent.
"""
import argparse
import re
import sys
import time

sys.dont_write_bytecode = True
import attempts  # noqa: E402
import calls  # noqa: E402
import callers  # noqa: E402
import lines  # noqa: E402
import policy  # noqa: E402
from stage import ROOT, Stage, log_in  # noqa: E402
from wire import KeyHolder  # noqa: E402

DOCUMENT = ROOT / "docs" / "security.md"
BEGIN, END = "<!-- begin: tests/ranks/ranks.py --write -->", "<!-- end -->"


def documents_said():
    """The paths of docs/web-protocol.md, and those of the code."""
    table = (ROOT / "docs/web-protocol.md").read_text().split("## Documents")[1].split("A WebSocket at")[0]
    said = {path for line in re.findall(r"^\| (`.*?) \|", table, flags=re.M) for path in re.findall(r"`(/[^`]*)`", line)}
    code = set()
    for source in (ROOT / "src/docent/modules/web").rglob("*"):
        if source.suffix in (".h", ".cpp") and not source.stem.endswith("_test"):
            code |= set(re.findall(r'"(/(?:api|camera|metrics)[^"%]*)"', source.read_text()))
    return said, code


def faults_of_documents():
    said, code = documents_said()
    return [f"docs/web-protocol.md: {path} has no expectation" for path in sorted(said - policy.DOCUMENTS.keys())] + [
        f"{path} has no expectation" for path in sorted(code - policy.DOCUMENTS.keys())] + [
        f"docs/web-protocol.md does not name {path}" for path in sorted(policy.DOCUMENTS.keys() - said - {"/audio/HASH.wav"})]


def see(stage):
    """All tables: title -> {row: {column: (expected, seen)}}; and the single attempts."""
    started = time.monotonic()
    everybody = calls.everybody(stage)
    gone = [(one.name, one.browser) for one in everybody if "logged out" in one.name or "account is gone" in one.name or "new password" in one.name or "moderator now" in one.name]
    rest = calls.rows_of(everybody)
    messages, doors, documents = lines.message_rows(stage), lines.door_rows(stage, gone), attempts.documents(stage)
    single = {**attempts.names(stage), **attempts.cookies(stage), **lines.lines_that_end(stage), **attempts.stops(stage)}
    count, wrong = calls.what_is_not_there(log_in(stage.port, "ada"))
    single["a method or path that /api/v1 has not, by an operator"] = ("404 or 405", "404 or 405" if not wrong else "; ".join(wrong))
    single.update(attempts.second_holder(stage))
    by_key(stage, rest, messages, single)
    single.update(without_trace(stage))
    print(f"{time.monotonic() - started:.1f} s, {count} calls that are not there")
    return {"Calls": rest, "Messages": messages, "Lines": doors, "Documents": documents}, single


def by_key(stage, rest, messages, single):
    """The gateway far away ends, and somebody takes its place."""
    stage.far_gateway.end()
    operator, visitor = log_in(stage.port, "ada"), attempts.visitor_of(stage)
    line = KeyHolder(stage.uplink_port, stage.key)
    end = time.monotonic() + 10.0
    while not line.is_in and time.monotonic() < end:  # the museum holds the old line for a while
        line.close()
        time.sleep(0.3)
        line = KeyHolder(stage.uplink_port, stage.key)
    for row, cells in calls.rows_of(callers.key_holders(operator, visitor), line).items():
        rest[row].update(cells)
    operator = log_in(stage.port, "ada")
    for row, cells in lines.key_holder_rows(stage, line).items():
        messages[row].update(cells)
    single.update(attempts.key_holder(line, operator))
    line.close()


def without_trace(stage):
    """That nothing was done by those who were refused: what the audit log and the shown operation say."""
    operator = log_in(stage.port, "ada")
    done = {}
    before = ""
    while True:
        page = operator.call("GET", "/api/v1/audit" + (f"?before={before}" if before else "")).json()
        for line in page["lines"]:
            done.setdefault(line["what"], set()).add(line["who"])
        before = page.get("next", "")
        if not before:
            break
    verbs = {verb.name for verb in calls.verbs()}
    cells = {"operators' calls in the audit log that nobody had a right to": ("none", ", ".join(sorted(verbs & done.keys() - {"login"})) or "none")}
    cells["hours set, by others than operators on /operate"] = ("none", ", ".join(sorted(done.get("hours", set()) - {"ada"})) or "none")
    cells["stops pressed and leases taken, by others"] = ("none", ", ".join(sorted(who for who in done.get("stop", set()) | done.get("lease", set())
                                                                           if who != "ada" and not who.startswith("gone-"))) or "none")
    return cells


def grouped(rows):
    """Columns of which all cells are the same are one: [(names, {row: cell})]."""
    names = list(dict.fromkeys(name for cells in rows.values() for name in cells))
    groups = {}
    for name in names:
        column = tuple(rows[row][name][1] if name in rows[row] else "" for row in rows)
        groups.setdefault(column, []).append(name)
    return [(found, dict(zip(rows, column))) for column, found in groups.items()]


def table_of(title, rows):
    groups = grouped(rows)
    text = [f"{title}:", "", f"| | {' | '.join(str(i) for i in range(1, len(groups) + 1))} |", "|---|" + "---|" * len(groups)]
    for row in rows:
        text.append(f"| {row} | " + " | ".join("**yes**" if cells[row] == "yes" else cells[row] for _, cells in groups) + " |")
    text.append("")
    text += [f"{i}. {in_short(names)}" for i, (names, _) in enumerate(groups, 1)]
    return "\n".join(text)


def in_short(names):
    """What begins alike is said once."""
    found = {}
    for name in names:
        beginning = next((one for one in ("an operator who calls the robot ", "an operator's page of ") if name.startswith(one)), "")
        found.setdefault(beginning or name, []).append(name[len(beginning):])
    return "; ".join(beginning + ", ".join(ends) if beginning not in ends else beginning for beginning, ends in found.items())


TITLES = {
    "Calls": "Calls of `/api/v1`. **yes**: it gets as far as what it asks for; else the word with which it is refused (421: by its name)",
    "Messages": "Messages on a line, by whom it belongs to. 1008: the line is closed, and nothing is done",
    "Lines": "Which lines they can open (`/uplink`: without its key)",
    "Documents": "Documents. 204, there is none yet, counts as yes",
}


def page_of(tables, single):
    parts = [table_of(TITLES[name], rows) for name, rows in tables.items()]
    parts.append("\n".join(["And what has no row there:", "", "| attempt | what comes of it |", "|---|---|", *(f"| {name} | {seen} |" for name, (_, seen) in single.items())]))
    return "\n\n".join(parts)


def judge(tables, single):
    faults, cells, refusals = [], 0, 0
    for name, rows in [*tables.items(), ("Attempts", {"": single})]:
        for row, columns in rows.items():
            for column, (expected, seen) in columns.items():
                cells += 1
                refusals += expected != "yes"
                if expected != seen:
                    faults.append(f"{name}: {row} {column}: {seen}, expected {expected}")
    return faults, cells, refusals


def in_document(text):
    head, rest = text.split(BEGIN)
    return head, rest.split(END)[0].strip(), rest.split(END, 1)[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help="write the table into docs/security.md")
    options = parser.parse_args()
    faults = calls.faults_of_policy() + lines.faults_of_policy() + faults_of_documents()
    stage = Stage()
    try:
        tables, single = see(stage)
    finally:
        stage.close()
    found, cells, refusals = judge(tables, single)
    faults += found
    page = page_of(tables, single)
    head, old, tail = in_document(DOCUMENT.read_text())
    if options.write:
        DOCUMENT.write_text(f"{head}{BEGIN}\n\n{page}\n\n{END}{tail}")
    elif old != page:
        faults.append("docs/security.md has another table: tests/ranks/ranks.py --write")
    if refusals < 400 or cells - refusals < 100:
        faults.append("too few cells")
    for fault in faults:
        print(f"FAILED  {fault}")
    print(f"{cells} cells, {refusals} of them refusals")
    print(f"{cells - len(found)} passed, {len(faults)} failed")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
