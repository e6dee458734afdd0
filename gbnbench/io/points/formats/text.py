"""Point sets in text: lines of numbers framed by counts, # lines, a column of set numbers, or nothing."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import NoReturn

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.io.points.columns import SET_NAMES
from gbnbench.io.points.file_format import LEGIBLE
from gbnbench.io.points.formats.axes import XYZ, refuse_plane
from gbnbench.io.points.formats.format import Format
from gbnbench.io.points.formats.text_writing import WRITERS
from gbnbench.io.points.number_parser import Lexed, lex
from gbnbench.io.points.options import ReadingOptions
from gbnbench.io.points.point_file import PointFile
from gbnbench.io.points.point_sets import Coordinates, FileContent, IntArray
from gbnbench.io.points.text_columns import Rows, plain_rows
from gbnbench.io.points.text_header import header_form
from gbnbench.io.points.text_projection import STRUCK

# (first line, lines) of one set, as indices into Lexed.line
Span = tuple[int, int]

STRAY = 3  # bytes of a short text that no text has, such as a NUL or an old end-of-file mark


def _recognises(file: PointFile) -> bool:
    """Tell text by its bytes; a few stray ones among them are better named by their line."""
    strange = len(file.head.translate(None, LEGIBLE))
    return 20 * strange < len(file.head) or (strange <= STRAY and 4 * strange < len(file.head))


def read_text(file: PointFile) -> FileContent:
    """Read the sets of a text file; the grammar stands in ``gbnbench.io.points``.

    Parameters
    ----------
    file : PointFile
        Any text.

    Returns
    -------
    FileContent
        All sets, in file order.

    Raises
    ------
    FormatError
        At the first line that breaks the grammar.
    """
    path, options = file.path, file.options
    unit_torus = options.period is None and options.bounds is None and not options.wrap
    table = plain_rows(path, file.read(), options.columns, counted=unit_torus)
    names = table.names
    text = lex(path, table.data, names, table.cell)
    if len(text.line) == 0:
        raise FormatError(path, "the file holds no points")
    _refuse_hidden(path, text)
    sets = _sets(path, text, table, options)
    if tuple(name for name in names if name not in SET_NAMES) == XYZ:
        whole = np.concatenate([one.points for one in sets])
        refuse_plane(path, whole, options.columns, int(text.line[0]))
    return FileContent(sets)


def _sets(path: Path, text: Lexed, table: Rows, options: ReadingOptions) -> list[Coordinates]:
    """Part the numbers into sets, by what frames them."""
    begin = np.concatenate([[0], np.cumsum(text.width)])
    unit_torus = options.period is None and options.bounds is None and not options.wrap
    form = 0 if table.names else header_form(path, text, unit_torus)
    if form:
        spans = _counted(path, text, begin, form)
    else:
        _same_width(path, text, table.names)
        if any(name in SET_NAMES for name in table.names):
            return _by_column(path, text, table.names)
        spans = _parted(path, text, marked=not table.headed)
    # a matrix of numbers alone may be transposed; a count, a name or the user says what its rows are
    bare = not form and not table.names and options.columns is None
    return [_coordinates(text, begin, span, bare=bare) for span in spans]


def _refuse_hidden(path: Path, text: Lexed) -> None:
    """Refuse a comment that holds the numbers of a point: a stray # may have struck it out."""
    whole = bool(text.bare[-int(text.width[-1]) :].all())
    held = np.abs(text.hidden) if whole else text.hidden
    lost = np.flatnonzero((held > 0) & (held == text.width[-1]))
    if len(lost):
        raise FormatError(path, STRUCK, int(text.comment[lost[0]]))


def _counted(path: Path, text: Lexed, begin: IntArray, form: int) -> list[Span]:
    """Find the sets that each follow a header line of the given form."""
    spans: list[Span] = []
    lines = len(text.line)
    d, at = 0, 0
    while at < lines:
        number = int(text.line[at])
        header = text.value[begin[at] : begin[at + 1]]
        if len(header) != form or not text.bare[begin[at] : begin[at + 1]].all():
            _refuse_surplus(path, text, spans, at)
        if np.any(header < 1) or np.any(header > 2**53):
            raise FormatError(
                path, f"no set has this header: {' '.join(f'{v:.17g}' for v in header)}", number
            )
        n, said = int(header[0]), int(header[1]) if form == 2 else 0
        here = said or (int(text.width[at + 1]) if at + 1 < lines else 0)
        if here == 1 and form == 1 and n == 1:
            raise FormatError(path, "'1' may be a count or a point: write the header as '1 1'", number)
        d = d or here
        if said and said != d:
            raise FormatError(path, f"this set has {said} dimensions, the sets before have {d}", number)
        held = min(n, lines - at - 1)
        wrong = np.flatnonzero(text.width[at + 1 : at + 1 + held] != d)
        if len(wrong):
            _refuse_width(path, text, at + 1 + int(wrong[0]), d, f"line {number} says {_points(n)}")
        if held < n:
            raise FormatError(
                path,
                f"this line says {_points(n)}, and the file ends after {held}"
                + (f"; as a point, write it as '{' '.join(f'{v:.1f}' for v in header)}'" if not held else ""),
                number,
            )
        spans.append((at + 1, n))
        at += 1 + n
    return spans


