"""Thousands of damaged point-set files: each gives one error or the very set that a strict twin reads."""

from __future__ import annotations

import ast
import csv
import io
import re
import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gbnbench.core.errors import FormatError
from gbnbench.io.points import PointSets, ReadingOptions, read, read_sets, save

pytestmark = pytest.mark.slow  # thousands of damaged files

Sets = list[list[tuple[float, ...]]]

FUZZ = settings(max_examples=350, derandomize=True, deadline=None, database=None)


# The strict twin: plain Python, no code shared with gbnbench.io.points

DECIMAL = r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?"
QUOTED = r'(?<![^\s,])"([0-9.eE+-]+)"(?![^\s,])'


class NoPointsError(Exception):
    pass


def need(condition: object) -> None:
    if not condition:
        raise NoPointsError


def twin_tokens(line: str) -> list[str]:
    return [t.strip() for t in line.split(",")] if "," in line else line.split()


def twin_point(tokens: list[str], d: int) -> tuple[float, ...]:
    need(len(tokens) == d)
    values = [float(t) for t in tokens]
    need(all(0 <= v <= 1 for v in values))
    return tuple(0.0 if v == 1 else v for v in values)


def twin_cells(line: str) -> list[str]:
    """Cells that commas part, else blanks; quotes hold a cell together."""
    if '"' in line and "," in line:
        return [cell.strip() for cell in next(csv.reader([line], skipinitialspace=True))]
    if '"' in line:
        words = re.findall(r'"[^"]*"|[^ \t\v\f]+', line)
        return [re.sub(r'^"(.*)"$', r"\1", word, flags=re.DOTALL) for word in words]
    return twin_tokens(line)


def twin_names(line: str) -> list[str]:
    tabbed = "\t" in line and '"' not in line and "," not in line
    cells = [cell.strip() for cell in line.split("\t")] if tabbed else twin_cells(line)
    cells = [cell.strip("\"'").strip() for cell in cells]
    words = [cell for cell in cells if cell]
    named = words and all(
        re.match("[A-Za-z]", w) and w.lower() not in ("nan", "inf", "infinity") for w in words
    )
    return [cell.lower() for cell in cells] if named else []


def twin_axes(names: list[str]) -> bool:
    """Whether these are x, y, z, w in turn, or one letter with numbers from 0 or 1 on."""
    if names == list("xyzw")[: len(names)]:
        return True
    parts = [re.fullmatch(r"([a-z])[_ ]?[\[(]?([0-9]{1,6})[\])]?", name) for name in names]
    numbers = [int(part[2]) for part in parts if part]
    return len({part and part[1] for part in parts}) == 1 and numbers in (
        list(range(len(names))),
        list(range(1, len(names) + 1)),
    )


def twin_decimal_commas(text: str) -> str:
    """Points for commas and commas for semicolons, unless every comma could part thousands."""
    found = re.findall(r"[0-9]*,[0-9]*", text)
    need(not found or not all(re.fullmatch(r"[1-9][0-9]?[0-9]?,[0-9]{3}", cell) for cell in found))
    return text.replace(",", ".").replace(";", ",")


def twin_is_tabbed(line: str) -> bool:
    cells = [cell.strip() for cell in line.split("\t")]
    comma = r"[+-]?\d*,\d+([eE][+-]?\d+)?"
    return (
        len(cells) > 1
        and all(re.fullmatch(comma, c, re.ASCII) or re.fullmatch(DECIMAL, c, re.ASCII) for c in cells)
        and any("," in c for c in cells)
    )


def twin_numbered(lines: list[str], rows: list[int], width: int) -> None:
    """Leave out a first column without a name, which counts the rows or quotes their names."""
    need(rows)
    cells = [twin_cells(lines[row]) for row in rows]
    need(all(len(row) == width for row in cells))
    need(all(re.fullmatch(DECIMAL, cell, re.ASCII) for row in cells for cell in row[1:]))
    if not all(lines[row].startswith('"') and lines[row].count('"') == 2 for row in rows):
        begin = 0 if cells[0][0] == "0" else 1
        need([row[0] for row in cells] == [str(begin + k) for k in range(len(cells))])
    for row, kept in zip(rows, cells, strict=True):
        lines[row] = " ".join(kept[1:])


