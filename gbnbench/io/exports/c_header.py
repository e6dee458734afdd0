"""C headers: constant arrays that C99 and C++ compile, whose decimal numbers read back to the same bits."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.readable_text import in_one_line

C_TYPES = {
    "float32": "float", "float64": "double", "uint16": "uint16_t", "uint32": "uint32_t"
}  # fmt: skip
A_LINE = 12  # numbers, of rows that are longer


def c_name(stem: str) -> str:
    """Make the name of a file one that C takes for a variable, once something is added behind it.

    Parameters
    ----------
    stem : str
        Name without its suffix.

    Returns
    -------
    str
        Letters, digits and single underscores, a letter in front.

    Examples
    --------
    >>> c_name("gbn 64-2D"), c_name("64"), c_name("è")
    ('gbn_64_2D', 'set_64', 'set')
    """
    plain = re.sub(r"[^0-9A-Za-z]+", "_", stem).strip("_")
    return plain if plain[:1].isalpha() else f"set_{plain}".rstrip("_")


def c_header(
    name: str, what: str, values: NDArray[Any], constants: Mapping[str, int], comments: Sequence[str]
) -> bytes:
    """Write an array as a C header.

    Parameters
    ----------
    name : str
        As ``c_name`` returns it; the array is called NAME_WHAT.
    what : str
        What the array holds, such as points.
    values : (...) float32, float64, uint16 or uint32
        With two axes or three.
    constants : mapping of str to int
        Macros NAME_KEY, in capitals.
    comments : sequence of str
        What the reader of the header has to know, a line each.

    Returns
    -------
    bytes
        UTF-8. Floating-point numbers are the shortest decimals that a compiler rounds back to the same bits.
    """
    upper = name.upper()
    guard = f"GBNBENCH_{upper}_{what.upper()}_H"
    kind = C_TYPES[str(values.dtype)]
    lines = [
        *_comment(comments),
        f"#ifndef {guard}",
        f"#define {guard}",
        "",
        *(["#include <stdint.h>", ""] if kind.endswith("_t") else []),
        *(f"#define {upper}_{key.upper()} {value}" for key, value in constants.items()),
        "",
        f"static const {kind} {name}_{what}{''.join(f'[{side}]' for side in values.shape)} = {{",
        *_rows(_literals(values), values.shape),
        "};",
        "",
        f"#endif /* {guard} */",
        "",
    ]
    return "\n".join(lines).encode()


def _comment(lines: Sequence[str]) -> Iterator[str]:
    """Write a comment that nothing in it can end or go beyond."""
    for k, line in enumerate(lines):
        text = in_one_line(line).replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?").rstrip("\\ ")
        yield f"{'/*' if k == 0 else ' *'} {text}".rstrip()
    yield " */"


def _literals(values: NDArray[Any]) -> list[str]:
    flat = values.ravel()
    if values.dtype == np.float32:
        return [f"{number!s}f" for number in flat]
    return (
        [f"{number}u" for number in flat.tolist()]
        if values.dtype.kind == "u"
        else list(map(repr, flat.tolist()))
    )


def _rows(literals: Sequence[str], shape: Sequence[int]) -> Iterator[str]:
    """Write the numbers of an array in braces, a line or several for each row."""
    width = shape[-1]
    rows = shape[-2]
    for first in range(0, len(literals), width):
        row = literals[first : first + width]
        at = first // width % rows
        deep = len(shape) == 3
        if deep and at == 0:
            yield "  {"
        pieces = [", ".join(row[k : k + A_LINE]) for k in range(0, width, A_LINE)]
        indent = "    " if deep else "  "
        yield f"{indent}{{{(',' + chr(10) + indent + ' ').join(pieces)}}},"
        if deep and at == rows - 1:
            yield "  },"
