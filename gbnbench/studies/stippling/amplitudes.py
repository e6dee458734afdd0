"""Amplitudes of kernels: the density around each point over its mean (Ahmed, Ren & Wonka 2022, 5.3)."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.gbn.generator import AdaptiveGaussianBlueNoise
from gbnbench.generators.adaptive.gbn.kernel_widths import BORDER, kernel_widths
from gbnbench.generators.adaptive.protocol import AdaptiveGenerator


def amplitudes(generator: AdaptiveGenerator, density: Density, x: FloatArray) -> FloatArray:
    """Find the amplitude of each point.

    Parameters
    ----------
    generator : AdaptiveGenerator
        That drew the set.
    density : Density
        That it was drawn for.
    x : (n, d) float64
        Positions in pixels, rows first.

    Returns
    -------
    (n,) float64
        Of mean 1: for Gaussian blue noise (sigma^2 / 2 s_k^2)^(d/2), s_k being the width of the kernel; for
        other methods the density of the pixel that holds the point.
    """
    if isinstance(generator, AdaptiveGaussianBlueNoise):
        block = generator.blocks(density, len(x))
        field = kernel_widths(density, len(x), generator.sigma, generator.smoothing, block=block)
        at = (x / block - 0.5 + BORDER).T
        log_width = ndimage.map_coordinates(field.coefficients, at, order=3, prefilter=False, mode="nearest")
        found = np.exp(-density.d * (log_width - log_width.min()))
    else:
        found = density.values[tuple(np.floor(x).astype(np.intp).T)]
    return np.asarray(found / found.mean(), np.float64)
