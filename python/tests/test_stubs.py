"""The type stubs name exactly what the module has."""
import ast
import inspect
import re
from pathlib import Path

import docent
from docent import _docent

STUB = ast.parse(Path(docent.__file__).with_name("_docent.pyi").read_text())
OF_PYBIND11 = {"__init__", "__hash__", "__repr__"}  # or not part of a type


def members(nodes):
    """Names that stand in a stub, with the functions of each."""
    found = {}
    for node in nodes:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found.setdefault(node.name, []).append(node)
        elif isinstance(node, ast.AnnAssign):
            found.setdefault(node.target.id, []).append(node)
    return {name: found[name] for name in found if not re.match(r"_[^_]", name)}


def names_of(things):
    return {name for name in things if not name.startswith("_") or (name.startswith("__") and callable(things[name]))}


def arguments_of(function):
    """Of the C++ function, as pybind11 writes them; None of one with overloads."""
    signature = function.__doc__.splitlines()[0]
    if signature.endswith("(*args, **kwargs)"):
        return None
    inside, depth, parts = signature[signature.index("(") + 1:signature.rindex(")")], 0, [""]
    for letter in inside:
        depth += (letter in "([{") - (letter in ")]}")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip().split(":")[0] for part in parts if part.strip() not in {"", "*"}]


def arguments_in(node):
    return [one.arg for one in [*node.args.args, *node.args.kwonlyargs]]


def test_names_of_the_module():
    assert set(members(STUB.body)) == names_of(vars(_docent))


def test_members_of_the_classes():
    for name, (node,) in members(STUB.body).items():
        thing = getattr(_docent, name)
        assert inspect.isclass(thing) == isinstance(node, ast.ClassDef), name
        if inspect.isclass(thing):
            assert set(members(node.body)) - OF_PYBIND11 == names_of(vars(thing)) - OF_PYBIND11, name
            # pybind11 gives each class an __init__, which refuses where C++ has none
            assert ("__init__" in members(node.body)) == (type(thing.__init__) is not type(Simple.__init__)), name


Simple = _docent.Verdict  # a class without a constructor


def test_arguments():
    checked = 0
    for name, (node, *_) in members(STUB.body).items():
        of_class = members(node.body) if isinstance(node, ast.ClassDef) else {}
        for function, nodes in [(name, [node])] if not of_class else of_class.items():
            thing = getattr(getattr(_docent, name), function) if of_class else getattr(_docent, name)
            if not isinstance(nodes[0], ast.FunctionDef) or isinstance(thing, property) or function.startswith("__eq"):
                continue
            wanted = arguments_of(thing)
            if len(nodes) > 1 or wanted is None or wanted == ["self", "**kwargs"]:
                continue
            given = arguments_in(nodes[0])
            if function in {"__lt__", "__le__"}:
                given[1:] = wanted[1:]
            assert given == wanted, f"{name}.{function}"
            checked += 1
    assert checked > 80


def test_all_is_exported():
    assert names_of(vars(_docent)) | {"Error", "Simulation", "find_program", "simulate"} == set(docent.__all__)


def test_every_class_and_function_says_what_it_is():
    for name in members(STUB.body):
        thing = getattr(_docent, name)
        if callable(thing):
            assert thing.__doc__, name
