"""The file of cases: JSON that people write and ``gbnbench check --update`` completes."""

from __future__ import annotations

import json
from collections.abc import Iterable
from importlib import resources
from pathlib import Path
from typing import Any

from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import FormatError
from gbnbench.regression.case_parser import CASE_KEYS, FORMAT, CaseParser
from gbnbench.regression.cases import Case, Expectation


def default_path() -> Path:
    """Where the cases that gbnbench brings stand."""
    return Path(str(resources.files("gbnbench.regression") / "cases.json"))


def read_cases(path: Path) -> tuple[Case, ...]:
    """Read a file of cases.

    Raises
    ------
    FormatError
        If it is absent or no such file; the text says which line, or which key of which case, and what is
        expected there.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise FormatError(path, "does not exist; leave out --cases to use those of gbnbench") from None
    except IsADirectoryError:
        raise FormatError(path, "is a folder; give a file of cases") from None
    except UnicodeDecodeError:
        raise FormatError(path, "is not UTF-8 text; a file of cases is JSON, see docs/check.md") from None
    except json.JSONDecodeError as error:
        raise FormatError(path, f"is not JSON: {error.msg} (column {error.colno})", error.lineno) from None
    return CaseParser(path).cases(content)


def write_cases(path: Path, cases: Iterable[Case]) -> None:
    """Write a file of cases, whole or not at all.

    Parameters
    ----------
    path : Path
        The file.
    cases : iterable of Case
        Its content, in this order.

    Raises
    ------
    OSError
        If the place cannot be written.
    """
    content = {"format": FORMAT, "cases": [_case_to_json(case) for case in cases]}
    write_whole(path, (_text(content) + "\n").encode())


def _case_to_json(case: Case) -> dict[str, Any]:
    blank = Case("", "", 0, 0)
    entry: dict[str, Any] = {}
    for key in CASE_KEYS:
        value = getattr(case, key)
        always = key in ("name", "kind", "n", "d") or (key == "seed" and case.kind != "lattice")
        if key == "measures":
            entry[key] = {name: _expectation_to_json(value[name]) for name in value}
        elif always or value != getattr(blank, key) or (key == "precision" and case.kind != "sets"):
            entry[key] = value
    return entry


def _expectation_to_json(expectation: Expectation) -> dict[str, Any]:
    entry: dict[str, Any] = {"better": expectation.better, "scale": expectation.scale}
    values = expectation.expected
    if values:
        entry |= {"expected": values[0] if len(values) == 1 else list(values)}
        entry |= {"tolerance": expectation.tolerance}
    if expectation.spread:
        entry["spread"] = {"seeds": expectation.spread.seeds, "deviation": expectation.spread.deviation}
    if expectation.reference:
        entry["reference"] = expectation.reference
    return {**entry, "reason": expectation.reason}


def _text(value: object, indent: str = "") -> str:
    """JSON with an object's entries on lines of their own, but numbers and spreads together on one."""
    if isinstance(value, dict) and not set(value) <= {"seeds", "deviation"}:
        inner = indent + "  "
        rows = [f"{inner}{json.dumps(key)}: {_text(item, inner)}" for key, item in value.items()]
        return "{\n" + ",\n".join(rows) + f"\n{indent}}}"
    if isinstance(value, list) and any(isinstance(item, dict) for item in value):
        inner = indent + "  "
        return "[\n" + ",\n".join(inner + _text(item, inner) for item in value) + f"\n{indent}]"
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
