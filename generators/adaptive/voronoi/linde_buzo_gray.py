"""Weighted Linde-Buzo-Gray stippling (Deussen, Spicker & Zheng 2017): cells split and vanish by their ink."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.domain import within
from gbnbench.generators.adaptive.method import AdaptiveMethod
from gbnbench.generators.adaptive.protocol import Told
from gbnbench.generators.adaptive.rejection import Rejection
from gbnbench.generators.adaptive.voronoi.secord import on_ink, parts_refusal
from gbnbench.generators.adaptive.voronoi.weighted_cells import CellParts, WeightedCells
from gbnbench.generators.ranges import check_least, check_range

TURNS_TO_COUNT = 60  # in which the number of points is made the one asked for
LAST_MOVES = 5  # to centroids, once it is
JITTER = 0.1  # of points that come of a split, in standard deviations of the cell


@dataclass(frozen=True)
class LindeBuzoGray(AdaptiveMethod):
    """Points whose cells have the ink of about one dot each.

    Parameters
    ----------
    start : int
        Points to begin with, >= 1.
    hysteresis : float
        Width of the band around one dot's ink in which a cell is left alone, at first, above 0 and below 2.
    widening : float
        By which it grows in each iteration, >= 0.
    iterations : int
        At most so many, >= 1.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    A cell with less ink than 1 - h / 2 of a dot vanishes, one with more than 1 + h / 2 splits in two along
    its longest axis, and every other point moves to its centroid, until nothing splits or vanishes. The dot's
    ink is the density over n, so that about n points are left; the publication lets their number follow from
    the size of dots, and exactly n are made of them here at the end: the fullest cells split, or the emptiest
    vanish, a few at a time, between moves to centroids. All begins with one point, wherever it lies, and
    would come to the same set for every seed: as in the authors' program, both points of a split are
    jittered, there by up to a thousandth of the image's sides, here by a tenth of the cell's standard
    deviation.

    References
    ----------
    Deussen, Spicker & Zheng, "Weighted Linde-Buzo-Gray stippling", ACM Trans. Graph. 36(6), 2017.

    Examples
    --------
    >>> from gbnbench.generators.adaptive.density import as_density
    >>> ramp = as_density(np.linspace(0, 1, 32)[:, None] * np.ones(32))
    >>> LindeBuzoGray()(ramp, 50, np.random.default_rng(0)).shape
    (50, 2)
    """

    name: ClassVar[str] = "lbg"
    summary: ClassVar[str] = "weighted Linde-Buzo-Gray stippling (Deussen, Spicker & Zheng 2017)"
    reference: ClassVar[str] = "Deussen, Spicker & Zheng, Weighted Linde-Buzo-Gray stippling, 2017"
    start: int = 1
    hysteresis: float = 0.6
    widening: float = 0.01
    iterations: int = 100

    def __post_init__(self) -> None:
        check_least("start", self.start, 1)
        if not 0 < self.hysteresis < 2:
            raise InputError(f"hysteresis must be above 0 and below 2; got {self.hysteresis}")
        check_range("widening", self.widening, 0, 1)
        check_least("iterations", self.iterations, 1)

    def refusal(self, density: Density, n: int) -> str | None:
        """Say why the pixels cannot be cut finely enough, as ``AdaptiveMethod.refusal`` does."""
        return parts_refusal(density, n)

    def one_set(self, density: Density, n: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one set, as ``AdaptiveMethod.one_set`` describes it."""
        parts = CellParts(density, n)
        x = Rejection()(density, min(self.start, n), rng)
        for done in range(self.iterations):
            cells = parts.cells(x)
            half = min((self.hysteresis + done * self.widening) / 2, 0.999)
            full, empty = cells.masses > 1 + half, cells.masses < 1 - half
            told(done + 1, self.iterations, "iterations of lbg")
            x = within(density, split(cells, full, ~(full | empty), rng))
            if not (full.any() or empty.any()):
                break
            if not len(x):  # every cell was too empty
                x = Rejection()(density, 1, rng)
        return on_ink(density, parts, _exactly(density, parts, x, n, rng))


def split(
    cells: WeightedCells, full: NDArray[np.bool_], kept: NDArray[np.bool_], rng: np.random.Generator
) -> FloatArray:
    """Put two points in some cells and one in others, which is their centroid.

    Parameters
    ----------
    cells : WeightedCells
        The cells.
    full, kept : (n,) bool
        Cells of two points, and of one.
    rng : numpy.random.Generator
        Turns the axis of cells that have no longest one, and jitters both points of a split.

    Returns
    -------
    (m, d) float64
        In pixels; those of two lie about a standard deviation to either side along the longest axis.
    """
    directions, deviations = cells.main_axes()
    flat = deviations == 0
    directions[flat] = rng.normal(size=(int(flat.sum()), cells.x.shape[1]))
    deviations = np.maximum(deviations, 1e-6)[full, None]
    step = deviations * directions[full]
    jitter = JITTER * deviations * rng.normal(size=(2, *step.shape))
    centroid = cells.x + cells.moves
    found: FloatArray = np.concatenate(
        [centroid[kept], centroid[full] - step + jitter[0], centroid[full] + step + jitter[1]]
    )
    return found


def _exactly(
    density: Density, parts: CellParts, x: FloatArray, n: int, rng: np.random.Generator
) -> FloatArray:
    """Split the fullest cells or drop the emptiest until there are n, and move all to centroids."""
    for turn in range(TURNS_TO_COUNT):
        lack = n - len(x)
        if lack == 0:
            break
        cells = parts.cells(x)
        few = min(abs(lack), max(1, len(x) // 4)) if turn < TURNS_TO_COUNT - 1 else abs(lack)
        order = np.argsort(cells.masses, kind="stable")
        full, kept = np.zeros(len(x), bool), np.ones(len(x), bool)
        if lack > 0:
            full[order[len(x) - min(few, len(x)) :]] = True
            kept &= ~full
        else:
            kept[order[:few]] = False
        x = within(density, split(cells, full, kept, rng))
    for _ in range(LAST_MOVES):
        x = within(density, x + parts.cells(x).moves)
    return x
