"""The scaled Gram matrix of the amplitudes' Jacobian, times a vector.

Rows are scaled by 1 / (sqrt(n) |q|). Between f and f' the matrix holds (q.q' / |q||q'|) F_{f-f'} / 2n, and
-F_{f+f'} in its place for the conjugate of the vector: for each axis a convolution with F.
"""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np
from scipy import fft

from gbnbench.core.integer_frequencies import IntArray, half_ball
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gauss_newton.axis_waves import ComplexArray
from gbnbench.generators.gauss_newton.modes import Modes
from gbnbench.generators.gauss_newton.product_cost import convolutions_are_cheaper
from gbnbench.generators.gauss_newton.wave_sums import WaveSums


class GramProduct(Protocol):
    """Multiplies amplitudes below the edge by J J^T at one set of points."""

    method: str

    def __call__(self, y: ComplexArray) -> ComplexArray:
        """Product with y, (m,) complex; real-linear, symmetric in Re(conj(y) z)."""
        ...


def gram_product(x: FloatArray, modes: Modes, waves: WaveSums) -> GramProduct:
    """Choose the cheaper of the two products: by transforms, or by sums over the points.

    Parameters
    ----------
    x : (n, d) float64
        Points, box sides.
    modes : Modes
        Frequencies below the edge.
    waves : WaveSums
        Their sums at x.

    Returns
    -------
    GramProduct
    """
    if convolutions_are_cheaper(modes.n, modes.d, int(modes.square.max())):
        return Convolutions(x, modes)
    return PointSums(modes, waves)


def _side(reach: int) -> int:
    """Grid side on which differences of two frequencies do not alias."""
    return int(fft.next_fast_len(4 * reach + 1, real=True))


class PointSums:
    """J J^T as J times (J^T times a vector), two sums over the points; best for few points of many axes."""

    method = "sums over points"

    def __init__(self, modes: Modes, waves: WaveSums) -> None:
        self._waves = waves
        self._side = math.pow(modes.n, 1 / modes.d)
        self._scale = 1 / (math.sqrt(modes.n) * modes.length)

    def __call__(self, y: ComplexArray) -> ComplexArray:
        """Multiply; see ``GramProduct``."""
        move = self._waves.gradient(self._scale * y, self._side)
        out: ComplexArray = -1j * self._scale * self._waves.divergence(move, self._side)
        return out


class Convolutions:
    """J J^T by 2 d real Fourier transforms on a grid, from the amplitudes up to twice the edge.

    Those amplitudes are summed in single precision, so the product is right to about 1e-6.
    """

    method = "convolutions"

    def __init__(self, x: FloatArray, modes: Modes) -> None:
        n, d = modes.n, modes.d
        reach = int(np.abs(modes.f).max())
        self._shape = (_side(reach),) * d
        self._direction = modes.direction
        self._places = _Places(modes.f, self._shape)
        # Differences of frequencies below the edge
        doubled = half_ball(d, 4 * int(modes.square.max()))
        doubled = doubled[np.abs(doubled).max(axis=1) <= 2 * reach]
        places = _Places(doubled, self._shape)
        amplitudes = WaveSums(x, doubled, single=True).amplitudes()
        spectrum = places.spread(amplitudes / (2 * n))
        spectrum[(0,) * d] = 0.5
        self._density = fft.irfftn(spectrum, self._shape, norm="forward", overwrite_x=True)

    def __call__(self, y: ComplexArray) -> ComplexArray:
        """Multiply; see ``GramProduct``."""
        out = np.zeros_like(y)
        for along in self._direction.T:
            wave = fft.irfftn(self._places.spread(1j * along * y), self._shape, overwrite_x=True)
            wave *= self._density
            out -= 1j * along * self._places.pick(fft.rfftn(wave, overwrite_x=True))
        return out


class _Places:
    """Where amplitudes of a half space stand in the half spectrum of a real transform."""

    def __init__(self, f: IntArray, shape: tuple[int, ...]) -> None:
        self._half = (*shape[:-1], shape[-1] // 2 + 1)
        last = f[:, -1]
        self._flip = last < 0
        self._index = self._flat(np.where(self._flip[:, None], -f, f), shape)
        self._plane = np.nonzero(last == 0)[0]  # here the half spectrum holds f and -f
        self._mirror = self._flat(-f[self._plane], shape)

    def _flat(self, f: IntArray, shape: tuple[int, ...]) -> IntArray:
        return np.asarray(np.ravel_multi_index(tuple(np.mod(f, shape).T), self._half), dtype=np.int64)

    def spread(self, y: ComplexArray) -> ComplexArray:
        spectrum = np.zeros(math.prod(self._half), np.complex128)
        spectrum[self._index] = np.where(self._flip, np.conj(y), y)
        spectrum[self._mirror] = np.conj(y[self._plane])
        return spectrum.reshape(self._half)

    def pick(self, spectrum: ComplexArray) -> ComplexArray:
        y: ComplexArray = spectrum.reshape(-1)[self._index]
        return np.where(self._flip, np.conj(y), y)
