"""A strict reading of text files in plain Python, line by line, that shares no code with our reader.

It follows the grammar in the docstring of ``gbnbench.io.points``, and is what damaged files are judged by.
"""

from __future__ import annotations

import csv
import re

DECIMAL = r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?"
QUOTED = r'(?<![^\s,])"([0-9.eE+-]+)"(?![^\s,])'


Sets = list[list[tuple[float, ...]]]


class NoPointsError(Exception):
    """The strict reading refuses the file."""


def need(condition: object) -> None:
    """Refuse the file unless the condition holds."""
    if not condition:
        raise NoPointsError


def _tokens(line: str) -> list[str]:
    return [t.strip() for t in line.split(",")] if "," in line else line.split()


def read_point(tokens: list[str], d: int) -> tuple[float, ...]:
    """Read d numbers of [0, 1], whose upper end is the lower.

    Parameters
    ----------
    tokens : list of str
        Literals.
    d : int
        How many there have to be.

    Returns
    -------
    tuple of float
    """
    need(len(tokens) == d)
    values = [float(t) for t in tokens]
    need(all(0 <= v <= 1 for v in values))
    return tuple(0.0 if v == 1 else v for v in values)


def _cells(line: str) -> list[str]:
    """Cells that commas part, else blanks; quotes hold a cell together."""
    if '"' in line and "," in line:
        return [cell.strip() for cell in next(csv.reader([line], skipinitialspace=True))]
    if '"' in line:
        words = re.findall(r'"[^"]*"|[^ \t\v\f]+', line)
        return [re.sub(r'^"(.*)"$', r"\1", word, flags=re.DOTALL) for word in words]
    return _tokens(line)


def _names(line: str) -> list[str]:
    tabbed = "\t" in line and '"' not in line and "," not in line
    cells = [cell.strip() for cell in line.split("\t")] if tabbed else _cells(line)
    cells = [cell.strip("\"'").strip() for cell in cells]
    words = [cell for cell in cells if cell]
    named = words and all(
        re.match("[A-Za-z]", w) and w.lower() not in ("nan", "inf", "infinity") for w in words
    )
    return [cell.lower() for cell in cells] if named else []


def _axes(names: list[str]) -> bool:
    """Whether these are x, y, z, w in turn, or one letter with numbers from 0 or 1 on."""
    if names == list("xyzw")[: len(names)]:
        return True
    parts = [re.fullmatch(r"([a-z])[_ ]?[\[(]?([0-9]{1,6})[\])]?", name) for name in names]
    numbers = [int(part[2]) for part in parts if part]
    return len({part and part[1] for part in parts}) == 1 and numbers in (
        list(range(len(names))),
        list(range(1, len(names) + 1)),
    )


def _decimal_commas(text: str) -> str:
    """Points for commas and commas for semicolons, unless every comma could part thousands."""
    found = re.findall(r"[0-9]*,[0-9]*", text)
    need(not found or not all(re.fullmatch(r"[1-9][0-9]?[0-9]?,[0-9]{3}", cell) for cell in found))
    return text.replace(",", ".").replace(";", ",")


def _is_tabbed(line: str) -> bool:
    cells = [cell.strip() for cell in line.split("\t")]
    comma = r"[+-]?\d*,\d+([eE][+-]?\d+)?"
    return (
        len(cells) > 1
        and all(re.fullmatch(comma, c, re.ASCII) or re.fullmatch(DECIMAL, c, re.ASCII) for c in cells)
        and any("," in c for c in cells)
    )


def _numbered(lines: list[str], rows: list[int], width: int) -> None:
    """Leave out a first column without a name, which counts the rows or quotes their names."""
    need(rows)
    cells = [_cells(lines[row]) for row in rows]
    need(all(len(row) == width for row in cells))
    need(all(re.fullmatch(DECIMAL, cell, re.ASCII) for row in cells for cell in row[1:]))
    if not all(lines[row].startswith('"') and lines[row].count('"') == 2 for row in rows):
        begin = 0 if cells[0][0] == "0" else 1
        need([row[0] for row in cells] == [str(begin + k) for k in range(len(cells))])
    for row, kept in zip(rows, cells, strict=True):
        lines[row] = " ".join(kept[1:])


