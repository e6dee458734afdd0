"""One source's results as files, and back: what is written is what is read, to the last bit."""

from __future__ import annotations

import io
import json
import math
import zipfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.core.results import Measures, RadialPower, Spectrum
from gbnbench.runs.comparison_result import SourceResult

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import NDArray

T = TypeVar("T")
TABLES = ("anisotropy", "rdf", "valence")
EXTREMES = {"nan": math.nan, "inf": math.inf, "-inf": -math.inf}


def encode(result: SourceResult) -> dict[str, bytes]:
    """Files of one source: names to contents.

    Parameters
    ----------
    result : SourceResult
        Everything measured of it.

    Returns
    -------
    dict of bytes
        ``source.json`` (labels, measures), ``points.npz``, ``spectrum.npz``, ``radial.csv``,
        ``anisotropy.csv`` and, where the source has them, ``rdf.csv``, ``valence.csv``, ``zone_plate.npz``.
    """
    spectrum = result.spectrum
    arrays: dict[str, NDArray[Any]] = {"power": spectrum.power}
    if spectrum.frequencies is not None:
        arrays["frequencies"] = spectrum.frequencies
    for name in (
        "n",
        "d",
        "realizations",
        "fmax",
        "precision",
        "method",
        "device",
        "error_rms",
        "error_bound",
    ):
        arrays[name] = np.asarray(getattr(spectrum, name))
    about = {
        "key": result.key,
        "label": result.label,
        "n": result.n,
        "d": result.d,
        "realizations": result.realizations,
        "cpu_seconds": _to_json(result.cpu_seconds),
        "warnings": list(result.warnings),
        "measures": _numbers_to_json(result.measures.measured),
        "standard_errors": _numbers_to_json(result.measures.standard_error),
        "reasons": dict(result.measures.reasons),
    }
    files = {
        "source.json": to_json(about),
        "points.npz": to_npz(points=result.points),
        "spectrum.npz": to_npz(**arrays),
        "radial.csv": to_csv(result.radial.to_frame()),
    }
    for name in TABLES:
        table = getattr(result, name)
        if table is not None:
            files[f"{name}.csv"] = to_csv(table)
    if result.zone_plate is not None:
        files["zone_plate.npz"] = to_npz(zone_plate=result.zone_plate)
    return files


def decode(folder: Path) -> SourceResult:
    """Read back what ``encode`` made.

    Raises
    ------
    FormatError
        If a file is missing or is not what was written, naming it.
    """
    about = reading(folder / "source.json", lambda path: dict(json.loads(path.read_text(encoding="utf-8"))))
    arrays = reading(folder / "spectrum.npz", read_npz)
    radial = reading(folder / "radial.csv", read_csv)
    tables = {
        name: reading(folder / f"{name}.csv", read_csv) if (folder / f"{name}.csv").exists() else None
        for name in TABLES
    }
    plate = folder / "zone_plate.npz"

    def build(_: Path) -> SourceResult:
        spectrum = Spectrum(
            power=arrays["power"],
            frequencies=arrays.get("frequencies"),
            n=int(arrays["n"]),
            d=int(arrays["d"]),
            realizations=int(arrays["realizations"]),
            fmax=int(arrays["fmax"]),
            precision=str(arrays["precision"]),
            method=str(arrays["method"]),
            device=str(arrays["device"]),
            error_rms=float(arrays["error_rms"]),
            error_bound=float(arrays["error_bound"]),
        )
        measures = Measures(
            _numbers_from_json(about["measures"]),
            _numbers_from_json(about["standard_errors"]),
            dict(about["reasons"]),
        )
        anisotropy = tables["anisotropy"]
        if anisotropy is None:
            raise FormatError(folder / "anisotropy.csv", "is missing from the run")
        return SourceResult(
            key=about["key"],
            label=about["label"],
            n=about["n"],
            d=about["d"],
            realizations=about["realizations"],
            points=reading(folder / "points.npz", read_npz)["points"],
            spectrum=spectrum,
            radial=RadialPower(*(radial[name].to_numpy() for name in ("frequency", "nu", "power", "count"))),
            anisotropy=anisotropy,
            rdf=tables["rdf"],
            valence=tables["valence"],
            zone_plate=reading(plate, read_npz)["zone_plate"] if plate.exists() else None,
            measures=measures,
            cpu_seconds=_from_json(about["cpu_seconds"]),
            warnings=tuple(about["warnings"]),
        )

    return reading(folder, build)


def reading(path: Path, read: Callable[[Path], T]) -> T:
    """Read a file, turning whatever is wrong with it into one FormatError that names it."""
    try:
        return read(path)
    except FormatError:
        raise
    except FileNotFoundError:
        raise FormatError(path, "is missing from the run") from None
    except (ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile) as error:
        raise FormatError(path, f"is not what gbnbench wrote ({type(error).__name__}: {error})") from error


def to_json(content: object) -> bytes:
    """Indented UTF-8 JSON with a final newline."""
    return (json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False) + "\n").encode()


def to_npz(**arrays: NDArray[Any]) -> bytes:
    """Uncompressed .npz of the arrays."""
    buffer = io.BytesIO()
    np.savez(buffer, allow_pickle=False, **arrays)
    return buffer.getvalue()


def read_npz(path: Path) -> dict[str, NDArray[Any]]:
    """All arrays of an .npz, never pickles."""
    with path.open("rb") as file, np.load(file, allow_pickle=False) as stored:
        return {name: stored[name] for name in stored.files}


def to_csv(table: pd.DataFrame) -> bytes:
    """UTF-8 CSV whose floats are the shortest that read back the same."""
    text: str = table.to_csv(index=False, lineterminator="\n", na_rep="nan")
    return text.encode()


def read_csv(path: Path, text: Sequence[str] = ()) -> pd.DataFrame:
    """Read a table of numbers: whole columns as int64, the rest as the float64 that were written.

    Columns named in ``text`` stay text.

    Notes
    -----
    How exactly pandas reads floats by itself depends on its version.
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


def _to_json(number: float) -> float | str:
    return float(number) if math.isfinite(number) else str(float(number))  # JSON has no nan


def _from_json(number: float | str) -> float:
    return EXTREMES[number] if isinstance(number, str) else float(number)


def _numbers_to_json(numbers: Mapping[str, float]) -> dict[str, float | str]:
    return {name: _to_json(number) for name, number in numbers.items()}


def _numbers_from_json(numbers: Mapping[str, float | str]) -> dict[str, float]:
    return {name: _from_json(number) for name, number in numbers.items()}
