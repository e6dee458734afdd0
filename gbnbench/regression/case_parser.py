"""Cases out of parsed JSON: every fault is told with its file, its case and the key where it stands."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NoReturn, cast, get_args

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


class CaseParser:
    """Parses the content of one file of cases.

    Parameters
    ----------
    path : Path
        The file, for messages.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._where = ""

    def _refuse(self, text: str) -> NoReturn:
        raise FormatError(self._path, f"{self._where}{text}; docs/check.md tells what a case holds")

    def cases(self, content: object) -> tuple[Case, ...]:
        """Return the cases that the JSON of the whole file stands for.

        Raises
        ------
        FormatError
            If a key is missing, unknown or wrong; the text says of which case, and what is expected there.
        """
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
