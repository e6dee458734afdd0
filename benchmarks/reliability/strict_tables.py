"""A strict reading of tables in text: names of columns, names and numbers of rows, decimal commas."""

from __future__ import annotations

import csv
import re

from gbnbench.benchmarks.reliability.strict_words import DECIMAL, QUOTED, need, tokens_of

AXIS = r"[xyzw]|[a-z][_ ]?[\[(]?[0-9]{1,6}[\])]?"  # the name of one, alone


def cells_of(line: str) -> list[str]:
    """Part a line by commas, else by blanks; quotes hold a cell together.

    Parameters
    ----------
    line : str
        Without blanks at its ends.

    Returns
    -------
    list of str
    """
    if '"' in line and "," in line:
        return [cell.strip() for cell in next(csv.reader([line], skipinitialspace=True))]
    if '"' in line:
        words = re.findall(r'"[^"]*"|[^ \t\v\f]+', line)
        return [re.sub(r'^"(.*)"$', r"\1", word, flags=re.DOTALL) for word in words]
    return tokens_of(line)


def names_of(line: str) -> list[str]:
    """Return the names of a line of names in lower case, or none.

    Parameters
    ----------
    line : str
        Without blanks at its ends.

    Returns
    -------
    list of str
    """
    tabbed = "\t" in line and '"' not in line and "," not in line
    cells = [cell.strip() for cell in line.split("\t")] if tabbed else cells_of(line)
    cells = [cell.strip("\"'").strip() for cell in cells]
    words = [cell for cell in cells if cell]
    named = words and all(
        re.match("[A-Za-z]", w) and w.lower() not in ("nan", "inf", "infinity") for w in words
    )
    return [cell.lower() for cell in cells] if named else []


def are_axes(names: list[str]) -> bool:
    """Tell whether names are x, y, z, w in turn, or one letter with numbers from 0 or 1 on.

    Parameters
    ----------
    names : list of str
        In lower case.

    Returns
    -------
    bool
    """
    if names == list("xyzw")[: len(names)]:
        return True
    parts = [re.fullmatch(r"([a-z])[_ ]?[\[(]?([0-9]{1,6})[\])]?", name) for name in names]
    numbers = [int(part[2]) for part in parts if part]
    return len({part and part[1] for part in parts}) == 1 and numbers in (
        list(range(len(names))),
        list(range(1, len(names) + 1)),
    )


def with_points(text: str) -> str:
    """Write points for commas and commas for semicolons, unless every comma could part thousands.

    Parameters
    ----------
    text : str
        The whole file.

    Returns
    -------
    str
    """
    found = re.findall(r"[0-9]+,[0-9]*|,[0-9]+", text)
    need(not found or not all(re.fullmatch(r"[1-9][0-9]?[0-9]?,[0-9]{3}", cell) for cell in found))
    return text.replace(",", ".").replace(";", ",")


def is_tabbed(line: str) -> bool:
    """Tell whether tabs part several numbers with decimal commas.

    Parameters
    ----------
    line : str
        Without blanks at its ends.

    Returns
    -------
    bool
    """
    cells = [cell.strip().strip('"') for cell in line.split("\t")]
    comma = r"[+-]?\d*,\d+([eE][+-]?\d+)?"
    return (
        len(cells) > 1
        and all(re.fullmatch(comma, c, re.ASCII) or re.fullmatch(DECIMAL, c, re.ASCII) for c in cells)
        and any("," in c for c in cells)
    )


def take_row_names(lines: list[str], rows: list[int], width: int) -> None:
    """Leave out a first column without a name, which counts the rows or quotes their names.

    Parameters
    ----------
    lines : list of str
        Of the file; changed in place.
    rows : list of int
        Which of them are rows.
    width : int
        Cells of each row.
    """
    need(rows)
    cells = [cells_of(lines[row]) for row in rows]
    need(all(len(row) == width for row in cells))
    need(all(re.fullmatch(DECIMAL, cell, re.ASCII) for row in cells for cell in row[1:]))
    if not all(lines[row].startswith('"') and lines[row].count('"') == 2 for row in rows):
        need(_counted_rows([row[0] for row in cells]))
    for row, kept in zip(rows, cells, strict=True):
        lines[row] = " ".join(kept[1:])


