#!/usr/bin/env python3
"""How large folders, files, functions and modules may be.

The functions of C++ are found by clang-format's layout: the brace of a body has a space before it, that of a value has
none or stands behind "=". A function begins with its template, attributes or type and ends with its last brace; lambdas
count with the function that holds them. A module is a thin coat: of its class the data members are counted, which are
the names with a "_" at the end that are declared in the class itself.
"""
import ast
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True  # the work tree stays as it was
from findings import check, report  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
FILES_OF_FOLDER = 30
LINES_OF_FILE = 450
LINES_OF_FUNCTION = 60
MEMBERS_OF_MODULE = 15
CPP = {".h", ".cpp", ".inc"}
PAGE = {".ts", ".svelte"}
READ = {"include": CPP, "src": CPP, "tests": CPP | {".py"}, "web/src": PAGE, "scripts": {".py"}, "python": CPP | {".py"},
        "examples": CPP | {".py"}}

# What may be larger, and why: a folder, a file, "file: function", or "file: class" of a module.
EXCEPTIONS = {
    "web/src/contract/contract.ts": "written by docent_web_contract, not by hand",
}


def without_text(code):
    """C++ in which comments, strings, characters and the preprocessor's lines are blank; every line keeps its place."""
    token = re.compile(
        r'//[^\n]*|/\*.*?\*/|R"(?P<mark>\w*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|(?<!\w)(?:u8|u|U|L)?\'(?:\\.|[^\'\\\n])+\''
        r"|^[ \t]*#(?:\\\n|[^\n])*", re.S | re.M)

    def blank(match):
        kept = "\n" * match[0].count("\n")
        return kept if match[0].lstrip()[0] in "/#" else '""' + kept
    return token.sub(blank, code)


def name_of(head):
    """Of a function, as a reader would look for it: "McapReader::read", "TEST(Pose2, Turns)"."""
    if test := re.match(r"(TEST\w*|RC_GTEST\w*)\(([^)]*)\)", head):
        return f"{test[1]}({' '.join(test[2].split())})"
    before = "operator()" if "operator()" in head else re.split(r"\(| = \[", head)[0]
    return before.split()[-1].lstrip("*&")


def cpp_functions(code):
    """(name, first line, last line) of every function. Raises ValueError where the braces do not match."""
    found, scopes = [], []  # a scope: "scope" (a namespace, a block), "value", or (name, first line) of a function
    head, begun, depth, line = "", 0, 0, 1  # head: what stands since the last statement, outside of any function
    inside = 0  # functions around
    for i, c in enumerate(code):
        if c == "{":
            is_value = "value" in scopes or code[i - 1] not in " \n" or re.search(r"(=|,|return)\s*$", code[max(0, i - 80):i])
            is_scope = not is_value and re.search(r"\b(namespace|struct|class|union|enum|extern)\b[^()=]*$",
                                                  re.sub(r"\b(alignas|requires) ?\([^()]*\)", "", head))
            if inside == 0 and not is_value and not is_scope and ("(" in head or "[" in head):
                scopes.append((name_of(head), begun))
                inside += 1
            else:
                scopes.append("value" if is_value else "scope")
                if inside == 0 and not is_value:
                    head = ""
        elif c == "}":
            if not scopes:
                raise ValueError(f"line {line}: a brace closes nothing")
            scope = scopes.pop()
            if isinstance(scope, tuple):
                found.append((*scope, line))
                inside -= 1
            if inside == 0 and scope != "value":
                head = ""
        elif inside == 0:
            depth += (c == "(") - (c == ")")
            if c == ";" and depth == 0 and "value" not in scopes:
                head = ""
            elif not c.isspace() or head:
                begun = begun if head else line
                head += c
                if head in {"public:", "private:", "protected:"}:
                    head = ""
        line += c == "\n"
    if scopes:
        raise ValueError(f"{len(scopes)} braces stay open")
    return found


def without_parentheses(code):
    while re.search(r"\([^()]*\)", code):
        code = re.sub(r"\([^()]*\)", "", code)
    return code


