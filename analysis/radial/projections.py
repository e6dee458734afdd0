"""Spectra of a set's projections on coordinate subsets S, each with its own spacing n^(-1/|S|)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.analysis.radial import profile_measures
from gbnbench.analysis.radial.radial_power import mean_over_groups, shells_of
from gbnbench.analysis.spectrum.limits import default_fmax, default_radius
from gbnbench.analysis.spectrum.power_of_each import each_power
from gbnbench.analysis.standard_errors import mean_over_sets
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.sides import Sides, as_sides
from gbnbench.core.torus import FloatArray, as_realizations, spacing

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Projection:
    """Spectrum of one projection, and the measures of its profile.

    Attributes
    ----------
    axes : tuple of int
        Coordinates onto which the points are projected.
    radial : RadialPower
        Mean over realizations; nu in the projection's own spacings.
    noise_floor, power_at_1 : float
        Means over realizations of ``profile_measures.noise_floor`` and ``power_at_1``.
    noise_floor_error, power_at_1_error : float
        Standard errors over realizations; nan for a single one.
    peak, peak_nu : float
        Largest mean power over rings, and its nu (``profile_measures.peak``); nan where the spectrum ends
        below nu = 1.
    """

    axes: tuple[int, ...]
    radial: RadialPower
    noise_floor: float
    noise_floor_error: float
    power_at_1: float
    power_at_1_error: float
    peak: float
    peak_nu: float


def projections(
    x: ArrayLike,
    chosen: Sequence[Sequence[int]],
    fmax: int | None = None,
    sides: ArrayLike | None = None,
) -> tuple[Projection, ...]:
    """Measure projections of one or several sets.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) array_like
        Points on the unit torus.
    chosen : sequence of sequences of int
        Coordinates of each projection, such as ``gbnbench.generators.gbn.projective.subsets("1/0+1", d)``.
    fmax : int, optional
        Largest harmonic, or |k| for unequal sides; by default to nu = 2 of each projection, or as affordable.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given. A projection has those of its
        axes.

    Returns
    -------
    tuple of Projection
        In the order of ``chosen``.

    Raises
    ------
    InputError
        If x is not points of the unit torus, or a projection is empty, names a coordinate twice or one that x
        does not have, fmax ends within the noise floor's band, or sides are not d lengths.

    Notes
    -----
    The power of a projection at f is that of the whole set at the frequency which is f on those axes and 0 on
    the others.

    Examples
    --------
    >>> x = np.random.default_rng(0).random((20, 256, 3))
    >>> [round(p.noise_floor, 1) for p in projections(x, [(0,), (0, 2)])]
    [1.0, 1.0]
    """
    points = as_realizations(x)
    d = points.shape[2]
    for axes in chosen:
        if not axes or len(set(axes)) < len(axes) or not all(0 <= a < d for a in axes):
            raise InputError(
                f"a projection must name some of the coordinates 0 to {d - 1}, each once; got {tuple(axes)}"
            )
    lengths = as_sides(sides, d)
    return tuple(_measured(points, tuple(axes), fmax, lengths) for axes in chosen)


def frame(projected: Sequence[Projection]) -> pd.DataFrame:
    """Table of one row a projection: its coordinates (as 0+1) and its measures with their errors."""
    import pandas as pd

    names = (
        "noise_floor", "noise_floor_error", "power_at_1", "power_at_1_error", "peak", "peak_nu",
    )  # fmt: skip
    rows = [
        {"projection": "+".join(map(str, p.axes)), **{name: getattr(p, name) for name in names}}
        for p in projected
    ]
    return pd.DataFrame(rows, columns=["projection", *names])


def _measured(points: FloatArray, axes: tuple[int, ...], fmax: int | None, sides: Sides | None) -> Projection:
    projected = np.ascontiguousarray(points[:, :, axes])
    sets, n, m = projected.shape
    own = None if sides is None else as_sides([sides[a] for a in axes], m)
    if fmax is None:
        fmax = default_fmax(n, m, sets) if own is None else default_radius(n, m, sets, own)
    powers, spectrum = each_power(projected, fmax, sides=own)
    shells = shells_of(spectrum)
    radials = [mean_over_groups(power, shells, spacing(n, m)) for power in powers]
    mean = mean_over_groups(spectrum.power, shells, spacing(n, m))
    floor, first = (
        mean_over_sets(np.array([measure(r) for r in radials]))
        for measure in (profile_measures.noise_floor, profile_measures.power_at_1)
    )
    try:
        peak, peak_nu = profile_measures.peak(mean)
    except RefusalError:
        peak, peak_nu = math.nan, math.nan
    return Projection(axes, mean, *floor, *first, peak, peak_nu)
