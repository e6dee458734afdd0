"""The description that every format of point files gives of itself: how it is told, read and written."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

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
        Those of its files, in lower case.
    recognises : callable
        ``recognises(file)``: whether this is such a file, by its first bytes, and by its name only where
        bytes cannot tell.
    read : callable
        ``read(file)``: its sets in its own unit.
    write : mapping of str to callable
        Suffix of the files that are written -> ``write(sets)``, their bytes; empty where it is only read.
    takes : frozenset of str
        The reading options that it has a use for, of columns and array; others are refused.
    keeps_box : bool
        Whether it can hold the box of its points.
    """

    name: str
    suffixes: tuple[str, ...]
    recognises: Callable[[PointFile], bool]
    read: Callable[[PointFile], FileContent]
    write: Mapping[str, Callable[[PointSets], bytes]] = field(default_factory=dict)
    takes: frozenset[str] = frozenset()
    keeps_box: bool = False
