"""A spectrum in words and numbers, as ``gbnbench spectrum`` prints it: headline, error, first rows."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.radial.profile_measures import noise_floor, peak, power_at_1
from gbnbench.analysis.radial.radial_power import shells_from_cube
from gbnbench.analysis.spectrum.evaluators.registry import title_of
from gbnbench.cli.missing_numbers import SPECTRUM, with_reasons
from gbnbench.core.errors import RefusalError
from gbnbench.core.readable_text import display_width, right
from gbnbench.core.results.radial import ShellSpectrum
from gbnbench.core.results.resolution import resolvable_power
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.sides import sides_text
from gbnbench.runs.spectrum_files import columns

ROWS = 16  # printed


def as_text(result: Spectrum | ShellSpectrum, label: str) -> str:
    """Return the headline, the error, floor, power at 1 and peak, and the first rows.

    Parameters
    ----------
    result : Spectrum or ShellSpectrum
        The spectrum.
    label : str
        Name of the sets, for the user.

    Returns
    -------
    str
        Lines for a terminal.
    """
    lines = [headline(result, label), f"  {exactness(result)}"]
    if isinstance(result, Spectrum) and result.frequencies is not None:
        rows = columns(result)
    else:
        shells = shells_from_cube(result) if isinstance(result, Spectrum) else result
        lines += _of_note(shells, result)
        rows = columns(shells)
        del rows["deviation"]
        again = np.diff(rows["ring"], prepend=-1) == 0  # a ring's number stands by its first shell
        rows["ring"] = np.where(again, "", rows["ring"].astype(str))
        rows["anisotropy_db"] = np.where(again, np.nan, rows["anisotropy_db"])
    more = len(rows["power"]) - ROWS
    rows = {name: values[:ROWS] for name, values in rows.items()}
    told_apart = {name: _apart(rows[name]) for name in ("frequency", "nu")}
    power = {"power": np.array([_power(p, result) for p in rows["power"].tolist()])}
    lines += ["", *_aligned(rows | told_apart | power)]
    return "\n".join([*lines, f"... {more:,} more: -o FILE.csv has all"] if more > 0 else lines)


def as_record(result: Spectrum | ShellSpectrum, label: str) -> dict[str, Any]:
    """Return a spectrum for JSON.

    Parameters
    ----------
    result : Spectrum or ShellSpectrum
        The spectrum.
    label : str
        Name of the sets, for the user.

    Returns
    -------
    dict
        The label, how it was found, its errors, and ``rows``: one a shell or listed frequency.
    """
    import pandas as pd

    names = ("n", "d", "realizations", "fmax", "precision", "method", "device", "error_rms", "error_bound")
    about = {name: getattr(result, name) for name in names}
    if result.sides is not None:
        about["sides"] = list(result.sides)
    if isinstance(result, Spectrum) and result.frequencies is None:
        result = shells_from_cube(result)
    return {"label": label, **about, "rows": with_reasons(pd.DataFrame(columns(result)), SPECTRUM)}


def _of_note(shells: ShellSpectrum, result: Spectrum | ShellSpectrum) -> list[str]:
    """Noise floor, power at 1 and peak, of shells that are whole from the first."""
    if shells.frequency[0] > 1 or shells.frequency[-1] > shells.fmax:
        return []
    profile, said = shells.radial(), []
    try:
        said += [f"noise floor {_power(noise_floor(profile), result)}"]
        lowest = "P(|f|=1)" if shells.sides is None else "P at the lowest |k|"
        said += [f"{lowest} {_power(power_at_1(profile), result)}"]
        height, nu = peak(profile)
        said += [f"peak {_power(height, result)} at nu = {nu:.3g}"]
    except RefusalError:  # these shells do not reach so far
        pass
    return [f"  {', '.join(said)}"] if said else []


def headline(result: Spectrum | ShellSpectrum, label: str) -> str:
    """Name the spectrum and its points in one line.

    Parameters
    ----------
    result : Spectrum or ShellSpectrum
        The spectrum.
    label : str
        Name of the sets, for the user.

    Returns
    -------
    str
        Such as ``cube |f_a| <= 64, 16,641 frequencies, of mine.txt (n=1,024, d=2)``.
    """
    mean = f", mean of {result.realizations:,} sets" if result.realizations > 1 else ""
    box = f", sides {sides_text(result.sides)}" if result.sides is not None else ""
    return f"{_content(result)} of {label} (n={result.n:,}, d={result.d}{box}{mean})"


def _content(result: Spectrum | ShellSpectrum) -> str:
    if isinstance(result, ShellSpectrum):
        low, high = result.frequency[[0, -1]]
        many = "s" * (len(result.frequency) > 1)
        length = "|f|" if result.sides is None else "|k|"
        return f"{len(result.frequency):,} shell{many}, {length} from {low:.4g} to {high:.4g},"
    if result.frequencies is not None:
        return f"{len(result):,} listed frequenc{'y' if len(result) == 1 else 'ies'}"
    half = "half " if result.half else ""
    if result.sides is not None:
        reach = f"|f_a| <= {', '.join(map(str, result.harmonics))}"
        return f"{half}box {reach} round |k| <= {result.fmax}, {result.power.size:,} frequencies,"
    return f"{half}cube |f_a| <= {result.fmax}, {result.power.size:,} frequencies,"


def exactness(result: Spectrum | ShellSpectrum) -> str:
    """Say how it was found and how far off it may be."""
    title = title_of(result.method)
    return (
        f"{title} in {result.precision}; sqrt(P) is off by {result.error_rms:.1e} typically, "
        f"{result.error_bound:.1e} at worst; P = {resolvable_power(result.error_rms):.1e} is known to 1%"
    )


def _power(power: float, result: Spectrum | ShellSpectrum) -> str:
    """Four digits, or what it is below where it is less than the result resolves."""
    least = resolvable_power(result.error_rms)
    if not power < least:
        return f"{power:.4g}"
    unit = 10.0 ** math.floor(math.log10(least))
    return f"below {math.ceil(least / unit - 1e-6) * unit:.0e}"


def _apart(values: NDArray[np.float64]) -> NDArray[Any]:
    """Write numbers with four digits, or as many as it takes to tell the different ones apart."""
    different = np.unique(values).tolist()
    digits = 4
    while digits < 17 and len({f"{value:.{digits}g}" for value in different}) < len(different):
        digits += 1
    return np.array([f"{value:.{digits}g}" for value in values.tolist()])


def _aligned(rows: dict[str, NDArray[Any]]) -> list[str]:
    """Lines of right-aligned columns under their heads."""
    cells = {name: [_cell(value) for value in values.tolist()] for name, values in rows.items()}
    widths = {name: max(map(display_width, [name, *values])) for name, values in cells.items()}
    lines = ["  ".join(right(name, width) for name, width in widths.items())]
    for row in zip(*cells.values(), strict=True):
        line = "  ".join(right(cell, width) for cell, width in zip(row, widths.values(), strict=True))
        lines.append(line.rstrip())
    return lines


def _cell(value: object) -> str:
    if isinstance(value, float):
        return "" if math.isnan(value) else f"{value:.4g}"
    return str(value)
