"""Thousands of damaged point-set files: each gives one error or the very set that a strict twin reads."""

from __future__ import annotations

import io
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gbnbench.benchmarks.reliability.strict_arrays import strict_npy, strict_rps
from gbnbench.benchmarks.reliability.strict_formats import strict_eps
from gbnbench.benchmarks.reliability.strict_text import strict_text
from gbnbench.benchmarks.reliability.strict_words import DECIMAL
from gbnbench.core.errors import FormatError
from gbnbench.io.points import PointSets, ReadingOptions, read, read_sets
from tests.io.damage import DAMAGE, FUZZ, damaged, outcome, verdict, written

pytestmark = pytest.mark.slow  # thousands of damaged files


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("fuzz")


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
    verdict(path, data, strict_text)

    @FUZZ
    @given(DAMAGE)
    def check(edits: bytes) -> None:
        verdict(path, damaged(data, edits), strict_text)

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
    verdict(folder / "damaged.eps", data, strict_eps)


def test_damaged_rps(folder: Path) -> None:
    seeds = [np.random.default_rng(n).random((n, 2)).astype("<f4").tobytes() for n in (1, 3, 40)]

    @FUZZ
    @given(DAMAGE, st.sampled_from(seeds))
    def check(edits: bytes, seed: bytes) -> None:
        data = damaged(seed, edits, binary=True)
        numerals = set(data) <= set(
            b"0123456789+-.eE \t\r\n,#"
        )  # then it is text: none of these seeds comes to that
        verdict(folder / "damaged.rps", seed if numerals else data, strict_rps)

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
            assert [x.tolist() for x in found] == [[list(p) for p in s] for s in strict_npy(data)]

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
        assert [[tuple(p) for p in x.tolist()] for x in found] == strict_text(data)


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
    verdict(path, path.read_bytes(), strict_text)


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
    ReadingOptions(bounds=(-1.0, 2.0) * 3, wrap=True),
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
