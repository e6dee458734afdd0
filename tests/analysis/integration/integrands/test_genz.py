"""Genz' six families: values and integrals against their definitions."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest
from scipy.stats import qmc

from gbnbench.analysis.integration.integrands.genz import DIFFICULTY, Genz
from gbnbench.analysis.integration.integrands.genz_kinds import KINDS
from gbnbench.core.errors import InputError, RefusalError

DIMENSIONS = (1, 2, 3, 5, 8, 12, 20)


def quad(f: Callable[[Any], Any], *breaks: float) -> mpmath.mpf:
    return mpmath.quad(f, sorted({0.0, 1.0, *(float(b) for b in breaks)}))


def slow_integral(kind: str, a: list[float], u: list[float]) -> mpmath.mpf:
    """By one quadrature an axis, the corner peak by inclusion and exclusion in 80 digits."""
    d = len(a)
    if kind == "oscillatory":
        each = [quad(lambda x, b=b: mpmath.exp(1j * b * x), 0.5) for b in a]
        return (mpmath.expjpi(2 * mpmath.mpf(u[0])) * mpmath.fprod(each)).real
    if kind == "corner-peak":
        weights = [mpmath.mpf(b) for b in a]
        total = mpmath.fsum(
            (-1) ** sum(v) / (1 + mpmath.fdot(weights, v)) for v in itertools.product((0, 1), repeat=d)
        )
        return total / (mpmath.factorial(d) * mpmath.fprod(weights))
    one: dict[str, Callable[[Any, float, float], Any]] = {
        "product-peak": lambda x, b, c: 1 / (mpmath.mpf(b) ** -2 + (x - c) ** 2),
        "gaussian": lambda x, b, c: mpmath.exp(-((b * (x - c)) ** 2)),
        "continuous": lambda x, b, c: mpmath.exp(-b * abs(x - c)),
        "discontinuous": lambda x, b, c: mpmath.exp(b * x),
    }
    if kind == "discontinuous":
        ends = [*u[:2], *[1.0] * d][:d]
        return mpmath.fprod(
            mpmath.quad(lambda x, b=b: mpmath.exp(b * x), [0, e]) for b, e in zip(a, ends, strict=True)
        )
    return mpmath.fprod(quad(lambda x, b=b, c=c: one[kind](x, b, c), c) for b, c in zip(a, u, strict=True))


def slow_value(kind: str, a: list[float], u: list[float], x: list[float]) -> float:
    away = [b * (p - c) for b, c, p in zip(a, u, x, strict=True)]
    dot = math.fsum(b * p for b, p in zip(a, x, strict=True))
    if kind == "oscillatory":
        return math.cos(2 * math.pi * u[0] + dot)
    if kind == "product-peak":
        return math.prod(b * b / (1 + r * r) for b, r in zip(a, away, strict=True))
    if kind == "corner-peak":
        return (1 + dot) ** -(len(a) + 1)
    if kind == "discontinuous":
        return math.exp(dot) if all(p <= c for p, c in zip(x[:2], u[:2], strict=True)) else 0.0
    return math.exp(-math.fsum(r * r if kind == "gaussian" else abs(r) for r in away))


@pytest.mark.parametrize("d", DIMENSIONS)
@pytest.mark.parametrize("kind", DIFFICULTY)
def test_values_and_integral_are_those_of_the_definition(kind: str, d: int) -> None:
    one = Genz(kind).draw(d, np.random.default_rng(d))  # type: ignore[arg-type]
    a, u = one.a.tolist(), one.u.tolist()
    assert sum(a) == pytest.approx(DIFFICULTY[kind])
    x = np.concatenate([np.random.default_rng(1).random((20, d)), one.u[None] / 2])
    assert one(x) == pytest.approx([slow_value(kind, a, u, p) for p in x.tolist()], rel=1e-13)
    if kind == "corner-peak" and d > 12:
        return  # 2^20 corners in many digits take a minute; see below
    with mpmath.workdps(80 if kind == "corner-peak" else 25):
        slow = float(slow_integral(kind, a, u))
    assert one.integral == pytest.approx(slow, rel=2e-14 if kind != "oscillatory" else 0, abs=2e-15)


@pytest.mark.parametrize("difficulty", [1e-6, 0.1, 1.85, 50.0, 3000.0])
@pytest.mark.parametrize("d", [1, 2, 5, 10, 20])
def test_corner_peaks_of_equal_sides_at_any_difficulty(d: int, difficulty: float) -> None:
    a = np.full(d, difficulty / d)
    with mpmath.workdps(300):
        side = mpmath.mpf(a[0])
        terms = [(-1) ** k * math.comb(d, k) / (1 + k * side) for k in range(d + 1)]
        slow = float(mpmath.fsum(terms) / (mpmath.factorial(d) * side**d))
    assert KINDS["corner-peak"](a, np.zeros(d)).integral == pytest.approx(slow, rel=5e-14)


@pytest.mark.parametrize("kind", DIFFICULTY)
def test_points_find_the_integral(kind: str) -> None:
    x = qmc.Sobol(5, seed=3).random_base2(15)
    one = Genz(kind, 3.0).draw(5, np.random.default_rng(6))  # type: ignore[arg-type]
    values = one(x)
    assert values.mean() == pytest.approx(one.integral, abs=0.01 * values.std())
    assert Genz(kind).frequencies(5, 0.1).shape == (0, 5)  # type: ignore[arg-type]


def test_settings_out_of_range_are_told() -> None:
    with pytest.raises(InputError, match=r"kind of genz must be one of oscillatory, .*; got 'smooth'"):
        Genz("smooth")  # type: ignore[arg-type]
    with pytest.raises(
        InputError, match=r"difficulty of genz\[kind=oscillatory\] must be from 1e-06 to 1e\+06.*; got 0"
    ):
        Genz(difficulty=0)
    with pytest.raises(RefusalError, match="Genz' families are for d = 1 to 20; got d=21"):
        Genz().draw(21, np.random.default_rng(0))