def strict_text(data: bytes) -> Sets:
    """Read text by the grammar in the docstring of gbnbench.io.points, one line after the other."""
    need(
        data.removeprefix(b"\xef\xbb\xbf").isascii() or b"#" in data or b'"' in data
    )  # comments and names of rows may be in any language
    lines = re.split("\r\n|\r|\n", data.removeprefix(b"\xef\xbb\xbf").decode("latin-1"))
    if lines[-1] == "":
        lines.pop()
    content = [line.strip(" \t\v\f") for line in lines]
    holding = [line for line in content if line and line[0] != "#"]
    need(holding)
    numbers = holding[1:] if _names(holding[0]) else holding
    if ";" in holding[0] or (numbers and _is_tabbed(numbers[0])):
        lines = _decimal_commas("\n".join(lines)).split("\n")
    lines = [line.strip(" \t\v\f") for line in lines]
    first = next(i for i, line in enumerate(lines) if line and line[0] != "#")
    names = _names(lines[first])
    if names:
        rows = [i for i, line in enumerate(lines) if line and line[0] != "#"][1:]
        width = len(_cells(lines[rows[0]])) if rows else len(_cells(lines[first]))
        if names[0] and width == len(names) + 1:
            names.insert(0, "")
        lines[first] = ""
        if names[0] == "":
            _numbered(lines, rows, width)
            names = names[1:]
        axes = [name for name in names if name not in ("set", "realization")]
        need(not axes or _axes(axes))
    lines = [re.sub(QUOTED, r"\1", line) for line in lines]
    tokens = [_tokens(line) for line in lines if line and line[0] != "#"]
    need(tokens)
    need(all(re.fullmatch(DECIMAL, t, re.ASCII) for row in tokens for t in row))
    for line in lines:
        struck = _tokens(line.lstrip("#").strip()) if line[:1] == "#" else []
        if (
            struck
            and all(re.fullmatch(DECIMAL, t, re.ASCII) for t in struck)
            and len(struck) == len(tokens[-1])
        ):
            need(all(t.isdigit() for t in struck))
    if names:
        need(all(len(row) == len(names) for row in tokens))
        key = [i for i, n in enumerate(names) if n in ("set", "realization")]
        need(len(key) <= 1 and len(names) > len(key))
        if key:
            return _column(tokens, key[0])
        return _sections(lines, len(names))
    head = [int(t) for t in tokens[0]] if all(t.isdigit() for t in tokens[0]) else []
    after = len(tokens[1]) if len(tokens) > 1 else 0
    if len(head) in (1, 2):
        if max(head) > 1 or (len(head) == 1 and after > 1) or (head == [1, 1] and after == 1):
            return _counted(tokens, len(head))
        need(head in ([0, 0], [1, 0]))
    return _sections(lines, len(tokens[0]))


def _counted(tokens: list[list[str]], form: int) -> Sets:
    sets: Sets = []
    d = 0
    while tokens:
        head, tokens = tokens[0], tokens[1:]
        need(len(head) == form and all(t.isdigit() for t in head))
        n = int(head[0])
        need(1 <= n <= len(tokens))
        here = int(head[1]) if form == 2 else len(tokens[0])
        need(here >= 1 and d in (0, here))
        need(not (form == 1 and here == 1 and n == 1))
        d = here
        sets.append([read_point(row, d) for row in tokens[:n]])
        tokens = tokens[n:]
    return sets


def _column(tokens: list[list[str]], key: int) -> Sets:
    sets: Sets = []
    last = None
    for row in tokens:
        number = float(row[key])
        point = read_point(row[:key] + row[key + 1 :], len(row) - 1)
        if last is None:
            need(number in (0, 1))
        if last is None or number == last + 1:
            sets.append([])
        else:
            need(number == last)
        sets[-1].append(point)
        last = number
    return sets


def _sections(lines: list[str], d: int) -> Sets:
    sets: Sets = []
    before = "#"
    blank = False
    for line in lines:
        if not line:
            blank = True
        elif line[0] == "#":
            before = "#"
        else:
            if before == "#":
                sets.append([])
            else:
                need(not blank)
            sets[-1].append(read_point(_tokens(line), d))
            before, blank = "row", False
    return sets
