"""The kernel itself: its periodised profile, and the transform that truncating it leaves (Fig. 4 and 6)."""

from __future__ import annotations

import math

import numpy as np
from scipy.special import jv, wofz

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn import kernel

NARROW = (
    2.5  # sigmas a side below which theta is summed over frequencies: either sum then ends within ten terms
)


def theta(u: FloatArray, side: float, sigma: float) -> FloatArray:
    """Sum exp(-(u + j side)^2 / 2 sigma^2) over all integers j, the paper's Eq. (22).

    Parameters
    ----------
    u : (...) float64
        Distances, in the units of side and sigma.
    side, sigma : float
        Period and width.

    Returns
    -------
    (...) float64
        Good to a few roundings of its largest value.

    Raises
    ------
    InputError
        If side or sigma is not positive.
    """
    if not (side > 0 and sigma > 0 and math.isfinite(side / sigma)):
        raise InputError(f"side and sigma must be positive; got side={side}, sigma={sigma}")
    near = np.asarray(u, dtype=np.float64) / side
    near = near - np.rint(near)
    if side < NARROW * sigma:
        w = kernel.weights(side, sigma, 8)
        harmonics = 1 + 2 * sum(w[f] * np.cos(2 * np.pi * f * near) for f in range(1, 9))
        return np.asarray(math.sqrt(2 * math.pi) * sigma / side * harmonics, dtype=np.float64)
    images = math.ceil(9 * sigma / side) + 1
    total = sum(np.exp(-0.5 * ((near + j) * side / sigma) ** 2) for j in range(-images, images + 1))
    return np.asarray(total, dtype=np.float64)


def energy_profile(u: FloatArray, side: float, sigma: float) -> FloatArray:
    """Theta over its largest value, that at u = 0: the curves of Fig. 6.

    Parameters
    ----------
    u : (...) float64
        Distances, in the units of side and sigma.
    side, sigma : float
        Period and width.

    Returns
    -------
    (...) float64
    """
    return np.asarray(theta(u, side, sigma) / theta(np.zeros(1), side, sigma)[0])


def truncated_transform(nu: FloatArray, sigma: float, cutoff: float, d: int = 1) -> FloatArray:
    """Fourier transform of exp(-r^2 / 2 sigma^2), r <= cutoff * sigma, 0 beyond: the curves of Fig. 4.

    Parameters
    ----------
    nu : (...) float64
        Frequencies, cycles per unit of sigma's length.
    sigma : float
        Width.
    cutoff : float
        In sigmas; inf is the whole Gaussian.
    d : {1, 2}
        On the line, or radially in the plane.

    Returns
    -------
    (...) float64
        Good to 1e-14 of its value at 0.

    Raises
    ------
    InputError
        If sigma or cutoff is not positive, cutoff is beyond 12 and finite, or d is neither 1 nor 2.

    Notes
    -----
    With z = 2 pi sigma nu and t = cutoff, in 1D sqrt(2 pi) sigma exp(-z^2/2) Re erf((t + i z) / sqrt 2), by
    the Faddeeva function; in 2D 2 pi sigma^2 exp(-t^2/2) sum over m >= 1 of (t/z)^m J_m(t z), by parts from
    (r J_1(z r))' = z r J_0(z r). Both decay like a power of nu, where the Gaussian's own is exp(-z^2/2).
    """
    if d not in (1, 2):
        raise InputError(f"d must be 1 or 2; got {d}")
    if not (sigma > 0 and cutoff > 0):
        raise InputError(f"sigma and cutoff must be positive; got sigma={sigma}, cutoff={cutoff}")
    z = 2 * np.pi * sigma * np.abs(np.asarray(nu, dtype=np.float64))
    whole = np.exp(-(z**2) / 2)
    scale = (math.sqrt(2 * math.pi) * sigma) ** d
    if math.isinf(cutoff):
        return np.asarray(scale * whole)
    if cutoff > 12:
        raise InputError(
            f"a Gaussian cut at {cutoff} sigmas is whole to 1e-31; give a cutoff up to 12, or inf"
        )
    if d == 1:
        rest = np.exp(-(cutoff**2) / 2) * np.real(
            np.exp(-1j * cutoff * z) * wofz((-z + 1j * cutoff) / math.sqrt(2))
        )
        return np.asarray(scale * (whole - rest))
    return np.asarray(scale * _disc(z, cutoff))


def _disc(z: FloatArray, t: float) -> FloatArray:
    """Integral of r exp(-r^2/2) J_0(z r) over 0 <= r <= t.

    Notes
    -----
    exp(-t^2/2) sum over m of (t/z)^m J_m(t z), of which no term exceeds (t^2/2)^m / m!. Where t z < 1 a power
    and its J_m would over- and underflow apart: their product comes from the series of J_m.
    """
    flat = np.atleast_1d(z).ravel()
    out = np.empty_like(flat)
    most = math.ceil(t * t / 2 * math.e + 60)
    m = np.arange(1, most + 1)
    for i, x in enumerate(flat):
        if x * t < 1:  # J_m(t z) (t/z)^m = (t^2/2)^m / m! (1 - (t z / 2)^2 / (m + 1) + ...)
            logs = m * math.log(t * t / 2) - np.array([math.lgamma(k + 1.0) for k in m]) - t * t / 2
            h, term, series = (t * x / 2) ** 2, np.ones(most), np.ones(most)
            for k in range(1, 12):
                term = -term * h / (k * (m + k))
                series = series + term
            out[i] = np.sum(np.exp(logs) * series)
        else:
            bessel = jv(m, t * x)
            with np.errstate(divide="ignore"):
                logs = m * math.log(t / x) + np.log(np.abs(bessel)) - t * t / 2
            out[i] = np.sum(np.sign(bessel) * np.exp(logs))
    return out.reshape(np.shape(z))
