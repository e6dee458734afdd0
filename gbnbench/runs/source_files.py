"""The results of one source as files, and back: what is written is what is read, to the last bit."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gbnbench.core.atomic_write import Writer
from gbnbench.core.results.measures import Measures
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.io import data_files
from gbnbench.runs.comparison_result import SourceResult

if TYPE_CHECKING:
    from numpy.typing import NDArray

# The scalar fields of a Spectrum that files hold beside its power, and their types.
SPECTRUM_SCALARS: dict[str, Callable[[Any], Any]] = {
    "n": int,
    "d": int,
    "realizations": int,
    "fmax": int,
    "precision": str,
    "method": str,
    "device": str,
    "error_rms": float,
    "error_bound": float,
}
SOURCE = (
    "key",
    "label",
    "n",
    "d",
    "realizations",
)  # fields of a SourceResult that source.json holds as they are
TABLES = ("anisotropy", "rdf", "valence")  # fields that are a DataFrame, or None
ARRAYS = {"points": "points.npz", "zone_plate": "zone_plate.npz"}  # fields that are an array, or None
EXTREMES = {"nan": math.nan, "inf": math.inf, "-inf": -math.inf}


def encode(result: SourceResult) -> dict[str, bytes | Writer]:
    """Make the files of one source.

    Parameters
    ----------
    result : SourceResult
        Everything measured of it.

    Returns
    -------
    dict of bytes, or of what writes them
        ``source.json`` (labels, measures), ``points.npz``, ``spectrum.npz``, ``radial.csv``,
        ``anisotropy.csv`` and, where the source has them, ``rdf.csv``, ``valence.csv``, ``zone_plate.npz``.
    """
    spectrum = result.spectrum
    spectra: dict[str, NDArray[Any]] = {"power": spectrum.power}
    if spectrum.frequencies is not None:
        largest = np.abs(spectrum.frequencies).max()  # of whole shells they are small and many
        spectra["frequencies"] = spectrum.frequencies.astype(np.min_scalar_type(-int(largest) - 1))
    if spectrum.sides is not None:
        spectra["sides"] = np.array(spectrum.sides)
    spectra |= {name: np.asarray(getattr(spectrum, name)) for name in SPECTRUM_SCALARS}
    about = {
        **{name: getattr(result, name) for name in SOURCE},
        "cpu_seconds": _to_json(result.cpu_seconds),
        "warnings": list(result.warnings),
        "measures": _numbers_to_json(result.measures.measured),
        "standard_errors": _numbers_to_json(result.measures.standard_error),
        "reasons": dict(result.measures.reasons),
    }
    tables = {name: getattr(result, name) for name in TABLES}
    arrays = {name: getattr(result, name) for name in ARRAYS}
    return {
        "source.json": data_files.to_json(about),
        "spectrum.npz": data_files.to_npz(**spectra),
        "radial.csv": data_files.to_csv(result.radial.to_frame()),
        **{f"{name}.csv": data_files.to_csv(table) for name, table in tables.items() if table is not None},
        **{ARRAYS[name]: data_files.npz_writer(**{name: x}) for name, x in arrays.items() if x is not None},
    }


def decode(folder: Path) -> SourceResult:
    """Read back what ``encode`` made.

    Parameters
    ----------
    folder : Path
        With the files of one source.

    Returns
    -------
    SourceResult

    Raises
    ------
    FormatError
        If a file is missing or is not what was written, naming it.
    """
    about = data_files.read_json(folder / "source.json")
    spectra = data_files.read_or_explain(folder / "spectrum.npz", data_files.read_npz)
    radial = data_files.read_or_explain(folder / "radial.csv", data_files.read_csv)

    def table(name: str) -> Any:
        path = folder / f"{name}.csv"
        if name != "anisotropy" and not path.exists():
            return None
        return data_files.read_or_explain(path, data_files.read_csv)

    def array(name: str) -> Any:
        path = folder / ARRAYS[name]
        needed = name == "points"
        return (
            data_files.read_or_explain(path, data_files.read_npz)[name] if needed or path.exists() else None
        )

    def build(_: Path) -> SourceResult:
        return SourceResult(
            **{name: about[name] for name in SOURCE},
            **{name: table(name) for name in TABLES},
            **{name: array(name) for name in ARRAYS},
            spectrum=Spectrum(
                power=spectra["power"],
                frequencies=spectra["frequencies"].astype(np.int64) if "frequencies" in spectra else None,
                sides=tuple(spectra["sides"].tolist()) if "sides" in spectra else None,
                **{name: kind(spectra[name]) for name, kind in SPECTRUM_SCALARS.items()},
            ),
            radial=RadialPower(*(radial[name].to_numpy() for name in ("frequency", "nu", "power", "count"))),
            measures=Measures(
                _numbers_from_json(about["measures"]),
                _numbers_from_json(about["standard_errors"]),
                dict(about["reasons"]),
            ),
            cpu_seconds=_from_json(about["cpu_seconds"]),
            warnings=tuple(about["warnings"]),
        )

    return data_files.read_or_explain(folder, build)


def _to_json(number: float) -> float | str:
    return float(number) if math.isfinite(number) else str(float(number))  # JSON has no nan


def _from_json(number: float | str) -> float:
    return EXTREMES[number] if isinstance(number, str) else float(number)


def _numbers_to_json(numbers: Mapping[str, float]) -> dict[str, float | str]:
    return {name: _to_json(number) for name, number in numbers.items()}


def _numbers_from_json(numbers: Mapping[str, float | str]) -> dict[str, float]:
    return {name: _from_json(number) for name, number in numbers.items()}
