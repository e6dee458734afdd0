"""The point sets that claims are measured on, each kind drawn or read once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from gbnbench.analysis.measures import measures
from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.errors import GbnbenchError, InputError
from gbnbench.core.results.measures import Measures
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.results.resolution import gaussian_response
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.torus import FloatArray, as_realizations
from gbnbench.generators.monitor import Monitor, Trace
from gbnbench.generators.registry import find, generate
from gbnbench.io.points import load

SEED = 2022
PAPER = "gbn[iterations=10000]"  # the paper's own descent at the length that it recommends
FAST = "gbn"  # 320 gradients: the same quality
MILLION = "gbn[gradients=3000]"  # as deep as a million steps of descent; the claim `equivalence` checks it


class MissingError(GbnbenchError):
    """Sets by others that are needed and were not given."""


@dataclass(frozen=True)
class DrawnSets:
    """Some sets of one kind.

    Attributes
    ----------
    x : (sets, n, d) float64
        On the unit torus.
    """

    x: FloatArray

    @cached_property
    def measures(self) -> Measures:
        """Every scalar with its standard error over the sets."""
        return measures(self.x)

    @cached_property
    def spectrum(self) -> Spectrum:
        """Mean power up to nu = 1 at least."""
        _, n, d = self.x.shape
        return periodogram(self.x, max(1, int(np.ceil(n ** (1 / d)))))

    @cached_property
    def radial(self) -> RadialPower:
        """Mean power on exact shells."""
        return radial(self.spectrum)

    @cached_property
    def lowest(self) -> float:
        """Mean power at |f| = 1, in any dimension."""
        d = self.x.shape[2]
        return float(periodogram(self.x, frequencies=np.eye(d, dtype=np.int64)).power.mean())

    @property
    def level(self) -> float:
        """Power at |f| = 1 over exp(4 pi^2 nu^2): eps of Eq. (19) as the lowest shell has it."""
        _, n, d = self.x.shape
        return self.lowest * float(gaussian_response(np.array(n ** (-1 / d)), 1.0))

    def value(self, measure: str) -> tuple[float, float]:
        """Return a measure and its standard error."""
        told = self.measures
        return told[measure], told.standard_error[measure]


class SetCache:
    """Draws sets or reads them, and keeps each kind for all claims.

    Parameters
    ----------
    folders : mapping of str to Path
        Folders of point sets by others: ``bnot``, ``step``.
    share : float
        Of the number of sets and steps that claims ask for; tests take less than 1.
    """

    def __init__(self, folders: Mapping[str, Path] | None = None, share: float = 1.0) -> None:
        self._folders = dict(folders or {})
        self._share = share
        self._drawn: dict[tuple[str, int, int, int], DrawnSets] = {}
        self._traces: dict[tuple[int, ...], Trace] = {}

    def few(self, count: int, least: int = 2) -> int:
        """Return a count, or the share of it that is taken where less is done.

        Parameters
        ----------
        count : int
            The count of a whole measurement.
        least : int
            The smallest that is returned.

        Returns
        -------
        int
        """
        return max(least, round(self._share * count)) if self._share < 1 else count

    def draw(self, spec: str, n: int = 1024, d: int = 2, sets: int = 4) -> DrawnSets:
        """Draw sets of a generator, once for all claims.

        Parameters
        ----------
        spec : str
            The generator, with its settings.
        n, d, sets : int
            Points in a set, dimension, number of sets.

        Returns
        -------
        DrawnSets
        """
        sets = self.few(sets)
        if self._share < 1:
            generator = find(spec)
            if getattr(generator, "iterations", 0):
                spec = spec.replace(
                    f"iterations={generator.iterations}",  # type: ignore[attr-defined]
                    f"iterations={self.few(generator.iterations, 30)}",  # type: ignore[attr-defined]
                )
        key = (spec, n, d, sets)
        if key not in self._drawn:
            x = generate(spec, n=n, d=d, seed=SEED, realizations=sets)
            self._drawn[key] = DrawnSets(x.reshape(sets, n, d))
        return self._drawn[key]

    def evolution(self, stops: tuple[int, ...], n: int = 1024, sets: int = 4) -> Trace:
        """Follow the paper's descent in the plane.

        Parameters
        ----------
        stops : tuple of int
            Steps after which the points are kept.
        n, sets : int
            Points in a set, number of sets.

        Returns
        -------
        Trace
        """
        key = (n, self.few(sets), *(self.few(stop, 1) for stop in stops))
        if key not in self._traces:
            trace = Trace(keep_at=key[2:])
            generator = f"gbn[iterations={key[-1]}]"
            x = generate(generator, n=n, seed=SEED, realizations=key[1], monitor=Monitor(trace=trace))
            self._traces[key] = trace
            self._drawn[generator, n, 2, key[1]] = DrawnSets(x.reshape(key[1], n, 2))
        return self._traces[key]

    def others(self, name: str) -> DrawnSets:
        """Read sets by others, all those of one size in their folder.

        Raises
        ------
        MissingError
            If their folder was not given.
        InputError
            If it holds no sets, or of several sizes.
        """
        if name not in self._folders:
            raise MissingError(f"no sets of {name}: give their folder by --sets {name}=FOLDER")
        key = (name, 0, 0, 0)
        if key not in self._drawn:
            files = sorted(path for path in self._folders[name].iterdir() if path.suffix == ".txt")
            found = [as_realizations(load(path)) for path in files]
            if not found or len({x.shape[1:] for x in found}) != 1:
                raise InputError(
                    f"{self._folders[name]} must hold sets of one size; found {len(found)} files"
                )
            self._drawn[key] = DrawnSets(np.concatenate(found))
        return self._drawn[key]
