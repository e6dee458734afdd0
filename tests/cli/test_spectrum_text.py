"""What ``gbnbench spectrum`` tells: profiles, plans, rounding as a bound, and long work beforehand."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import gbnbench
import gbnbench.cli.spectrum_run
from gbnbench.analysis.spectrum.limits import default_fmax
from gbnbench.cli import run, share_progress
from gbnbench.core.number_text import duration
from gbnbench.io.data_files import read_csv
from gbnbench.io.points import save
from tests.cli.spectrum_files import Said, stored


def test_without_out_it_tells_the_profile(said: Said, sets: np.ndarray) -> None:
    out, err = said("a.txt")
    assert err == ""
    fmax = default_fmax(40, 2)
    lines = out.splitlines()
    assert lines[0] == f"cube |f_a| <= {fmax}, {(2 * fmax + 1) ** 2} frequencies, of a.txt (n=40, d=2)"
    profile = gbnbench.radial(gbnbench.periodogram(sets[0], fmax))
    assert f"P(|f|=1) {profile.power[0]:.4g}, peak " in lines[2]
    assert lines[4].split() == ["frequency", "nu", "power", "count", "ring", "anisotropy_db"]
    for line, f, p, count in zip(lines[5:21], profile.frequency, profile.power, profile.count, strict=False):
        shown = line.split()
        assert [shown[0], shown[2], shown[3]] == [f"{f:.4g}", f"{p:.4g}", str(count)]
    assert lines[-1] == f"... {len(profile.power) - 16} more: -o FILE.csv has all"
    Path("at.txt").write_text("1 2\n")
    out, _ = said("a.txt", "--at", "at.txt")
    assert out.splitlines()[-1].split()[:2] == ["1", "2"]
    out, _ = said("s.npz", "--each", "--shells", "--fmax", 1)
    assert out.count("1 shell, |f| from 1 to 1, of s.npz, set") == 2


def test_explain_computes_and_writes_nothing(
    said: Said, monkeypatch: pytest.MonkeyPatch, sets: np.ndarray
) -> None:
    def forbidden(*_: object, **__: object) -> None:
        raise AssertionError("evaluated")

    monkeypatch.setattr("gbnbench.analysis.spectrum.settings.periodogram", forbidden)
    monkeypatch.setattr("gbnbench.analysis.spectrum.settings.shells", forbidden)
    plan = gbnbench.plan(40, 2, 3, realizations=2, half=True)
    assert said("s.npz", "--half", "--fmax", 3, "--explain", "-o", "x.npz") == (f"s.npz:\n{plan}\n", "")
    assert not Path("x.npz").exists()
    out, _ = said("s.npz", "c.txt", "--each", "--fmax", 3, "--explain")
    assert "s.npz, set 0 and 1 more, each:\ncube: 49 frequencies" in out
    assert "c.txt:\n" in out
    out, _ = said("--explain", "--shells", "-n", 4096, "-d", 10, "--fmax", 3)
    assert out == f"{gbnbench.plan(4096, 10, 3, shells=True)}\n"
    Path("at.txt").write_text("1 2 3\n4 -9 6\n")
    out, _ = said("--explain", "--at", "at.txt", "--realizations", 2)
    assert out == f"{gbnbench.plan(1024, 3, 9, frequencies=2, realizations=2)}\n"


def test_analyze_explains_each_size_in_each_file(said: Said, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["analyze", "--explain", "s.npz", "nowhere.txt", "d3.npy"]) == 2
    out, err = capsys.readouterr()
    two, three = (gbnbench.plan(n, d, default_fmax(n, d)) for n, d in ((40, 2), (30, 3)))
    assert out == f"s.npz, 2 sets, each:\n{two}\nd3.npy:\n{three}\n"
    assert "nowhere.txt" in err
    assert run(["analyze", "--explain", "--json", "a.txt"]) == 2


def test_rounding_is_not_told_as_power_nor_as_anisotropy(said: Said) -> None:
    grid = np.stack(np.meshgrid(*[np.arange(16) / 16] * 2), axis=-1).reshape(-1, 2)
    save("grid.txt", grid)
    save("point.txt", np.array([[0.25, 0.7]]))
    out, _ = said("grid.txt")
    # The error stated depends on the evaluation, and on the width of the device's vectors.
    assert re.search(r"noise floor below ([\d.]+e-2[567]), P\(\|f\|=1\) below \1, peak ", out)
    assert "e-30" not in out
    for name in ("grid.txt", "point.txt"):
        said(name, "--shells", "--fmax", 12, "-o", "r.csv")
        said(name, "--shells", "--fmax", 12, "-o", "r.npz")
        assert read_csv(Path("r.csv"))["anisotropy_db"].isna().all()
        assert np.isnan(stored("r.npz")["anisotropy_db"]).all()
        assert "inf" not in said(name, "--shells", "--fmax", 12)[0]
    said("grid.txt", "--shells", "--fmax", 12, "--precision", "float", "-o", "r.csv")
    assert read_csv(Path("r.csv"))["anisotropy_db"].isna().all()


def test_shells_that_lie_close_are_told_apart(said: Said) -> None:
    out, _ = said("a.txt", "--band", "1000,1000.1")
    rows = [line.split()[:2] for line in out.splitlines()[4:20]]
    for column in zip(*rows, strict=True):
        assert len(set(column)) == 16
    assert float(rows[1][0]) ** 2 == pytest.approx(round(float(rows[1][0]) ** 2), abs=0.5)


def test_long_work_is_said_beforehand_and_shows_how_far_it_is(
    said: Said, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gbnbench.cli.spectrum_run.SLOW", 0.0)
    monkeypatch.setattr("gbnbench.cli.share_progress.PATIENCE", 0.0)
    _, err = said("a.txt", "--shells", "--fmax", 30, "-o", "r.npz")
    frequencies = gbnbench.plan(40, 2, 30, shells=True).request.frequencies
    said_first = r"gbnbench: about \S+ s, 0\.\d+ GB of memory at most: streamed two-group product in double"
    assert re.fullmatch(said_first, err.splitlines()[0])
    assert err.splitlines()[-1].startswith(f"{frequencies}/{frequencies} frequencies")
    worth = share_progress.worth_showing
    monkeypatch.setattr("gbnbench.cli.share_progress.PATIENCE", 1.0)
    assert [worth(*at) for at in ((0.9, 0.1), (1.1, 0.9), (1.1, 0.2))] == [False, False, True]
    assert [duration(s) for s in (42, 600, 9e4, 2.4e6)] == ["42 s", "10 minutes", "25 hours", "27.8 days"]


def test_help_loads_no_heavy_library() -> None:
    script = (
        "import sys\nfrom gbnbench.cli import run\nrun(['spectrum', '--help'])\n"
        "sys.exit(' '.join({'numpy', 'pandas', 'matplotlib', 'pyopencl', 'rich'} & set(sys.modules)) or 0)\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
