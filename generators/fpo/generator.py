"""Farthest-point optimisation (Schlömer, Heck & Deussen 2011) with its triangulation kept on the device."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, check_points, densest_spacing
from gbnbench.generators.fpo.relocation import Sweeps, minimum_distance
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import check_least, check_range, outside_plane
from gbnbench.generators.set_by_set import SetBySet, Told

WINDOW = 5  # sweeps over which the gain is judged
JAM = 1e-6  # in densest spacings: a set that gains less over the window goes nowhere


@dataclass(frozen=True)
class FarthestPointResult:
    """One optimised set and how it came about.

    Attributes
    ----------
    points : (n, 2) float64
        The set.
    min_distance : (sweeps + 1,) float64
        Minimum toroidal distance of the start and after each sweep; it never falls.
    converged : bool
        Whether the stop rule was met or the set jammed; False where the sweeps ran out.
    fresh_moves : int
        Moves made by a fresh Delaunay triangulation, because the gaps were too large for local surgery.
    """

    points: FloatArray
    min_distance: FloatArray
    converged: bool
    fresh_moves: int


@dataclass(frozen=True)
class FarthestPoint(SetBySet):
    """Farthest-point optimisation: each point in turn moves to the centre of the largest gap of the rest.

    Parameters
    ----------
    target : float
        Minimum distance to reach, in densest spacings d_hex.
    gain : float
        Stop once the target is reached and five sweeps together raise the minimum distance by less than this,
        in densest spacings.
    sweeps : int
        Most sweeps from one start; a ``RuntimeWarning`` says when they did not suffice.
    starts : int
        Most random starts: a set that jams below the target is begun anew, and the best is kept.
    strategy : {"global", "local"}
        Where a point looks for the largest gap: among all, or those beside the neighbours that it had.

    Notes
    -----
    A point leaves the Delaunay triangulation, and moves to the centre of its largest circumcircle if that
    radius exceeds the distance the point had to its nearest neighbour; else it stays. That is the paper's
    global strategy; its local one looks at circles through a former neighbour alone, and needs twice as many
    sweeps to sets that are as good. Points are visited in one random order, the same in every sweep; since
    the start is independent uniform points, that is their index order.

    A set jams where no point has a farther place to go: five sweeps gain less than 1e-6 d_hex. That happens
    below the target to one start in six at n = 64 or 100, to three in a hundred at n = 256, and was not
    seen at n = 1024; hence ``starts``. For a few small n, such as 3 (whose densest packing of the torus has
    0.834 d_hex), 5, 6, 7 and 10, no start reached the target; the best set found is returned.

    Examples
    --------
    >>> FarthestPoint()(64, 2, np.random.default_rng(0)).shape
    (64, 2)
    """

    name: ClassVar[str] = "fpo"
    summary: ClassVar[str] = "farthest-point optimisation on the torus (Schlömer, Heck & Deussen 2011)"
    family: ClassVar[Family] = "cellular"
    dimensions: ClassVar[tuple[int, int | None]] = (2, 2)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Schlömer, Heck & Deussen, Farthest-point optimized point sets, 2011"

    target: float = 0.925
    gain: float = 0.002
    sweeps: int = 1000
    starts: int = 10
    strategy: Literal["global", "local"] = "global"

    def __post_init__(self) -> None:
        check_range("target", self.target, 0, 1, "densest spacings")
        check_least("gain", self.gain, 0, "densest spacings")
        check_least("sweeps", self.sweeps, 1)
        check_least("starts", self.starts, 1)

    def refusal(self, n: int, d: int) -> str | None:  # noqa: ARG002 (the protocol's arguments)
        """Say why not: d is other than 2.

        Parameters
        ----------
        n : int
            Points; any number will do.
        d : int
            Dimension.

        Returns
        -------
        str or None
            The reason; None for d = 2.
        """
        return outside_plane(d, "fpo works on 2D Delaunay triangulations")

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization from a uniform random start, as ``SetBySet.one_set`` says."""
        unit = densest_spacing(n, 2)
        best = self.optimise(rng.random((1, n, d)), told)[0]
        for _ in range(self.starts - 1):
            if not best.converged or best.min_distance[-1] >= self.target * unit:
                break
            best = max(
                best,
                self.optimise(rng.random((1, n, d)), told)[0],
                key=lambda result: result.min_distance[-1],
            )
        if not best.converged:
            warnings.warn(
                f"fpo: sweeps={self.sweeps} took n={n} to a minimum distance of only "
                f"{best.min_distance[-1] / unit:.4f} d_hex, target={self.target}; raise sweeps",
                RuntimeWarning,
                stacklevel=2,
            )
        return best.points

    def optimise(self, starts: FloatArray, told: Told | None = None) -> list[FarthestPointResult]:
        """Optimise several sets at once, one work-item a set.

        Parameters
        ----------
        starts : (sets, n, 2) float64
            Points on the unit torus; left as they are.
        told : callable, optional
            Takes the share of the sweeps that are done; most sets need a tenth of them.

        Returns
        -------
        list of FarthestPointResult
            In the order of starts; each is the same whatever the other sets.

        Raises
        ------
        InputError
            If starts are no 2D points of the torus.
        DeviceError
            If the device does not compute in double precision.
        """
        x = check_points(starts)
        if x.ndim != 3 or x.shape[2] != 2:
            raise InputError(f"starts must be (sets, n, 2); got shape {x.shape}")
        unit = densest_spacing(x.shape[1], 2)
        work = Sweeps(x, local=self.strategy == "local")
        history = [[minimum_distance(points)] for points in x]
        converged = np.zeros(len(x), dtype=bool)
        for done in range(self.sweeps):
            if told is not None:
                told(done / self.sweeps)
            moved = work.sweep(~converged)
            for s in np.flatnonzero(~converged):
                history[s].append(float(work.nearest[s]))
                converged[s] = moved[s] == 0 or self._settled(np.array(history[s]) / unit)
            if converged.all():
                break
        points = work.download()
        return [
            FarthestPointResult(points[s], np.array(history[s]), bool(converged[s]), int(work.fresh_moves[s]))
            for s in range(len(x))
        ]

    def _settled(self, history: FloatArray) -> bool:
        """Tell whether the stop rule holds for minimum distances in densest spacings, start first."""
        if len(history) <= WINDOW:
            return False
        gain = history[-1] - history[-1 - WINDOW]
        return bool(gain < JAM or (gain < self.gain and history[-1] >= self.target))