def twin_text(data: bytes) -> Sets:
    """Read text by the grammar in the docstring of gbnbench.io.points, one line after the other."""
    need(data.removeprefix(b"\xef\xbb\xbf").isascii() or b"#" in data)
    lines = re.split("\r\n|\r|\n", data.removeprefix(b"\xef\xbb\xbf").decode("latin-1"))
    if lines[-1] == "":
        lines.pop()
    content = [line.strip(" \t\v\f") for line in lines]
    holding = [line for line in content if line and line[0] != "#"]
    need(holding)
    numbers = holding[1:] if twin_names(holding[0]) else holding
    if ";" in holding[0] or (numbers and twin_is_tabbed(numbers[0])):
        lines = twin_decimal_commas("\n".join(lines)).split("\n")
    lines = [line.strip(" \t\v\f") for line in lines]
    first = next(i for i, line in enumerate(lines) if line and line[0] != "#")
    names = twin_names(lines[first])
    if names:
        rows = [i for i, line in enumerate(lines) if line and line[0] != "#"][1:]
        width = len(twin_cells(lines[rows[0]])) if rows else len(twin_cells(lines[first]))
        if names[0] and width == len(names) + 1:
            names.insert(0, "")
        lines[first] = ""
        if names[0] == "":
            twin_numbered(lines, rows, width)
            names = names[1:]
        axes = [name for name in names if name not in ("set", "realization")]
        need(not axes or twin_axes(axes))
    lines = [re.sub(QUOTED, r"\1", line) for line in lines]
    rows = [line for line in lines if line and line[0] != "#"]
    tokens = [twin_tokens(row) for row in rows]
    need(rows)
    need(all(re.fullmatch(DECIMAL, t, re.ASCII) for row in tokens for t in row))
    for line in lines:
        struck = twin_tokens(line.lstrip("#").strip()) if line[:1] == "#" else []
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
            return twin_column(tokens, key[0])
        return twin_sections(lines, len(names))
    head = [int(t) for t in tokens[0]] if all(t.isdigit() for t in tokens[0]) else []
    after = len(tokens[1]) if len(tokens) > 1 else 0
    if len(head) in (1, 2):
        if max(head) > 1 or (len(head) == 1 and after > 1) or (head == [1, 1] and after == 1):
            return twin_counted(tokens, len(head))
        need(head in ([0, 0], [1, 0]))
    return twin_sections(lines, len(tokens[0]))


def twin_counted(tokens: list[list[str]], form: int) -> Sets:
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
        sets.append([twin_point(row, d) for row in tokens[:n]])
        tokens = tokens[n:]
    return sets


def twin_column(tokens: list[list[str]], key: int) -> Sets:
    sets: Sets = []
    last = None
    for row in tokens:
        number = float(row[key])
        point = twin_point(row[:key] + row[key + 1 :], len(row) - 1)
        if last is None:
            need(number in (0, 1))
        if last is None or number == last + 1:
            sets.append([])
        else:
            need(number == last)
        sets[-1].append(point)
        last = number
    return sets


def twin_sections(lines: list[str], d: int) -> Sets:
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
            sets[-1].append(twin_point(twin_tokens(line), d))
            before, blank = "row", False
    return sets


def twin_rps(data: bytes) -> Sets:
    need(data and len(data) % 8 == 0 and (any(data) or len(data) == 8))
    values = struct.unpack(f"<{len(data) // 4}f", data)
    return [[twin_point([repr(a), repr(b)], 2) for a, b in zip(values[::2], values[1::2], strict=True)]]