def data_members(code, begin):
    """The names of the data members of the class whose brace opens at `begin`."""
    names, head, scopes = [], "", []  # head: what stands in the class itself since the last statement
    for i in range(begin, len(code)):
        c = code[i]
        if c == "{":
            is_value = "=" in re.sub(r"operator\W+", "", without_parentheses(head)) or code[i - 1] not in " \n"
            scopes.append("value" if is_value or "(" not in head or len(scopes) != 1 else "function")
        elif c == "}":
            head = "" if scopes.pop() == "function" else head
            if not scopes:
                return names
        elif len(scopes) == 1 and c == ";" and head.count("(") == head.count(")"):
            names += re.findall(r"\b[A-Za-z]\w*_(?!\w)", re.sub(r"=[^,]*", "", without_parentheses(head)))
            head = ""
        elif len(scopes) == 1:
            head += c
    raise ValueError("a class stays open")


def fat_modules(path):
    """(class, number of data members) of each module in the file that has more than it may have."""
    code = without_text(path.read_text())
    members = [(found[1], len(data_members(code, found.end() - 1)))
               for found in re.finditer(r"^[ \t]*class (\w*Module)\b[^;{()]*\{", code, re.M)]
    return [(name, count) for name, count in members if count > MEMBERS_OF_MODULE]


def python_functions(code):
    return [(node.name, min([node.lineno, *(d.lineno for d in node.decorator_list)]), node.end_lineno)
            for node in ast.walk(ast.parse(code)) if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))]


def page_functions(code):
    """Of TypeScript, by prettier's layout: a function's last brace stands under the begin of its first line."""
    lines = code.splitlines()
    found = []
    for first, line in enumerate(lines):
        begin = re.match(r"(\s*)(?:export )?(?:default )?(?:async )?(?:function\*? (\w+)|(?:const|let) (\w+) = .*|"
                         r"(?:private |public |static |async |get |set )*(\w+)\()", line)
        is_function = begin and (begin[2] or begin[4] or re.search(r"=> \{$|= (async )?(\w+)?\(\w*$", line))
        if not is_function or begin[4] in {"if", "for", "while", "switch", "catch", "return", "super"}:
            continue
        end = next((n for n in range(first, len(lines)) if re.match(rf"{begin[1]}\}}", lines[n]) or
                    (n > first and lines[n].strip() and len(lines[n]) - len(lines[n].lstrip()) < len(begin[1]))), None)
        if end is not None:
            found.append((begin[2] or begin[3] or begin[4], first + 1, end + 1))
    return found


def functions(path):
    code = path.read_text()
    if path.suffix in CPP:
        return cpp_functions(without_text(code))
    return python_functions(code) if path.suffix == ".py" else page_functions(code)


def too_large(root):
    """(what, size, limit) of all that is over its limit under the root; `what` as in EXCEPTIONS."""
    large = []
    tops = [root / "src" / "docent", *(root / top for top in ("python", "examples") if (root / top).is_dir())]
    for folder in [folder for top in tops for folder in [top, *sorted(path for path in top.rglob("*") if path.is_dir())]]:
        files = sum(path.is_file() for path in folder.iterdir())
        if files > FILES_OF_FOLDER:
            large.append((folder.relative_to(root).as_posix(), f"{files} files", FILES_OF_FOLDER))
    for top, kinds in READ.items():
        for path in sorted((root / top).rglob("*")):
            if path.suffix not in kinds or "node_modules" in path.parts:
                continue
            where = path.relative_to(root).as_posix()
            lines = len(path.read_text().splitlines())
            if lines > LINES_OF_FILE:
                large.append((where, f"{lines} lines", LINES_OF_FILE))
            try:
                for name, first, last in functions(path):
                    if last - first + 1 > LINES_OF_FUNCTION:
                        large.append((f"{where}: {name}", f"{last - first + 1} lines", LINES_OF_FUNCTION))
                if path.suffix in CPP and path.is_relative_to(root / "src/docent/modules"):
                    for name, members in fat_modules(path):
                        large.append((f"{where}: {name}", f"{members} data members", MEMBERS_OF_MODULE))
            except (ValueError, SyntaxError) as error:
                large.append((where, f"functions that cannot be found ({error})", 0))
    return large


def check_sizes(root, exceptions):
    large = too_large(root)
    for what, size, limit in large:
        check(what in exceptions, f"{what} has {size}; at most {limit} are allowed")
    for what, reason in exceptions.items():
        check(reason.strip(), f"{what}: an exception without a reason")
        check(any(what == other for other, *_ in large), f"{what} is an exception and needs none any more")


if __name__ == "__main__":
    check_sizes(ROOT, EXCEPTIONS)
    sys.exit(report())
