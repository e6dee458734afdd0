"""Figure of a dither mask: its thresholds, patterns at three grey levels, their spectra and radial power."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from numpy.typing import NDArray

from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.torus import FloatArray
from gbnbench.reports import layout, style

LEVELS = ((1 / 16, "1/16"), (1 / 4, "1/4"), (1 / 2, "1/2"))
SIDE = 2.4  # inches of a picture
BINS = 64  # of a radial mean, in a cycle a pixel
POWER = (1e-3, 10.0)  # shown, from black to white


@style.styled
def figure(ranks: NDArray[np.int64]) -> Figure:
    """Draw a mask with what it does.

    Parameters
    ----------
    ranks : (rows, columns) int64
        Ranks of the pixels; of a mask with frames those of one frame.

    Returns
    -------
    Figure
        A column for the mask and one for each of three grey levels.
    """
    rows, columns = ranks.shape
    caption = (
        f"A void-and-cluster mask of {columns} x {rows} pixels. Above: its thresholds, and the pixels below "
        "three grey levels. Between: power at the frequencies of the raster, zero in the middle, over that "
        "of random pixels, from 0.001 (black) to 10 (white). Below: its radial mean, with a line at the "
        "principal frequency, which is that of the mean distance of the pixels in the minority, and of the "
        "raster's end along an axis at 1/2."
    )
    sheet = layout.sheet(
        f"Dither mask, {columns} x {rows}", caption, 1 + len(LEVELS), SIDE,
        [SIDE * rows / columns, SIDE, 1.2], gaps=[0.12, 0.35], left=0.55, under=0.35,
    )  # fmt: skip
    order = np.argsort(np.argsort(ranks.ravel())).reshape(ranks.shape)  # within the frame
    thresholds = (order + 0.5) / order.size
    _column(sheet.cells[0], thresholds, "thresholds", thresholds - 0.5, 1.0, None)
    for cell, (level, name) in zip(sheet.cells[1:], LEVELS, strict=True):
        ones = order < level * order.size
        white = (order.size - ones.sum()) / (order.size - 1)
        principal = min(math.sqrt(min(level, 1 - level)), 0.5)
        _column(cell, (~ones).astype(float), f"level {name}", ones.astype(float), white, principal)
    for k, (*_, below) in enumerate(sheet.cells):
        below.set_ylabel("" if k else "power, 1 of random pixels")
        below.tick_params(labelleft=not k)
    return sheet.figure


def _column(
    cell: list[Axes],
    picture: FloatArray,
    title: str,
    weights: FloatArray,
    white: float,
    principal: float | None,
) -> None:
    above, between, below = cell
    above.imshow(picture, cmap="gray", vmin=0, vmax=1, origin="upper", interpolation="nearest")
    above.set_title(title, loc="left")
    layout.frame(above)
    spectrum = _spectrum(weights)
    shown = np.clip(spectrum.power / white, *POWER)
    shown[tuple(size // 2 for size in shown.shape)] = POWER[0]  # the mean
    between.imshow(
        shown, cmap="gray", norm=LogNorm(*POWER), origin="upper", interpolation="nearest", aspect="auto"
    )
    layout.frame(between)
    profile = radial(spectrum)
    bins = (profile.frequency / math.sqrt(weights.size) * BINS).astype(int)  # of cycles a pixel
    counts = np.bincount(bins, profile.count)
    mean = np.bincount(bins, profile.power * profile.count)
    seen = counts > 0
    below.plot((np.flatnonzero(seen) + 0.5) / BINS, mean[seen] / counts[seen] / white, color=style.COLOURS[0])
    if principal is not None:
        below.axvline(principal, color=style.FAINT, linewidth=0.7)
    below.axhline(1, color=style.RULE, linewidth=0.7, zorder=0)
    below.set(yscale="log", ylim=POWER, xlim=(0, 0.5), xlabel="cycles a pixel")


def _spectrum(weights: FloatArray) -> Spectrum:
    """Power of a picture, as that of points at the centres of its pixels with these weights."""
    counted = weights != 0
    centres = (np.argwhere(counted) + 0.5) / weights.shape
    half = math.floor(math.sqrt(weights.size) / 2)  # cycles a side of a square of its area
    return periodogram(centres, half, weights=weights[counted], sides=weights.shape)
