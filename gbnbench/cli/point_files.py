"""Files of points that a command reads: what is said of them, and errors that name them."""

from __future__ import annotations

import contextlib
import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gbnbench.core.errors import FormatError, GbnbenchError

if TYPE_CHECKING:
    from gbnbench.core.torus import FloatArray
    from gbnbench.io.points import ReadingOptions

NO_TORUS = (
    "says that its box is no torus, and it is measured as one: what crosses the sides is not real. "
    "Estimates that hold in such a window: gbnbench analyze {} --window file"
)


def read_cube(path: Path, reading: ReadingOptions) -> list[FloatArray]:
    """Read the sets of a file whose box has equal sides, and warn where the file says that it is no torus.

    Parameters
    ----------
    path : Path
        The file.
    reading : ReadingOptions
        How it is read.

    Returns
    -------
    list of (n_i, d) float64
        Fractions of the box.

    Raises
    ------
    FormatError
        If the file cannot be read, or its box has unequal sides.
    """
    from gbnbench.io.points import read_sets
    from gbnbench.io.points.point_sets import unequal_sides

    found = read_sets(path, reading)
    if (fault := unequal_sides(found.sides)) is not None:
        raise FormatError(path, fault)
    if found.toroidal is False:
        click.echo(f"gbnbench: warning: {path}: {NO_TORUS.format(shlex.quote(str(path)))}", err=True)
    return found.sets


@contextlib.contextmanager
def naming(path: Path, index: int | None = None) -> Iterator[None]:
    """Name the file in errors that arise from its points after it was read.

    Parameters
    ----------
    path : Path
        The file.
    index : int, optional
        Which of its sets, counted from 0.

    Yields
    ------
    None

    Raises
    ------
    FormatError
        In place of any other error of gbnbench.
    """
    try:
        yield
    except FormatError:
        raise
    except GbnbenchError as error:
        raise FormatError(path, f"{error}" if index is None else f"set {index}: {error}") from error
