"""Slow twins of the energy's evaluations: mpmath's theta functions pair by pair, images in long double."""

from __future__ import annotations

import math

import mpmath
import numpy as np


def theta_field(x, sigma, digits=30):
    """Gradient in spacings and excess energy by mpmath's jtheta (Eq. 22); flat kernels need more digits."""
    n, d = x.shape
    with mpmath.workdps(digits):
        side = mpmath.mpf(n) ** (mpmath.mpf(1) / d)
        s = mpmath.mpf(sigma) / side
        nome = mpmath.exp(-2 * mpmath.pi**2 * s**2)
        scale = mpmath.sqrt(2 * mpmath.pi) * s
        energy, gradient = mpmath.mpf(0), [[mpmath.mpf(0)] * d for _ in range(n)]
        for k in range(n):
            for m in range(k, n):
                u = [mpmath.mpf(float(x[k, a])) - mpmath.mpf(float(x[m, a])) for a in range(d)]
                value = [scale * mpmath.jtheta(3, mpmath.pi * t, nome) for t in u]
                energy += mpmath.fprod(value) / (2 if k == m else 1)
                if k == m:
                    continue
                slope = [scale * mpmath.pi * mpmath.jtheta(3, mpmath.pi * t, nome, 1) / side for t in u]
                for a in range(d):
                    force = slope[a] * mpmath.fprod(v for b, v in enumerate(value) if b != a)
                    gradient[k][a] += force
                    gradient[m][a] -= force
        uniform = n * (2 * mpmath.pi) ** (mpmath.mpf(d) / 2) * mpmath.mpf(sigma) ** d / 2
        return np.array(gradient, float), float((energy - uniform) / n)


def image_field(x, sigma):
    """The same by adding images one by one in long double, for boxes of at least three sigmas."""
    n, d = x.shape
    long = np.longdouble
    side = long(n) ** (long(1) / d)
    assert side >= 3 * sigma
    images = np.arange(-4, 5) if side < 10 * sigma else np.arange(-1, 2)
    u = (x.astype(long)[:, None] - x.astype(long)[None]) * side
    value, slope = [], []
    for a in range(d):
        near = u[..., a] - side * np.rint(u[..., a] / side)
        gauss = [np.exp(-((near + j * side) ** 2) / (2 * long(sigma) ** 2)) for j in images]
        value.append(sum(gauss))
        slope.append(
            sum(-(near + j * side) / long(sigma) ** 2 * g for j, g in zip(images, gauss, strict=True))
        )
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
