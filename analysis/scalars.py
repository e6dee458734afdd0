"""Scalar measures of point sets, put together from the pieces of a source, with their standard errors."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.measure_definitions import DEFINITIONS
from gbnbench.analysis.measuring_plan import MeasuringPlan
from gbnbench.analysis.outcomes import Arrays, is_refused, values_of, within
from gbnbench.analysis.radial.anisotropy import anisotropy_columns
from gbnbench.analysis.radial.psa import statistics_of
from gbnbench.analysis.set_powers import PowersMerger, SetPowers
from gbnbench.analysis.spectral_scalars import spectral_scalars
from gbnbench.analysis.spectrum.listed_shells import shell_sizes
from gbnbench.analysis.standard_errors import Estimate, mean_over_sets
from gbnbench.core.errors import RefusalError, ShortSpectrumError
from gbnbench.core.large_arrays import RowFiller
from gbnbench.core.results.measures import Measures
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.torus import FloatArray

NYQUIST_STEP = 0.005  # resolution of the effective Nyquist frequency, part of its error
_Entry = tuple[tuple[str, ...], Callable[[], list[Estimate]]]


class Scalars:
    """Scalars of a source, from what its pieces measured.

    Parameters
    ----------
    plan : MeasuringPlan
        Of the source.
    pieces : iterable of mapping
        As ``measure_piece`` returns them, all, in the order of the sets.

    Attributes
    ----------
    near : SetPowers
        Power of the sets: cubes where they are affordable, else the shells of a ball.
    far : SetPowers or None
        Shells beyond the end of a default cube, listed; None where they were not evaluated.

    Notes
    -----
    A new measure of the spectrum is one more entry of ``spectral_scalars``: its names and a function that
    gives a value and a standard error for each. One of single sets is an entry of ``_of_sets`` in
    ``piece_measures``.
    """

    def __init__(self, plan: MeasuringPlan, pieces: Iterable[Arrays]) -> None:
        self._plan = plan
        self._pieces: list[Arrays] = []  # without the powers
        near = PowersMerger(plan.near, plan.group, plan.n, plan.realizations)
        far: PowersMerger | None = None
        self._rows: dict[str, RowFiller] = {}
        for piece in pieces:  # each is looked at once, and may then be let go
            near.add(within(piece, "near"))
            if plan.far is not None and (farther := within(piece, "far")):
                far = far or PowersMerger(plan.far, plan.group, plan.n, plan.realizations)
                far.add(farther)
            others = {name: array for name, array in piece.items() if "/" not in name}
            if not is_refused(others["psa"]):  # many numbers a set
                if "psa" not in self._rows:
                    self._rows["psa"] = RowFiller((plan.realizations, others["psa"].shape[1]))
                self._rows["psa"].add(others["psa"])
                others["psa"] = others["psa"][:0]
            self._pieces.append(others)
        self.near = near.merged()
        self.far = None if far is None else far.merged()
        self._spectral = spectral_scalars(self.near)

    @property
    def spectrum(self) -> Spectrum:
        """Mean power over the realizations."""
        return self.near.spectrum

    @property
    def radial(self) -> RadialPower:
        """Mean power of the exact shells, pooled where sides are unequal, as far as they were evaluated."""
        near, far = self.near.profile, self.far
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
        near, far = anisotropy_columns(self.near.shell_spectrum()), self.far
        if far is None:
            return near
        rings = anisotropy_columns(far.shell_spectrum())
        farther = rings["frequency"] > near["frequency"].max()
        return {name: np.append(values, rings[name][farther]) for name, values in near.items()}

    def outcomes(self, name: str) -> list[NDArray[Any]]:
        """Give what each piece has under a name; raises RefusalError where it is undefined."""
        return values_of([piece[name] for piece in self._pieces])

    def zone_plate(self) -> FloatArray | None:
        """Return the picture of the first set; None where it means nothing."""
        found = self._pieces[0]["zone_plate"]
        return None if is_refused(found) else found

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
        if self._plan.sides is not None or not (self._plan.fmax is None and powers.region.listed):
            return ""
        most = int(powers.region.most)
        count = sum(shell_sizes(self._plan.d, most + 1))
        return (
            f"; shells up to |f|^2 = {most} are affordable by default, the next one would make it "
            f"{float(count):.2g} frequencies"
        )

    def _of_sets(self) -> list[_Entry]:
        """Measures of each set, averaged."""

        def psa() -> list[Estimate]:
            self.outcomes("psa")  # raises the refusal of the first piece that has one
            statistics = statistics_of(self._rows["psa"].whole(), self._plan.n)
            return [
                (
                    statistics.effective_nyquist,
                    math.hypot(statistics.effective_nyquist_error, NYQUIST_STEP / math.sqrt(12)),
                ),
                (statistics.oscillations, statistics.oscillations_error),
            ]

        def averaged(name: str) -> list[Estimate]:
            return [mean_over_sets(np.concatenate(self.outcomes(name)))]

        each: list[_Entry] = [
            ((definition.name,), partial(averaged, definition.name))
            for definition in DEFINITIONS
            if definition.name in self._pieces[0]
        ]
        return [*each, (("effective_nyquist", "oscillations"), psa)]
