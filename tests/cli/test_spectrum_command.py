"""``gbnbench spectrum``: files hold the library's numbers, only what is asked, and errors are one line."""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from matplotlib.image import imread

import gbnbench
import gbnbench.cli.spectrum_run
from gbnbench.analysis.radial.anisotropy import anisotropy
from gbnbench.analysis.spectrum.limits import default_fmax
from gbnbench.cli import run
from gbnbench.io.data_files import read_csv
from gbnbench.io.points import save
from gbnbench.reports.comparison import single_spectrum
from tests.oracles.power import direct_power

Said = Callable[..., tuple[str, str]]


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


def stored(path: str) -> dict[str, Any]:
    with np.load(path) as archive:
        return {name: archive[name] for name in archive.files}


def frequencies(table: pd.DataFrame, d: int) -> np.ndarray:
    return table[[f"f{a}" for a in range(d)]].to_numpy()


def test_the_cube_of_one_file_in_every_format(said: Said, sets: np.ndarray) -> None:
    out, err = said("a.txt", "--fmax", 3, "-o", "p.npz")
    assert out.startswith("wrote p.npz: cube |f_a| <= 3, 49 frequencies, of a.txt (n=40, d=2)\n")
    assert "is known to 1%" in out
    assert err == ""
    expected = gbnbench.periodogram(sets[0], 3)
    kept = stored("p.npz")
    np.testing.assert_array_equal(kept["power"], expected.power)
    assert kept["sources"].tolist() == ["a.txt"]
    for name in ("n", "d", "realizations", "fmax", "precision", "method", "device", "half", "weighted"):
        assert kept[name] == getattr(expected, name)
    assert kept["error_rms"] == expected.error_rms > 0
    assert kept["error_bound"] == expected.error_bound
    assert kept["version"] == gbnbench.__version__
    said("a.txt", "--fmax", 3, "-o", "p.npy")
    np.testing.assert_array_equal(np.load("p.npy"), expected.power)
    said("a.txt", "--fmax", 3, "-o", "p.CSV")
    table = read_csv(Path("p.CSV"))
    assert list(table) == ["f0", "f1", "power"]
    np.testing.assert_array_equal(table["power"], expected.power.ravel())
    np.testing.assert_allclose(  # the rows say their own frequencies: summed here, without gbnbench
        table["power"], direct_power(sets[0], frequencies(table, 2)), rtol=1e-11, atol=1e-24
    )
    assert "replacing" in said("a.txt", "--fmax", 3, "-o", "p.npy")[0]


def test_half_a_cube_holds_its_half(said: Said, sets: np.ndarray) -> None:
    save("x3.npy", np.random.default_rng(2).random((20, 3)))
    said("x3.npy", "--half", "--fmax", 2, "-o", "h.csv")
    table = read_csv(Path("h.csv"))
    assert len(table) == 3 * 5 * 5
    assert table["f0"].min() == 0
    expected = direct_power(gbnbench.load("x3.npy"), frequencies(table, 3))
    np.testing.assert_allclose(table["power"], expected, rtol=1e-11, atol=1e-24)
    said("x3.npy", "--half", "--fmax", 2, "-o", "h.npz")
    assert stored("h.npz")["half"]


def test_sets_are_averaged_over_files_or_taken_each(said: Said, sets: np.ndarray) -> None:
    mean = gbnbench.periodogram(sets, 4).power
    said("s.npz", "--fmax", 4, "-o", "p.npy")
    np.testing.assert_array_equal(np.load("p.npy"), mean)
    out, _ = said("a.txt", "b.csv", "--fmax", 4, "-o", "p.npz")
    assert "a.txt and 1 more (n=40, d=2, mean of 2 sets)" in out
    assert stored("p.npz")["sources"].tolist() == ["a.txt", "b.csv"]
    np.testing.assert_array_equal(stored("p.npz")["power"], mean)
    out, _ = said("s.npz", "c.txt", "--each", "--fmax", 4, "-o", "q.npz")
    assert "wrote q_1.npz: cube |f_a| <= 4, 81 frequencies, of s.npz, set 1 (n=40, d=2)" in out
    for k, x in enumerate((sets[0], sets[1], sets[0, :30])):
        np.testing.assert_array_equal(stored(f"q_{k}.npz")["power"], gbnbench.periodogram(x, 4).power)
    assert not Path("q.npz").exists()


