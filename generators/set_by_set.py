"""Generators that draw one set after another and tell how far each is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.monitor import Monitor, refuse_all_but_progress
from gbnbench.generators.ranges import raise_refusal

PARTS = 1000  # of a set, in which its progress is told

Told = Callable[[float], None]  # takes the share of a set that is done, 0 to 1


class SetBySet(ABC):
    """What generators share whose sets take long: progress within a set, neither trace nor checkpoint.

    Attributes
    ----------
    name : str
        What the command calls it.
    """

    name: ClassVar[str]

    @abstractmethod
    def refusal(self, n: int, d: int) -> str | None:
        """Say why n points in d dimensions cannot be made, as ``Generator.refusal`` does."""

    @abstractmethod
    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization that is not refused.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        rng : numpy.random.Generator
            The stream that it is drawn from.
        told : callable
            Takes the share of it that is done, from 0 to 1.

        Returns
        -------
        (n, d) float64
        """

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization, (n, d) float64; RefusalError where ``refusal`` has a reason."""
        one: FloatArray = self.draw(n, d, [rng], Monitor())[0]
        return one

    def draw(self, n: int, d: int, rngs: Sequence[np.random.Generator], monitor: Monitor) -> FloatArray:
        """Draw one set from each stream.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        rngs : sequence of numpy.random.Generator
            One for each set.
        monitor : Monitor
            Progress.

        Returns
        -------
        (len(rngs), n, d) float64

        Raises
        ------
        InputError
            If a trace or a checkpoint is asked for.
        RefusalError
            Where ``refusal`` has a reason.
        """
        refuse_all_but_progress(monitor, self.name)
        raise_refusal(self.refusal(n, d))
        sets = []
        for k, rng in enumerate(rngs):
            told = self._told(monitor, k, len(rngs))
            sets.append(self.one_set(n, d, rng, told))
            told(1.0)
        return np.stack(sets)

    def _told(self, monitor: Monitor, k: int, sets: int) -> Told:
        progress, done = monitor.progress, 0

        def told(share: float) -> None:
            nonlocal done
            done = max(done, round(PARTS * share))  # a set that is begun anew does not go back
            if progress is not None:
                progress(PARTS * k + done, PARTS * sets, f"{self.name}, set {k + 1}")

        return told
