"""Stipplings in files: three units, columns of a plane, and inks are told from what the file holds."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.errors import FormatError
from gbnbench.io.points import ReadingOptions, reading_options
from gbnbench.io.points.image_stipplings import read_pixel_stipplings, read_plane_stipplings
from gbnbench.io.points.stippled_points import (
    PictureHeader,
    read_stipplings,
)

PLAIN = ReadingOptions()
WANTED = np.array([[0.25, 0.5], [0.5, 0.75]])  # x right, y up


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("square.txt", "0.25 0.5\n0.5 0.75\n"),
        ("named.csv", "x,y,amplitude\n0.25,0.5,2\n0.5,0.75,1\n"),
        ("sized.txt", "0.25 0.5 3.5\n0.5 0.75 4.5\n"),
        ("pixels.csv", "x,y\n10,24\n20,12\n"),
        ("sized pixels.txt", "10 24 0.75\n20 12 0.5\n"),
    ],
)
def test_files_of_a_plane_give_the_same_points(tmp_path, name, text):
    (tmp_path / name).write_text(text)
    (found,) = read_plane_stipplings(tmp_path / name, PLAIN, (40, 48))
    assert found.points == pytest.approx(WANTED, abs=1e-15)
    assert (found.amplitudes is None) == (name != "named.csv")


def test_pixels_go_down_and_the_unit_square_up(tmp_path):
    (tmp_path / "p.txt").write_text("10 24\n20 12\n")
    (found,) = read_pixel_stipplings(tmp_path / "p.txt", PLAIN, (40, 48))
    assert found.points == pytest.approx(WANTED, abs=1e-15)
    (boxed,) = read_stipplings(tmp_path / "p.txt", reading_options(bounds=(0, 40, 0, 48)))
    assert boxed.points == pytest.approx(np.array([[0.25, 0.5], [0.5, 0.25]]), abs=1e-15)


def test_inks_and_pictures_are_told(tmp_path):
    header = PictureHeader((40, 48), 0.25)
    parts = [f"{header.text(ink)}\n# x y amplitude\n0.25 0.5 1\n" for ink in ("cyan", "#dd0000")]
    (tmp_path / "inks.txt").write_text("".join(parts))
    found = read_stipplings(tmp_path / "inks.txt", PLAIN)
    assert [(one.ink, one.header) for one in found] == [("cyan", header), ("#dd0000", header)]
    (tmp_path / "inks.csv").write_text("ink,x,y\ncyan,0.25,0.5\n")
    with pytest.raises(FormatError, match=r"inks\.csv, line 1: its dots are of several inks in one table"):
        read_plane_stipplings(tmp_path / "inks.csv", PLAIN, (40, 48))


def test_points_of_the_unit_square_with_a_stray_one_are_not_taken_for_pixels(tmp_path):
    x = np.random.default_rng(0).random((20, 2))
    x[3, 0] = 1.2
    np.savetxt(tmp_path / "stray.txt", x)
    with pytest.raises(FormatError, match=r"coordinates go up to 1\.2: they are not all in the unit square"):
        read_plane_stipplings(tmp_path / "stray.txt", PLAIN, (40, 48))
    assert read_plane_stipplings(tmp_path / "stray.txt", PLAIN, (3, 3))[0].points.max() <= 1
