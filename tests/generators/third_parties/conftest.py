"""A program that writes points, a file that names it, and packages as an installer leaves them."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

# Says what it was told on a line each of standard error; writes its points to the file, else prints them.
PROGRAM = """
import os, random, sys
n, d, seed, mode, out = int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]), sys.argv[4], sys.argv[5:]
rng = random.Random(seed)
if mode == "folder":
    assert os.listdir() == [], os.listdir()
if mode == "fails":
    sys.exit("first line\\nno luck with %d" % n)
if mode == "dies":
    os.abort()
rows = [[rng.random() for _ in range(d)] for _ in range(n + (mode == "many"))]
if mode == "outside":
    rows[1][0] = 1.5
if mode == "rounding":
    rows[1][0] = -1e-9
text = "".join(" ".join(map(repr, row)) + "\\n" for row in rows)
if mode == "colour":
    sys.exit("%c[31mred%c" % (27, 0))
if mode == "garbage":
    text = "not a number\\n"
if mode != "silent":
    print(text, end="") if not out else open(out[0], "w").write(text)
"""


@pytest.fixture
def programs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Write the program and a file of programs with this text."""
    (tmp_path / "draw.py").write_text(PROGRAM)

    def write(text: str) -> Path:
        path = tmp_path / "generators.toml"
        path.write_text(text.replace("PYTHON", sys.executable))
        monkeypatch.setenv("GBNBENCH_GENERATORS", str(path))
        return path

    return write


@pytest.fixture
def install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Leave a package as an installer would: a module of this text, and entry points into it."""
    count = 0

    def package(name: str, text: str, *entries: str) -> None:
        nonlocal count
        count += 1
        place = tmp_path / f"site{count}"
        info = place / f"{name}-2.1.dist-info"
        info.mkdir(parents=True)
        (place / f"{name}.py").write_text(text)
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 2.1\n")
        (info / "entry_points.txt").write_text("\n".join(["[gbnbench.generators]", *entries, ""]))
        monkeypatch.syspath_prepend(str(place))
        monkeypatch.delitem(sys.modules, name, raising=False)

    return package