def twin_eps(data: bytes) -> Sets:
    """Every line of the body is a point; the frame around it is that of PSA's own files."""
    lines = [line.strip(" \t\v\f") for line in re.split("\r\n|\r|\n", data.decode("latin-1"))]
    body = [line for line in lines if re.search(r"(^|\s)p$", line, re.ASCII)]
    points = []
    for line in body:
        match = re.fullmatch(rf"({DECIMAL})\s+({DECIMAL})\s+p", line, re.ASCII)
        need(match)
        assert match is not None
        points.append(twin_point([match[1], match[4]], 2))
    need(points)
    start, stop = lines.index(body[0]), len(lines) - lines[::-1].index(body[-1])
    need(all(line in body or not line or line[0] == "%" for line in lines[start:stop]))
    setup = r"%.*|/.*|(.*\s)?(def|bind|gsave|save|scale|translate|newpath|set(gray|rgbcolor|linewidth))|"
    need(all(re.fullmatch(setup, line, re.DOTALL | re.ASCII) for line in lines[:start]))
    need(
        all(
            re.fullmatch(r"%.*|((grestore|restore|showpage|stroke|fill|end)(\s+|$))*", line, re.ASCII)
            for line in lines[stop:]
        )
    )
    closed = any(line and line[0] != "%" for line in lines[stop:])
    opened = any("gsave" in line.split() for line in lines[:start] if line[:1] != "%")
    need(closed or not opened)
    return [points]


def twin_npy(data: bytes) -> Sets:
    need(data[:6] == b"\x93NUMPY" and data[6:8] in (b"\1\0", b"\2\0", b"\3\0"))
    wide = data[6] > 1
    start = 12 if wide else 10
    need(len(data) >= start)
    (length,) = struct.unpack("<I" if wide else "<H", data[8:start])
    try:
        header = ast.literal_eval(data[start : start + length].decode("latin-1").strip())
        need(set(header) == {"descr", "fortran_order", "shape"})
        kind = re.fullmatch(r"([<>=|]?)f([248])", header["descr"])
        need(kind and isinstance(header["fortran_order"], bool) and not header["fortran_order"])
    except (ValueError, SyntaxError, TypeError, AttributeError):
        raise NoPointsError from None
    shape, body = header["shape"], data[start + length :]
    assert kind is not None
    need(isinstance(shape, tuple) and len(shape) in (2, 3))
    need(all(type(s) is int and s > 0 for s in shape))
    count = int(np.prod(shape))
    need(len(body) == count * int(kind[2]))
    order = ">" if kind[1] == ">" else "<"
    values = struct.unpack(f"{order}{count}{ {'2': 'e', '4': 'f', '8': 'd'}[kind[2]] }", body)
    d = shape[-1]
    points = [twin_point([repr(v) for v in values[i : i + d]], d) for i in range(0, count, d)]
    n = shape[-2]
    return [points[i : i + n] for i in range(0, len(points), n)]


# What is damaged, and how


def written(suffix: str, x: object, folder: Path) -> bytes:
    path = folder / f"seed{suffix}"
    save(path, x)  # type: ignore[arg-type]
    return path.read_bytes()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("fuzz")


TOKENS = [
    *(bytes([b]) for b in b"0123456789.,-+eE#% \t\n\r\0x\xff_;:'\"p"),
    *(
        b"nan",
        b"inf",
        b"-1",
        b"1e999",
        b"1e-999",
        b"1_0",
        b"0x1p-1",
        b"one",
        b"x",
        b"set",
        b"\r\n",
        b"\n\n",
        b"\n#\n",
    ),
    *(
        b"1.0",
        b"0",
        b"1",
        b"0.5",
        b"2",
        b"3 2",
        b"1 1",
        b"0 1",
        b"\xef\xbb\xbf",
        b"\xd9\xa1",
        b"\xc2\xa0",
        b"p\n",
    ),
]
# four bytes an edit, drawn at once: hypothesis takes longer to draw than we to read
DAMAGE = st.binary(min_size=4, max_size=12)


