"""Tables as JSON: a list of objects, a row each, in which an undefined number is null."""

from __future__ import annotations

import json
import math
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd


def json_text(content: object) -> str:
    """Return content as indented JSON; numbers that are not finite become null, tables lists of rows."""
    plain = _plain(content)
    text = json.dumps(plain, indent=2, ensure_ascii=False, allow_nan=False)
    try:
        text.encode(getattr(sys.stdout, "encoding", None) or "utf-8")
    except UnicodeEncodeError:  # the odd bytes of a file's name, or an encoding of few signs
        return json.dumps(plain, indent=2, allow_nan=False)
    return text


def records(table: pd.DataFrame) -> list[dict[str, Any]]:
    """Return the rows of a table, each with the names of its columns."""
    return [{str(name): value for name, value in row.items()} for row in table.to_dict(orient="records")]


def _plain(value: Any) -> Any:
    """Return what json can write, from numbers of numpy, tables and paths too."""
    if isinstance(value, dict):
        return {str(name): _plain(inner) for name, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(inner) for inner in value]
    if hasattr(value, "to_dict"):
        return _plain(records(value))
    if hasattr(value, "tolist"):  # an array or a number of numpy
        return _plain(value.tolist())
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value if value is None or isinstance(value, (bool, int, str)) else str(value)
