"""Scalar measures of point sets, computed from the power of every set, with their standard errors."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cached_property, partial
from typing import TYPE_CHECKING

import numpy as np

from gbnbench.analysis.measure_definitions import DEFINITIONS
from gbnbench.analysis.radial.anisotropy import anisotropy, anisotropy_db
from gbnbench.analysis.radial.profile_measures import (
    evacuated_energy,
    evacuated_energy_of_ball,
    exponential_fit,
    noise_floor,
    peak,
    power_at_1,
    powerlaw_fit,
)
from gbnbench.analysis.radial.psa import spectral_statistics
from gbnbench.analysis.set_powers import SetPowers, farther_powers, set_powers
from gbnbench.analysis.spatial.bond_order import bond_order, psi6
from gbnbench.analysis.spatial.delaunay import Neighbours, neighbours
from gbnbench.analysis.spatial.discrepancy import measure_discrepancies
from gbnbench.analysis.spatial.discrepancy_kernels import Discrepancy
from gbnbench.analysis.spatial.distances import mean_distance, min_distance
from gbnbench.analysis.spatial.valence import valence6
<<<<<<< HEAD
from gbnbench.analysis.spectrum.listed_shells import shell_sizes
from gbnbench.analysis.standard_errors import Estimate, jackknife, mean_over_sets
from gbnbench.core.errors import RefusalError, ShortSpectrumError
=======
from gbnbench.analysis.spectrum.limits import check_fmax, default_fmax
from gbnbench.analysis.spectrum.periodogram import each_power
from gbnbench.analysis.spectrum.shells import Shells, exact_shells
from gbnbench.analysis.standard_errors import Estimate, jackknife, left_out_sums, mean_over_sets
from gbnbench.core.errors import RefusalError
>>>>>>> main
from gbnbench.core.results.measures import Measures
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.torus import FloatArray

if TYPE_CHECKING:
    import pandas as pd

NYQUIST_STEP = 0.005  # resolution of the effective Nyquist frequency, part of its error
_Entry = tuple[tuple[str, ...], Callable[[], list[Estimate]]]


class Scalars:
    """Power of every set, from which the scalars are computed.

    Parameters
    ----------
    points : (realizations, n, d) float64
        Checked points.
    fmax : int or None
        Largest harmonic on each axis; None for as far as nu = 2, or as affordable (``default_fmax``).

    Attributes
    ----------
    near : SetPowers
        Power of every set: cubes where they are affordable, else the shells of a ball.
    spectrum : Spectrum
        Their mean over the realizations.

    Notes
    -----
    A new measure is one more entry of ``_of_spectrum`` or ``_of_sets``: its names and a function that gives a
    value and a standard error for each.
    """

    def __init__(self, points: FloatArray, fmax: int | None) -> None:
        self.points = points
        self.near = set_powers(points, fmax)
        self.spectrum = self.near.spectrum
        self._by_default = fmax is None
        self._neighbours: Sequence[Neighbours] | None = None

    @cached_property
    def far(self) -> SetPowers | None:
        """Shells beyond the end of a default cube, listed; None where none are affordable."""
        return farther_powers(self.points, self.near) if self._by_default else None

    @property
    def radial(self) -> RadialPower:
        """Mean power of the exact shells, as far as they were evaluated."""
        near, far = self.near.radial, self._evaluated_far()
        if far is None:
            return near
        beyond = far.radial.frequency > near.frequency[-1]
        return RadialPower(
            *(
                np.append(getattr(near, name), getattr(far.radial, name)[beyond])
                for name in ("frequency", "nu", "power", "count")
            )
        )

    def anisotropy(self) -> pd.DataFrame:
        """Anisotropy of each ring, as far as shells were evaluated."""
        near, far = anisotropy(self.near.shell_spectrum()), self._evaluated_far()
        if far is None:
            return near
        import pandas as pd

        rings = anisotropy(far.shell_spectrum())
        return pd.concat([near, rings[rings.frequency > near.frequency.max()]], ignore_index=True)

    def _evaluated_far(self) -> SetPowers | None:
        """Return the farther shells if a measure needed them."""
        return self.__dict__.get("far")

    def neighbours(self) -> Sequence[Neighbours]:
        """Delaunay neighbours of every set, triangulated once."""
        if self._neighbours is None:
            self._neighbours = neighbours(self.points)
        return self._neighbours

    def measures(self) -> Measures:
        """Assemble values, standard errors and reasons in the order of ``DEFINITIONS``."""
        values: dict[str, float] = {}
        errors: dict[str, float] = {}
        reasons: dict[str, str] = {}
        for names, compute in self._entries():
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

    def _entries(self) -> list[_Entry]:
        """Every measure; those that the spectrum is too short for are taken from farther shells."""
        spectral = [
            (names, partial(self._reaching, names, compute))
            for names, compute in self._of_spectrum(self.near)
        ]
        return [*spectral, *self._of_sets()]

    def _reaching(self, names: tuple[str, ...], compute: Callable[[], list[Estimate]]) -> list[Estimate]:
        """Compute a measure of the spectrum, of farther shells where it ends too early, or say their cost."""
        try:
            return compute()
        except ShortSpectrumError as short:
            if self.far is None:
                raise ShortSpectrumError(f"{short}{self._cost_of_more(self.near)}") from None
            far = self.far
        try:
            return dict(self._of_spectrum(far))[names]()
        except ShortSpectrumError as short:
            raise ShortSpectrumError(f"{short}{self._cost_of_more(far)}") from None

    def _cost_of_more(self, powers: SetPowers) -> str:
        """Say what stands in the way of the next shell; empty for a cube and for an fmax that was asked for."""
        if not self._by_default or powers.pairs == 2:
            return ""
        count = sum(shell_sizes(self.points.shape[2], powers.most + 1))
        return (
            f"; shells up to |f|^2 = {powers.most} are affordable by default, with the next one it would be "
            f"{float(count):.2g} frequencies"
        )

    def _of_spectrum(self, powers: SetPowers) -> list[_Entry]:
        """Measures of the mean spectrum, their errors by the jackknife over sets, and its evacuated energy."""
        rows = np.stack([powers.shells.mean(power) for power in powers.powers])
        realizations = len(rows)
        _, n, d = self.points.shape

        def profile(compute: Callable[[RadialPower], Sequence[float]]) -> Callable[[], list[Estimate]]:
            radial = powers.radial

            def with_power(power: FloatArray) -> RadialPower:
                return RadialPower(radial.frequency, radial.nu, power, radial.count)

            def estimates() -> list[Estimate]:
                others = (compute(with_power(p / (realizations - 1))) for p in left_out_sums(rows))
                return jackknife(compute(self.radial), others, realizations)

<<<<<<< HEAD
            return lambda: jackknife(compute(radial), left_out, realizations)

        def directional() -> list[Estimate]:
            spacing, total = self.spectrum.spacing, powers.powers.sum(axis=0)

            def left_out(k: int) -> Sequence[float]:
                rest = (total - powers.powers[k]) / (realizations - 1)
                return [anisotropy_db(rest, powers.shells, realizations - 1, spacing)]

            whole = [anisotropy_db(powers.spectrum.power, powers.shells, realizations, spacing)]
=======
            return estimates

        def directional() -> list[Estimate]:
            def decibels(power: FloatArray, sets: int) -> list[float]:
                return [anisotropy_db(power, self.shells, sets, self.spectrum.spacing)]

>>>>>>> main
            # Left-out spectra read -10 log10(M - 1): the same shift for each, so the spread is not touched.
            rest = realizations - 1
            others = (decibels(total / rest, rest) for total in left_out_sums(self.powers))
            return jackknife(decibels(self.spectrum.power, realizations), others, realizations)

        def energy() -> list[Estimate]:
            each = [
                evacuated_energy(power, n, d, powers.spectrum.fmax)
                if powers.pairs == 2
                else evacuated_energy_of_ball(power, powers.square, n, d)
                for power in powers.powers
            ]
            return [mean_over_sets(np.array(each))]

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
            (("profile_epsilon", "profile_c", "profile_residual_db"), profile(exponential)),
            (("powerlaw_exponent", "powerlaw_residual_db"), profile(powerlaw)),
            (("peak", "peak_nu"), summit),
            (("anisotropy_db",), directional),
            (("evacuated_energy",), energy),
        ]

    def _of_sets(self) -> list[_Entry]:
        """Measures of each set, averaged."""

        def psa() -> list[Estimate]:
            statistics = spectral_statistics(self.points)
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
            (("min_distance",), lambda: [mean_over_sets(min_distance(self.points))]),
            (("mean_distance",), lambda: [mean_over_sets(mean_distance(self.points))]),
            (("bond_order",), lambda: [mean_over_sets(bond_order(self.neighbours()))]),
            (("psi6",), lambda: [mean_over_sets(psi6(self.neighbours()))]),
            (("valence6",), lambda: [mean_over_sets(valence6(self.neighbours()))]),
            (("effective_nyquist", "oscillations"), psa),
            (("discrepancy_wd",), discrepancy("WD")),
            (("discrepancy_star",), discrepancy("L2-star")),
        ]
