"""The description that every format of point files gives of itself: how it is told, read and written."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from gbnbench.io.points.point_file import PointFile
from gbnbench.io.points.point_sets import FileContent, PointSets


@dataclass(frozen=True)
class Format:
    """A format of point files; its module defines one, and the registry lists it.

    Attributes
    ----------
    name : str
        For the user.
    suffixes : tuple of str
        Those of its files, in lower case; of one that is written, the first is not that of another format.
    recognises : callable
        ``recognises(file)``: whether this is such a file, by its first bytes, and by its name only where
        bytes cannot tell.
    read : callable
        ``read(file)``: its sets in its own unit.
    write : callable or None
        ``write(sets)``: the bytes of a file of these sets; None where the format is only read.
    takes : frozenset of str
        The reading options that it has a use for, of columns and array; others are refused.
    keeps_box : bool
        Whether it can hold the box of its points.
    """

    name: str
    suffixes: tuple[str, ...]
    recognises: Callable[[PointFile], bool]
    read: Callable[[PointFile], FileContent]
    write: Callable[[PointSets], bytes] | None = None
    takes: frozenset[str] = frozenset()
    keeps_box: bool = False