def test_the_default_reaches_as_far_as_the_measures_do(said: Said, sets: np.ndarray) -> None:
    said("s.npz", "-o", "p.npz")
    assert stored("p.npz")["fmax"] == default_fmax(40, 2)


def test_shells_bands_and_corners(said: Said, sets: np.ndarray) -> None:
    x = gbnbench.load("d3.npy")
    for arguments, settings in (
        (["--shells", "--fmax", 4], {"fmax": 4}),
        (["--band", "1.5,4.2"], {"fmax": 5, "band": (1.5, 4.2)}),
        (["--corners", "--fmax", 2], {"fmax": 2, "corners": True}),
    ):
        said("d3.npy", *arguments, "-o", "r.csv")
        said("d3.npy", *arguments, "-o", "r.npz")
        expected = gbnbench.shells(x, **settings)
        table, kept = read_csv(Path("r.csv")), stored("r.npz")
        for name in ("frequency", "nu", "power", "count", "deviation"):
            np.testing.assert_array_equal(table[name], getattr(expected, name))
            np.testing.assert_array_equal(kept[name], getattr(expected, name))
        rings = anisotropy(expected)
        np.testing.assert_array_equal(kept["ring"], rings["frequency"])
        np.testing.assert_array_equal(kept["anisotropy_db"], rings["anisotropy_db"])
        np.testing.assert_array_equal(table["ring"], np.round(table["frequency"]))
        first = table.drop_duplicates("ring")
        np.testing.assert_array_equal(first["anisotropy_db"], rings["anisotropy_db"])


def test_listed_frequencies_and_weights(said: Said, sets: np.ndarray) -> None:
    Path("at.txt").write_text("1 2\n-3 0\n1000000 -7\n")
    weights = np.random.default_rng(6).random((2, 40)) + 0.5
    Path("w.txt").write_text("\n".join(map(repr, weights[0].tolist())))
    np.save("w.npy", weights)
    said("a.txt", "--at", "at.txt", "-o", "l.csv")
    table = read_csv(Path("l.csv"))
    assert list(table) == ["f0", "f1", "frequency", "nu", "power"]
    np.testing.assert_allclose(
        table["power"], direct_power(sets[0], [[1, 2], [-3, 0], [1000000, -7]]), rtol=1e-9
    )
    np.testing.assert_allclose(table["frequency"], [5**0.5, 3, (1e12 + 49) ** 0.5], rtol=1e-15)
    np.testing.assert_allclose(table["nu"], table["frequency"] / 40**0.5, rtol=1e-15)

    one, two = (direct_power(sets[k], [[1, 2], [-3, 0]], weights[k]) for k in range(2))
    Path("at.txt").write_text("1 2\n-3 0\n")
    for files, w, expected in (("a.txt", "w.txt", one), ("s.npz", "w.npy", (one + two) / 2)):
        said(files, "--at", "at.txt", "--weights", w, "-o", "l.npz")
        np.testing.assert_allclose(stored("l.npz")["power"], expected, rtol=1e-11)
        assert stored("l.npz")["weighted"]
    said("s.npz", "--each", "--at", "at.txt", "--weights", "w.npy", "-o", "l.npy")
    np.testing.assert_allclose(np.load("l_1.npy"), two, rtol=1e-11)
    said("a.txt", "--shells", "--fmax", 3, "--weights", "w.txt", "-o", "l.npz")
    expected_shells = gbnbench.shells(sets[0], 3, weights=weights[0])
    np.testing.assert_array_equal(stored("l.npz")["power"], expected_shells.power)


