"""Tours visit every point by a short path, inks print an image, and darkness follows its rule."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.errors import InputError
from gbnbench.io.images.arrays import image_of
from gbnbench.studies.stippling.darkness import ToneCurve, as_darkness
from gbnbench.studies.stippling.inks import ink_darkness, shared_out
from gbnbench.studies.stippling.tour import path_length, tour


@pytest.mark.parametrize("n", [1, 2, 3, 4, 5, 30, 2000])
def test_a_tour_visits_every_point_once(n):
    points = np.random.default_rng(n).random((n, 2)) * [300, 7]
    assert sorted(tour(points)) == list(range(n))


def test_a_tour_of_random_points_is_near_the_shortest():
    points = np.random.default_rng(5).random((4000, 2))
    # The shortest is 0.7124 sqrt(n A) (Johnson & McGeoch 1996); a Hilbert curve is 25% above it, 2-opt 15%.
    assert path_length(points[tour(points)]) < 1.2 * 0.7124 * np.sqrt(4000)


def test_a_tour_is_a_local_optimum():
    points = np.random.default_rng(6).random((60, 2))
    path = points[tour(points)]
    for i in range(59):
        for j in range(i + 2, 59):  # turning i + 1 to j: every pair of steps
            before = np.linalg.norm(path[i] - path[i + 1]) + np.linalg.norm(path[j] - path[j + 1])
            after = np.linalg.norm(path[i] - path[j]) + np.linalg.norm(path[i + 1] - path[j + 1])
            near = np.linalg.norm(path[i] - path, axis=1)
            if np.sum(near < np.linalg.norm(path[i] - path[j])) <= 8:  # j is among the eight nearest
                assert after >= before - 1e-6


def test_points_in_one_place_have_a_tour():
    assert sorted(tour(np.full((20, 2), 3.0))) == list(range(20))


def test_inks_are_shared_out_by_what_they_cover():
    image = image_of(np.full((4, 4, 3), (0.5, 0.25, 0.5)))
    darkness = ink_darkness(image)
    assert {name: float(one.values[0, 0]) for name, one in darkness.items()} == pytest.approx(
        {"magenta": 0.5, "black": 0.5}
    )
    assert shared_out(darkness, 12) == {"magenta": 6, "black": 6}
    assert sum(shared_out(darkness, 999).values()) == 999
    with pytest.raises(InputError, match="2 inks need as many dots at least; got n=1"):
        shared_out(darkness, 1)
    with pytest.raises(InputError, match="invert goes with one ink"):
        ink_darkness(image, ToneCurve(invert=True))


def test_darkness_of_colours_is_that_of_their_luma():
    dark = as_darkness(np.full((2, 3, 3), (1.0, 0.0, 0.0)))
    assert dark.values == pytest.approx(1 - 0.2126, abs=1e-6)
    assert dark.coverage == pytest.approx(1 - 0.2126, abs=1e-6)
