"""The part of an image that its ink needs: white beyond the reach of all kernels is left out.

Where pixels are cut into finer ones, a page that is white but for a small drawing would cost as much as one
that is drawn all over. No kernel of a point on the ink sees what lies beyond the box: the points are those of
the whole.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.gbn.attraction import BEYOND_INK
from gbnbench.generators.adaptive.gbn.kernel_widths import kernel_widths

REACH = 8.3 * math.sqrt(2)  # widths of a kernel within which another of its width tells, in double precision
START = 32  # pixels around the ink that are tried first
WORTH = 0.7  # of the pixels: a larger box is not worth its own cost

Box = tuple[slice, ...]


def ink_box(
    whole: Density, densities: Sequence[Density], counts: Sequence[int], sigma: float, smoothing: float
) -> Box | None:
    """Find the box.

    Parameters
    ----------
    whole : Density
        Of all points.
    densities : sequence of Density
        Of each class, on the same pixels.
    counts : sequence of int
        Points of each class.
    sigma : float
        Kernel width of the uniform method, in spacings.
    smoothing : float
        c: the width of the average that gives the kernels their width, over that width.

    Returns
    -------
    tuple of slice or None
        Along each axis; None where all pixels are needed, and on the torus.
    """
    if whole.toroidal:
        return None
    lines = [np.flatnonzero(whole.values.any(axis=_others(a, whole.d))) for a in range(whole.d)]
    ink = [(int(line[0]), int(line[-1]) + 1) for line in lines]
    classes = [(whole, sum(counts)), *zip(densities, counts, strict=True)][: None if len(counts) > 1 else 1]
    room = START
    while True:
        box = _box(ink, whole.shape, room)
        if whole.values[box].size >= WORTH * whole.values.size:
            return None
        # Where the room suffices for the widths that are found in it, they are those of the whole.
        widest = max(_widest(density, count, box, sigma, smoothing) for density, count in classes)
        needed = math.ceil(REACH * max(BEYOND_INK, smoothing) * widest) + 2
        if needed <= room:
            return _box(ink, whole.shape, needed)
        room = max(needed, 2 * room)


def within_ink(
    whole: Density, densities: Sequence[Density], counts: Sequence[int], sigma: float, smoothing: float
) -> tuple[Density, Sequence[Density], FloatArray]:
    """Leave out the white beyond the box.

    Parameters
    ----------
    whole, densities, counts, sigma, smoothing
        As ``ink_box`` takes them.

    Returns
    -------
    whole : Density
        What is left of it.
    densities : sequence of Density
        What is left of them.
    corner : (d,) float64
        The first pixel that is left.
    """
    box = ink_box(whole, densities, counts, sigma, smoothing)
    if box is None:
        return whole, densities, np.zeros(whole.d)
    left = [Density(one.values[box]) for one in densities]
    return Density(whole.values[box]), left, np.array([float(side.start) for side in box])


def _others(axis: int, axes: int) -> tuple[int, ...]:
    return tuple(a for a in range(axes) if a != axis)


def _widest(density: Density, n: int, box: Box, sigma: float, smoothing: float) -> float:
    """Width of the widest kernel on ink, were the box all there is."""
    part = Density(density.values[box])
    widths = kernel_widths(part, n, sigma, smoothing)
    return math.exp(widths.log_width[part.values > 0].max())


def _box(ink: Sequence[tuple[int, int]], shape: Sequence[int], room: int) -> Box:
    """Pixels within so many of the ink."""
    return tuple(
        slice(max(0, start - room), min(size, end + room))
        for (start, end), size in zip(ink, shape, strict=True)
    )