def test_precision_and_floor_choose_the_evaluation(said: Said, sets: np.ndarray) -> None:
    said("a.txt", "--fmax", 3, "--precision", "float", "-o", "p.npz")
    assert stored("p.npz")["precision"] == "float"
    np.testing.assert_array_equal(stored("p.npz")["power"], gbnbench.periodogram(sets[0], 3, "float").power)
    out, _ = said("a.txt", "--fmax", 3, "--floor", 1e-3, "--explain")
    assert "because it is the cheapest that knows P = 0.001 to 1%" in out
    assert not out.splitlines()[2].strip().startswith("two-group product in double")


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


@pytest.mark.slow
def test_pictures(said: Said) -> None:
    save("one.csv", np.random.default_rng(3).random((9, 1)))
    lattice = np.stack(np.meshgrid(*[np.arange(8) / 8] * 2), axis=-1).reshape(-1, 2)
    save("lattice.txt", lattice)
    for arguments in (
        ["a.txt", "--half"], ["d3.npy", "--fmax", 3], ["s.npz", "--band", "2,5"], ["one.csv"],
        ["lattice.txt", "--precision", "float"], ["a.txt", "--shells", "--fmax", 1],
    ):  # fmt: skip
        said(*arguments, "-o", "x.png")
        picture = imread(io.BytesIO(Path("x.png").read_bytes()), format="png")[..., :3]
        assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 20
    said("a.txt", "-o", "x.pdf")
    assert Path("x.pdf").read_bytes().startswith(b"%PDF-")


