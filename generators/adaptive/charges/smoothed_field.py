"""Fields of charges on a grid in the plane, each smoothed by a Gaussian, with forces 1 / r (Ewald 1921).

A unit charge that is spread over a Gaussian of variance v has the field (1 - exp(-r^2 / 2 v)) / r, which is
smooth: it is convolved on the grid by Fourier transforms. In a bounded domain the grid is doubled, so that
nothing meets its images; on the torus all images act, with an even background of the opposite charge.
"""

from __future__ import annotations

import math

import numpy as np
from scipy import fft

from gbnbench.core.torus import FloatArray


class SmoothedField:
    """The field of charges on the nodes of a grid.

    Parameters
    ----------
    counts : tuple of two int
        Nodes along each axis.
    cell : (2,) float64
        Distances between nodes, in pixels.
    variance : float
        Of the Gaussian, squared pixels: at least 0.64 squared cells, where what a grid cannot tell is 4% of
        the finest waves.
    toroidal : bool
        Whether opposite ends meet.
    """

    def __init__(self, counts: tuple[int, ...], cell: FloatArray, variance: float, *, toroidal: bool) -> None:
        self._counts = counts
        if toroidal:
            self._padded = counts
            k0 = 2 * math.pi * fft.fftfreq(counts[0], cell[0])[:, None]
            k1 = 2 * math.pi * fft.rfftfreq(counts[1], cell[1])[None]
            square = k0**2 + k1**2
            square[0, 0] = 1.0
            strength = 2 * math.pi * np.exp(-variance * square / 2) / square / math.prod(cell.tolist())
            strength[0, 0] = 0.0
            self._spectra = [-1j * _odd(k, counts[a], a) * strength for a, k in enumerate((k0, k1))]
            return
        self._padded = tuple(fft.next_fast_len(2 * count, real=True) for count in counts)
        lines = [
            np.fft.fftfreq(size, 1 / size) * c for size, c in zip(self._padded, cell.tolist(), strict=True)
        ]
        x, y = lines[0][:, None], lines[1][None]
        square = x**2 + y**2
        square[0, 0] = 1.0
        push = -np.expm1(-square / (2 * variance)) / square
        push[0, 0] = 0.0
        self._spectra = [fft.rfft2(push * along) for along in (x, y)]

    def __call__(self, charges: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Push on a unit charge at each node.

        Parameters
        ----------
        charges : (nodes, nodes) float64
            At the nodes.

        Returns
        -------
        tuple of two (nodes, nodes) float64
            Along each axis, in charges a pixel.
        """
        spectrum = fft.rfft2(charges, self._padded)
        inside = tuple(slice(count) for count in self._counts)
        first, second = (fft.irfft2(spectrum * own, self._padded)[inside] for own in self._spectra)
        return first, second


def _odd(k: FloatArray, count: int, axis: int) -> FloatArray:
    """Wave numbers of a derivative: the one that a grid cannot tell from its opposite has none."""
    kept = k.copy()
    if count % 2 == 0:
        kept[(slice(None),) * axis + (count // 2,)] = 0.0
    return kept
