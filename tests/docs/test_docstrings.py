"""Docstrings are whole: public functions document their arguments, and modules open with a statement."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

from tests.paths import ROOT

FOLDERS = ("gbnbench", "analysis", "generators", "reports", "benchmarks")
LINKS = tuple(ROOT / "gbnbench" / folder for folder in FOLDERS[1:])
MODULES = sorted(
    path
    for folder in FOLDERS
    for path in (ROOT / folder).rglob("*.py")
    if not any(link in path.parents for link in LINKS)
)
QUESTION = re.compile(r"(What|Which|How|Whether|Where|Who|Why)\b")
INHERITED = re.compile(
    r"(those of ``[\w.]+|as ``[A-Z]\w+\.\w+)``"
)  # refers to a function or method that says it
Function = ast.FunctionDef | ast.AsyncFunctionDef


def name_of(decorator: ast.expr) -> str:
    """Last name of a decorator, such as ``property`` or ``command``."""
    node = decorator.func if isinstance(decorator, ast.Call) else decorator
    return node.attr if isinstance(node, ast.Attribute) else getattr(node, "id", "")


def public_functions(body: list[ast.stmt], prefix: str = "") -> list[tuple[str, Function]]:
    """Public functions and methods, those of commands and overloads left out."""
    found: list[tuple[str, Function]] = []
    for node in body:
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            found += public_functions(node.body, f"{node.name}.")
        elif isinstance(node, Function) and not node.name.startswith("_"):
            names = {name_of(decorator) for decorator in node.decorator_list}
            if not names & {"command", "group", "overload", "callback", "override"}:
                found.append((prefix + node.name, node))
    return found


def arguments(function: Function) -> list[str]:
    """Names of the arguments, without self and cls."""
    a = function.args
    names = [x.arg for x in (*a.posonlyargs, *a.args, *a.kwonlyargs)]
    names += [x.arg for x in (a.vararg, a.kwarg) if x is not None]
    return [name for name in names if name not in ("self", "cls")]


def section(text: str, title: str) -> str | None:
    """Text of a numpydoc section, None where there is none."""
    match = re.search(rf"^ *{title}\n *-{{3,}}\n(.*?)(?=^ *\w[\w ]*\n *-{{3,}}\n|\Z)", text, re.M | re.S)
    return match.group(1) if match else None


def faults(path: Path) -> list[str]:
    """Everything that is missing from the docstrings of a module."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    opening = ast.get_docstring(tree) or ""
    found = [] if opening else ["the module has no docstring"]
    if QUESTION.match(opening):
        found.append(f"the module opens with a question: {opening.splitlines()[0]}")
    for name, function in public_functions(tree.body):
        text = ast.get_docstring(function)
        if text is None:
            found.append(f"{name} has no docstring")
            continue
        if INHERITED.search(text):
            continue
        names = arguments(function)
        described = section(text, "Parameters")
        if len(names) > 1 and described is None:
            found.append(f"{name} lacks Parameters")
        if described is not None:
            found += [
                f"{name} does not describe {argument}"
                for argument in names
                if not re.search(rf"^ *(?:\*{{0,2}}\w+, )*\*{{0,2}}{argument}\b[^\n]*$", described, re.M)
            ]
        returns = ast.unparse(function.returns) if function.returns else "None"
        gives = returns not in ("None", "NoReturn", "Self") and len(names) > 1
        if gives and section(text, "Returns") is None and section(text, "Yields") is None:
            found.append(f"{name} lacks Returns")
    return found


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(ROOT)))
def test_docstrings_are_whole(path):
    assert faults(path) == []
