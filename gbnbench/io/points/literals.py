"""Numbers as texts write them, and what is wrong with a cell that is none."""

from __future__ import annotations

import re
from collections.abc import Sequence

NUMBER = re.compile(rb"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
DECIMAL_COMMA = re.compile(rb"[+-]?[0-9]*,[0-9]+(?:[eE][+-]?[0-9]+)?")

MISSING = (b"nan", b"na", b"n/a", b"#n/a", b"null", b"none", b"inf", b"infinity", b"-", b"--", b".", b"?")

_EXPONENT = re.compile(rb"[+-]?[0-9]*\.?[0-9]*(?:[dDqQ]|\*\^|[eE]?\*10\^)[+-]?[0-9]+")
_THOUSANDS = re.compile(rb"[+-]?[0-9]{1,3}(?:(?:['_ ]|\xc2?\xa0|\xe2\x80[\x89\xaf])[0-9]{3})+(?:[.,][0-9]*)?")
_WITH_MORE = re.compile(
    rb"[^0-9A-Za-z\"]?[ ]?" + NUMBER.pattern + rb"[ ]?[^0-9 \"][^0-9\"]{0,7}|[(\[{$]" + NUMBER.pattern
)
_QUOTED_COMMA = re.compile(rb'"([+-]?[0-9]*,[0-9]+)"')


def shown(token: bytes) -> str:
    """Show a literal in an error: quoted, on one line, cut to 40 characters."""
    text = token.decode("utf-8", "backslashreplace")
    return repr(text if len(text) <= 40 else text[:37] + "...")


def fault_in_line(cell: bytes, k: int, line: bytes, names: Sequence[str]) -> str:
    """Say what is wrong with a cell that is no number, by its line and the names that it stands under.

    Parameters
    ----------
    cell : bytes
        As it stands in the file.
    k : int
        Its column, counted from 0.
    line : bytes
        The line, made plain.
    names : sequence of str
        Of the columns; none where the file has none.

    Returns
    -------
    str
        For an error.
    """
    if match := _QUOTED_COMMA.search(line):  # the comma has parted the quotes
        cell = match[1]
    if not cell:
        if k < len(names):
            return f"an empty cell, in column {names[k]!r}"
        if not line.rstrip().endswith(b","):
            return "an empty cell between commas"
        return "an empty cell after the last comma: remove it" + (
            "" if names else ", or take columns, such as --columns 1,2"
        )
    if not names and cell[:1].isalpha() and not any(digit in line for digit in b"0123456789"):
        return f"{shown(line.strip())} holds no number: begin a line of words with '#', or remove it"
    return fault_of_cell(cell)


def fault_of_cell(cell: bytes) -> str:
    """Say what is wrong with a cell that is no number."""
    if not cell:
        return "an empty cell"
    said = f"{shown(cell)} is not a number"
    if cell.lower().lstrip(b"+-") in MISSING or cell in MISSING:
        return f"{said}: remove the point"
    if _EXPONENT.fullmatch(cell):
        return f"{said}: write its exponent with e, such as 1e-3"
    if _THOUSANDS.fullmatch(cell):
        return f"{said}: write it without parted thousands"
    if _WITH_MORE.fullmatch(cell):
        return f"{said}: write the number alone"
    if cell.startswith((b"#", b"%", b"//", b"!")):
        return f"{said}: a comment stands on a line of its own, which begins with '#'"
    if re.fullmatch(rb"[0-9]+[ \t]+[+-]?[0-9]+", cell) or DECIMAL_COMMA.fullmatch(cell):
        return f"{said}; decimal commas are read where semicolons or tabs part cells"
    if b'"' in cell:
        return f"{said}; quotes may hold one, without blanks, commas or parted thousands"
    return said


def too_large(literal: bytes) -> str:
    """Say that a literal is beyond the numbers that a float can be."""
    return f"{shown(literal)} is too large for a number: remove the point"
