"""Dots of a tile: those that hang over one border of the picture are drawn at the opposite border too."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.reports.stippling.page import DotLayer, Page


def drawn_layers(page: Page) -> tuple[DotLayer, ...]:
    """Add to the dots of a page the copies that make it a tile.

    Parameters
    ----------
    page : Page
        The page.

    Returns
    -------
    tuple of DotLayer
        Those of the page, where opposite borders do not meet. Else each has, after its own dots, their copies
        moved by whole widths and heights of the picture, as far as a part of them lies in the picture.

    Examples
    --------
    >>> corner = DotLayer("black", "#000000", np.array([[0.5, 0.2]]), np.array([1.0]))
    >>> [copied] = drawn_layers(Page(10, 20, (corner,), toroidal=True))
    >>> copied.centres.tolist()
    [[0.5, 0.2], [0.5, 20.2], [10.5, 0.2], [10.5, 20.2]]
    """
    return tuple(_with_copies(page, layer) for layer in page.layers) if page.toroidal else page.layers


def _with_copies(page: Page, layer: DotLayer) -> DotLayer:
    sides = np.array([page.width, page.height]) - 2 * page.margin
    low, high = np.full(2, page.margin), page.margin + sides
    reach = [1 + math.floor(float(layer.radii.max()) / side) for side in sides.tolist()]
    centres: list[FloatArray] = [layer.centres]
    radii: list[FloatArray] = [layer.radii]
    for right in range(-reach[0], reach[0] + 1):
        for down in range(-reach[1], reach[1] + 1):
            if right == down == 0:
                continue
            moved = layer.centres + sides * (right, down)
            beyond = np.maximum(np.maximum(low - moved, moved - high), 0)  # of the picture, along each axis
            seen = (beyond**2).sum(axis=1) < layer.radii**2
            centres.append(moved[seen])
            radii.append(layer.radii[seen])
    return replace(layer, centres=np.concatenate(centres), radii=np.concatenate(radii))
