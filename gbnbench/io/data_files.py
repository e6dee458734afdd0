"""Files of arrays, tables and settings (.npz, .csv, .json) that are read back to the last bit."""

from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, TypeVar

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.core.readable_text import without_bytes

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import NDArray

T = TypeVar("T")


def read_or_explain(path: Path, read: Callable[[Path], T]) -> T:
    """Read a file, turning whatever is wrong with it into one FormatError that names it.

    Parameters
    ----------
    path : Path
        The file.
    read : callable
        Reads it, given the path.

    Returns
    -------
    object
        What ``read`` returned.

    Raises
    ------
    FormatError
        If the file is missing or is not what gbnbench wrote.
    """
    try:
        return read(path)
    except FormatError:
        raise
    except FileNotFoundError:
        way_out = "put it back as it was, or make the run again in another folder"
        raise FormatError(path, f"is missing from the run: {way_out}") from None
    except (ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile) as error:
        raise FormatError(path, f"is not what gbnbench wrote ({type(error).__name__}: {error})") from error


def read_json(path: Path) -> dict[str, Any]:
    """Read a JSON object; raises FormatError naming the file."""
    return read_or_explain(path, lambda p: dict(json.loads(p.read_text(encoding="utf-8"))))


def to_json(content: object) -> bytes:
    """Indented UTF-8 JSON with a final newline; a file name's bytes that are no UTF-8 become escapes."""
    try:
        return (json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False) + "\n").encode()
    except UnicodeEncodeError:
        return (json.dumps(content, indent=2, allow_nan=False) + "\n").encode()


def to_npz(**arrays: NDArray[Any]) -> bytes:
    """Uncompressed .npz of the arrays."""
    buffer = io.BytesIO()
    np.savez(buffer, allow_pickle=False, **arrays)
    return buffer.getvalue()


def npz_writer(**arrays: NDArray[Any]) -> Callable[[IO[bytes]], None]:
    """Return what writes the bytes of ``to_npz`` into an open file, without holding them."""

    def write(file: IO[bytes]) -> None:
        np.savez(file, allow_pickle=False, **arrays)

    return write


def read_npz(path: Path) -> dict[str, NDArray[Any]]:
    """All arrays of an .npz, never pickles."""
    with path.open("rb") as file, np.load(file, allow_pickle=False) as stored:
        return {name: stored[name] for name in stored.files}


def to_csv(table: pd.DataFrame) -> bytes:
    """UTF-8 CSV whose floats are the shortest that read back the same."""
    text: str = table.to_csv(index=False, lineterminator="\n", na_rep="nan")
    return without_bytes(text).encode()


def read_csv(path: Path, text: Sequence[str] = ()) -> pd.DataFrame:
    """Read a table of numbers exactly as it was written.

    Parameters
    ----------
    path : Path
        The file.
    text : sequence of str
        Columns that stay text.

    Returns
    -------
    DataFrame
        Columns of whole numbers are int64, the others float64.

    Notes
    -----
    Numbers are parsed by Python: the precision of pandas' own parser depends on its version.
    """
    import pandas as pd

    texts = pd.read_csv(path, dtype=str, keep_default_na=False)
    return pd.DataFrame(
        {name: column if name in text else _numbers(column.tolist()) for name, column in texts.items()}
    )


def _numbers(texts: list[str]) -> NDArray[Any]:
    try:
        return np.array([int(text) for text in texts], dtype=np.int64 if texts else np.float64)
    except ValueError:
        return np.array([float(text) for text in texts])
