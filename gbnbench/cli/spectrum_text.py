"""A spectrum in words and numbers, as ``gbnbench spectrum`` prints it: headline, error, first rows."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.radial.profile_measures import noise_floor, peak, power_at_1
from gbnbench.analysis.radial.radial_power import shells_from_cube
from gbnbench.analysis.spectrum.evaluators.registry import title_of
from gbnbench.cli.json_text import records
from gbnbench.core.errors import RefusalError
from gbnbench.core.footnotes import footnotes
from gbnbench.core.results.radial import ShellSpectrum
from gbnbench.core.results.resolution import resolvable_power
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.sides import sides_text
from gbnbench.runs.spectrum_files import columns

ROWS = 16  # printed
NO_ANISOTROPY = (
    "the powers of such a ring are 0 or equal to rounding, or it has no two independent frequencies"
)


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
        decibels = np.array(["-" if math.isnan(v) else f"{v:.4g}" for v in rows["anisotropy_db"].tolist()])
        rows["anisotropy_db"] = np.where(again, "", decibels)
    more = len(rows["power"]) - ROWS
    rows = {name: values[:ROWS] for name, values in rows.items()}
    told_apart = {name: _apart(rows[name]) for name in ("frequency", "nu")}
    power = {"power": np.array([_power(p, result) for p in rows["power"].tolist()])}
    lines += ["", *_aligned(rows | told_apart | power)]
    lines += [f"... {more:,} more: -o FILE.csv has all"] if more > 0 else []
    missing = [("anisotropy_db", NO_ANISOTROPY)] if "-" in rows.get("anisotropy_db", ()) else []
    return "\n".join([*lines, *footnotes(missing)])


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
        The label, how it was found, its errors, and ``rows``: one a shell or listed frequency. Of shells also
        ``measures``, the noise floor, the power at 1, the peak and its nu; and ``reasons``, why any of them,
        or ``anisotropy_db`` in a row, is null.
    """
    import pandas as pd

    names = ("n", "d", "realizations", "fmax", "precision", "method", "device", "error_rms", "error_bound")
    about = {name: getattr(result, name) for name in names}
    if result.sides is not None:
        about["sides"] = list(result.sides)
    if isinstance(result, Spectrum):
        if result.frequencies is not None:
            return {"label": label, **about, "rows": records(pd.DataFrame(columns(result)))}
        result = shells_from_cube(result)
    rows = columns(result)
    measures, reasons = _measures(result)
    if np.isnan(rows["anisotropy_db"]).any():
        reasons["anisotropy_db"] = NO_ANISOTROPY
    return {
        "label": label,
        **about,
        "measures": measures,
        "reasons": reasons,
        "rows": records(pd.DataFrame(rows)),
    }


def _measures(shells: ShellSpectrum) -> tuple[dict[str, float], dict[str, str]]:
    """Noise floor, power at 1, peak and its nu, of shells that are whole from the first; or why not."""
    names: tuple[str, ...] = ("noise_floor", "power_at_1", "peak", "peak_nu")
    found: dict[str, float] = dict.fromkeys(names, math.nan)
    reasons: dict[str, str] = {}
    if shells.gaps or shells.frequency[0] > 1 or shells.frequency[-1] > shells.fmax:
        return found, dict.fromkeys(names, "measured of whole shells from the lowest on, which these are not")
    profile = shells.radial()
    found["power_at_1"] = power_at_1(profile)
    try:
        found["noise_floor"] = noise_floor(profile)
    except RefusalError as refusal:
        reasons["noise_floor"] = str(refusal)
    try:
        found["peak"], found["peak_nu"] = peak(profile)
    except RefusalError as refusal:
        reasons["peak"] = reasons["peak_nu"] = str(refusal)
    return found, reasons


def _of_note(shells: ShellSpectrum, result: Spectrum | ShellSpectrum) -> list[str]:
    """Write the measures of shells that are whole from the first, and why one of them is missing."""
    found, reasons = _measures(shells)
    if math.isnan(found["power_at_1"]):
        return []
    lowest = "P(|f|=1)" if shells.sides is None else "P at the lowest |k|"
    titles = {"noise_floor": "noise floor", "power_at_1": lowest, "peak": "peak"}
    told = {name: f"{title} {_power(found[name], result)}" for name, title in titles.items()}
    told["peak"] += f" at nu = {found['peak_nu']:.3g}"
    missing = [f"  no {titles[name]}: {text}" for name, text in reasons.items() if name in titles]
    return ["  " + ", ".join(told[name] for name in titles if name not in reasons), *missing]


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
    widths = {name: max(map(len, [name, *values])) for name, values in cells.items()}
    lines = ["  ".join(name.rjust(width) for name, width in widths.items())]
    for row in zip(*cells.values(), strict=True):
        line = "  ".join(cell.rjust(width) for cell, width in zip(row, widths.values(), strict=True))
        lines.append(line.rstrip())
    return lines


def _cell(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)
