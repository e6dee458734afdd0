"""Gaussian Blue Noise whose projections on chosen coordinates are Gaussian Blue Noise too.

E(x) = sum over subsets S of the coordinates of c_S E_S(x_S): x_S is the set seen along the other axes, n
points in |S| dimensions, and E_S the energy of Gaussian Blue Noise there, at its own spacing n^(-1/|S|). The
paper notes that the kernel's separability allows it and leaves it open; its program's switch does nothing.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from itertools import combinations

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gauss_newton.modes import bound_coordinates
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.protocol import EnergyGradient
from gbnbench.generators.gbn.step_sizes import step_size

Subset = tuple[int, ...]
EVACUATED = 0.72  # nu below which a set of the whole energy has next to no power
MOST_SUBSETS = 1000


def subsets(text: str, d: int) -> tuple[Subset, ...]:
    """Read which projections are meant.

    Parameters
    ----------
    text : str
        Items parted by ``/`` (or commas, where no brackets hold them): a number k for all subsets of k
        coordinates, ``0+2`` for the plane of coordinates 0 and 2, ``+1`` for the axis of coordinate 1.
    d : int
        Dimension of the sets.

    Returns
    -------
    tuple of tuple of int
        Each once, in the order given; never all d coordinates, which are always in the energy.

    Raises
    ------
    InputError
        If an item is not one of these, or names a coordinate or a size that d does not have.

    Examples
    --------
    >>> subsets("1/0+2", 3)
    ((0,), (1,), (2,), (0, 2))
    """
    found: dict[Subset, None] = {}
    for item in re.split(r"[/,]", text):
        part = item.strip()
        if re.fullmatch(r"\d+", part):
            size = int(part)
            if not 1 <= size < d:
                raise InputError(
                    f"projections of {d} dimensions are on "
                    f"{'1 coordinate' if d == 2 else f'1 to {d - 1} coordinates'}; got {part!r} in {text!r}. "
                    f"A lone axis is written +{part}"
                )
            if math.comb(d, size) > MOST_SUBSETS:
                raise InputError(
                    f"projections on {size} of {d} coordinates are {math.comb(d, size)}, more than "
                    f"{MOST_SUBSETS}; name the ones you need, such as 0+1"
                )
            found.update(dict.fromkeys(combinations(range(d), size)))
        elif re.fullmatch(r"\+?\d+(\+\d+)*", part):
            axes = tuple(sorted(int(axis) for axis in part.lstrip("+").split("+")))
            if len(set(axes)) < len(axes) or axes[-1] >= d or len(axes) == d:
                raise InputError(
                    f"a projection must name some of the coordinates 0 to {d - 1}, each once, not all; got "
                    f"{part!r} in {text!r}"
                )
            found[axes] = None
        else:
            raise InputError(f"projections must read like 1, 2, 1/2 or 0+1/+2; got {part!r} in {text!r}")
    return tuple(found)


def shares(n: int, d: int, chosen: Sequence[Subset], edge: float | None = None) -> dict[Subset, float]:
    """Share of the n d coordinates that each projection binds, and the whole set, where it is evacuated.

    Parameters
    ----------
    n, d : int
        Size of the sets.
    chosen : sequence of subsets
    edge : float, optional
        nu, in the projections' own spacings, up to which their energies see; by default 0.72 counts.

    Returns
    -------
    dict
        Subset -> share; the whole set stands under all its coordinates.

    Notes
    -----
    2 chi m / d, chi = V_m edge^m / 2 m and m = |S|, counted over actual frequencies. Frequencies of a
    projection that lie below the whole set's edge too are counted for both. Where the sum is beyond 1 the
    terms compete.
    """
    whole = tuple(range(d))
    return {
        axes: bound_coordinates(n, len(axes), EVACUATED if axes == whole or edge is None else edge) / (n * d)
        for axes in (whole, *chosen)
    }


class ProjectiveEnergy:
    """The whole energy and that of every chosen projection, balanced so that no term sets the step alone.

    Parameters
    ----------
    n, d : int
        Size of the sets.
    sigma : float
        Width of each term's kernel, in that term's spacings.
    chosen : sequence of subsets
        As ``subsets`` gives them.
    edge : float, optional
        The projections' energies see 0 < nu <= edge alone, nu in their own spacings.
    weights : mapping, optional
        Subset -> weight > 0, 1 unless given; that of the whole set under all its coordinates.
    precision : {"double", "float"}, optional

    Attributes
    ----------
    method, error
        As ``EnergyEvaluation``; the error is that of the worst term.
    scale : dict
        Subset -> c_S.

    Notes
    -----
    A term's largest curvature at a uniform density is lambda_S n^(2/|S| - 2/d) per squared spacing of the
    whole set: 1,024 times lambda_S for an axis of 1,024 points in 2D. So c_S is the term's weight over that;
    the sum's curvature is then at most the largest, over coordinates, sum of the weights of the subsets that
    hold it. c_S divides by this too and multiplies by the whole energy's curvature, so that
    ``step_size(n, d, sigma)`` serves the sum.
    """

    def __init__(
        self,
        n: int,
        d: int,
        sigma: float,
        chosen: Sequence[Subset],
        *,
        edge: float | None = None,
        weights: Mapping[Subset, float] | None = None,
        precision: str | None = None,
    ) -> None:
        whole = tuple(range(d))
        terms = (whole, *(axes for axes in chosen if axes != whole))
        weight = {axes: float((weights or {}).get(axes, 1.0)) for axes in terms}
        wrong = [axes for axes in terms if not (math.isfinite(weight[axes]) and weight[axes] > 0)]
        if wrong:
            raise InputError(f"weights must be positive; got {weight[wrong[0]]} for {wrong[0]}")
        self._terms = {
            axes: energy_evaluation(n, len(axes), sigma, precision, edge=None if axes == whole else edge)
            for axes in terms
        }
        largest = max(sum(weight[axes] for axes in terms if a in axes) for a in whole)
        # step_size is 1.2 over the curvature of a term, per its own squared spacings
        self._unit = {axes: n ** (1 / len(axes) - 1 / d) for axes in terms}
        step = {axes: step_size(n, len(axes), sigma) / self._unit[axes] ** 2 for axes in terms}
        self.scale = {axes: weight[axes] / largest * step[axes] / step[whole] for axes in terms}
        self.method = "; ".join(f"{axes}: {term.method}" for axes, term in self._terms.items())
        self.error = max(term.error for term in self._terms.values())

    @property
    def anchor(self) -> FloatArray | None:
        """Points as each term's strips were last sorted, side by side; see ``Strips``."""
        kept = [at for term in self._terms.values() if (at := getattr(term, "anchor", None)) is not None]
        return np.concatenate(kept, axis=2) if kept else None

    @anchor.setter
    def anchor(self, x: FloatArray) -> None:
        """Go on as if the points had last been sorted at x."""
        begin = 0
        for axes, term in self._terms.items():
            if hasattr(term, "anchor"):
                kept = np.ascontiguousarray(x[:, :, begin : begin + len(axes)])
                term.anchor = kept  # pyright: ignore[reportAttributeAccessIssue]: hasattr, just above
                begin += len(axes)

    def __call__(self, x: FloatArray) -> EnergyGradient:
        """Gradient and energy, the sum of c_S Ex_S, at x, (sets, n, d) float64 in box sides."""
        gradient, excess = np.zeros(x.shape), np.zeros(len(x))
        for axes, term in self._terms.items():
            at = term(np.ascontiguousarray(x[:, :, axes]))
            gradient[:, :, axes] += self.scale[axes] * self._unit[axes] * at.gradient
            excess += self.scale[axes] * at.excess
        return EnergyGradient(gradient, excess)
