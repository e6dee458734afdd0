"""The energy of Gaussian blue noise and its gradient: by theta functions, images, and single frequencies."""

from __future__ import annotations

import math

import mpmath
import numpy as np
from scipy.stats import chi2

from tests.oracles.theta import jacobi


def theta_field(x, sigma, digits=30):
    """Gradient in spacings and excess energy by mpmath's jtheta (Eq. 22); flat kernels need more digits."""
    n, d = x.shape
    with mpmath.workdps(digits):
        side = mpmath.mpf(n) ** (mpmath.mpf(1) / d)
        s = mpmath.mpf(sigma) / side
        energy, gradient = mpmath.mpf(0), [[mpmath.mpf(0)] * d for _ in range(n)]
        for k in range(n):
            for m in range(k, n):
                u = [mpmath.mpf(float(x[k, a])) - mpmath.mpf(float(x[m, a])) for a in range(d)]
                value = [jacobi(t, s) for t in u]
                energy += mpmath.fprod(value) / (2 if k == m else 1)
                if k == m:
                    continue
                slope = [jacobi(t, s, 1) / side for t in u]
                for a in range(d):
                    force = slope[a] * mpmath.fprod(v for b, v in enumerate(value) if b != a)
                    gradient[k][a] += force
                    gradient[m][a] -= force
        uniform = n * (2 * mpmath.pi) ** (mpmath.mpf(d) / 2) * mpmath.mpf(sigma) ** d / 2
        return np.array(gradient, float), float((energy - uniform) / n)


def image_field(x, sigma):
    """The same by adding images one by one in long double, those beyond 10.5 sigmas left out."""
    n, d = x.shape
    long = np.longdouble
    side = long(n) ** (long(1) / long(d))
    reach = max(1, math.ceil(10.5 * sigma / float(side) - 0.5))
    u = (x.astype(long)[:, None] - x.astype(long)[None]) * side
    value, slope = [], []
    for a in range(d):
        near = u[..., a] - side * np.rint(u[..., a] / side)
        total, force = np.zeros((n, n), long), np.zeros((n, n), long)
        for j in range(-reach, reach + 1):
            gauss = np.exp(-((near + j * side) ** 2) / (2 * long(sigma) ** 2))
            total += gauss
            force -= (near + j * side) / long(sigma) ** 2 * gauss
        value.append(total)
        slope.append(force)
    gradient = np.empty((n, d))
    for a in range(d):
        product = slope[a]
        for b in range(d):
            if b != a:
                product = product * value[b]
        gradient[:, a] = product.sum(axis=1)
    energy = math.prod(value[1:], start=value[0]).sum()
    pi = 4 * np.arctan(long(1))
    uniform = (2 * pi) ** (long(d) / 2) * long(sigma) ** d
    return gradient, float((energy / n - uniform) / 2)


def frequency_field(x, sigma, edge):
    """Gradient and energy of the modes 0 < nu <= edge alone, one at a time in long double (Eq. 20)."""
    n, d = x.shape
    side = n ** (1 / d)
    reach = math.floor(edge * side + 1e-9)
    f = np.indices((2 * reach + 1,) * d).reshape(d, -1).T - reach
    square = (f**2).sum(axis=1)
    f = f[(square > 0) & (square <= (edge * side) ** 2 * (1 + 1e-12))]
    phase = 2 * np.pi * (x.astype(np.longdouble) @ f.T.astype(np.longdouble) % 1)
    q = 2 * np.pi * f / side
    w = (2 * np.pi) ** (d / 2) * sigma**d * np.exp(-(sigma**2) * (q**2).sum(axis=1) / 2)
    c, s = np.cos(phase).sum(axis=0), np.sin(phase).sum(axis=0)
    excess = float((w * (c**2 + s**2)).sum() / (2 * n**2))
    gradient = (w / n * (-np.sin(phase) * c + np.cos(phase) * s)) @ q
    return np.asarray(gradient, float), excess


def pair_field(x, sigma, cutoff=math.inf):
    """Gradient in spacings and excess energy in long double, pair by pair and image by image."""
    n, d = x.shape
    side = np.longdouble(n) ** (np.longdouble(1) / d)
    between = (x[:, None].astype(np.longdouble) - x[None].astype(np.longdouble)) * side
    reach = math.ceil(11.5 * sigma / float(side))
    gradient, total = np.zeros((n, d), np.longdouble), np.longdouble(0)
    for image in np.ndindex(*(2 * reach + 1,) * d):
        u = between + (np.array(image) - reach) * side
        r2 = (u**2).sum(-1)
        g = np.where(r2 <= (cutoff * sigma) ** 2, np.exp(-r2 / (2 * np.longdouble(sigma) ** 2)), 0)
        total += g.sum()
        gradient -= (g[..., None] * u).sum(1) / np.longdouble(sigma) ** 2
    uniform = (2 * np.pi) ** (np.longdouble(d) / 2) * sigma**d * chi2.cdf(cutoff**2, d)
    return gradient.astype(float), float((total / n - uniform) / 2)


def box_field(x, sigma):
    """Gradient in spacings and excess energy: pairs in long double, the domain by Gauss-Legendre panels."""
    n, d = x.shape
    side = n ** (1 / d)
    nodes, weights = np.polynomial.legendre.leggauss(12)
    panels = np.linspace(0, side, max(2, round(side / sigma)) + 1)
    half = np.diff(panels)[:, None] / 2
    v, w = (panels[:-1, None] + half * (nodes + 1)).ravel(), (half * weights).ravel()
    u = (x * side).astype(np.longdouble)
    apart = u[:, None] - u[None]
    pair = np.exp(-(apart**2).sum(-1) / (2 * sigma**2))
    gradient = -(pair[..., None] * apart).sum(1) / sigma**2
    kernel = np.exp(-((u[..., None] - v) ** 2) / (2 * sigma**2)) * w
    along, slope = kernel.sum(-1), (-(u[..., None] - v) / sigma**2 * kernel).sum(-1)
    for a in range(d):
        gradient[:, a] -= slope[:, a] * np.delete(along, a, 1).prod(1)
    whole = ((np.exp(-((v[:, None] - v) ** 2) / (2 * sigma**2)) * w).sum(-1) * w).sum() ** d
    return gradient.astype(float), float((pair.sum() / 2 - along.prod(1).sum() + whole / 2) / n)
