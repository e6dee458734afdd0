"""The file of cases: JSON that people write and ``gbnbench check --update`` completes."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from importlib import resources
from pathlib import Path
from typing import Any, NoReturn, cast, get_args

from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import FormatError, InputError
from gbnbench.core.settings import nearest
from gbnbench.generators.registry import find
from gbnbench.regression.cases import Better, Case, Expectation, Scale, Spread, Values
from gbnbench.regression.measurement import NAMES, lattice

FORMAT = 1
CASE_KEYS = (
    "name", "kind", "full", "generator", "n", "d", "seed", "realizations", "sigma", "precision", "measures",
)  # fmt: skip
OWN_KEYS = {  # of one kind only
    "sets": ("generator", "realizations"),
    "field": ("sigma", "precision"),
    "lattice": ("precision",),
}
MEASURE_KEYS = ("better", "scale", "reason", "expected", "tolerance", "spread", "reference")


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
    return _Reader(path).cases(content)


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


def select(cases: Sequence[Case], only: Sequence[str], full: bool) -> tuple[Case, ...]:
    """Choose cases: those named, or those of the default run, or with ``full`` all.

    Parameters
    ----------
    cases : sequence of Case
        To choose from.
    only : sequence of str
        Names; none leaves the choice to ``full``.
    full : bool
        Choose all, not only those of the default run.

    Returns
    -------
    tuple of Case

    Raises
    ------
    InputError
        If a name is none of theirs.
    """
    names = [case.name for case in cases]
    for name in only:
        if name not in names:
            raise InputError(f"no case is named {name!r}{nearest(name, names)}; there are {', '.join(names)}")
    if only:
        return tuple(case for case in cases if case.name in only)
    return tuple(case for case in cases if full or not case.full)


class _Reader:
    """Reads one file and says of every fault where it stands."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._where = ""

    def _refuse(self, text: str) -> NoReturn:
        raise FormatError(self._path, f"{self._where}{text}; docs/check.md tells what a case holds")

    def cases(self, content: object) -> tuple[Case, ...]:
        if not isinstance(content, dict) or not isinstance(content.get("cases"), list):
            self._refuse('is not a file of cases: it must read {"format": 1, "cases": [...]}')
        if content.get("format") != FORMAT:
            self._refuse(f"has format {content.get('format')!r}; this version reads {FORMAT}")
        found: list[Case] = []
        for k, entry in enumerate(content["cases"]):
            self._where = f"case {k + 1}: "
            case = self._case(entry)
            if case.name in {other.name for other in found}:
                self._refuse("has a name that another case has")
            found.append(case)
        return tuple(found)

    def _case(self, entry: object) -> Case:
        if not isinstance(entry, dict):
            self._refuse(f"must be an object; got {entry!r:.40}")
        name = entry.get("name")
        if not (isinstance(name, str) and name):
            self._refuse(f"name must be a text; got {name!r:.40}")
        self._where = f"case {name!r}: "
        kind = entry.get("kind")
        if kind not in OWN_KEYS:
            self._refuse(f"kind must be one of {', '.join(OWN_KEYS)}; got {kind!r:.40}")
        other = {key for keys in OWN_KEYS.values() for key in keys} - set(OWN_KEYS[kind])
        self._known(entry, [key for key in CASE_KEYS if key not in other])
        case = Case(
            name=name,
            kind=kind,
            n=self._whole(entry, "n", None, 1),
            d=self._whole(entry, "d", None, 1),
            full=self._truth(entry, "full"),
            seed=self._whole(entry, "seed", 0, 0),
            realizations=self._whole(entry, "realizations", 1, 1),
            generator=str(entry.get("generator", "")),
            sigma=self._positive(entry, "sigma", 1.0),
            precision=str(entry.get("precision", "double")),
        )
        if case.precision not in ("double", "float"):
            self._refuse(f"precision must be double or float; got {case.precision!r:.40}")
        self._servable(case)
        measures = entry.get("measures")
        if not isinstance(measures, dict) or not measures:
            self._refuse('measures must be an object of measures, such as {"noise_floor": {...}}')
        read: dict[str, Expectation] = {}
        for measure, given in measures.items():
            self._where = f"case {name!r}: measure {measure!r}: "
            if measure not in NAMES[kind]:
                near = nearest(measure, NAMES[kind])
                self._refuse(f"a case of {kind} has no such measure{near}; it has {', '.join(NAMES[kind])}")
            read[measure] = self._expectation(given)
        return Case(**{**vars(case), "measures": read})

    def _servable(self, case: Case) -> None:
        try:
            if case.kind == "sets":
                if reason := find(case.generator).refusal(case.n, case.d):
                    self._refuse(reason)
            elif case.kind == "lattice":
                lattice(case.n, case.d)
        except FormatError:
            raise
        except InputError as error:
            self._refuse(str(error))

    def _expectation(self, entry: object) -> Expectation:
        if not isinstance(entry, dict):
            self._refuse(f"must be an object; got {entry!r:.40}")
        self._known(entry, MEASURE_KEYS)
        better, scale = entry.get("better"), entry.get("scale")
        if better not in get_args(Better):
            self._refuse(f"better must be one of {', '.join(get_args(Better))}; got {better!r:.40}")
        if scale not in get_args(Scale):
            self._refuse(f"scale must be one of {', '.join(get_args(Scale))}; got {scale!r:.40}")
        reason, reference = entry.get("reason"), entry.get("reference", "")
        if not (isinstance(reason, str) and reason.strip()):
            self._refuse("reason must say why the tolerance is what it is")
        if not isinstance(reference, str):
            self._refuse(f"reference must be a text; got {reference!r:.40}")
        expected = self._values(entry)
        if scale == "ratio" and not all(value > 0 for value in expected):
            self._refuse("a ratio needs an expected value above 0; scale may be difference")
        if scale == "relative" and expected and not any(expected):
            self._refuse("a relative departure needs an expected value other than 0; scale may be difference")
        if len(expected) > 1 and scale == "ratio":
            self._refuse("a ratio is of one value; scale may be relative")
        if reference and not expected:
            self._refuse("what has a reference needs its expected value")
        least = 1.0 if scale == "ratio" else 0.0
        tolerance = self._positive(entry, "tolerance", None if expected else 1.0)
        if expected and not tolerance > least:
            self._refuse(f"tolerance must be above {least:g}; got {tolerance}")
        if expected and not reference and "spread" not in entry:
            self._refuse("must have a spread (from gbnbench check --update) or a reference (from elsewhere)")
        return Expectation(
            better=cast(Better, better),
            scale=cast(Scale, scale),
            reason=reason,
            expected=expected,
            tolerance=tolerance if expected else 0.0,
            spread=self._spread(entry["spread"]) if "spread" in entry else None,
            reference=reference,
        )

    def _values(self, entry: Mapping[str, Any]) -> Values:
        given = entry.get("expected", [])
        values = given if isinstance(given, list) else [given]
        if not all(_is_number(value) for value in values):
            self._refuse(f"expected must be a finite number or a list of them; got {given!r:.40}")
        return tuple(float(value) for value in values)

    def _spread(self, entry: object) -> Spread:
        if not isinstance(entry, dict) or set(entry) != {"seeds", "deviation"}:
            self._refuse('spread must read {"seeds": ..., "deviation": ...}')
        deviation = entry["deviation"]
        if not _is_number(deviation) or deviation < 0:
            self._refuse(f"deviation of spread must be a number of 0 or more; got {deviation!r:.40}")
        return Spread(self._whole(entry, "seeds", None, 2), float(deviation))

    def _known(self, entry: Mapping[str, Any], keys: Sequence[str]) -> None:
        for key in entry:
            if key not in keys:
                self._refuse(f"has an unknown key {key!r}{nearest(key, keys)}; it may have {', '.join(keys)}")

    def _whole(self, entry: Mapping[str, Any], key: str, default: int | None, least: int) -> int:
        value = entry.get(key, default)
        if not isinstance(value, int) or isinstance(value, bool) or value < least:
            self._refuse(f"{key} must be a whole number >= {least}; got {value!r:.40}")
        return value

    def _positive(self, entry: Mapping[str, Any], key: str, default: float | None) -> float:
        value = entry.get(key, default)
        if not _is_number(value) or not value > 0:
            self._refuse(f"{key} must be a number above 0; got {value!r:.40}")
        return float(value)

    def _truth(self, entry: Mapping[str, Any], key: str) -> bool:
        value = entry.get(key, False)
        if not isinstance(value, bool):
            self._refuse(f"{key} must be true or false; got {value!r:.40}")
        return value


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


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
