"""``gbnbench.stipple``: its points lie on the ink, x right and y up, whatever the image is given as."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image as Pillow

import gbnbench
from gbnbench.core.errors import FormatError, InputError
from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.registry import ADAPTIVE_GENERATORS, adaptive_points
from gbnbench.studies.stippling.darkness import as_darkness

WHITE = np.full((20, 30), 255, np.uint8)
QUICK = "gbn[gradients=5]"


def corner() -> np.ndarray:
    """White but for a black square of four pixels, right and near the top."""
    image = WHITE.copy()
    image[2:6, 22:26] = 0
    return image


@pytest.mark.parametrize("method", ADAPTIVE_GENERATORS)
def test_points_are_in_the_unit_square_x_to_the_right_and_y_up(method):
    made = gbnbench.stipple(corner(), 40, method=method)
    assert made.size == (30, 20)
    assert (made.pixels.min(axis=0) >= [22, 2]).all()
    assert (made.pixels.max(axis=0) <= [26, 6]).all()
    points, amplitudes = made
    assert (points.min(axis=0) >= [22 / 30, 14 / 20 - 1e-15]).all()
    assert (points.max(axis=0) <= [26 / 30, 18 / 20 + 1e-15]).all()
    assert points == pytest.approx(made.pixels * [1 / 30, -1 / 20] + [0, 1])
    assert amplitudes is made.amplitudes
    assert made.amplitudes.shape == (40,)
    assert made.amplitudes.mean() == pytest.approx(1)


def test_a_path_a_name_and_an_array_are_one_image(here):
    picture = np.random.default_rng(1).integers(0, 256, (12, 17), np.uint8)
    Pillow.fromarray(picture).save("x.png")
    np.save("x.npy", picture)
    density = as_density(1 - picture / 255)
    sets = [
        gbnbench.stipple(source, 50, method=QUICK, seed=2).pixels
        for source in ("x.png", here / "x.png", "x.npy", picture, picture / np.float32(255))
    ]
    expected = adaptive_points(QUICK, density, 50, seed=2)[:, ::-1]
    for found in sets:
        assert found == pytest.approx(expected, abs=1e-3)  # tones are rounded to float32
    assert gbnbench.stipple(density, 50, method=QUICK, seed=2).pixels == pytest.approx(expected)


def test_functions_and_volumes_are_densities():
    made = gbnbench.stipple(lambda x: x[:, 0], 4000, shape=(40, 10), method="rejection")
    assert made.size == (10, 40)
    assert made.pixels.mean(axis=0) == pytest.approx([5, 80 / 3], abs=0.6)  # denser down; 4 standard errors
    volume = np.zeros((6, 7, 8))
    volume[5, 3, 1] = 9
    made = gbnbench.stipple(volume, 5, method=QUICK)
    assert made.size == (8, 7, 6)
    assert np.floor(made.pixels).tolist() == [[1, 3, 5]] * 5
    assert (
        np.floor(made.points * [8, 7, 6]).tolist() == [[1, 3, 5]] * 5
    )  # z along the slices, y the other way
    assert made.points == pytest.approx(made.pixels / [8, 7, 6] * [1, -1, 1] + [0, 1, 0])
    assert made.radius == pytest.approx((1 / 5 * 3 / (4 * np.pi)) ** (1 / 3))


def test_colours_are_no_volume():
    picture = np.ones((8, 9, 3))
    picture[4:, :, :] = 0
    assert gbnbench.stipple(picture, 20, method="rejection").points[:, 1].max() <= 0.5


def test_tones_are_inverted_bent_and_cut():
    ramp = np.linspace(0, 1, 5)[None, :]

    def drawn(**settings):
        return gbnbench.stipple(ramp, 10, method="rejection", **settings).density.values[0]

    assert drawn() == pytest.approx([1, 0.75, 0.5, 0.25, 0], abs=1e-6)
    assert drawn(invert=True) == pytest.approx([0, 0.25, 0.5, 0.75, 1], abs=1e-6)
    assert drawn(gamma=2) == pytest.approx([1, 15 / 16, 3 / 4, 7 / 16, 0], abs=1e-6)
    assert drawn(gamma=2, invert=True) == pytest.approx([0, 1 / 16, 1 / 4, 9 / 16, 1], abs=1e-6)
    assert drawn(white_cutoff=0.7, invert=True, gamma=2) == pytest.approx([0, 0, 1 / 4, 9 / 16, 1], abs=1e-6)
    assert drawn(white_cutoff=0.5) == pytest.approx([1, 0.75, 0, 0, 0], abs=1e-6)
    assert drawn(white_cutoff=0.5, invert=True) == pytest.approx([0, 0, 0, 0.75, 1], abs=1e-6)


def test_amplitudes_tell_the_density():
    halves = np.ones((64, 64))
    halves[:, 32:] = 0.25
    density = as_density(halves, toroidal=True)
    made = gbnbench.stipple(density, 800, method="gbn[gradients=20]")
    dense = np.abs(made.pixels[:, 0] - 16) < 8
    sparse = np.abs(made.pixels[:, 0] - 48) < 8
    ratio = made.amplitudes[dense].mean() / made.amplitudes[sparse].mean()
    assert ratio == pytest.approx(4, rel=0.03)  # kernels of the other half reach there a little
    flat = gbnbench.stipple(as_density(np.ones((32, 32)), toroidal=True), 60, method=QUICK)
    assert flat.amplitudes == pytest.approx(1, abs=1e-6)
    independent = gbnbench.stipple(density, 800, method="rejection")
    assert set(independent.amplitudes / independent.amplitudes.max()) == {1, 0.25}


def test_dots_cover_as_much_as_the_image_is_dark():
    made = gbnbench.stipple(np.full((10, 20), 0.75), 8, method="rejection")
    assert made.coverage == pytest.approx(0.25)
    assert 8 * np.pi * made.radius**2 == pytest.approx(50)


def test_n_follows_from_the_ink():
    assert len(gbnbench.stipple(np.full((25, 25), 0.5), method="rejection").points) == 50
    assert len(gbnbench.stipple(np.zeros((1, 1)), method="rejection").points) == 1
    assert len(gbnbench.stipple(np.zeros((999, 999)), method="rejection").points) == 20_000


def test_what_made_it_is_told():
    made = gbnbench.stipple(corner(), 3, method="gbn[gradients=5,sigma=0.85]", seed=7)
    assert (made.method, made.seed, made.name) == ("gbn[sigma=0.85,gradients=5]", 7, "the array")
    assert made.version == gbnbench.__version__
    assert made.device
    frame = made.to_frame()
    assert np.array_equal(frame[["right_of_width", "up_of_height"]], made.points)
    assert np.array_equal(frame[["right_pixels", "down_pixels"]], made.pixels)
    assert np.array_equal(frame.amplitude, made.amplitudes)


def test_progress_is_told():
    told = []
    gbnbench.stipple(corner(), 20, method=QUICK, progress=lambda *step: told.append(step))
    assert [step[:2] for step in told][-1] == (5, 5)


@pytest.mark.parametrize(
    ("image", "settings", "says"),
    [
        (WHITE, {}, "the array has no place for points: it is all white"),
        (np.full((3, 3), 0.5), {"white_cutoff": 0.4}, "the array has no place for points"),
        (corner(), {"gamma": 0}, "gamma must be above 0; got 0"),
        (corner(), {"gamma": float("nan")}, "gamma must be above 0"),
        (corner(), {"white_cutoff": 1.5}, "white_cutoff must be above 0 and at most 1; got 1.5"),
        (corner(), {"invert": "no"}, "invert must be True or False; got 'no'"),
        (corner(), {"toroidal": 1}, "toroidal must be True or False; got 1"),
        (corner(), {"progressive": None}, "progressive must be True or False; got None"),
        (corner(), {"n": 0}, "n must be an integer >= 1; got 0"),
        (corner(), {"n": 2.5}, "n must be an integer >= 1; got 2.5"),
        (corner(), {"method": "gnb"}, "did you mean 'gbn'?"),
        (corner(), {"shape": (3, 3)}, "shape is of a function of positions: leave it out"),
        (lambda x: x[:, 0], {}, "a function of positions needs shape"),
        (np.ones((5, 6, 7)), {"invert": True}, "invert, gamma and white_cutoff are of an image's tones"),
        (np.full((5, 6, 7), -1.0), {}, "a density is nowhere below 0"),
        (np.array([[0, 300]]), {}, "unsigned whole numbers"),
        (np.array([[0.5, np.nan]]), {}, "1 of the pixels' values are nan"),
    ],
)
def test_what_cannot_be_stippled_is_refused(image, settings, says):
    with pytest.raises(InputError) as caught:
        gbnbench.stipple(image, **{"n": 5, "method": QUICK, **settings})
    assert says in str(caught.value)


def test_a_bad_array_file_is_named(here):
    np.save("v.npy", np.full((5, 6, 7), np.nan))
    with pytest.raises(FormatError, match=r"^v\.npy: 210 pixels of the density are nan"):
        gbnbench.stipple("v.npy", 5)
    with pytest.raises(FormatError, match=r"^no\.npy: there is no such file"):
        gbnbench.stipple("no.npy", 5)


def test_faint_ink_on_white_keeps_its_digits():
    faint = 1e-8 * np.random.default_rng(0).random((12, 18))
    darkness = as_darkness(1 - faint).values
    assert darkness == pytest.approx(faint, abs=2e-16)
    assert len(gbnbench.stipple(1 - faint, 20, method="rejection").points) == 20
