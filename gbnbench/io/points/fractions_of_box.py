"""Coordinates in the unit of a file become fractions of their box, or an error that names the line."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points.options import ReadingOptions, listed
from gbnbench.io.points.point_sets import Box, Coordinates, FileContent, PointSets, seems_transposed

ROUNDING = 1e-6  # in sides: float32 and six written digits leave the box by less
FAR = 1.0  # sides beyond the unit torus up to which wrap is believed without a box
SHOWN = 9  # dimensions from which an option is not written out
ROWS = 9  # a first column that counts more rows than these from any number is no coordinate


def fractions_of_box(path: Path, content: FileContent, options: ReadingOptions) -> PointSets:
    """Divide the coordinates of a file by the sides of their box.

    Parameters
    ----------
    path : Path
        Named in errors.
    content : FileContent
        What the file holds.
    options : ReadingOptions
        The box, where the file tells none, and whether to wrap.

    Returns
    -------
    PointSets
        The upper end of a periodic box becomes 0; of one that is not told to be periodic but has bounds, the
        largest number below 1, so that a window keeps the points on its edge.

    Raises
    ------
    FormatError
        If the box has another number of axes, contradicts that of the file, or a point lies outside it.
    """
    d = content.sets[0].points.shape[1]
    if any(one.points.shape[1] != d for one in content.sets):
        dimensions = sorted({one.points.shape[1] for one in content.sets})
        raise FormatError(path, f"its sets have different dimensions: {dimensions}")
    for one in content.sets:
        if one.bare and not options.shape_told:
            _refuse_transposed(path, one)
            refuse_row_numbers(path, one)
    box = _box(path, content.box, options, d)
    toroidal = None if box is None or box.periodic is None else all(box.periodic)
    edge = 0.0 if box is None or toroidal else float(np.nextafter(1, 0))
    sets = [_inside(path, one, box, options, edge) for one in content.sets]
    return PointSets(sets, None if box is None else box.sides, None if box is None else box.low, toroidal)


def _refuse_transposed(path: Path, one: Coordinates) -> None:
    """Refuse a matrix that is likely transposed, where nothing says that it is not."""
    n, d = one.points.shape
    if seems_transposed(one.points):
        raise FormatError(
            path,
            f"{one.where}{n} point{'s' * (n != 1)} of {d} dimensions: is it transposed? Rows are points and "
            f"columns coordinates; save its transpose, or say that its rows are points, by --columns 1-{d}",
        )


def refuse_row_numbers(path: Path, one: Coordinates) -> None:
    """Refuse a first column that counts the rows, from 0 or 1 or many of them: it would become a coordinate.

    Parameters
    ----------
    path : Path
        Named in the error.
    one : Coordinates
        A set whose columns have no names.

    Raises
    ------
    FormatError
        If it does.
    """
    n, d = one.points.shape
    first = one.points[:, 0]
    counts = d > 1 and n > (2 if first[0] in (0, 1) else ROWS) and first[0] == np.floor(first[0])
    if counts and np.array_equal(first, first[0] + np.arange(n)):
        wanted = ",".join(str(k) for k in range(2, d + 1))
        raise FormatError(
            path,
            f"{one.where}the first column numbers the rows: take the others by --columns {wanted}, "
            "or name all",
            None if one.lines is None else int(one.lines[0]),
        )


def _box(path: Path, own: Box | None, options: ReadingOptions, d: int) -> Box | None:
    given = _given_box(path, options, d)
    if given is None or own is None:
        return own if given is None else given
    far = max(
        abs(a - b) / side
        for pair in ((given.low, own.low), (given.sides, own.sides))
        for a, b, side in zip(*pair, own.sides, strict=True)
    )
    if far > ROUNDING:
        name = "--period" if options.period is not None else _ends(options)
        instead = "--window file takes that" if options.window else "leave it out"
        raise FormatError(path, f"tells its own box, {_described(own)}, which {name} contradicts; {instead}")
    return own


def _given_box(path: Path, options: ReadingOptions, d: int) -> Box | None:
    if options.period is not None:
        sides = options.period * d if len(options.period) == 1 else options.period
        if len(sides) != d:
            raise FormatError(
                path, f"--period {listed(sides)} has {len(sides)} sides, and its points have d={d}"
            )
        return Box((0.0,) * d, sides, (True,) * d)
    if options.bounds is None:
        return None
    low, high = options.bounds[::2], options.bounds[1::2]
    if len(low) != d:
        axes = f"{len(low)} ax{'i' if len(low) == 1 else 'e'}s"
        said = f"{_ends(options)} {listed(options.bounds)} is of {axes}, and its points have d={d}"
        every = f": write {listed(options.bounds * d)} for all" if len(low) == 1 and d < SHOWN else ""
        raise FormatError(path, said + every)
    return Box(low, tuple(b - a for a, b in zip(low, high, strict=True)))


def _ends(options: ReadingOptions) -> str:
    """Name the option that told the ends of the axes."""
    return "--window" if options.window else "--bounds"


def _described(box: Box) -> str:
    return " x ".join(f"[{a:g}, {a + s:g}]" for a, s in zip(box.low, box.sides, strict=True))


def _inside(
    path: Path, one: Coordinates, box: Box | None, options: ReadingOptions, edge: float
) -> FloatArray:
    x = one.points
    if box is not None and not one.scaled:
        with np.errstate(invalid="ignore", over="ignore"):
            x = x - np.array(box.low)
            x /= np.array(box.sides)  # in place: a large set is not held twice
    x = np.require(x, np.float64, ["C", "W"])
    if not (x.min() >= 0 and x.max() <= 1):  # nan is neither
        if not (options.wrap or one.unwrapped):
            _refuse(path, one, x, ~((x >= 0) & (x <= 1)), box, options)
        within = np.isfinite(x) if box is not None else (x >= -FAR) & (x <= 1 + FAR)
        if not within.all():
            _refuse(path, one, x, ~within, box, options)
        x = np.mod(x, 1.0)
        x[x >= 1] = 0
        return x
    x[x == 1] = edge
    return x


def _refuse(
    path: Path, one: Coordinates, x: FloatArray, outside: np.ndarray, box: Box | None,
    options: ReadingOptions,
) -> None:  # fmt: skip
    """Refuse the first coordinate outside, with the way out that fits how far it lies."""
    row, column = (int(i) for i in np.argwhere(outside)[0])
    value = float(one.points[row, column])
    line = None if one.lines is None else int(one.lines[row])
    where = "" if line is not None else f" (point {row}, axis {column})"
    said = _said(value, x, column, None if one.scaled else box, window=options.window)
    raise FormatError(path, f"{one.where}{said}{where}", line)


def _said(value: float, x: FloatArray, axis: int, box: Box | None, *, window: bool) -> str:
    if not np.isfinite(value):
        return f"coordinate {value!r} is not finite: remove the point"
    low, high = (0.0, 1.0) if box is None else (box.low[axis], box.low[axis] + box.sides[axis])
    said = f"coordinate {value!r} is not in [{low:g}, {high:g}]"
    if window:
        if box is None:
            return f"{said}, and no box is told: give the window's ends for 'file', such as 0,512,0,256"
        return f"{said}, the window; give one that holds all points"
    finite = x[np.isfinite(x)]
    if finite.min() >= -ROUNDING and finite.max() <= 1 + ROUNDING:
        return f"{said}, but no further outside than rounding takes it: --wrap (wrap=True) brings it in"
    if box is None:
        return (
            f"{said}; scale the points to the unit torus first: give the box that they were measured in, "
            "such as --period 512,512 (its sides) or --bounds 0,512,0,512 (period=, bounds= in Python)"
        )
    if box.periodic is not None and box.periodic[axis]:
        return f"{said}, the box; where it left through a side, --wrap (wrap=True) brings it back"
    return f"{said}, the box; give the box that holds all points"