def _counted_rows(cells: list[str]) -> bool:
    """Whether these are 0, 1, 2, ... or 1, 2, 3, ..."""
    begin = 0 if cells[0] == "0" else 1
    return cells == [str(begin + k) for k in range(len(cells))]


def take_ends(lines: list[str], rows: list[int], names: list[str]) -> list[str]:
    """Take the empty cell off the end of each row, where the first ends in one that has no name.

    Parameters
    ----------
    lines : list of str
        Of the file; changed in place.
    rows : list of int
        Which of them are rows.
    names : list of str
        Of the columns.

    Returns
    -------
    list of str
        The names, without that of the end.
    """
    cells = [cells_of(lines[row]) for row in rows]
    width = len(cells[0]) if cells else 0
    if not cells or cells[0][-1]:
        return names
    if width == len(names) > 1 and not names[-1]:
        names = names[:-1]
    elif width != len(names) + 1:
        return names
    need(all(len(row) == width and not row[-1] for row in cells))
    need(all(re.fullmatch(DECIMAL, cell, re.ASCII) for row in cells for cell in row[names[0] == "" : -1]))
    if names[0]:
        need(len(cells) < 3 or not _counted_rows([row[0] for row in cells]))
        need(not all(lines[row].startswith('"') and lines[row].count('"') == 2 for row in rows))
    for row in rows:
        lines[row] = re.sub(r"""[ \t\v\f]*,[ \t\v\f]*("")?$""", "", lines[row])
    return names


def names_above(lines: list[str], first: int) -> list[str]:
    """Return the names in a comment right above the first row, a word for each number.

    Parameters
    ----------
    lines : list of str
        Of the file.
    first : int
        Which of them is the first row.

    Returns
    -------
    list of str
        None where the comment is another.
    """
    cells = tokens_of(re.sub(QUOTED, r"\1", lines[first]))
    if not first or lines[first - 1][:1] != "#":
        return []
    if not all(re.fullmatch(DECIMAL, cell, re.ASCII) for cell in cells):
        return []
    if len(cells) < 3 and all(cell.isdigit() for cell in cells):
        after = [line for line in lines[first + 1 :] if line and line[0] != "#"]
        if any(int(cell) > 1 for cell in cells) or not after or len(cells_of(after[0])) != len(cells):
            return []
    names = names_of(lines[first - 1].lstrip("#").strip(" \t\v\f"))
    axes = [name for name in names if re.fullmatch(AXIS, name, re.IGNORECASE | re.ASCII)]
    return names if len(names) == len(cells) and axes else []


def unnamed_taken(lines: list[str], first: int, names: list[str]) -> list[str]:
    """Take the line of names off a table, and the cells of its rows that have none.

    Parameters
    ----------
    lines : list of str
        Of the file; changed in place.
    first : int
        Which of them holds the names.
    names : list of str
        As it holds them.

    Returns
    -------
    list of str
        Of the columns that remain.
    """
    rows = [i for i, line in enumerate(lines) if line and line[0] != "#"][1:]
    names = take_ends(lines, rows, names)
    width = len(cells_of(lines[rows[0]])) if rows else len(names)
    if names[0] and width == len(names) + 1:
        cell = cells_of(lines[rows[0]])[0]
        quoted = lines[rows[0]].startswith('"') and lines[rows[0]].count('"') == 2
        named = quoted and (cell.isdigit() or not re.fullmatch(DECIMAL, cell, re.ASCII))
        need(named or cell in ("0", "1"))
        names = ["", *names]
    lines[first] = ""
    if names[0] == "":
        take_row_names(lines, rows, width)
        names = names[1:]
    return names
