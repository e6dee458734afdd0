"""Columns of a file that are coordinates: which names are axes, and which columns the user wants."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from gbnbench.core.errors import FormatError

SET_NAMES = ("set", "realization")

_LETTERS = ("x", "y", "z", "w")
_NUMBERED = re.compile(r"([a-z])[_ ]?[\[(]?([0-9]{1,6})[\])]?")


def choose(path: Path, wanted: Sequence[str], names: Sequence[str], width: int) -> list[int]:
    """Find the columns that the user wants.

    Parameters
    ----------
    path : Path
        Named in errors.
    wanted : sequence of str
        Names, or numbers counted from 1 where the file has no names.
    names : sequence of str
        Of the file's columns; empty where it has none.
    width : int
        Columns of the file.

    Returns
    -------
    list of int
        Their positions, counted from 0, in the order wanted.

    Raises
    ------
    FormatError
        If there is no such column.
    """
    lower = [name.lower() for name in names]
    found: list[int] = []
    for name in wanted:
        if name in names:
            found.append(list(names).index(name))
        elif lower.count(name.lower()) == 1:
            found.append(lower.index(name.lower()))
        elif names:
            raise FormatError(path, f"has no column {name!r}; its columns are {', '.join(names)}")
        elif not (name.isascii() and name.isdigit() and 1 <= int(name[:7]) <= width):
            raise FormatError(
                path,
                f"has no column {name!r}: without names its {width} columns are counted from 1",
            )
        else:
            found.append(int(name) - 1)
    if len({*found}) < len(found):
        raise FormatError(path, f"columns {','.join(wanted)} name one column twice")
    return found


def fault_of_names(names: Sequence[str]) -> str | None:
    """Say why names are not those of the axes, or return None.

    Parameters
    ----------
    names : sequence of str
        Of columns in lower case, without those of ``SET_NAMES``.

    Returns
    -------
    str or None
        Axes are x, y, z, w in turn, as many as there are, or one letter with the numbers from 0 or 1 on.
    """
    if not names:
        return None
    if tuple(names) == _LETTERS[: len(names)]:
        return None
    numbered = [_NUMBERED.fullmatch(name) for name in names]
    pairs = [(match[1], int(match[2])) for match in numbered if match]
    if len(pairs) == len(names):
        stem, first = pairs[0]
        if first in (0, 1) and pairs == [(stem, first + k) for k in range(len(pairs))]:
            return None
    repeated = next((name for at, name in enumerate(names) if name in names[:at]), None)
    if repeated:
        return f"column {repeated!r} is there twice; name columns once each"
    if sorted(names) == sorted(_LETTERS[: len(names)]):
        return f"coordinates stand out of order; put the columns as {', '.join(_LETTERS[: len(names)])}"
    order = sorted(zip(pairs, names, strict=False))
    stems = {stem for stem, _ in pairs}
    if (
        len(pairs) == len(names)
        and len(stems) == 1
        and [number - order[0][0][1] for (_, number), _ in order] == [*range(len(names))]
    ):
        return f"coordinates stand out of order; put the columns as {', '.join(name for _, name in order)}"
    some = [name for name in names if name in _LETTERS[:3]] or [name for name in names if name][:2]
    wanted = (
        f"--columns {','.join(some) if all(len(name) <= 20 for name in some) else 'x,y'} takes those wanted"
    )
    if "" in names:
        return (
            f"column {names.index('') + 1} has no name, as where each line ends in a comma: remove it, or "
            f"{wanted}"
        )
    strange = next((name for name in names if name not in _LETTERS and not _NUMBERED.fullmatch(name)), None)
    strange = strange or ("w" if "w" in names and len(pairs) < len(names) else None)
    said = f"columns {', '.join(names)} are" if strange is None else f"column {strange[:40]!r} is"
    return f"{said} no coordinate; the names are x, y, z or x0, x1, ..., once each; {wanted}"
