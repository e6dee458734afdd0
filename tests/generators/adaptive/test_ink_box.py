"""White beyond the reach of all kernels: leaving it out changes the cost, not the points."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.gbn import generator
from gbnbench.generators.adaptive.gbn.ink_box import ink_box
from gbnbench.generators.adaptive.registry import adaptive_generator, adaptive_points


def drawing(side: int = 200) -> np.ndarray:
    """A small drawing, and a dot beside it, in white."""
    values = np.zeros((side, side - 20))
    values[60:75, 70:100] = np.random.default_rng(1).random((15, 30)) + 0.5
    values[67, 104] = 1
    return values


def test_points_are_those_of_the_whole_page(monkeypatch: pytest.MonkeyPatch) -> None:
    density, method = as_density(drawing()), "gbn[precision=double,gradients=2]"
    found = adaptive_points(method, density, 900)
    box = ink_box(density, [density], [900], 0.78, 0.5)
    assert box is not None
    assert density.values[box].size < density.values.size / 2
    monkeypatch.setattr(generator, "within_ink", lambda whole, parts, *_: (whole, parts, np.zeros(2)))
    assert found == pytest.approx(adaptive_points(method, density, 900), abs=1e-6)


def test_a_torus_and_a_page_that_is_drawn_all_over_stay_whole() -> None:
    small = as_density(drawing(), toroidal=True)
    assert ink_box(small, [small], [900], 0.78, 0.5) is None
    full = as_density(np.eye(100))
    assert ink_box(full, [full], [900], 0.78, 0.5) is None


def test_a_small_drawing_on_a_large_page_takes_many_points() -> None:
    page = np.zeros((3000, 3000))
    page[2000:2030, 700:730] = 1
    density = as_density(page)
    assert adaptive_generator("gbn").refusal(density, 10_000) is None
    x = adaptive_points("gbn[gradients=2]", density, 3000)
    assert (page[tuple(x.astype(int).T)] > 0).all()
