"""Fixtures of the tests of ``gbnbench spectrum``: two sets, and the command beside files of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gbnbench.cli import run
from gbnbench.io.points import save
from tests.cli.spectrum_files import Said


@pytest.fixture
def sets() -> np.ndarray:
    return np.random.default_rng(11).random((2, 40, 2))


@pytest.fixture
def said(
    tmp_path: Path, sets: np.ndarray, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Said:
    """Run the command beside two sets in s.npz, the same in a.txt and b.csv, and c.txt of another n."""
    monkeypatch.chdir(tmp_path)
    save("s.npz", sets)
    save("a.txt", sets[0])
    save("b.csv", sets[1])
    save("c.txt", sets[0, :30])
    save("d3.npy", np.random.default_rng(12).random((30, 3)))

    def command(*arguments: object, code: int = 0) -> tuple[str, str]:
        found = run(["spectrum", *map(str, arguments)])
        out, err = capsys.readouterr()
        assert found == code, err
        return out, err

    return command
