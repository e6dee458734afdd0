"""Numbers that are missing carry their reasons, in JSON and below tables."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from gbnbench.cli import run


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def nulls(row: dict[str, object]) -> set[str]:
    return {name for name, value in row.items() if value is None}


@pytest.mark.slow
def test_every_null_of_a_study_has_its_reason(capsys: pytest.CaptureFixture[str]) -> None:
    command = ["integrate", "grid", "random", "-n", "16", "--realizations", "1"]
    command += ["--instances", "1", "--quiet"]
    assert run([*command, "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["variance"]
    assert len(rows) == 4
    for row in rows:
        assert nulls(row) == set(row.get("reasons", {}))
        assert all(row.get("reasons", {"": "some"}).values())
    assert any("foretold" in row["reasons"] for row in rows)
    assert run(command) == 0
    assert "- slope: a slope needs two sizes n or more" in capsys.readouterr().out


@pytest.mark.slow
def test_a_size_that_a_source_lacks_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    np.savetxt("mine.txt", np.random.default_rng(0).random((9, 2)))
    command = ["integrate", "mine.txt", "random", "-n", "16", "--realizations", "2", "--instances", "2"]
    assert run([*command, "--integrand", "half-space", "--quiet"]) == 0
    out = capsys.readouterr().out
    assert "- n=9; n=16: this source has no sets of that size" in out


@pytest.mark.slow
def test_every_null_of_a_spectrum_and_a_comparison_has_its_reason(
    capsys: pytest.CaptureFixture[str],
) -> None:
    np.savetxt("line.txt", np.random.default_rng(0).random((9, 1)))
    assert run(["spectrum", "line.txt", "--json"]) == 0
    (found,) = json.loads(capsys.readouterr().out)
    assert all(nulls(row) == {"anisotropy_db"} for row in found["rows"])  # a pair on each shell
    assert set(found["reasons"]) == {"anisotropy_db"} | nulls(found["measures"])
    assert run(["compare", "line.txt", "--json", "--quiet", "--jobs", "1"]) == 0
    for row in json.loads(capsys.readouterr().out):
        assert nulls(row) == set(row["reasons"])
        assert all(row["reasons"].values())
