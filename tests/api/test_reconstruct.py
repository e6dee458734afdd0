"""``gbnbench.reconstruct``: pictures found back upright, in their tones, from points of any origin."""

from __future__ import annotations

import re

import numpy as np
import pytest
from skimage import data
from skimage.metrics import peak_signal_noise_ratio, structural_similarity

import gbnbench
from gbnbench.analysis.reconstruction.density_estimates import ESTIMATES
from gbnbench.core.errors import InputError
from gbnbench.studies.stippling.tones import tones


def corner_points() -> np.ndarray:
    """A jittered grid of 18 x 18 points in the upper right quarter, and 4 x 4 more everywhere."""
    rng = np.random.default_rng(1)
    dense, sparse = ((np.argwhere(np.ones((m, m))) + 0.3 + 0.4 * rng.random((m * m, 2))) / m for m in (18, 4))
    return np.concatenate([0.5 + dense / 2, sparse])


@pytest.mark.parametrize("method", ESTIMATES)
def test_dense_is_dark_at_its_place_at_any_size(method):
    for rows, columns in ((40, 60), (33, 20)):
        picture = gbnbench.reconstruct(corner_points(), shape=(rows, columns), method=method)
        assert picture.shape == (rows, columns)
        assert 0 <= picture.min() <= picture.max() <= 1
        upper_right = picture[: rows // 2, columns // 2 :].mean()
        assert upper_right < 0.45
        assert picture[rows // 2 :].mean() > 0.9
        light = gbnbench.reconstruct(corner_points(), shape=(rows, columns), method=method, invert=True)
        assert light == pytest.approx(1 - picture)


def test_volumes_have_z_along_their_slices():
    x = np.random.default_rng(2).random((300, 3)) * [1, 0.5, 0.5]  # the lower half, in the first slices
    volume = gbnbench.reconstruct(x, shape=(8, 12, 16))
    assert volume.shape == (8, 12, 16)
    assert volume[:4, 6:].mean() < 0.6
    assert min(volume[4:].mean(), volume[:4, :6].mean()) > 0.85
    assert gbnbench.reconstruct(x[:5], np.ones(5)).shape == (64, 64, 64)


def test_a_picture_comes_back():
    image = data.camera()[::4, ::4] / 255
    made = gbnbench.stipple(image, 1500, method="gbn[gradients=20]")
    found = {
        "alone": gbnbench.reconstruct(made.points, shape=image.shape),
        "amplitudes": gbnbench.reconstruct(*made, shape=image.shape, coverage=made.coverage),
    }
    for picture in found.values():  # measured: 23.0 and 23.3 dB
        assert peak_signal_noise_ratio(image, picture, data_range=1) > 22.5
    assert found["amplitudes"].mean() == pytest.approx(image.mean(), abs=2e-3)
    lying = gbnbench.reconstruct(made.points * [1, -1] + [0, 1], shape=image.shape)
    assert peak_signal_noise_ratio(image, lying, data_range=1) < 12


@pytest.mark.slow
def test_the_round_trip_of_10_000_points_is_as_documented():
    made = gbnbench.stipple("camera", 10_000)
    image = data.camera() / 255
    for arguments, psnr, ssim in (((made.points,), 26.55, 0.768), ((*made,), 26.96, 0.780)):
        picture = gbnbench.reconstruct(*arguments, shape=image.shape, coverage=made.coverage)
        # seeds differ by 0.1 dB and 0.003
        assert peak_signal_noise_ratio(image, picture, data_range=1) == pytest.approx(psnr, abs=0.3)
        assert structural_similarity(image, picture, data_range=1) == pytest.approx(ssim, abs=0.01)


def test_amplitudes_widen_kernels_in_any_scale():
    x, shape = corner_points(), (30, 30)
    a = np.random.default_rng(3).random(len(x)) + 0.5
    found = gbnbench.reconstruct(x, a, shape)
    assert gbnbench.reconstruct(x, 7 * a, shape) == pytest.approx(found, abs=1e-6)
    assert np.abs(gbnbench.reconstruct(x, shape=shape) - found).max() > 0.05
    assert gbnbench.reconstruct(x, np.ones(len(x)), shape) == pytest.approx(
        gbnbench.reconstruct(x, shape=shape, method="kernel", sigma=0.5), abs=1e-6
    )


def test_black_is_what_coverage_says_else_the_densest_hundredth():
    density = np.array([[1.0, 2, 4, 13]])
    assert tones(density) == pytest.approx(1 - density / 13)
    assert tones(density, coverage=0.25) == pytest.approx(1 - density / 20)
    assert tones(density, coverage=1, invert=True) == pytest.approx(np.minimum(density / 5, 1))
    peaked = np.append(np.full(999, 1.0), 5.0)  # the peak holds half a hundredth of the mass
    assert tones(peaked).tolist() == [0.0] * 1000


def test_one_point_and_points_on_the_borders_are_served():
    for method in ESTIMATES:
        assert np.isfinite(gbnbench.reconstruct([[0.5, 0.5]], shape=(9, 7), method=method)).all()
        assert np.isfinite(gbnbench.reconstruct([[0, 0], [1, 1], [1, 0]], shape=(9, 7), method=method)).all()


def test_progress_is_told():
    told = []
    gbnbench.reconstruct(corner_points(), shape=(9, 9), progress=lambda *step: told.append(step))
    assert [step[:2] for step in told] == [(k, 11) for k in range(1, 12)]


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (
            {"points": [[100.0, 3.0]]},
            r"coordinate 0 of point 0 is 100\.0: divide pixels by the picture's size",
        ),
        ({"points": [[np.nan, 0.5]]}, "is nan"),
        ({"points": np.ones((3, 4))}, r"points must be \(n, 2\) of a picture or \(n, 3\) of a volume"),
        ({"points": np.ones((0, 2))}, "points holds no point"),
        ({"points": "dots.txt"}, "array"),
        ({"shape": (8, 8, 8)}, r"shape must be \(rows, columns\), whole numbers"),
        ({"shape": (0, 8)}, "shape must be"),
        ({"shape": (2.5, 8)}, "shape must be"),
        ({"shape": (1 << 20, 1 << 20)}, "at most 134,217,728 pixels"),
        ({"method": "vornoi"}, "did you mean 'voronoi'"),
        ({"amplitudes": [1.0]}, r"one number a point, \(340,\); got an array of shape \(1,\)"),
        ({"amplitudes": np.zeros(340)}, "finite numbers above 0"),
        ({"amplitudes": np.ones(340), "method": "kernel"}, "'kernel' has no use for them"),
        ({"coverage": 1.5}, "coverage must be above 0 and at most 1"),
        ({"sigma": 0}, "sigma must be above 0"),
        ({"sigma": 1.0, "method": "voronoi"}, "sigma must be above 0, and is of kernels"),
    ],
)
def test_what_cannot_be_meant_is_refused(arguments, says):
    with pytest.raises(InputError, match=says):
        gbnbench.reconstruct(**{"points": corner_points(), "shape": (8, 8), **arguments})