def damaged(data: bytes, edits: bytes, binary: bool = False) -> bytes:
    """Insert, overwrite, delete, truncate or double stretches of a file."""
    for high, low, what, how in struct.iter_unpack("4B", edits[: len(edits) // 4 * 4]):
        at = (256 * high + low) * (len(data) + 1) >> 16
        token = bytes([how]) if binary else TOKENS[how % len(TOKENS)]
        if what < 96:
            data = data[:at] + token + data[at + len(token) :]
        elif what < 160:
            data = data[:at] + token + data[at:]
        elif what < 208:
            data = data[:at] + data[at + 1 + how % 13 :]
        elif what < 232:
            data = data[:at]
        else:
            data = data[: at + 1 + how % 13] + data[at:]
    return data


def outcome(path: Path, data: bytes) -> list[np.ndarray] | str:
    """Our reader's sets of a file of these bytes, or its error's text."""
    path.write_bytes(data)
    try:
        return read(path)
    except FormatError as error:
        said = str(error)
    assert said.startswith(str(path))
    assert "\n" not in said
    return said


def verdict(path: Path, data: bytes, twin: Callable[[bytes], Sets]) -> None:
    """Our reader and the twin agree: both refuse, or both read the same sets bit for bit."""
    found = outcome(path, data)
    try:
        expected: Sets | str = twin(data)
    except NoPointsError:
        expected = "no points"
    if isinstance(found, str) or isinstance(expected, str):
        assert isinstance(found, str) == isinstance(expected, str), (data, found, expected)
        return
    assert len(found) == len(expected)
    for x, points in zip(found, expected, strict=True):
        assert x.dtype == np.float64
        assert x.tobytes() == np.array(points).tobytes()


X = np.random.default_rng(7).random((2, 3, 2)).round(3)
Y = np.arange(60).reshape(2, 2, 15) / 64
SEEDS: list[tuple[str, Callable[[Path], bytes]]] = [
    (".txt", lambda f: written(".txt", X[0], f)),
    (".txt", lambda f: written(".txt", X, f)),
    (".txt", lambda f: written(".txt", Y[:, :, :3], f)),
    (".txt", lambda f: written(".txt", Y[:, :1, :1], f)),
    (".txt", lambda f: b"3\n0.25\n1\n0\n2\n.5\n1e-1\n"),
    (".txt", lambda f: b"0.5 0.25\n0 1\n1.0 0.125"),
    (".txt", lambda f: b"0.5\n0.25\n0.75\n"),
    (".dat", lambda f: written(".dat", [X[0], X[1][:2]], f)),
    (".dat", lambda f: b"# made by hand\r\n0 0\r\n0.5 .5\r\n#\r\n\r\n#\r\n0.5 1e-2\r\n"),
    (".csv", lambda f: written(".csv", X[0], f)),
    (".csv", lambda f: written(".csv", X, f)),
    (".csv", lambda f: written(".csv", X[0, :, :1], f)),
    (".csv", lambda f: b"0.5,0.25\n0.125, 1.0\n"),
    (".csv", lambda f: b"x;y\r\n0,5;0,25\r\n0,125;,75\r\n"),
    (".csv", lambda f: b'"x","y"\n"0.5","0.25"\n"0.125","1.0"\n'),
    (".csv", lambda f: b",x,y\n0,0.5,0.25\n1,0.125,1.0\n2,0,1\n"),
    (".txt", lambda f: b'"x" "y"\n"1" 0.5 0.25\n"2" 0.125 1.0\n'),
    (".txt", lambda f: b"x\ty\n0,5\t0,25\n0,125\t,75\n"),
    (".tsv", lambda f: written(".tsv", X, f)),
]


@pytest.mark.parametrize("seed", range(len(SEEDS)), ids=lambda k: f"{k}{SEEDS[k][0]}")
def test_damaged_text(seed: int, folder: Path) -> None:
    suffix, make = SEEDS[seed]
    data = make(folder)
    path = folder / f"damaged{suffix}"
    verdict(path, data, twin_text)

    @FUZZ
    @given(DAMAGE)
    def check(edits: bytes) -> None:
        verdict(path, damaged(data, edits), twin_text)

    check()


PSA_HEAD = (
    b"%!PS-Adobe-3.1 EPSF-3.0\n%%HiResBoundingBox: -3 -3 515 515\n/radius { 0.00585938 } def\n"
    b"/p { radius 0 360 arc closepath fill stroke } def\ngsave 512 512 scale\n0 setgray\n"
)


@FUZZ
@given(DAMAGE, st.booleans())
def test_damaged_eps(folder: Path, edits: bytes, head: bool) -> None:
    body = b"0.600459 0.549315 p\n4.62451e-06 1 p\n0.5 0.25 p\ngrestore\n"
    data = PSA_HEAD + damaged(body, edits) if head else PSA_HEAD + body
    verdict(folder / "damaged.eps", data, twin_eps)


def test_damaged_rps(folder: Path) -> None:
    seeds = [np.random.default_rng(n).random((n, 2)).astype("<f4").tobytes() for n in (1, 3, 40)]

    @FUZZ
    @given(DAMAGE, st.sampled_from(seeds))
    def check(edits: bytes, seed: bytes) -> None:
        data = damaged(seed, edits, binary=True)
        numerals = set(data) <= set(
            b"0123456789+-.eE \t\r\n,#"
        )  # then it is text: none of these seeds comes to that
        verdict(folder / "damaged.rps", seed if numerals else data, twin_rps)

    check()


@pytest.mark.parametrize("part", ["header", "anywhere"])
def test_damaged_npy(part: str, folder: Path) -> None:
    seeds = []
    for x in (X, X[0], X.astype(np.float32), X[0].astype(">f8"), Y[0, :1, :5].astype(np.float16)):
        file = io.BytesIO()
        np.save(file, x)
        seeds.append(file.getvalue())

    @FUZZ
    @given(DAMAGE, st.sampled_from(seeds))
    def check(edits: bytes, seed: bytes) -> None:
        cut = 80 if part == "header" else len(seed)
        data = damaged(seed[:cut], edits, binary=part == "anywhere") + seed[cut:]
        # without its magic it is no .npy, and the .npy tests have nothing to say
        data = data if data.startswith(b"\x93NUMPY") else seed
        found = outcome(folder / "damaged.npy", data)
        if not isinstance(found, str):
            assert [x.tolist() for x in found] == [[list(p) for p in s] for s in twin_npy(data)]

    check()


def test_damaged_npz(folder: Path) -> None:
    """Every byte that matters is under a checksum, so a damaged archive gives the same sets or none."""
    sets = {"one": [X[0]], "stack": X, "ragged": [X[0], X[1][:2], X[0][:1]]}
    seeds = [(written(".npz", x, folder), [np.asarray(s).tolist() for s in x]) for x in sets.values()]
    packed = io.BytesIO()
    np.savez_compressed(packed, points=X[0], other=np.eye(3))
    seeds.append((packed.getvalue(), [X[0].tolist()]))

    @FUZZ
    @given(DAMAGE, st.sampled_from(seeds), st.booleans())
    def check(edits: bytes, seed: tuple[bytes, object], tail: bool) -> None:
        data, expected = seed
        cut = len(data) // 2 if tail else 0  # the directory stands at the end
        data = data[:cut] + damaged(data[cut:], edits, binary=True)
        found = outcome(folder / "damaged.npz", data)
        if not isinstance(found, str):
            assert [x.tolist() for x in found] == expected

    check()


@settings(FUZZ, max_examples=1000)
@given(st.binary(max_size=300), st.sampled_from([".txt", ".csv", ".dat", ".npy", ".npz", ".eps", ""]))
def test_binary_junk(folder: Path, data: bytes, suffix: str) -> None:
    """Random bytes are refused in one line, unless they happen to be numbers."""
    found = outcome(folder / f"junk{suffix}", data)
    if not isinstance(found, str):
        assert [[tuple(p) for p in x.tolist()] for x in found] == twin_text(data)


COUNTED = b"4\n0.1 0.2\n0.3 0.4\n0.5 0.6\n0.7 0.8\n"


@FUZZ
@given(
    st.integers(0, 3), st.integers(0, 1), st.text(min_size=1, max_size=6).filter(lambda t: not t.isspace())
)
def test_one_token_replaced(folder: Path, row: int, column: int, text: str) -> None:
    """A coordinate overwritten with any text is that number or an error, and the other points stay."""
    path = folder / "token.txt"
    lines = [line.split() for line in COUNTED.decode().splitlines()]
    lines[row + 1][column] = text
    path.write_bytes("\n".join(" ".join(line) for line in lines).encode("utf-8", "surrogatepass"))
    expected = (np.arange(8).reshape(4, 2) + 1) / 10
    number = re.fullmatch(DECIMAL, text, re.ASCII)
    if number and 0 <= float(text) <= 1:
        expected[row, column] = float(text) % 1
        assert read(path)[0].tolist() == expected.tolist()
        return
    # blanks, commas, # and line ends can leave other good rows: then the twin must read the same
    verdict(path, path.read_bytes(), twin_text)


@FUZZ
@given(st.integers(0, 10**7))
def test_wrong_count(folder: Path, count: int) -> None:
    path = folder / "count.txt"
    path.write_bytes(COUNTED.replace(b"4\n", b"%d\n" % count, 1))
    if count == 4:
        assert read(path)[0].shape == (4, 2)
    else:
        with pytest.raises(FormatError, match=r"line [1-6]: "):
            read(path)


BOXED = (".extxyz", ".lammpstrj", ".edat", ".json", ".npz")
SUFFIXES = (".ply", ".xyz", *BOXED, ".csv.gz", ".txt.xz", ".ply.b")
OPTIONS = [
    ReadingOptions(),
    ReadingOptions(columns=("x", "y")),
    ReadingOptions(columns=("2", "1")),
    ReadingOptions(period=(2.0,)),
    ReadingOptions(bounds=(-1.0, 2.0), wrap=True),
    ReadingOptions(array="points"),
    ReadingOptions(raw="float32,3"),
    ReadingOptions(wrap=True),
]


def other_seed(suffix: str, k: int, folder: Path) -> bytes:
    """A file of another format: of the unit torus, or in a box of its own where it can hold one."""
    if suffix == ".ply.b":
        head = b"ply\nformat binary_%s_endian 1.0\nelement vertex 4\n" % (b"little", b"big")[k]
        rows = Y[0, :, :12].reshape(-1, 3)[:4].astype("<f8" if k == 0 else ">f8").tobytes()
        return head + b"property double x\nproperty double y\nproperty double z\nend_header\n" + rows
    x = Y[:, :, :3] if suffix != ".ply" else Y[:1, :, :3]
    box = suffix in BOXED and k == 1
    return written(suffix, PointSets(list(x), (2.0,) * 3, (-1.0,) * 3, True) if box else x, folder)


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("k", range(2))
def test_damaged_files_of_other_formats(suffix: str, k: int, folder: Path) -> None:
    """Whatever is damaged, however it is to be read: points of [0, 1), or one line that names the file."""
    seed = other_seed(suffix, k, folder)
    path = folder / f"other{suffix.removesuffix('.b')}"

    @FUZZ
    @given(DAMAGE, st.sampled_from(OPTIONS), st.booleans())
    def check(edits: bytes, options: ReadingOptions, binary: bool) -> None:
        path.write_bytes(damaged(seed, edits, binary))
        said = ""
        try:
            found = read_sets(path, options)
        except FormatError as error:
            said = str(error)
        if said:
            assert said.startswith(str(path))
            assert "\n" not in said
            return
        assert all(((x >= 0) & (x < 1)).all() for x in found.sets)
        assert found.sides is None or len(found.sides) == found.sets[0].shape[1]

    check()
