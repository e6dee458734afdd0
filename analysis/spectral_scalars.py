"""Scalar measures of the mean spectrum, with their standard errors by the jackknife over sets."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from gbnbench.analysis.outcomes import values_of
from gbnbench.analysis.radial.anisotropy import anisotropy_db
from gbnbench.analysis.radial.profile_measures import (
    exponential_fit,
    noise_floor,
    peak,
    power_at_1,
    powerlaw_fit,
)
from gbnbench.analysis.set_powers import SetPowers
from gbnbench.analysis.standard_errors import Estimate, jackknife, left_out_sums, mean_over_sets
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.torus import FloatArray

Entries = dict[tuple[str, ...], Callable[[], list[Estimate]]]


def spectral_scalars(powers: SetPowers) -> Entries:
    """List the measures of a spectrum.

    Parameters
    ----------
    powers : SetPowers
        Of the sets of a source, in a cube or a ball.

    Returns
    -------
    dict
        Names of measures -> function that gives a value and a standard error for each of them; it raises
        RefusalError where they are undefined, ShortSpectrumError where the spectrum ends too early. A new
        measure is one more entry.
    """
    rows = powers.rows
    full_rows = powers.full_rows
    realizations, spacing = len(rows), powers.spectrum.spacing

    def profile(
        compute: Callable[[RadialPower], Sequence[float]], *, full: bool = False
    ) -> Callable[[], list[Estimate]]:
        radial, each = (powers.profile, full_rows) if full else (powers.radial, rows)

        def estimates() -> list[Estimate]:
            others = (
                compute(replace(radial, power=total / (realizations - 1))) for total in left_out_sums(each)
            )
            return jackknife(compute(radial), others, realizations)

        return estimates

    def directional() -> list[Estimate]:
        def decibels(power: FloatArray, sets: int) -> list[float]:
            return [anisotropy_db(power, powers.full_shells, sets, spacing)]

        # Left-out spectra read -10 log10(M - m): the same shift for each, so the spread is not touched.
        size = powers.group
        whole, rest = realizations // size, realizations - size
        others = (
            decibels(total / rest, rest)
            for total in left_out_sums(powers.groups[:whole], powers.groups[whole:].sum(axis=0))
        )
        return jackknife(decibels(powers.spectrum.power, realizations), others, realizations, size)

    def energy() -> list[Estimate]:
        return [mean_over_sets(np.concatenate(values_of(powers.energies)))]

    def exponential(radial: RadialPower) -> Sequence[float]:
        fit = exponential_fit(radial)
        return math.exp(fit.intercept), fit.slope, fit.residual_db

    def powerlaw(radial: RadialPower) -> Sequence[float]:
        fit = powerlaw_fit(radial)
        return fit.slope, fit.residual_db

    def summit() -> list[Estimate]:
        (value, error), (nu, spread) = profile(peak)()
        # Left-out spectra often peak on the same ring: its width is part of the error.
        return [(value, error), (nu, math.hypot(spread, spacing / math.sqrt(12)))]

    return {
        ("noise_floor",): profile(lambda r: [noise_floor(r)]),
        ("power_at_1",): profile(lambda r: [power_at_1(r)]),
        ("profile_epsilon", "profile_c", "profile_residual_db"): profile(exponential, full=True),
        ("powerlaw_exponent", "powerlaw_residual_db"): profile(powerlaw, full=True),
        ("peak", "peak_nu"): summit,
        ("anisotropy_db",): directional,
        ("evacuated_energy",): energy,
    }
