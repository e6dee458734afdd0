"""Axes of formats that name their coordinates x, y and z: which are taken, and planes told from space."""

from __future__ import annotations

from pathlib import Path

from gbnbench.core.errors import FormatError
from gbnbench.core.torus import FloatArray

XYZ = ("x", "y", "z")
DIMENSION = "dimension"  # what our own files call a note that their points are of three, though z is constant


def axes_of(path: Path, columns: tuple[str, ...] | None, there: tuple[str, ...]) -> list[int]:
    """Tell which of the axes x, y, z are taken.

    Parameters
    ----------
    path : Path
        Named in errors.
    columns : tuple of str, optional
        Names that the user wants; all that are there by default.
    there : tuple of str
        Axes of the file.

    Returns
    -------
    list of int
        0 for x, 1 for y, 2 for z.

    Raises
    ------
    FormatError
        If a name is not that of an axis of the file.
    """
    wanted = there if columns is None else tuple(name.lower() for name in columns)
    for name in wanted:
        if name not in there:
            raise FormatError(path, f"has no axis {name!r}; its axes are {', '.join(there)}")
    return [XYZ.index(name) for name in wanted]


def is_plane(points: FloatArray) -> bool:
    """Tell whether points of three coordinates all have one z."""
    n, d = points.shape
    return d == 3 and n > 1 and bool(points[:, 2].min() == points[:, 2].max())


def refuse_plane(
    path: Path, points: FloatArray, columns: tuple[str, ...] | None, line: int | None = None
) -> None:
    """Refuse points of three coordinates whose z is the same: they are a set of the plane.

    Parameters
    ----------
    path : Path
        Named in the error.
    points : (n, d) float64
        As the file holds them.
    columns : tuple of str, optional
        Named by the user, who then means it so.
    line : int, optional
        For the error.

    Raises
    ------
    FormatError
        If all z are equal and the user named no columns.
    """
    if columns is None and is_plane(points):
        said = f"z is {points[0, 2]:g} in every point: a set of the plane is read by --columns x,y"
        raise FormatError(path, f"{said}, one of space by x,y,z", line)
