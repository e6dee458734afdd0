"""Files whose names are no UTF-8, or hold line ends, blanks and the signs of HTML and the shell."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import numpy as np
import pytest

from tests.processes import command

pytestmark = [
    pytest.mark.skipif(sys.platform != "linux", reason="other systems refuse such names"),
    pytest.mark.slow,
]
NAMES = [b"caf\xe9.txt", b"two\nlines.txt", b"<b>$x_1$ & 'q'.txt", "点集.txt".encode()]
LABELS = ["caf\\xe9", "two\nlines", "<b>$x_1$ & 'q'", "点集"]


@pytest.fixture
def files(tmp_path: Path) -> list[str]:
    for k, name in enumerate(NAMES):
        np.savetxt(tmp_path / os.fsdecode(name), np.random.default_rng(k).random((32, 2)))
    return [os.fsdecode(name) for name in NAMES]


def test_a_comparison_keeps_such_names_in_every_file(files: list[str], tmp_path: Path) -> None:
    folder = os.fsdecode(b"run\xe9")
    for reused in (False, True):
        done = command("compare", *files, "--quiet", "-o", folder, cwd=tmp_path, errors="surrogateescape")
        assert done.returncode == 0, done.stderr
        assert ("4 of 4 pieces reused" in done.stdout) == reused
    run = tmp_path / folder
    settings = json.loads((run / "settings.json").read_text("utf-8"))
    assert [source["label"] for source in settings["sources"]] == LABELS
    assert "caf\\xe9," in (run / "table.csv").read_text("utf-8")
    page = (run / "report.html").read_text("utf-8")
    assert "caf\\xe9" in page
    assert "<b>$x" not in page
    again = command("compare", files[0], "--quiet", "-o", "next", "--baseline", folder, cwd=tmp_path)
    assert again.returncode == 0, again.stderr
    assert command("report", folder, cwd=tmp_path, errors="surrogateescape").returncode == 0


def test_every_other_command_reads_and_writes_such_names(files: list[str], tmp_path: Path) -> None:
    rows = json.loads(command("analyze", *files, "--json", cwd=tmp_path).stdout)
    assert [row["path"] for row in rows] == files  # as the system knows them, so that they can be opened
    table = command("analyze", *files, cwd=tmp_path).stdout
    assert all(name in table for name in ("caf\\xe9.txt", "two\\nlines.txt", "点集.txt"))
    for ending in ("csv", "npz", "png"):
        out = os.fsdecode(b"o\xff.") + ending
        done = command("spectrum", files[0], "-o", out, cwd=tmp_path, errors="surrogateescape")
        assert done.returncode == 0, done.stderr
        assert (tmp_path / out).exists()
    done = command("integrate", files[0], "--quiet", "--instances", "2", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    lost = command("analyze", os.fsdecode(b"no\xe9"), cwd=tmp_path)
    assert lost.returncode == 2
    assert lost.stderr.startswith(r"gbnbench: error: no\xe9: ")
