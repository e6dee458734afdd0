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
    from gbnbench.io.points import PointSets, ReadingOptions

WINDOW = "Estimates that hold in such a window: gbnbench analyze {} --window file"


def read_torus(path: Path, reading: ReadingOptions) -> PointSets:
    """Read the sets of a file with the sides of their torus, and warn where the file says that it is none.

    Parameters
    ----------
    path : Path
        The file.
    reading : ReadingOptions
        How it is read.

    Returns
    -------
    PointSets
        Fractions of the box, and its sides.

    Raises
    ------
    FormatError
        If the file cannot be read.
    """
    from gbnbench.io.points import read_sets
    from gbnbench.io.points.point_sets import NO_TORUS

    found = read_sets(path, reading)
    if found.toroidal is False:
        click.echo(
            f"gbnbench: warning: {path}: {NO_TORUS}. {WINDOW.format(shlex.quote(str(path)))}", err=True
        )
    return found


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
