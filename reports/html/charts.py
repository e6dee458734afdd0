"""Data of the page's charts: the curves of the pictures beside them, thinned to what can be seen."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.reports import style
from gbnbench.reports.comparison import loglog, radial, table
from gbnbench.reports.source_groups import Group, members
from gbnbench.runs.comparison_result import Run, SourceResult

SHELLS = 4000  # of one grid; of more, the lowest and the highest of each strip of the axis are kept
DIGITS = 6  # of every number
DASHES = ("solid", "dash", "dot", "dashdot")  # what the charts call those of ``style.DASHES``
NU = "nu = |f| n^(-1/d)"


def loglog_chart(run: Run, group: Group) -> dict[str, Any]:
    """Return the log-log picture of the radial power as data.

    Parameters
    ----------
    run : Run
        The comparison.
    group : (n, d)
        Size and dimension of the sources shown.

    Returns
    -------
    dict
        JSON-ready: ``x`` and ``panels`` (title, log, range; rules, which are horizontal lines), ``sources``
        (name, colour, on_dark, dash), ``grids`` of nu, ``curves`` (source, panel, grid, y; ``alone`` numbers
        the values that no line reaches, ``zero`` the shells whose power is zero to rounding), ``guides``
        (name, x, y), ``shells`` of the source that has most, and ``thinned``.
    """
    sources = members(run, group)
    gone = [loglog.zero_to_rounding(source) for source in sources]
    powers = [np.where(zero, np.nan, s.radial.power) for s, zero in zip(sources, gone, strict=True)]
    bottom, top = loglog.power_limits(powers)
    guides = []
    fitted = loglog.guide(sources)
    span = [float(nu) for s in sources for nu in (*s.radial.nu[:1], *s.radial.nu[-1:])]
    if fitted is not None:
        epsilon, end = fitted
        nu = np.geomspace(min([*span, end]), end, 80)
        power = epsilon * np.exp(4 * math.pi**2 * nu**2)
        guides = [{"name": "ε exp(4π²ν²)", "x": _numbers(nu), "y": _numbers(power)}]
    low, high = (min(span), max(span)) if span else (0.1, 1.0)
    chart = _chart(run, sources, "log-log chart of the radial power")
    chart["x"] = {"title": NU, "log": True, "range": [0.93 * low, 1.07 * high if high > low else 2 * high]}
    chart["panels"] = [{"title": "radial power", "log": True, "range": [bottom, top], "rules": [1]}]
    chart["guides"] = guides
    _add_shells(chart, sources, powers, gone, log=True)
    return chart


def radial_chart(run: Run, group: Group) -> dict[str, Any]:
    """Return the radial power with the anisotropy below it as data, as ``loglog_chart`` does.

    Parameters
    ----------
    run : Run
        The comparison.
    group : (n, d)
        Size and dimension of the sources shown.

    Returns
    -------
    dict
        JSON-ready.
    """
    sources = members(run, group)
    chart = _chart(run, sources, "chart of the radial power and the anisotropy")
    chart["x"] = {"title": NU, "log": False, "range": [0, max(map(radial.reach, sources))]}
    isotropic = sorted({-10 * math.log10(max(source.realizations, 1)) for source in sources})
    chart["panels"] = [
        {"title": "power", "log": False, "range": [0, radial.power_limit(sources)], "rules": [1]},
        {"title": "anisotropy, dB", "log": False, "range": list(radial.decibel_limits(sources)),
         "rules": _numbers(np.array(isotropic))},
    ]  # fmt: skip
    _add_shells(chart, sources, [source.radial.power for source in sources], None, log=False)
    for k, source in enumerate(sources):
        rings = source.anisotropy
        decibel = rings["anisotropy_db"].to_numpy(dtype=float)
        grid = _grid(chart, _numbers(rings["nu"].to_numpy(dtype=float)))
        alone = np.flatnonzero(loglog.without_neighbours(decibel)).tolist()
        curve = {"source": k, "panel": 1, "grid": grid, "y": _numbers(decibel), "alone": alone, "zero": []}
        chart["curves"].append(curve)
    return chart


def _chart(run: Run, sources: Sequence[SourceResult], label: str) -> dict[str, Any]:
    strokes = style.strokes(run)
    named = [
        {
            "name": table.row_label(source, run),
            "colour": strokes[source.key].colour,
            "on_dark": strokes[source.key].on_dark,
            "dash": DASHES[style.DASHES.index(strokes[source.key].dash)],
        }
        for source in sources
    ]
    shells = max((len(source.radial.nu) for source in sources), default=0)
    return {"label": label, "sources": named, "grids": [], "curves": [], "guides": [], "shells": shells}


def _add_shells(
    chart: dict[str, Any],
    sources: Sequence[SourceResult],
    powers: Sequence[FloatArray],
    gone: Sequence[NDArray[np.bool_]] | None,
    log: bool,
) -> None:
    """Add the radial power. Sources with the same shells keep the same, so that values stand together."""
    same: list[list[int]] = []
    for k, source in enumerate(sources):
        for others in same:
            if np.array_equal(sources[others[0]].radial.nu, source.radial.nu):
                others.append(k)
                break
        else:
            same.append([k])
    chart["thinned"] = False
    for numbers in same:
        nu = sources[numbers[0]].radial.nu
        shown = thinned(np.log(nu) if log else nu, [powers[k] for k in numbers])
        chart["thinned"] |= len(shown) < len(nu)
        grid = _grid(chart, _numbers(nu[shown]))
        for k in numbers:
            power = powers[k][shown]
            alone = np.flatnonzero(loglog.without_neighbours(power)).tolist()
            zero = [] if gone is None else np.flatnonzero(gone[k][shown]).tolist()
            chart["curves"].append(
                {"source": k, "panel": 0, "grid": grid, "y": _numbers(power), "alone": alone, "zero": zero}
            )
    chart["curves"].sort(key=lambda curve: curve["source"])


def thinned(x: FloatArray, values: Sequence[FloatArray], most: int = SHELLS) -> NDArray[np.int_]:
    """Choose shells that look like all of them.

    Parameters
    ----------
    x : (shells,) float64
        Places along the axis, ascending.
    values : sequence of (shells,) float64
        The curves; nan is no value.
    most : int
        Shells that need no choice.

    Returns
    -------
    (kept,) int
        All of them up to ``most``; else, in each strip of the axis, those where a curve is lowest or highest,
        and the first and the last of all.
    """
    if len(x) <= most:
        return np.arange(len(x))
    strips = max(most // (2 * len(values)), 50)
    strip = np.minimum(((x - x[0]) / (x[-1] - x[0]) * strips).astype(int), strips - 1)
    starts = np.flatnonzero(np.diff(strip, prepend=-1))
    kept = {0, len(x) - 1}
    for start, end in zip(starts, [*starts[1:], len(x)], strict=True):
        for value in values:
            part = value[start:end]
            if np.isfinite(part).any():
                kept |= {int(start + np.nanargmin(part)), int(start + np.nanargmax(part))}
            else:
                kept.add(int(start))
    return np.array(sorted(kept))


def _grid(chart: dict[str, Any], nu: list[float | None]) -> int:
    """Return the number of a grid, added where it is new."""
    if nu not in chart["grids"]:
        chart["grids"].append(nu)
    return int(chart["grids"].index(nu))


def _numbers(values: FloatArray) -> list[float | None]:
    return [float(f"{value:.{DIGITS}g}") if math.isfinite(value) else None for value in values.tolist()]
