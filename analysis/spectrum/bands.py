"""Bands of |f| that are asked for together, and the shells of several put in one table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.results.radial import ShellSpectrum

Band = tuple[float, float]


def separate_bands(band: Sequence[float] | Sequence[Sequence[float]] | None) -> list[Sequence[float] | None]:
    """List the bands of a request, those that overlap or touch being joined.

    Parameters
    ----------
    band : (low, high), a sequence of such pairs, or None
        What the user gave.

    Returns
    -------
    list of (low, high) or None
        Ascending where there are several; a single entry as it was given.

    Raises
    ------
    InputError
        If a band of several is no pair of numbers 0 <= low <= high.

    Examples
    --------
    >>> separate_bands([(30, 40), (1, 8), (8, 9)])
    [(1.0, 9.0), (30.0, 40.0)]
    >>> separate_bands((1, 8)), separate_bands(None)
    ([(1, 8)], [None])
    """
    first = next(iter(band), None) if isinstance(band, (list, tuple, np.ndarray)) else None
    if band is None or not isinstance(first, (list, tuple, np.ndarray)):
        return [band]  # type: ignore[list-item]
    found: list[Band] = []
    for low, high in sorted(_pair(one) for one in band):
        if found and low <= found[-1][1]:
            found[-1] = found[-1][0], max(high, found[-1][1])
        else:
            found.append((low, high))
    return list(found)


def _pair(one: object) -> Band:
    try:
        low, high = (float(edge) for edge in one)  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        raise InputError(
            f"a band must be two numbers, the least and the largest |f|, such as (2, 8); got {one!r}"
        ) from None
    if not 0 <= low <= high:
        raise InputError(f"a band must be 0 <= low <= high, cycles per unit length; got {one!r}")
    return low, high


def joined_shells(parts: Sequence[ShellSpectrum]) -> ShellSpectrum:
    """Put the shells of separate bands in one spectrum.

    Parameters
    ----------
    parts : sequence of ShellSpectrum
        Of the same points, ascending and apart.

    Returns
    -------
    ShellSpectrum
        With ``gaps`` where there are several parts; its errors hold for all of them.
    """
    first = parts[0]
    if len(parts) == 1:
        return first
    return replace(
        first,
        frequency=np.concatenate([part.frequency for part in parts]),
        nu=np.concatenate([part.nu for part in parts]),
        power=np.concatenate([part.power for part in parts]),
        count=np.concatenate([part.count for part in parts]),
        deviation=np.concatenate([part.deviation for part in parts]),
        fmax=max(part.fmax for part in parts),
        method=", ".join(dict.fromkeys(part.method for part in parts)),
        precision=", ".join(dict.fromkeys(part.precision for part in parts)),
        error_rms=max(part.error_rms for part in parts),
        error_bound=max(part.error_bound for part in parts),
        gaps=True,
    )
