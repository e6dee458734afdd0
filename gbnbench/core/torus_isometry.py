"""Isometries of the torus that keep its axes: shifts, reflections and exchanges of axes."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.sides import Sides
from gbnbench.core.torus import FloatArray, wrap

FEW = 5000  # orders and reflections of the axes; where there are more, hardly any is drawn twice


@dataclass(frozen=True)
class TorusIsometry:
    """Axes put in another order, some of them reflected, and then a shift: it keeps every toroidal distance.

    Attributes
    ----------
    axes : tuple of int
        Axis a of the copy is axis ``axes[a]`` of the set.
    flipped : tuple of bool
        For each axis of the copy, whether x becomes 1 - x.
    shift : tuple of float
        Added last, in sides of the torus.

    Notes
    -----
    With s_a = -1 on the flipped axes, the power of the copy at g is that of the set at the f with
    f_axes[a] = s_a g_a: shifts keep the spectrum, and what else there is takes its frequencies elsewhere on
    their shell.
    """

    axes: tuple[int, ...]
    flipped: tuple[bool, ...]
    shift: tuple[float, ...]

    def __call__(self, x: FloatArray) -> FloatArray:
        """Return the copy of points (..., d), to 2**-53 of a side."""
        turned = x[..., list(self.axes)]
        turned = np.where(self.flipped, wrap(-turned), turned)
        return wrap(turned + np.array(self.shift)) if any(self.shift) else turned

    def is_identity(self) -> bool:
        """Whether the copy is the set itself."""
        return self == identity(len(self.axes))

    def words(self) -> str:
        """Say what is done, in its order, such as ``axes 1,0; flipped on 0; shifted by 0.5,0``."""
        said = []
        if self.axes != tuple(range(len(self.axes))):
            said.append(f"axes in the order {','.join(map(str, self.axes))}")
        if any(self.flipped):
            said.append(f"flipped on {','.join(str(a) for a, flip in enumerate(self.flipped) if flip)}")
        if any(self.shift):
            said.append(f"shifted by {','.join(repr(float(value)) for value in self.shift)}")
        return "; ".join(said) or "as it is"


def identity(d: int) -> TorusIsometry:
    """Return the isometry that does nothing in d dimensions."""
    return TorusIsometry(tuple(range(d)), (False,) * d, (0.0,) * d)


def isometry(
    d: int,
    swap: Sequence[Sequence[int]] = (),
    flip: Sequence[int] = (),
    shift: Sequence[float] | None = None,
    sides: Sides | None = None,
) -> TorusIsometry:
    """Check what is to be done to points, and put it together.

    Parameters
    ----------
    d : int
        Dimension of the points.
    swap : sequence of pairs of int
        Axes that are exchanged, one pair after another; counted from 0.
    flip : sequence of int
        Axes that are reflected then.
    shift : (d,) sequence of float, optional
        Shift at last, in sides.
    sides : tuple of float, optional
        Of the torus; axes of unequal sides cannot be exchanged.

    Returns
    -------
    TorusIsometry

    Raises
    ------
    InputError
        If there is no such axis, axes to be exchanged are not two of equal sides, or the shift is not d
        finite numbers.
    """
    axes = list(range(d))
    for pair in swap:
        a, b = _axes("swap", pair, d, 2)
        if sides is not None and not math.isclose(sides[a], sides[b], rel_tol=1e-9):
            raise InputError(
                f"swap keeps distances where the sides are equal; those of {a} and {b} are {sides[a]:g} and "
                f"{sides[b]:g}"
            )
        axes[a], axes[b] = axes[b], axes[a]
    flipped = set(_axes("flip", flip, d, None))
    moved = np.zeros(d) if shift is None else np.asarray(shift, dtype=np.float64)
    if moved.shape != (d,) or not np.isfinite(moved).all():
        raise InputError(f"shift must be {d} finite numbers, one for each axis, in sides; got {shift!r}")
    return TorusIsometry(tuple(axes), tuple(a in flipped for a in range(d)), tuple(wrap(moved).tolist()))


def random_isometries(
    count: int, d: int, rng: np.random.Generator, sides: Sides | None = None
) -> tuple[TorusIsometry, ...]:
    """Draw isometries that differ: orders of the axes and reflections by turns, and a random shift for each.

    Parameters
    ----------
    count, d : int
        How many, and the dimension.
    rng : numpy.random.Generator
        Draws them.
    sides : tuple of float, optional
        Of the torus; only axes of equal sides change places.

    Returns
    -------
    tuple of TorusIsometry
        The first is the identity. No turn of the axes comes again before all have come, where there are at
        most 5,000.
    """
    equal = [tuple(range(d))] if sides is None else _equal_axes(sides)
    turns = math.prod(math.factorial(len(group)) for group in equal) * 2**d
    drawn = [identity(d)]
    waiting: list[tuple[tuple[int, ...], tuple[bool, ...]]] = []
    while len(drawn) < count:
        if not waiting:
            if turns <= FEW:
                every = _all_turns(equal, d)
                waiting = [every[k] for k in rng.permutation(turns)]
                if len(drawn) == 1:  # the identity's has come
                    waiting.remove((drawn[0].axes, drawn[0].flipped))
            else:
                waiting = [_random_turn(equal, d, rng)]
            continue
        drawn.append(TorusIsometry(*waiting.pop(), tuple(rng.random(d).tolist())))
    return tuple(drawn[:count])


def _axes(what: str, given: Sequence[int], d: int, count: int | None) -> tuple[int, ...]:
    listed = np.ndim(given) == 1
    axes = tuple(given) if listed else ()
    wrong = [a for a in axes if not isinstance(a, (int, np.integer)) or not 0 <= a < d]
    if not listed or wrong or len(set(axes)) < len(axes) or (count is not None and len(axes) != count):
        how_many = "two axes" if count == 2 else "axes"
        raise InputError(
            f"{what} must name {how_many} of 0 to {d - 1}, each once; got {axes if listed else given}"
        )
    return tuple(int(a) for a in axes)


def _equal_axes(sides: Sides) -> list[tuple[int, ...]]:
    """Group the axes by the length of their sides."""
    groups: list[list[int]] = []
    for a, side in enumerate(sides):
        for group in groups:
            if math.isclose(sides[group[0]], side, rel_tol=1e-9):
                group.append(a)
                break
        else:
            groups.append([a])
    return [tuple(group) for group in groups]


def _all_turns(equal: Sequence[tuple[int, ...]], d: int) -> list[tuple[tuple[int, ...], tuple[bool, ...]]]:
    orders = []
    for choice in itertools.product(*(itertools.permutations(group) for group in equal)):
        order = list(range(d))
        for group, placed in zip(equal, choice, strict=True):
            for a, b in zip(group, placed, strict=True):
                order[a] = b
        orders.append(tuple(order))
    return [(order, flips) for order in orders for flips in itertools.product((False, True), repeat=d)]


def _random_turn(
    equal: Sequence[tuple[int, ...]], d: int, rng: np.random.Generator
) -> tuple[tuple[int, ...], tuple[bool, ...]]:
    order = np.arange(d)
    for group in equal:
        order[list(group)] = rng.permutation(group)
    return tuple(order.tolist()), tuple((rng.random(d) < 0.5).tolist())
