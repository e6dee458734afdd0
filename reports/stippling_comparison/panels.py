"""Panels of the pictures: the density, points, the picture found back, the difference, the local spectrum."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, Normalize
from matplotlib.patches import Rectangle

from gbnbench.core.torus import FloatArray
from gbnbench.reports import layout, style
from gbnbench.reports.comparison import spectrum
from gbnbench.studies.stippling_comparison.flat_patch import FlatPatch
from gbnbench.studies.stippling_comparison.stippling_results import StipplingResult

VECTOR = 12_000  # a PDF holds so many points as vectors, more as a picture
CLOSE = 0.5  # of a dot's width, so that dots are seen apart
DIFFERENCE = "RdBu_r"
POWER = (1e-6, 10.0)  # colours of the local spectrum


def ink(ax: Axes, density: FloatArray, top: float = 1.0, patch: FlatPatch | None = None) -> None:
    """Draw a density as ink on paper.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    density : (rows, columns) float64
        The first row on top.
    top : float
        What is black.
    patch : FlatPatch, optional
        A square that is framed.
    """
    rows, columns = density.shape
    ax.imshow(
        density, cmap="gray_r", vmin=0, vmax=top, origin="upper", extent=(0, columns, rows, 0),
        interpolation="antialiased",
    )  # fmt: skip
    if patch is not None:
        corner = (patch.column, patch.row)
        ax.add_patch(
            Rectangle(corner, patch.side, patch.side, fill=False, edgecolor=style.COLOURS[1], linewidth=1)
        )
    layout.frame(ax)


def dots(
    ax: Axes, points: FloatArray, density: FloatArray, inches: float, patch: FlatPatch | None = None
) -> None:
    """Draw points as dots that cover, overlaps apart, as much as the image is dark; half as wide close up.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    points : (n, 2) float64
        In pixels, rows first.
    density : (rows, columns) float64
        1 where all is to be covered.
    inches : float
        Width of the axes.
    patch : FlatPatch, optional
        Show this square alone.
    """
    rows, columns = density.shape
    diameter = 2 * math.sqrt(float(density.sum()) / len(points) / math.pi)  # pixels
    left, top, wide, high = (
        (0, 0, columns, rows) if patch is None else (patch.column, patch.row, patch.side, patch.side)
    )
    y, x = points.T
    near = np.abs(x - left - wide / 2) < wide / 2 + diameter
    near &= np.abs(y - top - high / 2) < high / 2 + diameter
    size = diameter * (1 if patch is None else CLOSE) * 72 * inches / wide
    ax.plot(
        x[near], y[near], "o", markersize=size, markeredgewidth=0, color="black",
        rasterized=bool(near.sum() > VECTOR),
    )  # fmt: skip
    ax.set(xlim=(left, left + wide), ylim=(top + high, top), aspect="equal")
    layout.frame(ax)


def found_back(ax: Axes, source: StipplingResult, density: FloatArray) -> None:
    """Draw the picture that Algorithm 2 finds back, at the gain that makes its error least.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    source : StipplingResult
        Source to draw.
    density : (rows, columns) float64
        What it was to be.
    """
    found = source.reconstruction.astype(np.float64)
    square = float((found**2).sum())
    ink(ax, found * (float((found * density).sum()) / square if square > 0 else 0.0), float(density.max()))


def difference(ax: Axes, source: StipplingResult, scale: Normalize) -> None:
    """Draw where there are too many points (red) and too few (blue), blurred by 16 pixels.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    source : StipplingResult
        Source to draw.
    scale : Normalize
        Of the colours, over the mean density.
    """
    rows, columns = source.blurred.shape
    ax.imshow(source.blurred, cmap=DIFFERENCE, norm=scale, origin="upper", extent=(0, columns, rows, 0))
    layout.frame(ax)


def local_spectrum(ax: Axes, source: StipplingResult) -> None:
    """Draw the power of the first set in the flattest square, log10, zero frequency in the middle.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    source : StipplingResult
        Source to draw, with a local spectrum.
    """
    if source.patch_map is None:
        layout.empty(ax, "no square holds enough points")
        return
    reach = source.patch_reach
    ax.imshow(
        np.maximum(source.patch_map, POWER[0]), cmap=spectrum.palette(), norm=LogNorm(*POWER, clip=True),
        extent=(-reach, reach, -reach, reach), origin="upper",
    )  # fmt: skip
    layout.frame(ax)
