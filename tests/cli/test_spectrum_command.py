"""``gbnbench spectrum``: files hold the library's numbers, only what is asked, and errors are one line."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import gbnbench
import gbnbench.cli.spectrum_run
from gbnbench.analysis.radial.anisotropy import anisotropy
from gbnbench.analysis.spectrum.limits import default_fmax
from gbnbench.io.data_files import read_csv
from gbnbench.io.points import save
from gbnbench.reports.comparison import single_spectrum
from tests.cli.spectrum_files import Said, frequencies, stored
from tests.oracles.power import direct_power


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
        with Image.open("x.png") as picture:
            assert len(picture.convert("RGB").getcolors(picture.width * picture.height)) > 20
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


def test_listed_frequencies_reach_as_far_as_64_bits(said: Said, sets: np.ndarray) -> None:
    Path("at.txt").write_text(f"{-(2**63)} 1\n")
    out, _ = said("a.txt", "--at", "at.txt", "-o", "l.npz")
    assert "1 listed frequency, " in out or "1 listed frequency of" in out
    expected = gbnbench.periodogram(sets[0], frequencies=np.array([[-(2**63), 1]])).power
    np.testing.assert_array_equal(stored("l.npz")["power"], expected)
    Path("at.txt").write_text("0 0\n")
    said("a.txt", "--at", "at.txt", "-o", "l.npz")
    assert stored("l.npz")["power"] == pytest.approx(40)


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
