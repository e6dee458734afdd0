"""Power of the sets of a source over a region of frequencies: measured by pieces, then put together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.frequency_region import FrequencyRegion
from gbnbench.analysis.outcomes import Arrays, outcome
from gbnbench.analysis.radial.profile_measures import evacuated_energy, evacuated_energy_of_ball
from gbnbench.analysis.radial.radial_power import mean_over_groups
from gbnbench.analysis.spectrum.power_of_each import averaged
from gbnbench.analysis.spectrum.shells import Shells
from gbnbench.core.large_arrays import RowFiller
from gbnbench.core.results.radial import RadialPower, ShellSpectrum
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.torus import FloatArray

OF_SPECTRUM = ("fmax", "precision", "method", "device", "error_rms", "error_bound")


@dataclass(frozen=True)
class SetPowers:
    """What is kept of the power of every set of a source, and its mean.

    Attributes
    ----------
    region : FrequencyRegion
        The frequencies.
    spectrum : Spectrum
        Mean over the sets.
    rows, full_rows : (realizations, shells) float64
        Mean power of every set on each exact and on each full shell.
    groups : (groups, ...) float64
        Sums of the power over consecutive groups of sets, at every frequency; the last may be of fewer.
    group : int
        Sets of a group.
    energies : tuple of array
        Evacuated energy of each set, or its refusal: outcomes of the pieces.
    """

    region: FrequencyRegion
    spectrum: Spectrum
    rows: FloatArray
    full_rows: FloatArray
    groups: FloatArray
    group: int
    energies: tuple[NDArray[Any], ...]

    @property
    def shells(self) -> Shells:
        """Exact shells of the frequencies."""
        return self.region.shells

    @property
    def full_shells(self) -> Shells:
        """Shells with frequencies enough for a mean and a spread: pooled ones where sides are unequal."""
        return self.region.full_shells

    @cached_property
    def radial(self) -> RadialPower:
        """Mean power of every shell."""
        return mean_over_groups(self.spectrum.power, self.shells, self.spectrum.spacing)

    @cached_property
    def profile(self) -> RadialPower:
        """Mean power of every full shell."""
        if self.spectrum.sides is None:
            return self.radial
        return mean_over_groups(self.spectrum.power, self.full_shells, self.spectrum.spacing)

    def shell_spectrum(self) -> ShellSpectrum:
        """Mean and spread of every shell."""
        mean, deviation = self.shells.moments(self.spectrum.power)
        names = (
            "n", "d", "realizations", "fmax", "precision", "method", "device", "error_rms", "error_bound",
            "sides",
        )  # fmt: skip
        return ShellSpectrum(
            frequency=self.shells.radius,
            nu=self.shells.radius * self.spectrum.spacing,
            power=mean,
            count=self.shells.count,
            deviation=deviation,
            **{name: getattr(self.spectrum, name) for name in names},
        )


def measured_powers(points: FloatArray, region: FrequencyRegion, group: int) -> dict[str, NDArray[Any]]:
    """Evaluate the power of the sets of a piece, and keep what ``PowersMerger`` needs of it.

    Parameters
    ----------
    points : (sets, n, d) float64
        Checked points.
    region : FrequencyRegion
        At which frequencies.
    group : int
        Sets of a group, as ``group_size`` gives them.

    Returns
    -------
    dict of arrays
        ``rows``, ``full_rows`` (for unequal sides), ``groups``, ``energies``, and what a spectrum says of how
        it was found.
    """
    powers, first = region.powers(points)
    n, d = points.shape[1:]
    kept: dict[str, NDArray[Any]] = {
        "rows": np.stack([region.shells.mean(power) for power in powers]),
        "groups": powers
        if group == 1
        else np.stack([powers[k : k + group].sum(axis=0) for k in range(0, len(powers), group)]),
        "energies": outcome(lambda: [_energy(power, region, n, d) for power in powers]),
    }
    if region.sides is not None:
        kept["full_rows"] = np.stack([region.full_shells.mean(power) for power in powers])
    return kept | {name: np.asarray(getattr(first, name)) for name in OF_SPECTRUM}


class PowersMerger:
    """What was kept of the pieces of a source put together, piece by piece.

    Parameters
    ----------
    region : FrequencyRegion
        The frequencies.
    group : int
        Sets of a group.
    n, realizations : int
        Points of a set, and sets of all pieces together.

    Notes
    -----
    The same bits come out wherever and whenever the pieces were made: sums are taken in their order.
    """

    def __init__(self, region: FrequencyRegion, group: int, n: int, realizations: int) -> None:
        self._region, self._group, self._n, self._realizations = region, group, n, realizations
        self._rows = RowFiller((realizations, region.shells.size))
        self._full_rows = None if region.sides is None else RowFiller((realizations, region.full_shells.size))
        self._groups = _Groups(group)
        self._told: list[dict[str, NDArray[Any]]] = []

    def add(self, piece: Arrays) -> None:
        """Take the next piece, as ``measured_powers`` returns it, in the order of the sets."""
        self._rows.add(piece["rows"])
        if self._full_rows is not None:
            self._full_rows.add(piece["full_rows"])
        self._groups.add(piece)
        self._told.append({name: piece[name] for name in (*OF_SPECTRUM, "energies")})

    def merged(self) -> SetPowers:
        """Return the powers of all pieces."""
        told, region, rows, groups = self._told, self._region, self._rows.whole(), self._groups.all()
        first = Spectrum(
            groups[0],
            n=self._n,
            d=region.d,
            realizations=1,
            fmax=int(told[0]["fmax"]),
            frequencies=region.frequencies,
            precision=_words(told, "precision"),
            method=_words(told, "method"),
            device=_words(told, "device"),
            error_rms=max(float(piece["error_rms"]) for piece in told),
            error_bound=max(float(piece["error_bound"]) for piece in told),
            sides=region.sides,
        )
        return SetPowers(
            region=region,
            spectrum=averaged(first, groups.sum(axis=0) / len(rows), len(rows)),
            rows=rows,
            full_rows=rows if self._full_rows is None else self._full_rows.whole(),
            groups=groups,
            group=self._group,
            energies=tuple(piece["energies"] for piece in told),
        )


def one_set(powers: SetPowers) -> SetPowers:
    """Return the same as if the first set, or group, were all: what it is too short for, they all are."""
    few = replace(powers.spectrum, realizations=1)
    return replace(powers, spectrum=few, rows=powers.rows[:1], full_rows=powers.full_rows[:1])


def _words(pieces: Sequence[Arrays], name: str) -> str:
    """Join what pieces say, where they differ."""
    return ", ".join(dict.fromkeys(str(piece[name]) for piece in pieces))


class _Groups:
    """Sums of groups of sets; where a group is larger than a piece, consecutive pieces are its parts."""

    def __init__(self, group: int) -> None:
        self._group, self._many = group, 0
        self._sums: list[FloatArray] = []
        self._parts: list[FloatArray] = []

    def add(self, piece: Arrays) -> None:
        """Take the groups, or the part of one, that are in a piece."""
        self._many = self._many or max(1, self._group // len(piece["rows"]))
        if self._many == 1:
            self._sums.extend(piece["groups"])
            return
        self._parts.append(piece["groups"][0])
        if len(self._parts) == self._many:
            self._close()

    def all(self) -> FloatArray:
        """List the groups."""
        if self._parts:
            self._close()
        return np.stack(self._sums)

    def _close(self) -> None:
        self._sums.append(np.sum(self._parts, axis=0))
        self._parts = []


def _energy(power: FloatArray, region: FrequencyRegion, n: int, d: int) -> float:
    """Evacuated energy of one set."""
    if region.listed:
        return evacuated_energy_of_ball(power, region.square, n, d, region.most if region.sides else None)
    return evacuated_energy(power, n, d, int(region.reach), region.sides)
