"""Point sets as a file holds them, in its own unit, and as fractions of their box."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.sides import EQUAL
from gbnbench.core.torus import FloatArray

IntArray = NDArray[np.int64]

FEW, MANY = 4, 16  # points and dimensions of an array that is more likely transposed
NO_TORUS = "says that its box is no torus, and it is measured as one: what crosses the sides is not real"


@dataclass(frozen=True)
class PointSets:
    """The sets of a file, ready to be measured.

    Attributes
    ----------
    sets : list of (n_i, d) float64
        Fractions of the box, in [0, 1).
    sides : tuple of float or None
        Lengths of the box's sides in the unit of the file; None where the file and the options tell none and
        the unit torus is meant.
    low : tuple of float or None
        Its lower corner, likewise.
    toroidal : bool or None
        Whether opposite sides of the box are one; None where nothing says so.
    """

    sets: list[FloatArray]
    sides: tuple[float, ...] | None = None
    low: tuple[float, ...] | None = None
    toroidal: bool | None = None


@dataclass(frozen=True)
class Box:
    """The box of a file, whose axes are those of its points.

    Attributes
    ----------
    low, sides : tuple of float
        Lower corner and lengths, in the unit of the file.
    periodic : tuple of bool or None
        For each axis, whether its ends are one; None where the file does not say.
    """

    low: tuple[float, ...]
    sides: tuple[float, ...]
    periodic: tuple[bool, ...] | None = None


@dataclass(frozen=True)
class Coordinates:
    """One set as its file holds it.

    Attributes
    ----------
    points : (n, d) float64
        In the unit of the file.
    lines : (n,) int64 or None
        1-based line of each point, where the format has lines.
    where : str
        What an error says of its place in the file before anything else, such as the name of its array.
    scaled : bool
        Whether they are fractions of the box already, as LAMMPS's xs are.
    unwrapped : bool
        Whether the format defines that whole sides are to be taken off, as LAMMPS's xu does.
    bare : bool
        Whether nothing but the shape of a matrix tells points from coordinates: no count, name or format.
    """

    points: FloatArray
    lines: IntArray | None = None
    where: str = ""
    scaled: bool = False
    unwrapped: bool = False
    bare: bool = False


@dataclass(frozen=True)
class FileContent:
    """What a file holds: its sets in its own unit, and its box where it tells one.

    Attributes
    ----------
    sets : list of Coordinates
        In the order of the file, of one dimension, at least one.
    box : Box or None
        Of all sets.
    """

    sets: list[Coordinates]
    box: Box | None = None


def seems_transposed(points: FloatArray) -> bool:
    """Tell whether a matrix has so few rows and so many columns that its rows may be the axes."""
    n, d = points.shape
    return bool(n <= FEW and d >= MANY)


def in_own_unit(x: PointSets) -> list[FloatArray]:
    """Return the sets in the unit of their box: its lower corner plus each fraction times the side.

    Parameters
    ----------
    x : PointSets
        Fractions.

    Returns
    -------
    list of (n_i, d) float64
        The fractions themselves where no box is told.
    """
    if x.sides is None or x.low is None:
        return x.sets
    low, sides = np.array(x.low), np.array(x.sides)
    return [_kept_within(low + s * sides, low, sides) for s in x.sets]


def _kept_within(points: FloatArray, low: FloatArray, sides: FloatArray) -> FloatArray:
    """Round down what was rounded beyond the upper end, where reading would find it outside."""
    while (beyond := (points - low) / sides > 1).any():
        points[beyond] = np.nextafter(points, low)[beyond]
    return points


def unequal_sides(sides: tuple[float, ...] | None) -> bool:
    """Tell whether a box is no cube; None is the unit torus."""
    return sides is not None and max(sides) - min(sides) > EQUAL * max(sides)
