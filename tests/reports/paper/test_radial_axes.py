"""Axes of radial power: few ticks, and always that of white noise."""

from __future__ import annotations

import pytest
from matplotlib.figure import Figure

from gbnbench.reports.paper import radial_axes


@pytest.mark.parametrize(
    ("low", "high", "ticks", "marks"),
    [(1e-10, 100, 7, range(-10, 3, 2)), (1e-3, 30, 7, range(-3, 2)), (1e-32, 100, 5, range(-32, 1, 8))],
)
def test_log_axes_have_few_ticks_and_always_that_of_white_noise(low, high, ticks, marks):
    ax = Figure().subplots()
    radial_axes.log_power(ax, low, high, ticks)
    assert ax.get_yticks() == pytest.approx([10.0**k for k in marks])
    assert 1.0 in ax.get_yticks()
