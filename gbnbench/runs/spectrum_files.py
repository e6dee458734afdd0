"""Spectra as files: .npz with everything, .npy with the power alone, .csv with a row a frequency or shell."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gbnbench import __version__
from gbnbench.analysis.radial.anisotropy import ROUNDING_VARIANCE, anisotropy
from gbnbench.analysis.radial.profile_measures import ROUNDING_POWER
from gbnbench.analysis.spectrum.box_shells import pooled_spectrum
from gbnbench.core.errors import InputError
from gbnbench.core.results.radial import ShellSpectrum
from gbnbench.core.results.resolution import resolvable_power
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.sides import wave_numbers
from gbnbench.io import data_files
from gbnbench.runs.source_files import SPECTRUM_SCALARS

if TYPE_CHECKING:
    import pandas as pd

DATA = (".npz", ".npy", ".csv")
MOST_ROWS = 4_000_000  # of a .csv, 150 MB

_SHELL = ("frequency", "nu", "power", "count", "deviation")


def check_writable(suffix: str, what: str, rows: int) -> None:
    """Refuse, before any work, a format that cannot hold a spectrum.

    Parameters
    ----------
    suffix : str
        One of ``DATA``.
    what : {"cube", "half cube", "shells", "listed"}
        Which frequencies.
    rows : int
        Frequencies or shells.

    Raises
    ------
    InputError
        If it is .npy for shells, whose |f| would be lost, or .csv of more rows than anyone can read.
    """
    if suffix == ".npy" and what == "shells":
        raise InputError("an .npy has no room for the |f| of shells; write .csv or .npz")
    if suffix == ".csv" and rows > MOST_ROWS:
        raise InputError(f"a .csv of {rows:,} rows is more than {MOST_ROWS:,}; write .npz or .npy")


def encode(suffix: str, result: Spectrum | ShellSpectrum, sources: Sequence[str] = ()) -> bytes:
    """Make the bytes of a file.

    Parameters
    ----------
    suffix : str
        One of ``DATA``.
    result : Spectrum or ShellSpectrum
        What was found.
    sources : sequence of str
        Names of the files that the points are from, kept in an .npz.

    Returns
    -------
    bytes
        .npz: every field of the result by its name, ``version`` and ``sources``; of shells also the rings'
        ``ring`` and ``anisotropy_db``. .npy: ``power``. .csv: ``columns``.
    """
    import pandas as pd

    if suffix == ".npz":
        return data_files.to_npz(**_arrays(result, sources))
    if suffix == ".npy":
        check_writable(suffix, "shells" if isinstance(result, ShellSpectrum) else "cube", 0)
        return _npy(result.power)
    return data_files.to_csv(pd.DataFrame(columns(result)))


def rings_of(shells: ShellSpectrum) -> pd.DataFrame:
    """Rings as ``gbnbench.analysis.radial.anisotropy`` finds them, nan where only rounding would be measured.

    That is where a ring's mean power is at or below ``ROUNDING_POWER`` or what the spectrum resolves, or its
    powers are all equal, as those of a single point are.
    """
    rings = anisotropy(shells)
    if shells.sides is not None:
        shells = pooled_spectrum(shells)
    ring = np.searchsorted(rings["frequency"].to_numpy(), np.rint(shells.frequency).astype(np.int64))
    mean = np.bincount(ring, shells.count * shells.power) / np.bincount(ring, shells.count)
    equal = rings["anisotropy_db"].to_numpy() <= 10 * math.log10(ROUNDING_VARIANCE)
    least = max(ROUNDING_POWER, resolvable_power(shells.error_rms))
    blank = (mean <= least) | equal | (shells.n == 1)
    return rings.assign(anisotropy_db=rings["anisotropy_db"].where(~blank))


def columns(result: Spectrum | ShellSpectrum) -> dict[str, NDArray[Any]]:
    """Columns of a table with a row a frequency or shell.

    Returns
    -------
    dict of (rows,) arrays
        Of a cube: f0, f1, ..., power. Of listed frequencies: f0, f1, ..., frequency, nu, power. Of shells:
        frequency, nu, power, count, deviation, and of the ring that the shell is in, its number ``ring`` and
        its ``anisotropy_db``, the same for all its shells; nan where it would be that of rounding.
    """
    if isinstance(result, ShellSpectrum):
        rings = rings_of(result)
        ring = np.rint(result.frequency).astype(np.int64)
        # The shells of unequal sides are pooled in rings, whose first may lie above the first shell.
        decibel = rings.set_index("frequency")["anisotropy_db"].reindex(ring).to_numpy()
        return {**{name: getattr(result, name) for name in _SHELL}, "ring": ring, "anisotropy_db": decibel}
    if result.frequencies is None:
        axes = [np.arange(-f, f + 1) for f in result.harmonics]
        axes[0] = axes[0][result.harmonics[0] :] if result.half else axes[0]
        grid = np.meshgrid(*axes, indexing="ij")
        return {**{f"f{a}": axis.ravel() for a, axis in enumerate(grid)}, "power": result.power.ravel()}
    found = {f"f{a}": result.frequencies[:, a] for a in range(result.d)}
    radius = wave_numbers(result.frequencies, result.sides)
    return {**found, "frequency": radius, "nu": radius * result.spacing, "power": result.power}


def _arrays(result: Spectrum | ShellSpectrum, sources: Sequence[str]) -> dict[str, NDArray[Any]]:
    about = {name: np.asarray(getattr(result, name)) for name in SPECTRUM_SCALARS}
    if result.sides is not None:
        about["sides"] = np.array(result.sides)
    about |= {"version": np.asarray(__version__), "sources": np.asarray(list(sources), dtype=np.str_)}
    if isinstance(result, ShellSpectrum):
        rings = rings_of(result)
        found = {"ring": rings["frequency"].to_numpy(), "anisotropy_db": rings["anisotropy_db"].to_numpy()}
        return {**{name: getattr(result, name) for name in _SHELL}, **found, **about}
    about |= {name: np.asarray(getattr(result, name)) for name in ("half", "weighted")}
    listed = {} if result.frequencies is None else {"frequencies": result.frequencies}
    return {"power": result.power, **listed, **about}


def _npy(power: NDArray[Any]) -> bytes:
    file = io.BytesIO()
    np.lib.format.write_array(file, np.ascontiguousarray(power), allow_pickle=False)
    return file.getvalue()
