"""Columns of a file that are coordinates: which names are axes, and which columns the user wants."""

from __future__ import annotations

import re
import shlex
from collections.abc import Sequence
from itertools import takewhile
from pathlib import Path

from gbnbench.core.errors import FormatError

LONGEST = 40  # letters of a name in an error
SET_NAMES = ("set", "realization")

_LETTERS = ("x", "y", "z", "w")
_RANGE = re.compile(r"([0-9]{1,7})-([0-9]{1,7})")
_NUMBERED = re.compile(r"([a-z])[_ ]?[\[(]?([0-9]{1,6})[\])]?")


def choose(path: Path, wanted: Sequence[str], names: Sequence[str], width: int) -> list[int]:
    """Find the columns that the user wants.

    Parameters
    ----------
    path : Path
        Named in errors.
    wanted : sequence of str
        Names, or numbers counted from 1 where the file has no names; 1-16 there is the numbers from 1 to 16.
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
    if not names:
        wanted = [number for name in wanted for number in _range(name, width)]
    for name in wanted:
        if list(names).count(name) > 1:
            raise FormatError(path, f"column {name!r} is there twice; name columns once each")
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


def _range(name: str, width: int) -> list[str]:
    """Return the numbers of a range such as 1-16, or the name itself."""
    match = _RANGE.fullmatch(name)
    if match is None or not 0 < int(match[1]) <= int(match[2]) <= width:
        return [name]
    return [str(number) for number in range(int(match[1]), int(match[2]) + 1)]


def advised(names: Sequence[str]) -> str:
    """Write the option that takes columns of these names, as a shell takes it."""
    return f"--columns {shlex.quote(','.join(names))}"


def advice(names: Sequence[str]) -> str:
    """Say which columns may be the coordinates, with the option that takes them.

    Parameters
    ----------
    names : sequence of str
        As they stand in the file.

    Returns
    -------
    str
        For an error. Where no names are alike but for an axis or a number all are told, none advised.
    """
    some = _likely_axes([name for name in names if name])
    if some and all(len(name) <= LONGEST and "," not in name for name in some):
        return f"{advised(some)} takes those wanted"
    if some:
        return f"to take those wanted by --columns, rename {', '.join(map(repr, some))[:80]} without commas"
    shown = ", ".join(name[:LONGEST] for name in names[:8] if name) + ", ..." * (len(names) > 8)
    return f"--columns takes those wanted; here are {shown}"


def _likely_axes(names: list[str]) -> list[str]:
    """Find x, y, z; else names that differ by such a letter alone, or by numbers from 0 or 1; else two."""
    plain = sorted((name for name in names if name.lower() in _LETTERS[:3]), key=str.lower)
    if plain:
        return plain
    for name in names:
        for at in (match.start() for match in re.finditer("[xX]", name)):
            alike = [name[:at] + letter + name[at + 1 :] for letter in ("yz" if name[at] == "x" else "YZ")]
            if alike[0] in names:
                return [name, *(other for other in alike if other in names)]
    for name in names:
        for match in re.finditer("[01]", name):
            series = [
                name[: match.start()] + str(k) + name[match.end() :]
                for k in range(int(match[0]), len(names) + 2)
            ]
            there = list(takewhile(names.__contains__, series))
            if len(there) > 1:
                return there
    return names if len(names) == 2 else []


def is_axis(name: str) -> bool:
    """Tell whether a name, in any case, is that of an axis: x, y, z, w, or a letter with a number."""
    return name.lower() in _LETTERS or _NUMBERED.fullmatch(name.lower()) is not None


def fault_of_names(given: Sequence[str]) -> str | None:
    """Say why names are not those of the axes, or return None.

    Parameters
    ----------
    given : sequence of str
        Names of columns as they stand in the file, in any case, without those of ``SET_NAMES``.

    Returns
    -------
    str or None
        Axes are x, y, z, w in turn, as many as there are, or one letter with the numbers from 0 or 1 on.
    """
    if not given:
        return None
    names = [name.lower() for name in given]
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
    wanted = advice(given)
    if "" in names:
        return (
            f"column {names.index('') + 1} has no name, as where each line ends in a comma: remove it, or "
            f"{wanted}"
        )
    other = [name not in _LETTERS and not _NUMBERED.fullmatch(name) for name in names]
    strange = given[other.index(True)] if any(other) else None
    strange = strange or (given[names.index("w")] if "w" in names and len(pairs) < len(names) else None)
    said = f"columns {', '.join(given)} are" if strange is None else f"column {strange[:40]!r} is"
    return f"{said} no coordinate; the names are x, y, z or x0, x1, ..., once each; {wanted}"