def test_every_marker_of_the_picture_is_on_its_axes(sets: np.ndarray) -> None:
    corners = single_spectrum.figure(gbnbench.shells(sets[0], 9, corners=True), "corners")
    _, lower = corners.axes
    (line,) = [line for line in lower.lines if line.get_marker() == "o"]
    assert line.get_xdata()[-1] == pytest.approx(13 / 40**0.5)  # of |f| = 12.7
    assert lower.get_xlim()[1] > line.get_xdata()[-1]
    assert lower.get_ylabel() == "anisotropy, dB"
    flat = single_spectrum.figure(gbnbench.shells(sets[0, :, :1], 9), "1D")
    assert not flat.axes[1].lines  # "undefined" has no line through it
    assert "holds only the shells inside" in " ".join(t.get_text() for t in corners.texts).replace("\n", " ")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], "name a FILE of points"),
        (["nowhere.txt"], "nowhere.txt: cannot be read: no such file"),
        (["bad.txt"], "bad.txt, line 2"),
        (["a.txt", "c.txt"], "a.txt has n=40, d=2, c.txt has n=30, d=2; --each"),
        (["a.txt", "--half", "--shells"], "--half and --shells do not go together"),
        (["a.txt", "--half", "--band", "1,2"], "--half and --band do not go together"),
        (["a.txt", "--at", "bad.txt", "--fmax", "3"], "--at and --fmax do not go together"),
        (["a.txt", "-n", "40"], "FILE and -n do not go together"),
        (["a.txt", "--at", "bad.txt"], "bad.txt, line 1: '0.5' is not an integer"),
        (["a.txt", "--weights", "bad.txt"], "bad.txt, line 1: 2 numbers in a line"),
        (["a.txt", "c.txt", "--each", "--weights", "bad.txt"], "weights are for sets of one size"),
        (["a.txt", "--fmax", "0"], "--fmax"),
        (["d3.npy", "--fmax", "100000"], "the largest fmax that fits is"),
        (["a.txt", "--fmax", "9" * 30], "more than 2^63"),
        (["a.txt", "--band", "3"], "the least and the largest |f|, such as 2,8"),
        (["a.txt", "--band", "3,nan"], "0 <= LOW <= HIGH"),
        (["a.txt", "--band", "1,9", "--fmax", "4"], "ask for fmax=9"),
        (["a.txt", "--floor", "1e-60"], "out of reach"),
        (["a.txt", "-o", "x.txt"], "written as .npz, .npy, .csv, .png, .pdf; got extension '.txt'"),
        (["a.txt", "-o", "no/x.npz"], "there is no folder no"),
        (["a.txt", "--shells", "-o", "x.npy"], "no room for the |f| of shells"),
        (["a.txt", "--at", "at.txt", "-o", "x.png"], "listed frequencies make no picture"),
        (["a.txt", "--fmax", "1500", "-o", "x.csv"], "write .npz or .npy"),
        (["b.csv", "-o", "./b.csv"], "is read here, and writing would replace it"),
        (["a.txt", "--band", "0,0"], "|f| in 0,0 (DC is left out)"),
        (["a.txt", "--explain", "--weights", "w30.txt"], "w30.txt: 30 numbers where 40 points need 40"),
        (["--explain", "-n", "40", "--weights", "w30.txt"], "w30.txt: 30 numbers where 40 points need 40"),
        (["cube.npz"], "cube.npz: is a spectrum, not points"),
        (["a.txt", "radial.npz"], "radial.npz: is a spectrum, not points"),
        (["a.txt", "--at", "cube.npz"], ".npz lists are not read"),
    ],
)
def test_what_cannot_be_is_one_line_and_exit_2(
    said: Said, arguments: list[str], words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    Path("bad.txt").write_text("0.5 0.5\n0.5 x\n")
    Path("at.txt").write_text("1 2\n")
    Path("w30.txt").write_text("1\n" * 30)
    said("a.txt", "--fmax", 2, "-o", "cube.npz")
    said("a.txt", "--shells", "--fmax", 2, "-o", "radial.npz")
    before = {path: path.read_bytes() for path in Path().iterdir()}
    out, err = said(*arguments, code=2)
    assert out == ""
    assert err.startswith("gbnbench: error: ")
    assert err.count("\n") == 1
    assert words in err
    assert {path: path.read_bytes() for path in Path().iterdir()} == before


def test_each_never_replaces_what_is_read(said: Said, sets: np.ndarray) -> None:
    for k in range(2):
        save(f"pts_{k}.csv", sets[k])
    os.link("pts_1.csv", "link.csv")
    Path("far").symlink_to(Path.cwd())
    Path("w_0.csv").write_text("1\n" * 40)
    Path("f_1.csv").write_text("1 2\n")
    kept = {path: path.read_bytes() for path in Path().iterdir() if path.is_file()}
    for arguments, name in (
        (["pts_0.csv", "pts_1.csv", "-o", "pts.csv"], "pts_0.csv"),
        (["a.txt", "pts_1.csv", "-o", "far/pts.csv"], "far/pts_1.csv"),
        (["a.txt", "link.csv", "-o", "pts.csv"], "pts_1.csv"),
        (["s.npz", "--weights", "w_0.csv", "-o", "w.csv"], "w_0.csv"),
        (["s.npz", "--at", "f_1.csv", "-o", "f.csv"], "f_1.csv"),
    ):
        reach = [] if "--at" in arguments else ["--fmax", 2]
        out, err = said(*arguments, "--each", *reach, code=2)
        expected = f"{name} is read here, and --each would replace it; choose another name"
        assert (out, err) == ("", f"gbnbench: error: {expected}\n")
    assert {path: path.read_bytes() for path in Path().iterdir() if path.is_file()} == kept
    said("a.txt", "b.csv", "--each", "--fmax", 2, "-o", "b.csv")  # b_0.csv and b_1.csv, not b.csv
    assert Path("b.csv").read_bytes() == kept[Path("b.csv")]
    assert Path("b_1.csv").is_file()


def test_a_run_that_is_stopped_says_what_it_keeps(said: Said, monkeypatch: pytest.MonkeyPatch) -> None:
    find, calls = gbnbench.analysis.spectrum.settings.SpectrumSettings.evaluate, []

    def stopped(*arguments: Any) -> Any:
        calls.append(1)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return find(*arguments)

    monkeypatch.setattr(gbnbench.analysis.spectrum.settings.SpectrumSettings, "evaluate", stopped)
    _, err = said("s.npz", "a.txt", "b.csv", "--each", "--fmax", 2, "-o", "q.npy", code=130)
    assert err == "gbnbench: stopped; 2 of 4 files are written and kept\n"
    assert sorted(path.name for path in Path().glob("q*")) == ["q_0.npy", "q_1.npy"]


def test_rounding_is_not_told_as_power_nor_as_anisotropy(said: Said) -> None:
    grid = np.stack(np.meshgrid(*[np.arange(16) / 16] * 2), axis=-1).reshape(-1, 2)
    save("grid.txt", grid)
    save("point.txt", np.array([[0.25, 0.7]]))
    out, _ = said("grid.txt")
    # The error stated, and so the bound, depends on the width of the device's vectors.
    assert re.search(r"noise floor below ([23]e-27), P\(\|f\|=1\) below \1, peak ", out)
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


def test_listed_frequencies_reach_as_far_as_64_bits(said: Said, sets: np.ndarray) -> None:
    Path("at.txt").write_text(f"{-(2**63)} 1\n")
    out, _ = said("a.txt", "--at", "at.txt", "-o", "l.npz")
    assert "1 listed frequency, " in out or "1 listed frequency of" in out
    expected = gbnbench.periodogram(sets[0], frequencies=np.array([[-(2**63), 1]])).power
    np.testing.assert_array_equal(stored("l.npz")["power"], expected)
    Path("at.txt").write_text("0 0\n")
    said("a.txt", "--at", "at.txt", "-o", "l.npz")
    assert stored("l.npz")["power"] == pytest.approx(40)


def test_long_work_is_said_beforehand_and_shows_how_far_it_is(
    said: Said, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gbnbench.cli.spectrum_run.SLOW", 0.0)
    monkeypatch.setattr("gbnbench.cli.spectrum_run.PATIENCE", 0.0)
    _, err = said("a.txt", "--shells", "--fmax", 30, "-o", "r.npz")
    frequencies = gbnbench.plan(40, 2, 30, shells=True).request.frequencies
    assert err.splitlines()[0] == "gbnbench: about 0 s: streamed two-group product in double"
    assert err.splitlines()[-1].startswith(f"{frequencies}/{frequencies} frequencies")
    worth = gbnbench.cli.spectrum_run._worth_showing
    monkeypatch.setattr("gbnbench.cli.spectrum_run.PATIENCE", 1.0)
    assert [worth(*at) for at in ((0.9, 0.1), (1.1, 0.9), (1.1, 0.2))] == [False, False, True]
    duration = gbnbench.cli.spectrum_run._duration
    assert [duration(s) for s in (42, 600, 9e4, 2.4e6)] == ["42 s", "10 minutes", "25 hours", "27.8 days"]


def test_without_a_device_numpy_does_it(tmp_path: Path, sets: np.ndarray) -> None:
    save(tmp_path / "s.npz", sets)
    command = [
        sys.executable,
        "-m",
        "gbnbench",
        "spectrum",
        "s.npz",
        "--shells",
        "--fmax",
        "5",
        "-o",
        "r.npz",
    ]
    environment = {**os.environ, "OCL_ICD_VENDORS": "/nonexistent", "OCL_ICD_FILENAMES": ""}
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "numpy product in double" in done.stdout
    kept, expected = stored(str(tmp_path / "r.npz")), gbnbench.shells(sets, 5)
    assert kept["device"] == "numpy, no OpenCL device"
    np.testing.assert_array_equal(kept["count"], expected.count)
    np.testing.assert_allclose(kept["power"], expected.power, rtol=1e-12)


def test_help_loads_no_heavy_library() -> None:
    script = (
        "import sys\nfrom gbnbench.cli import run\nrun(['spectrum', '--help'])\n"
        "sys.exit(' '.join({'numpy', 'pandas', 'matplotlib', 'pyopencl', 'rich'} & set(sys.modules)) or 0)\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
