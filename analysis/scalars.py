"""Scalar measures of point sets, computed from the power of every set, with their standard errors."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from gbnbench.analysis.measure_definitions import DEFINITIONS
from gbnbench.analysis.radial.anisotropy import anisotropy_db
from gbnbench.analysis.radial.profile_measures import (
    evacuated_energy,
    exponential_fit,
    noise_floor,
    peak,
    power_at_1,
    powerlaw_fit,
)
from gbnbench.analysis.radial.psa import spectral_statistics
from gbnbench.analysis.radial.radial_power import mean_over_groups, shells_of
from gbnbench.analysis.spatial.bond_order import bond_order, psi6
from gbnbench.analysis.spatial.delaunay import Neighbours, neighbours
from gbnbench.analysis.spatial.discrepancy import measure_discrepancies
from gbnbench.analysis.spatial.discrepancy_kernels import Discrepancy
from gbnbench.analysis.spatial.distances import mean_distance, min_distance
from gbnbench.analysis.spatial.valence import valence6
from gbnbench.analysis.spectrum.box_shells import pooled
from gbnbench.analysis.spectrum.limits import default_fmax, default_radius
from gbnbench.analysis.spectrum.periodogram import each_power
from gbnbench.analysis.spectrum.shells import Shells
from gbnbench.analysis.standard_errors import Estimate, jackknife, left_out_sums, mean_over_sets
from gbnbench.core.errors import RefusalError
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
    spectrum : Spectrum
        Mean over the realizations.
    radial : RadialPower
        Its exact shells. Where the sides are unequal these are pooled (``box_shells.pooled``), for profile
        fits and anisotropy too; noise floor, lowest power and peak are of frequencies and rings as they are.

    Notes
    -----
    A new measure is one more entry of ``_of_spectrum`` or ``_of_sets``: its names and a function that gives a
    value and a standard error for each.
    """

    def __init__(self, points: FloatArray, fmax: int | None, sides: Sides | None = None) -> None:
        self.points, self.sides = points, sides
        realizations, n, d = points.shape
        if fmax is None:
            fmax = (
                default_fmax(n, d, realizations)
                if sides is None
                else default_radius(n, d, realizations, sides)
            )
        self.powers, self.spectrum = each_power(points, fmax, sides=sides)
        self._exact: Shells = shells_of(self.spectrum)
        self.shells = self._exact if sides is None else pooled(self._exact, d)
        self.radial = mean_over_groups(self.spectrum.power, self.shells, self.spectrum.spacing)
        self._neighbours: Sequence[Neighbours] | None = None

    def neighbours(self) -> Sequence[Neighbours]:
        """Delaunay neighbours of every set, triangulated once."""
        if self._neighbours is None:
            self._neighbours = neighbours(self.points, self.sides)
        return self._neighbours

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
        """Measures of the mean spectrum, their errors by the jackknife over sets."""
        realizations = len(self.powers)
        exact = self.radial
        if self.shells is not self._exact:
            exact = mean_over_groups(self.spectrum.power, self._exact, self.spectrum.spacing)

        def rows_of(shells: Shells) -> FloatArray:
            return np.stack([shells.mean(power) for power in self.powers])

        rows = rows_of(self._exact)
        pooled_rows = rows if self.shells is self._exact else rows_of(self.shells)

        def profile(
            compute: Callable[[RadialPower], Sequence[float]], *, pool: bool = False
        ) -> Callable[[], list[Estimate]]:
            radial, each = (self.radial, pooled_rows) if pool else (exact, rows)

            def estimates() -> list[Estimate]:
                others = (
                    compute(replace(radial, power=power / (realizations - 1)))
                    for power in left_out_sums(each)
                )
                return jackknife(compute(radial), others, realizations)

            return estimates

        def directional() -> list[Estimate]:
            def decibels(power: FloatArray, sets: int) -> list[float]:
                return [anisotropy_db(power, self.shells, sets, self.spectrum.spacing)]

            # Left-out spectra read -10 log10(M - 1): the same shift for each, so the spread is not touched.
            rest = realizations - 1
            others = (decibels(total / rest, rest) for total in left_out_sums(self.powers))
            return jackknife(decibels(self.spectrum.power, realizations), others, realizations)

        def exponential(radial: RadialPower) -> Sequence[float]:
            fit = exponential_fit(radial)
            return math.exp(fit.intercept), fit.slope, fit.residual_db

        def powerlaw(radial: RadialPower) -> Sequence[float]:
            fit = powerlaw_fit(radial)
            return fit.slope, fit.residual_db

        def summit() -> list[Estimate]:
            (value, error), (nu, spread) = profile(peak)()
            # Left-out spectra often peak on the same ring: its width is part of the error.
            return [(value, error), (nu, math.hypot(spread, self.spectrum.spacing / math.sqrt(12)))]

        return [
            (("noise_floor",), profile(lambda r: [noise_floor(r)])),
            (("power_at_1",), profile(lambda r: [power_at_1(r)])),
            (("profile_epsilon", "profile_c", "profile_residual_db"), profile(exponential, pool=True)),
            (("powerlaw_exponent", "powerlaw_residual_db"), profile(powerlaw, pool=True)),
            (("peak", "peak_nu"), summit),
            (("anisotropy_db",), directional),
        ]

    def _of_sets(self) -> list[_Entry]:
        """Measures of each set, averaged."""
        _, n, d = self.points.shape

        def energy() -> list[Estimate]:
            each = [evacuated_energy(power, n, d, self.spectrum.fmax, self.sides) for power in self.powers]
            return [mean_over_sets(np.array(each))]

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
                found = measure_discrepancies(self.points, (kind,))[kind]
                unknown = [reason for reason in found.reasons if reason]
                if unknown:
                    raise RefusalError(unknown[0])
                return [mean_over_sets(found.value)]

            return estimates

        return [
            (("evacuated_energy",), energy),
            (("min_distance",), lambda: [mean_over_sets(min_distance(self.points, self.sides))]),
            (("mean_distance",), lambda: [mean_over_sets(mean_distance(self.points, self.sides))]),
            (("bond_order",), lambda: [mean_over_sets(bond_order(self.neighbours()))]),
            (("psi6",), lambda: [mean_over_sets(psi6(self.neighbours()))]),
            (("valence6",), lambda: [mean_over_sets(valence6(self.neighbours()))]),
            (("effective_nyquist", "oscillations"), psa),
            (("discrepancy_wd",), discrepancy("WD")),
            (("discrepancy_star",), discrepancy("L2-star")),
        ]
