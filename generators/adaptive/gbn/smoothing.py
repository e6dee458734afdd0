"""Gaussian smoothing of a field on pixels, by Fourier transforms, sampled as coarsely as its width allows."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.gbn.pixel_blocks import spline_spectrum

ComplexArray = NDArray[np.complex128]


@dataclass(frozen=True)
class PaddedGrid:
    """The pixels of a field, with a margin of zeros where it is bounded.

    Attributes
    ----------
    shape : tuple of int
        Pixels of the field.
    margin : int
        Pixels beyond each border; 0 on the torus.
    padded : tuple of int
        Pixels of the transform, whose ends meet.
    """

    shape: tuple[int, ...]
    margin: int
    padded: tuple[int, ...]

    def spectrum(self, field: FloatArray) -> ComplexArray:
        """Transform a field on the pixels, with zeros around it; the last axis keeps its half."""
        whole = np.zeros(self.padded)
        whole[tuple(slice(self.margin, self.margin + size) for size in self.shape)] = field
        return self.transform(whole)

    def transform(self, whole: FloatArray) -> ComplexArray:
        """Transform a field on all padded pixels; the last axis keeps its half."""
        return fft.rfftn(whole, workers=-1)

    def reflected(self, field: FloatArray) -> FloatArray:
        """Continue a field into the margin by its mirror images."""
        if self.margin == 0:
            return field
        sides = zip(self.shape, self.padded, strict=True)
        beyond = [(self.margin, whole - size - self.margin) for size, whole in sides]
        return np.pad(field, beyond, "symmetric")

    def smoothed(self, spectrum: ComplexArray, variance: float) -> ComplexArray:
        """Multiply a spectrum with that of a Gaussian of unit mass.

        Parameters
        ----------
        spectrum : array
            Of a field on the pixels.
        variance : float
            In squared pixels.

        Returns
        -------
        array
            Of the smoothed field.
        """
        factors = []
        for a, size in enumerate(self.padded):
            k = _harmonics(size, last=a == len(self.padded) - 1)
            factors.append(_along(np.exp(-2 * variance * (math.pi * k / size) ** 2), a, len(self.padded)))
        found: ComplexArray = spectrum * factors[0]
        for factor in factors[1:]:
            found *= factor
        return found

    def without_blocks(self, spectrum: ComplexArray) -> ComplexArray:
        """Divide the spectrum of a field in blocks (``pixel_blocks``) by that of their spline."""
        found = spectrum
        for a, size in enumerate(self.padded):
            k = _harmonics(size, last=a == len(self.padded) - 1)
            found = found / _along(spline_spectrum(k, size), a, len(self.padded))
        return found

    def sampled(self, spectrum: ComplexArray, counts: tuple[int, ...]) -> FloatArray:
        """Sample a field of the padded grid at the centres of so many equal cells.

        Parameters
        ----------
        spectrum : array
            Of the field; what lies beyond the harmonics that the cells can tell must be small already.
        counts : tuple of int
            Cells along each axis, at most ``padded``.

        Returns
        -------
        (counts) float64
        """
        axes = len(self.padded)
        for a, (size, count) in enumerate(zip(self.padded, counts, strict=True)):
            k = _harmonics(size, last=a == axes - 1)
            kept = np.abs(k) < count / 2
            if count < size:
                spectrum = np.compress(kept, spectrum, axis=a)
                k = k[kept]
                # Centres of cells are (m + 1/2) size / count, those of pixels m + 1/2.
                spectrum = spectrum * _along(np.exp(1j * math.pi * k * (1 / count - 1 / size)), a, axes)
                if a < axes - 1:
                    spectrum = _spread(spectrum, k, count, a)
        found: FloatArray = fft.irfftn(spectrum, counts, workers=-1)
        found *= math.prod(counts) / math.prod(self.padded)
        return found

    def inside(self, padded: FloatArray) -> FloatArray:
        """Cut the margin off a field on all padded pixels."""
        return padded[tuple(slice(self.margin, self.margin + size) for size in self.shape)]


def padded_grid(shape: tuple[int, ...], margin: int) -> PaddedGrid:
    """Lay out the transform of a field.

    Parameters
    ----------
    shape : tuple of int
        Pixels.
    margin : int
        Pixels of zeros that are wanted beyond each border; 0 makes a torus.

    Returns
    -------
    PaddedGrid
    """
    if margin == 0:
        return PaddedGrid(shape, 0, shape)
    return PaddedGrid(shape, margin, tuple(fft.next_fast_len(size + 2 * margin, real=True) for size in shape))


def _harmonics(size: int, *, last: bool) -> FloatArray:
    k = fft.rfftfreq(size) if last else fft.fftfreq(size)
    return np.rint(k * size)


def _along(values: NDArray, axis: int, axes: int) -> NDArray:  # type: ignore[type-arg]
    return values.reshape([-1 if a == axis else 1 for a in range(axes)])


def _spread(spectrum: ComplexArray, k: FloatArray, count: int, axis: int) -> ComplexArray:
    """Put harmonics where a transform of that length has them; one that it cannot tell from -k is 0."""
    shape = list(spectrum.shape)
    shape[axis] = count
    found = np.zeros(shape, np.complex128)
    at: list[object] = [slice(None)] * spectrum.ndim
    at[axis] = k.astype(np.intp) % count
    found[tuple(at)] = spectrum  # type: ignore[index]
    return found
