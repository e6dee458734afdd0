"""Minimisers of the Gaussian Blue Noise energy for many sets at once: the paper's descent, and Nesterov's."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.lowest_band import LowestBandPreconditioner
from gbnbench.generators.gbn.protocol import EnergyEvaluation
from gbnbench.generators.gbn.step_sizes import Curvature

PATIENCE = 20  # steps over which a rise of the excess energy halves the step
PRECONDITION_ABOVE = 45  # spacings a side; below, 300 gradients bring the lowest modes down by themselves


class Descent:
    """The paper's fixed steps (Algorithm 1).

    Parameters
    ----------
    energy : EnergyEvaluation
        The energy and its gradient.
    x : (sets, n, d) float64
        Start, box sides.
    step : float
        In squared spacings: a displacement in spacings over a gradient.
    excess : float
        A set is finished once its excess energy is at most this; 0 never finishes.

    Attributes
    ----------
    x : (sets, n, d) float64
        The points, box sides, not wrapped.
    gradients : int
        Evaluations so far.
    excess, largest : (sets,) float64
        Excess energy a point and longest force at the last evaluation, spacings.
    size : (sets,) float64
        The steps.
    finished : (sets,) bool
        Sets that do not move any more.
    constant : float
        What the energy of the pairs a point has beyond its excess, for traces; nan where it was not said.
    """

    def __init__(
        self,
        energy: EnergyEvaluation,
        x: FloatArray,
        step: float,
        excess: float = 0.0,
    ) -> None:
        sets, n, d = x.shape
        self.x = np.array(x)
        self.gradients = 0
        self.excess = np.full(sets, np.nan)
        self.largest = np.full(sets, np.nan)
        self.size = np.full(sets, step)
        self.finished = np.zeros(sets, bool)
        self.constant = math.nan
        self._side = n ** (1 / d)
        self._energy, self._enough = energy, excess

    def advance(self) -> None:
        """Evaluate once and move every set that is not finished."""
        slope = self._evaluate(self.x)
        moved = self.x - self._capped(self.size[:, None, None] * slope) / self._side
        self.x = np.where(self.finished[:, None, None], self.x, moved)

    def state(self) -> dict[str, NDArray[Any]]:
        """Everything that the next steps depend on."""
        state = {
            "x": self.x,
            "gradients": np.array(self.gradients),
            "excess": self.excess,
            "largest": self.largest,
            "size": self.size,
            "finished": self.finished,
        }
        if (anchor := getattr(self._energy, "anchor", None)) is not None:
            state["anchor"] = np.array(anchor)  # fields sort in place
        return state

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Go on from a state, bit by bit as if never interrupted."""
        self.x = np.array(state["x"])
        self.gradients = int(state["gradients"])
        self.excess, self.largest = np.array(state["excess"]), np.array(state["largest"])
        self.size, self.finished = np.array(state["size"]), np.array(state["finished"])
        if "anchor" in state:
            self._energy.anchor = np.array(state["anchor"])  # type: ignore[attr-defined]

    def _evaluate(self, x: FloatArray) -> FloatArray:
        at = self._energy(x)
        self.gradients += 1
        self.excess = at.excess
        self.largest = np.sqrt(_longest(at.gradient))
        self.finished = self.finished | (at.excess <= self._enough)
        return at.gradient

    @staticmethod
    def _capped(step: FloatArray) -> FloatArray:
        """Shorten a set's step where its longest displacement exceeds one spacing."""
        return step / np.sqrt(np.maximum(_longest(step), 1.0))[:, None, None]


class Nesterov(Descent):
    """Nesterov's method with adaptive restart: 300 gradients do the work of 10,000 steps of descent.

    Parameters
    ----------
    energy, x, step, excess
        As for ``Descent``.
    noise : float
        Error of the excess energy; a smaller rise does not count as one.
    curvature : callable, optional
        That of the energy's modes. Where it is given, wide boxes have their lowest band preconditioned, whose
        modes are too slow for any step that the middle band allows, or too fast for it.
    wide : float
        Spacings a side above which they have; 45, or 2,048 points in the plane, is right for Gaussians.

    Notes
    -----
    The restart is that of O'Donoghue & Candes (2015). The step is halved where the excess energy has risen
    over 20 gradients.
    """

    def __init__(
        self,
        energy: EnergyEvaluation,
        x: FloatArray,
        step: float,
        excess: float = 0.0,
        noise: float = 0.0,
        curvature: Curvature | None = None,
        wide: float = PRECONDITION_ABOVE,
    ) -> None:
        super().__init__(energy, x, step, excess)
        sets, n, d = x.shape
        self._noise = noise
        self._y = np.array(x)  # where the next gradient is taken
        self._momentum = np.ones(sets)
        self._recent = np.full((sets, PATIENCE + 1), np.nan)  # excess energies, the last one last
        self._bands = (
            [LowestBandPreconditioner(n, d, curvature) for _ in range(sets)]
            if curvature is not None and d <= 3 and self._side > wide
            else []
        )

    def advance(self) -> None:
        """Evaluate once and move every set that is not finished."""
        before = self.finished
        slope = self._evaluate(self._y)
        reached = (self.finished & ~before)[:, None, None]
        self._shorten()
        step = self.size[:, None, None] * slope
        for k, band in enumerate(self._bands):
            if not self.finished[k]:
                step[k] += band.correction(self._y[k], slope[k], float(self.size[k]))
        moved = self._y - self._capped(step) / self._side
        ahead = moved - self.x
        uphill = np.array([np.multiply(g, a).sum() > 0 for g, a in zip(slope, ahead, strict=True)])
        following = (1 + np.sqrt(1 + 4 * self._momentum**2)) / 2
        inertia = np.where(uphill, 0.0, (self._momentum - 1) / following)
        self._momentum = np.where(uphill, 1.0, following)
        live = ~self.finished[:, None, None]
        self.x = np.where(live, moved, np.where(reached, self._y, self.x))
        self._y = np.where(live, moved + inertia[:, None, None] * ahead, self._y)

    def state(self) -> dict[str, NDArray[Any]]:
        """Everything that the next steps depend on."""
        state = super().state() | {"y": self._y, "momentum": self._momentum, "recent": self._recent}
        none = np.full(self.x.shape[1:], np.nan)  # a set that was finished before its band was asked
        anchors = [none if band.anchor is None else band.anchor for band in self._bands]
        return state | ({"bands": np.array(anchors)} if anchors else {})

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Go on from a state, bit by bit as if never interrupted."""
        super().restore(state)
        self._y, self._momentum = np.array(state["y"]), np.array(state["momentum"])
        self._recent = np.array(state["recent"])
        for band, anchor in zip(self._bands, state.get("bands", ()), strict=True):
            if not np.isnan(anchor).any():
                band.place(anchor)

    def _shorten(self) -> None:
        self._recent = np.concatenate([self._recent[:, 1:], self.excess[:, None]], axis=1)
        risen = self._recent[:, -1] > self._recent[:, 0] + self._noise  # not while the first is nan
        self.size = np.where(risen, self.size / 2, self.size)
        self._recent[risen] = np.nan


def _longest(vectors: FloatArray) -> FloatArray:
    """Squared length of the longest vector of each set."""
    longest: FloatArray = np.einsum("kna,kna->kn", vectors, vectors).max(axis=1)
    return longest
