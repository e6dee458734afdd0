"""Large files of numbers are mapped into memory: the same points and errors, and the file does not change."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gbnbench
from gbnbench.core.errors import FormatError
from gbnbench.io.points import point_file
from gbnbench.io.points.formats import numpy_array

X = np.random.default_rng(41).random((3000, 2))


@pytest.fixture(autouse=True)
def _map_all(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(numpy_array, "MAPPED_FROM", 1)
    monkeypatch.setattr(point_file, "MAPPED_FROM", 1)


def base(x: np.ndarray) -> object:
    """What holds the memory of an array."""
    while isinstance(x, np.ndarray) and not isinstance(x, np.memmap) and x.base is not None:
        x = x.base
    return x


@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("dtype", ["<f8", ">f8", "<f4"])
def test_an_array_is_what_was_saved(tmp_path: Path, dtype: str, order: str) -> None:
    stored = np.array(X.astype(dtype), order=order)
    np.save(tmp_path / "x.npy", stored)
    found = gbnbench.load(tmp_path / "x.npy")
    assert np.array_equal(found, stored.astype(np.float64))
    assert isinstance(base(found), np.memmap) == (dtype == "<f8" and order == "C")


def test_the_upper_end_becomes_the_lower_and_the_file_stays_as_it_is(tmp_path: Path) -> None:
    stored = X.copy()
    stored[7, 1] = 1.0
    np.save(tmp_path / "x.npy", stored)
    before = (tmp_path / "x.npy").read_bytes()
    assert gbnbench.load(tmp_path / "x.npy")[7, 1] == 0.0
    assert (tmp_path / "x.npy").read_bytes() == before


@pytest.mark.parametrize("suffix", [".bin", ".rps"])
def test_numbers_without_a_header_are_what_was_written(tmp_path: Path, suffix: str) -> None:
    layout = "float32" if suffix == ".rps" else "float64"
    X.astype(layout).tofile(tmp_path / f"x{suffix}")
    before = (tmp_path / f"x{suffix}").read_bytes()
    found = gbnbench.load(tmp_path / f"x{suffix}", raw=None if suffix == ".rps" else f"{layout},2")
    assert np.array_equal(found, X.astype(layout).astype(np.float64))
    found[0, 0] = 0.5
    assert (tmp_path / f"x{suffix}").read_bytes() == before


@pytest.mark.parametrize("bad", [np.nan, 1.5, -0.25])
def test_errors_name_the_point(tmp_path: Path, bad: float) -> None:
    stored = X.copy()
    stored[11, 0] = bad
    np.save(tmp_path / "x.npy", stored)
    with pytest.raises(FormatError, match=r"\(point 11, axis 0\)"):
        gbnbench.load(tmp_path / "x.npy")
    stored.tofile(tmp_path / "x.bin")
    with pytest.raises(FormatError, match=r"\(point 11, axis 0\)"):
        gbnbench.load(tmp_path / "x.bin", raw="float64,2", wrap=False, period=1)


def test_zeros_alone_are_still_refused(tmp_path: Path) -> None:
    np.zeros(4000).tofile(tmp_path / "x.bin")
    with pytest.raises(FormatError, match="all bytes are zero"):
        gbnbench.load(tmp_path / "x.bin", raw="float64,2")


def test_a_box_divides_a_mapped_array(tmp_path: Path) -> None:
    np.save(tmp_path / "x.npy", X * 512)
    np.testing.assert_array_equal(gbnbench.load(tmp_path / "x.npy", period=512), X * 512 / 512)