def test_a_stippling_is_taken_with_all_that_it_knows():
    ramp = np.linspace(0, 0.9, 30)[:, None] * np.ones(20)
    made = gbnbench.stipple(ramp, 200, method="gbn[gradients=10]")
    expected = gbnbench.reconstruct(made.points, made.amplitudes, made.density.shape, coverage=made.coverage)
    assert np.array_equal(gbnbench.reconstruct(made), expected)
    alone = gbnbench.reconstruct(made, shape=(15, 10), method="kernel", coverage=0.3)
    assert np.array_equal(
        alone, gbnbench.reconstruct(made.points, shape=(15, 10), method="kernel", coverage=0.3)
    )
    given = np.ones(200)
    assert np.array_equal(
        gbnbench.reconstruct(made, given),
        gbnbench.reconstruct(made.points, given, made.density.shape, coverage=made.coverage),
    )


@pytest.mark.parametrize(
    ("shape", "says"),
    [
        ((0, 5), "got 0 x 5"),
        ((-3, 5), "got -3 x 5"),
        ((2.5, 5), "got 2.5 x 5"),
        ((5,), "got 5"),
        ((), "got no sides"),
        (7, "got 7"),
        ("7x8", "got 7x8"),
        ((5, 5, 5), "got 5 x 5 x 5"),
        ((1 << 20, 1 << 20), "at most 134,217,728 pixels in all; got 1,099,511,627,776"),
    ],
)
def test_a_bad_shape_is_told_in_words(shape, says):
    with pytest.raises(InputError, match=re.escape("shape must be (rows, columns), ")) as told:
        gbnbench.reconstruct(np.full((4, 2), 0.5), shape=shape)
    assert str(told.value).endswith(says)
    if shape != (5, 5, 5):
        with pytest.raises(InputError, match="shape must be") as told:
            gbnbench.stipple(lambda x: x[:, 0], 5, shape=shape)
        assert str(told.value).endswith(says)


def test_no_points_are_told_in_words():
    for none in ([], np.empty((0, 2)), np.empty((3, 0))):
        with pytest.raises(InputError, match="points holds no point: a picture needs at least one"):
            gbnbench.reconstruct(none)
        with pytest.raises(InputError, match="array holds no points: a source has at least one"):
            gbnbench.compare_stipplings(np.eye(20), [np.asarray(none)], quiet=True)
