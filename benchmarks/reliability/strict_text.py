"""A strict reading of text files in plain Python, line by line, that shares no code with our reader.

It follows the grammar in the docstring of ``gbnbench.io.points``, and is what damaged files are judged by.
"""

from __future__ import annotations

import re

from gbnbench.benchmarks.reliability.strict_tables import (
    are_axes,
    is_tabbed,
    names_above,
    names_of,
    unnamed_taken,
    with_points,
)
from gbnbench.benchmarks.reliability.strict_words import (
    DECIMAL,
    QUOTED,
    Sets,
    need,
    read_point,
    tokens_of,
)


def strict_text(data: bytes) -> Sets:
    """Read text by the grammar in the docstring of gbnbench.io.points, one line after the other."""
    need(
        data.removeprefix(b"\xef\xbb\xbf").isascii() or b"#" in data or b'"' in data
    )  # comments and names of rows may be in any language
    text = data.decode("latin-1")
    while text.startswith("\xef\xbb\xbf"):
        text = text[3:]
    lines = re.split("\r\n|\r|\n", text)
    told = re.fullmatch(r"""[ \t]*"?sep=(.)"?[ \t]*""", lines[0], re.IGNORECASE)
    if told:
        need(told[1] in ";,\t")
        lines[0] = ""
    if lines[-1] == "":
        lines.pop()
    content = [line.strip(" \t\v\f") for line in lines]
    holding = [line for line in content if line and line[0] != "#"]
    need(holding)
    numbers = holding[1:] if names_of(holding[0]) else holding
    parted = told[1] if told else ";" if ";" in holding[0] else ""
    if parted == ";" or (parted != "," and numbers and is_tabbed(numbers[0])):
        lines = with_points("\n".join(lines)).split("\n")
    lines = [line.strip(" \t\v\f") for line in lines]
    first = next(i for i, line in enumerate(lines) if line and line[0] != "#")
    names = names_of(lines[first])
    headed = bool(names)
    names = unnamed_taken(lines, first, names) if headed else names_above(lines, first)
    axes = [name for name in names if name not in ("set", "realization")]
    need(not axes or are_axes(axes))
    lines = [re.sub(QUOTED, r"\1", line) for line in lines]
    tokens = [tokens_of(line) for line in lines if line and line[0] != "#"]
    need(tokens)
    need(all(re.fullmatch(DECIMAL, t, re.ASCII) for row in tokens for t in row))
    for line in lines:
        struck = tokens_of(line.lstrip("#").strip()) if line[:1] == "#" else []
        if (
            struck
            and all(re.fullmatch(DECIMAL, t, re.ASCII) for t in struck)
            and len(struck) == len(tokens[-1])
        ):
            need(all(t.isdigit() for t in struck) and not all(t.isdigit() for t in tokens[-1]))
    if names:
        need(all(len(row) == len(names) for row in tokens))
        if axes == ["x", "y", "z"]:  # points of one z are a set of the plane
            need(len(tokens) == 1 or len({float(row[names.index("z")]) for row in tokens}) > 1)
        key = [i for i, n in enumerate(names) if n in ("set", "realization")]
        need(len(key) <= 1 and len(names) > len(key))
        if key:
            return _column(tokens, key[0])
        return _sections(lines, len(names), headed)
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


def _sections(lines: list[str], d: int, headed: bool = False) -> Sets:
    """Part sets by lines of #; where a line of names stands above, comments part nothing."""
    sets: Sets = []
    before = "#"
    blank = marked = False
    for line in lines:
        if not line:
            blank = True
        elif line[0] == "#" and headed:
            marked = marked or (bool(sets) and not line.strip("# \t"))
        elif line[0] == "#":
            before = "#"
        else:
            if before == "#":
                sets.append([])
            else:
                need(not blank and not marked)
            sets[-1].append(read_point(tokens_of(line), d))
            before, blank = "row", False
    return sets
