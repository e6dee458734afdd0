"""Commands under the settings of other machines, and sets of few points or many dimensions."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import gbnbench
from gbnbench.cli import run
from gbnbench.runs.spectrum_files import DATA
from tests.processes import COMMAND


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write(n: int, d: int) -> np.ndarray:
    x = np.random.default_rng(d).random((n, d))
    np.savetxt("x.csv", x, delimiter=",", header=",".join(f"x{a}" for a in range(d)), comments="")
    return x


@pytest.mark.parametrize(
    "backend",
    [
        "nonsense",
        pytest.param("Qt5Agg", marks=pytest.mark.slow),
        pytest.param("module://nowhere.at.all", marks=pytest.mark.slow),
        pytest.param("macosx", marks=pytest.mark.slow),
    ],
)
def test_a_backend_of_another_machine_stops_no_picture(backend: str) -> None:
    write(9, 2)
    done = subprocess.run(
        [*COMMAND, "spectrum", "x.csv", "-o", "p.png", "--quiet"],
        capture_output=True, text=True, check=False,
        env={**os.environ, "MPLBACKEND": backend, "LC_ALL": "C", "TERM": "dumb", "NO_COLOR": "1"},
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    assert Path("p.png").read_bytes().startswith(b"\x89PNG")


SETTINGS = {
    "ascii": {"LC_ALL": "C", "PYTHONIOENCODING": "ascii"},
    "no UTF-8": {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
    "no such locale": {"LC_ALL": "xx_YY", "TERM": ""},
    "no width": {"COLUMNS": "0", "TERM": "dumb"},
    "narrow": {"COLUMNS": "12", "NO_COLOR": "1", "FORCE_COLOR": "1"},
}


def numbers_under(settings: dict[str, str], folder: Path) -> list[str]:
    """What a small study prints of numbers under these settings, and none of the others of SETTINGS."""
    given = {name for each in SETTINGS.values() for name in each}
    done = subprocess.run(
        [*COMMAND, "integrate", "random", "-n", "8,16", "--instances", "2", "--quiet", "-o", "i"],
        capture_output=True, check=False, cwd=folder,
        env={**{name: value for name, value in os.environ.items() if name not in given}, **settings},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return [word for word in done.stdout.decode("utf-8").split() if word[:1].isdigit() and "." in word]


@pytest.fixture(scope="module")
def plain_numbers(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    return numbers_under({}, tmp_path_factory.mktemp("plain"))


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="variables of POSIX")
@pytest.mark.parametrize("name", SETTINGS)
def test_settings_of_odd_terminals_change_no_number(
    name: str, plain_numbers: list[str], tmp_path: Path
) -> None:
    assert len(plain_numbers) > 4
    assert numbers_under(SETTINGS[name], tmp_path) == plain_numbers


@pytest.mark.parametrize("d", [1, 2, 3])
@pytest.mark.parametrize("n", [1, 2])
def test_one_point_and_two(n: int, d: int, capsys: pytest.CaptureFixture[str]) -> None:
    x = write(n, d)
    assert run(["analyze", "x.csv", "--json"]) == 0
    (row,) = json.loads(capsys.readouterr().out)
    assert {name for name, value in row["measures"].items() if value is None} == set(row["reasons"])
    found = gbnbench.measures(x)
    for name, value in found.items():
        assert math.isfinite(value) or found.reasons[name]
    power = abs(np.exp(-2j * np.pi * x).sum(axis=0)) ** 2 / n
    assert found["power_at_1"] == pytest.approx(power.mean(), rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize(("d", "shells"), [(50, 3), (100, 2), (300, 1)])
def test_many_dimensions(d: int, shells: int, capsys: pytest.CaptureFixture[str]) -> None:
    x = write(8, d)
    found = gbnbench.measures(x[None])
    assert found["power_at_1"] == pytest.approx(
        (abs(np.exp(-2j * np.pi * x).sum(axis=0)) ** 2).mean() / 8, rel=1e-12
    )
    for name, value in found.items():
        assert math.isfinite(value) or found.reasons[name]
    assert f"up to |f|^2 = {shells} are affordable by default" in found.reasons["peak"]
    command = ["spectrum", "x.csv", "--columns", ",".join(f"x{a}" for a in range(d)), "--quiet"]
    assert run([*command, "--json"]) == 0
    (record,) = json.loads(capsys.readouterr().out)
    assert [row["count"] for row in record["rows"]] == [2 * d, 2 * d * (d - 1), 4 * math.comb(d, 3) * 2][
        :shells
    ]
    assert record["measures"]["power_at_1"] == pytest.approx(found["power_at_1"], rel=1e-12)
    for suffix in (*DATA, ".png"):
        assert run([*command, "-o", f"p{suffix}"]) == (2 if suffix == ".npy" else 0)
    assert "an .npy has no room for the |f| of shells" in capsys.readouterr().err
