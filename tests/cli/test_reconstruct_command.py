"""``gbnbench reconstruct``: what others wrote comes back too, and bad input is one line."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as Pillow

import gbnbench
from gbnbench.api.stippled_page import text_of
from gbnbench.cli import run

QUICK = "gbn[gradients=5]"


@pytest.fixture
def picture(here: Path) -> Path:
    """A grey ramp, dark on the left and darker below, as x.png; 300 points as dots.txt and dots.csv."""
    columns, rows = np.meshgrid(np.linspace(0, 200, 36), np.linspace(50, 0, 24))
    Pillow.fromarray(np.rint(columns + rows).astype(np.uint8)).save("x.png")
    made = gbnbench.stipple("x.png", 300, method=QUICK)
    for suffix in (".txt", ".csv"):
        Path(f"dots{suffix}").write_bytes(text_of({"black": made}, suffix))
    return here


def command(*arguments: object) -> int:
    return run(["reconstruct", *map(str, arguments), "--quiet"])


def greys(name: str) -> np.ndarray:
    return np.asarray(Pillow.open(name), float)


def test_what_stipple_wrote_comes_back_without_options(picture, capsys):
    assert run(["stipple", "x.png", "-n", "300", "--method", QUICK, "-o", "o.txt", "--quiet"]) == 0
    assert Path("o.txt").read_bytes() == Path("dots.txt").read_bytes()
    assert command("o.txt", "-o", "back.png") == 0
    assert "wrote back.png: 36 x 24 pixels from 300 points\n" in capsys.readouterr().out
    image, back = greys("x.png"), greys("back.png")
    assert back.mean() == pytest.approx(image.mean(), abs=1)
    assert np.abs(back - image).mean() < 10
    made = gbnbench.stipple("x.png", 300, method=QUICK)
    expected = gbnbench.reconstruct(*made, shape=(24, 36), coverage=made.coverage)
    assert command("o.txt", "-o", "back.npy") == 0
    assert np.array_equal(np.load("back.npy"), expected)
    assert np.array_equal(back, np.rint(255 * expected))


def test_a_table_has_amplitudes_and_is_told_its_size(picture, capsys):
    assert command("dots.csv", "-o", "a.npy", "--size", "36x24") == 0
    points, amplitudes = gbnbench.stipple("x.png", 300, method=QUICK)
    assert np.load("a.npy") == pytest.approx(gbnbench.reconstruct(points, amplitudes, (24, 36)), abs=1e-6)
    for more in (("--points-alone",), ("--method", "kernel"), ("--method", "voronoi")):
        assert command("dots.csv", "-o", "b.npy", "--size", "36,24", *more) == 0
        method = more[1] if len(more) > 1 else "shaping"
        assert np.load("b.npy") == pytest.approx(gbnbench.reconstruct(points, shape=(24, 36), method=method))
    np.save("p.npy", points[:20])
    assert command("p.npy", "-o", "c.jpg") == 0
    assert "wrote c.jpg: 512 x 512 pixels from 20 points" in capsys.readouterr().out


def test_a_strangers_pixels_are_the_same_picture(picture):
    made = gbnbench.stipple("x.png", 300, method=QUICK)
    np.savetxt("theirs.txt", made.pixels)
    assert command("theirs.txt", "-o", "t.npy", "--unit", "pixels", "--size", "36x24") == 0
    expected = gbnbench.reconstruct(made.points, shape=(24, 36))
    assert np.load("t.npy") == pytest.approx(expected, abs=1e-5)
    assert command("theirs.txt", "-o", "u.npy", "--unit", "pixels", "--against", "x.png") == 0
    assert np.array_equal(np.load("u.npy"), np.load("t.npy"))


def test_quality_is_told(picture, capsys):
    assert command("dots.txt", "-o", "a.png", "--against", "x.png") == 0
    assert "PSNR 30." in (said := capsys.readouterr().out)
    assert "of the darkness of x.png" in said
    assert command("dots.csv", "-o", "b.png", "--against", "x.png", "--points-alone", "--json") == 0
    row = json.loads(capsys.readouterr().out)
    assert (row["n"], row["size"], row["method"], row["amplitudes"]) == (300, [36, 24], "shaping", "found")
    assert 23 < row["psnr"] < 28
    assert 0.6 < row["ssim"] < 0.89


def test_white_ink_is_turned_back(picture, capsys):
    assert (
        run(["stipple", "x.png", "--invert", "-n", "300", "--method", QUICK, "-o", "w.txt", "--quiet"]) == 0
    )
    assert command("w.txt", "-o", "w.png", "--invert", "--against", "x.png") == 0
    assert np.abs(greys("w.png") - greys("x.png")).mean() < 12
    assert "PSNR 30." in capsys.readouterr().out


def test_a_negative_and_what_is_measured_are_told(picture, capsys):
    made = gbnbench.stipple("x.png", 300, method=QUICK, invert=True)
    Path("white.txt").write_bytes(text_of({"white": made}, ".txt"))
    negative = "the picture is a negative: "
    for name, invert, told in (
        ("white.txt", (), f"{negative}white.txt holds white dots; add --invert for the image itself"),
        ("dots.txt", ("--invert",), f"{negative}dots.txt holds black dots; leave out --invert"),
        ("white.txt", ("--invert",), None),
        ("dots.txt", (), None),
    ):
        assert command(name, "-o", "o.png", "--against", "x.png", *invert) == 0
        said = capsys.readouterr()
        assert told in said.err if told else negative not in said.err
        assert f"of the {'lightness' if invert else 'darkness'} of x.png" in said.out


def test_a_set_of_several_and_a_volume(picture):
    made = gbnbench.stipple("x.png", 60, method=QUICK)
    other = gbnbench.stipple("x.png", 50, method=QUICK)
    Path("inks.txt").write_bytes(text_of({"cyan": other, "black": made}, ".txt"))
    assert command("inks.txt", "-o", "k.npy", "--set", 1) == 0
    expected = gbnbench.reconstruct(*made, shape=(24, 36), coverage=made.coverage)
    assert np.array_equal(np.load("k.npy"), expected)
    volume = gbnbench.stipple(np.ones((4, 5, 6)), 20, method="rejection")
    Path("v.txt").write_bytes(text_of({"black": volume}, ".txt"))
    assert command("v.txt", "-o", "v.npy") == 0
    assert np.load("v.npy").shape == (4, 5, 6)
    assert command("v.txt", "-o", "v.png") == 2


def test_three_columns_without_names_are_refused_before_any_work(here, capsys, monkeypatch):
    Path("sized.txt").write_text("0.5 0.25 0.75\n0.125 0.75 0.5\n0.25 0.5 0.25\n")
    with monkeypatch.context() as patch:
        patch.setattr("gbnbench.api.reconstruct.density_of_points", None)  # is not reached
        assert command("sized.txt", "-o", "s.png") == 2
    error = capsys.readouterr().err
    assert "sized.txt: has points of three coordinates, a volume, which is written as .npy" in error
    assert "--columns 1,2" in error
    assert command("sized.txt", "-o", "s.png", "--columns", "1,2") == 0


def test_an_image_of_another_size_is_remarked(picture, capsys):
    Pillow.fromarray(np.tile(np.linspace(0, 200, 20).astype(np.uint8), (20, 1))).save("other.png")
    assert command("dots.txt", "-o", "o.png", "--against", "x.png") == 0
    assert "another image" not in capsys.readouterr().err
    assert command("dots.txt", "-o", "o.png", "--against", "other.png") == 0
    assert (
        "dots.txt was drawn of an image of 36 x 24 pixels, and other.png has 20 x 20"
        in capsys.readouterr().err
    )


def test_points_on_the_border_stay_there(here):
    Path("b.txt").write_text("0.0 1.0\n1.0 1.0\n1.0 0.5\n")
    assert command("b.txt", "-o", "b.npy", "--size", "9x9", "--method", "kernel") == 0
    found = np.load("b.npy")
    expected = gbnbench.reconstruct([[0, 1], [1, 1], [1, 0.5]], shape=(9, 9), method="kernel")
    assert found == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("no.txt", "-o", "o.png"), "no.txt: cannot be read"),
        (("dots.txt", "-o", "o.svg"), "o.svg: pictures are written as .png"),
        (("dots.txt", "-o", "no/o.png"), "there is no folder no"),
        (("dots.txt", "-o", "x.png", "--against", "x.png"), "x.png is a file that is read"),
        (("x.png", "-o", "o.png"), "x.png: is a PNG image"),
        (("dots.txt", "-o", "o.png", "--size", "0x5"), "must be pixels of width and height, such as 768x512"),
        (("dots.txt", "-o", "o.png", "--size", "99999999x99999999"), "at most 134,217,728 pixels"),
        (
            ("dots.txt", "-o", "o.png", "--size", "8x8x8"),
            "shape must be (rows, columns), whole numbers of pixels",
        ),
        (
            ("dots.txt", "-o", "o.png", "--size", "8x8", "--against", "x.png"),
            "x.png is 36x24: leave out --size",
        ),
        (("dots.txt", "-o", "o.png", "--against", "kamera"), "did you mean 'camera'?"),
        (("dots.txt", "-o", "o.png", "--set", "1"), "dots.txt: holds 1 set, counted from 0; got --set 1"),
        (("inks.txt", "-o", "o.png"), "inks.txt: holds 2 sets: take one by --set 0 to 1"),
        (("inks.csv", "-o", "o.png"), "inks.csv, line 1: its dots are of several inks"),
        (("pixels.txt", "-o", "o.png"), "such as --period 512,512"),
        (
            ("pixels.txt", "-o", "o.png"),
            "is not in [0, 1]: pixels, y down as in pictures, are read with --unit",
        ),
        (("pen.gcode", "-o", "o.png"), "pen.gcode: holds the moves of a plotter and no table of points"),
        (("pixels.txt", "-o", "o.png", "--unit", "pixels"), "needs the size of the picture: --size 768x512"),
        (
            ("pixels.txt", "-o", "o.png", "--unit", "pixels", "--size", "3x3"),
            "coordinate 5.5 is not in [0, 3]",
        ),
        (("pixels.txt", "-o", "o.png", "--unit", "pixels", "--period", "9"), "leave out --period"),
        (("zero.csv", "-o", "o.png"), "zero.csv, line 3: amplitude 0 is not a finite number above 0"),
        (
            ("turned.csv", "-o", "o.png"),
            "turned.csv: coordinates stand out of order; put the columns as x, y",
        ),
        (("four.npy", "-o", "o.png"), "four.npy: points must be (n, 2) of a picture"),
        (("dots.txt", "-o", "o.png", "--coverage", "2"), "coverage must be above 0 and at most 1; got 2"),
        (("dots.txt", "-o", "o.png", "--method", "best"), "'best' is not one of"),
    ],
)
def test_errors_say_what_was_wrong(picture, capsys, arguments, says):
    made = gbnbench.stipple("x.png", 20, method="rejection")
    for suffix in (".txt", ".csv"):
        Path(f"inks{suffix}").write_bytes(text_of({"cyan": made, "black": made}, suffix))
    Path("pixels.txt").write_text("5.5 3.5\n1.5 2.5\n")
    Path("zero.csv").write_text("x,y,amplitude\n0.5,0.5,1\n0.25,0.5,0\n")
    Path("turned.csv").write_text("y,x,amplitude\n0.9,0.1,1\n0.6,0.2,1\n")
    np.save("four.npy", np.full((9, 4), 0.5))
    before = {path: path.read_bytes() for path in picture.iterdir()}
    assert command(*arguments) == 2
    error = capsys.readouterr().err
    assert says in error
    assert error.strip().count("\n") <= 1  # a wrong use is told with the usage
    assert {path: path.read_bytes() for path in picture.iterdir()} == before
