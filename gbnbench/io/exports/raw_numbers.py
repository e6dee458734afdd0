"""Numbers alone, lowest byte first, and a JSON file beside them that says what they are."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray


def side_file(path: Path) -> Path:
    """Return the place of the description of a binary file: its name with .json behind."""
    return path.with_name(f"{path.name}.json")


def raw_numbers(path: Path, values: NDArray[Any], about: Mapping[str, Any]) -> dict[Path, bytes]:
    """Make the bytes of a binary file and of its description.

    Parameters
    ----------
    path : Path
        Of the binary file.
    values : (...) array
        Written in C order, the last axis fastest, without a header.
    about : mapping
        JSON-ready; what else the description says.

    Returns
    -------
    dict of Path to bytes
        The description first: numbers never stand without theirs.
    """
    data = np.ascontiguousarray(values, values.dtype.newbyteorder("<")).tobytes()
    layout = {
        "file": path.name,
        "dtype": str(values.dtype),
        "byte_order": "little",
        "shape": list(values.shape),
        "order": "C: the last axis moves fastest",
        "sha256": hashlib.sha256(data).hexdigest(),
    }
    return {side_file(path): json.dumps({**layout, **about}, indent=1).encode() + b"\n", path: data}