def _refuse_surplus(path: Path, text: Lexed, spans: list[Span], at: int) -> NoReturn:
    first, n = spans[-1]
    raise FormatError(
        path,
        f"line {text.line[first - 1]} says {_points(n)}, here is another, or no header of a next set",
        int(text.line[at]),
    )


def _points(n: int) -> str:
    return f"{n} point{'s' * (n != 1)}"


def _same_width(path: Path, text: Lexed, names: tuple[str, ...]) -> None:
    d = len(names) or int(text.width[0])
    wrong = np.flatnonzero(text.width != d)
    if len(wrong):
        what = "the header names" if names else "the lines before have"
        _refuse_width(path, text, int(wrong[0]), d, f"{what} {d}")


def _refuse_width(path: Path, text: Lexed, at: int, d: int, because: str) -> NoReturn:
    width = int(text.width[at])
    what = f"{width} number{'s' * (width != 1)} where a point has {d}"
    raise FormatError(path, f"{what}; {because}", int(text.line[at]))


def _parted(path: Path, text: Lexed, *, marked: bool) -> list[Span]:
    """Find the sets parted by # lines; a blank line in one is refused, since some programs part sets so.

    In a table with a line of names comments part nothing; a line of # alone, which could be meant to, is
    refused there.
    """
    section = np.searchsorted(text.comment, text.line)
    comments = np.diff(section)
    joined = comments == 0 if marked else np.ones(len(comments), np.bool_)
    gap = np.flatnonzero(joined & (np.diff(text.line) > 1 + comments))
    if len(gap):
        raise FormatError(
            path,
            "a blank line between points: part sets by a line '#', or remove it"
            if marked
            else "a blank line between points: remove it, or part sets by a column 'set'",
            int(text.line[gap[0]]) + 1,
        )
    inside = (text.comment > text.line[0]) & (text.comment < text.line[-1])
    if not marked and np.any(text.mark & inside):
        raise FormatError(
            path,
            "a line '#' in a table with names parts no sets: remove it, or part them by a column 'set'",
            int(text.comment[np.argmax(text.mark & inside)]),
        )
    bounds = [0, *(np.flatnonzero(~joined) + 1).tolist(), len(text.line)]
    return [(a, b - a) for a, b in pairwise(bounds)]


def _by_column(path: Path, text: Lexed, names: tuple[str, ...]) -> list[Coordinates]:
    """Find the sets by the column named set, whose numbers start at 0 or 1 and count up by one."""
    columns = [i for i, name in enumerate(names) if name in SET_NAMES]
    if len(columns) > 1 or len(names) < 2:
        raise FormatError(path, "the header needs one set column and at least one coordinate")
    table = text.value.reshape(len(text.line), len(names))
    index = np.clip(table[:, columns[0]], -1, 2.0**53)  # the difference of two inf is none
    step = np.diff(index, prepend=index[0])
    good = ((step == 0) | (step == 1)) & ((index[0] == 0) | (index[0] == 1))
    if not good.all():
        at = int(np.argmin(good))
        said = f"set number {table[at, columns[0]]:g}: sets must stand together and count up from 0 or 1"
        raise FormatError(path, said, int(text.line[at]))
    bounds = [0, *np.flatnonzero(step).tolist(), len(index)]
    points = np.delete(table, columns[0], axis=1)
    return [Coordinates(points[a:b].copy(), text.line[a:b]) for a, b in pairwise(bounds)]


def _coordinates(text: Lexed, begin: IntArray, span: Span, *, bare: bool) -> Coordinates:
    first, n = span
    points = text.value[begin[first] : begin[first + n]].reshape(n, -1)
    return Coordinates(points, text.line[first : first + n], bare=bare)


TEXT = Format(
    "text", (".txt", ".dat", ".csv", ".tsv"), _recognises, read_text, WRITERS, frozenset({"columns"})
)
