"""Scalar measures of point sets, computed from the power of every set, with their standard errors."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cached_property, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.affordable_powers import farther_powers, set_powers
from gbnbench.analysis.measure_definitions import DEFINITIONS
from gbnbench.analysis.radial.anisotropy import anisotropy_columns
from gbnbench.analysis.radial.psa import spectral_statistics
from gbnbench.analysis.set_powers import SetPowers
from gbnbench.analysis.spatial.bond_order import bond_order, psi6
from gbnbench.analysis.spatial.delaunay import Neighbours, neighbours
from gbnbench.analysis.spatial.discrepancy import DiscrepancyResult, measure_discrepancies
from gbnbench.analysis.spatial.discrepancy_kernels import Discrepancy
from gbnbench.analysis.spatial.distances import nearest_distances
from gbnbench.analysis.spatial.valence import valence6
from gbnbench.analysis.spectral_scalars import spectral_scalars
from gbnbench.analysis.spectrum.listed_shells import shell_sizes
from gbnbench.analysis.standard_errors import Estimate, mean_over_sets
from gbnbench.core.errors import RefusalError, ShortSpectrumError
from gbnbench.core.results.measures import Measures
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.sides import Sides
from gbnbench.core.torus import FloatArray

NYQUIST_STEP = 0.005  # resolution of the effective Nyquist frequency, part of its error
_Entry = tuple[tuple[str, ...], Callable[[], list[Estimate]]]


class Scalars:
    """Power of every set, from which the scalars are computed.

    Parameters
    ----------
    points : (realizations, n, d) float64
        Checked points.
    fmax : int or None
        Largest harmonic on each axis, or |k| for unequal sides; None for as far as nu = 2, or as affordable
        (``default_fmax``).
    sides : tuple of d floats, optional
        As ``as_sides`` returns them; a cube if not given.

    Attributes
    ----------
    near : SetPowers
        Power of every set: cubes where they are affordable, else the shells of a ball.
    spectrum : Spectrum
        Their mean over the realizations.

    Notes
    -----
    A new measure is one more entry of ``spectral_scalars`` or ``_of_sets``: its names and a function that
    gives a value and a standard error for each.
    """

    def __init__(self, points: FloatArray, fmax: int | None, sides: Sides | None = None) -> None:
        self.points, self.sides = points, sides
        self.near = set_powers(points, fmax, sides)
        self.spectrum = self.near.spectrum
        self._by_default = fmax is None
        self._spectral = spectral_scalars(self.near)
        self._neighbours: Sequence[Neighbours] | None = None

    @cached_property
    def far(self) -> SetPowers | None:
        """Shells beyond the end of a default cube, listed; None where none are affordable."""
        return farther_powers(self.points, self.near) if self._by_default else None

    @property
    def radial(self) -> RadialPower:
        """Mean power of the exact shells, pooled where sides are unequal, as far as they were evaluated."""
        near, far = self.near.profile, self._evaluated_far()
        if far is None:
            return near
        beyond = far.radial.frequency > near.frequency[-1]
        return RadialPower(
            *(
                np.append(getattr(near, name), getattr(far.radial, name)[beyond])
                for name in ("frequency", "nu", "power", "count")
            )
        )

    def anisotropy(self) -> dict[str, NDArray[Any]]:
        """Columns of the anisotropy of each ring, as far as shells were evaluated."""
        near, far = anisotropy_columns(self.near.shell_spectrum()), self._evaluated_far()
        if far is None:
            return near
        rings = anisotropy_columns(far.shell_spectrum())
        farther = rings["frequency"] > near["frequency"].max()
        return {name: np.append(values, rings[name][farther]) for name, values in near.items()}

    def _evaluated_far(self) -> SetPowers | None:
        """Return the farther shells if a measure needed them."""
        return self.__dict__.get("far")

    def neighbours(self) -> Sequence[Neighbours]:
        """Delaunay neighbours of every set, triangulated once."""
        if self._neighbours is None:
            self._neighbours = neighbours(self.points, self.sides)
        return self._neighbours

    @cached_property
    def nearest(self) -> FloatArray:
        """Distance of every point to its nearest neighbour, in densest spacings: (realizations, n)."""
        return nearest_distances(self.points, self.sides)

    @cached_property
    def discrepancies(self) -> dict[Discrepancy, DiscrepancyResult]:
        """Discrepancies of every set, which in the plane share most of their cost."""
        return measure_discrepancies(self.points, ("WD", "L2-star"))

    def measures(self) -> Measures:
        """Assemble values, standard errors and reasons in the order of ``DEFINITIONS``."""
        values: dict[str, float] = {}
        errors: dict[str, float] = {}
        reasons: dict[str, str] = {}
        for names, compute in (*self._of_spectrum(), *self._of_sets()):
            try:
                for name, (value, error) in zip(names, compute(), strict=True):
                    values[name], errors[name] = value, error
                    if not math.isfinite(value):
                        values[name] = errors[name] = math.nan
                        reasons[name] = "not finite: the sets are too few or too regular for it"
            except RefusalError as refusal:
                for name in names:
                    values[name] = errors[name] = math.nan
                    reasons[name] = str(refusal)
        order = [definition.name for definition in DEFINITIONS]
        return Measures({m: values[m] for m in order}, {m: errors[m] for m in order}, reasons)

    def _of_spectrum(self) -> list[_Entry]:
        """Measures of the mean spectrum; those that it is too short for are taken from farther shells."""
        return [(names, partial(self._reaching, names)) for names in self._spectral]

    def _reaching(self, names: tuple[str, ...]) -> list[Estimate]:
        """Compute measures of the spectrum, of farther shells where it ends too early, or say the cost."""
        try:
            return self._spectral[names]()
        except ShortSpectrumError as short:
            if self.far is None:
                raise ShortSpectrumError(f"{short}{self._cost_of_more(self.near)}") from None
        try:
            return spectral_scalars(self.far)[names]()
        except ShortSpectrumError as short:
            raise ShortSpectrumError(f"{short}{self._cost_of_more(self.far)}") from None

    def _cost_of_more(self, powers: SetPowers) -> str:
        """Say what the next shell costs; nothing of a cube, or where an fmax was asked for."""
        if self.sides is not None or not (self._by_default and powers.listed):
            return ""
        most = int(powers.most)
        count = sum(shell_sizes(self.points.shape[2], most + 1))
        return (
            f"; shells up to |f|^2 = {most} are affordable by default, the next one would make it "
            f"{float(count):.2g} frequencies"
        )

    def _of_sets(self) -> list[_Entry]:
        """Measures of each set, averaged."""

        def psa() -> list[Estimate]:
            statistics = spectral_statistics(self.points, self.sides)
            return [
                (
                    statistics.effective_nyquist,
                    math.hypot(statistics.effective_nyquist_error, NYQUIST_STEP / math.sqrt(12)),
                ),
                (statistics.oscillations, statistics.oscillations_error),
            ]

        def discrepancy(kind: Discrepancy) -> Callable[[], list[Estimate]]:
            def estimates() -> list[Estimate]:
                found = self.discrepancies[kind]
                unknown = [reason for reason in found.reasons if reason]
                if unknown:
                    raise RefusalError(unknown[0])
                return [mean_over_sets(found.value)]

            return estimates

        return [
            (("min_distance",), lambda: [mean_over_sets(self.nearest.min(axis=1))]),
            (("mean_distance",), lambda: [mean_over_sets(self.nearest.mean(axis=1))]),
            (("bond_order",), lambda: [mean_over_sets(bond_order(self.neighbours()))]),
            (("psi6",), lambda: [mean_over_sets(psi6(self.neighbours()))]),
            (("valence6",), lambda: [mean_over_sets(valence6(self.neighbours()))]),
            (("effective_nyquist", "oscillations"), psa),
            (("discrepancy_wd",), discrepancy("WD")),
            (("discrepancy_star",), discrepancy("L2-star")),
        ]
