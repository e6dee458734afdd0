"""Axes without ticks until they are drawn: the same picture as matplotlib's own, pixel for pixel."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogFormatterSciNotation

from gbnbench.reports import layout
from gbnbench.reports.comparison.figure_files import png
from gbnbench.reports.log_ticks import PowersOfTen
from gbnbench.reports.plot_axes import PlotAxes
from gbnbench.reports.style import styled


def curve(ax: Axes) -> None:
    ax.plot([-1, 2, 5], [0, 3, 1])
    ax.set_xlim(-1, 5)
    ax.grid(True)
    ax.set_title("curve", loc="left")
    ax.set_ylabel("power")


def logarithmic(ax: Axes) -> None:
    ax.plot([0.03, 2], [1e-10, 8])
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.tick_params(labelleft=False, length=5)
    ax.grid(True, which="major")


def image(ax: Axes) -> None:
    ax.imshow(np.arange(9.0).reshape(3, 3), extent=(-2, 2, -2, 2))
    layout.frame(ax)
    ax.set_ylabel("spectrum")
    ax.set_xticks([-1, 0, 1])


@pytest.mark.parametrize("draw", [curve, logarithmic, image])
def test_pictures_are_those_of_axes_of_matplotlib(draw: Callable[[Axes], None]) -> None:
    @styled
    def drawn(kind: type[Axes]) -> bytes:
        figure = Figure(figsize=(3, 2.5))
        draw(figure.add_axes((0.2, 0.2, 0.7, 0.65), axes_class=kind))
        return png(figure)

    assert drawn(PlotAxes) == drawn(Axes)


def test_axes_have_no_ticks_before_they_are_drawn() -> None:
    ax = Figure().add_axes((0, 0, 1, 1), axes_class=PlotAxes)
    assert (ax.xaxis.majorTicks, ax.xaxis.minorTicks) == ([], [])


@pytest.mark.parametrize(
    ("value", "label"), [(1e-4, "10⁻⁴"), (1.0, "10⁰"), (1e12, "10¹²"), (2e-1, "2×10⁻¹"), (0.5, "5×10⁻¹")]
)
def test_marks_of_logarithmic_axes_are_plain_text(value: float, label: str) -> None:
    formatter = PowersOfTen(labelOnlyBase=False, minor_thresholds=(9, 9))
    formatter.create_dummy_axis(minpos=1e-13)
    formatter.axis.set_view_interval(1e-12, 1e12)
    assert formatter(value) == label
    theirs = LogFormatterSciNotation(labelOnlyBase=False, minor_thresholds=(9, 9))
    theirs.create_dummy_axis(minpos=1e-13)
    theirs.axis.set_view_interval(1e-12, 1e12)
    assert "mathdefault" in theirs(value)
