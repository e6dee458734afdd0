"""Sums against J0 over fewer radii, held against sums over all of them in thirty digits."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest

from gbnbench.analysis.radial.hankel_nodes import STEP, nodes_for, on_nodes, stride_for


@pytest.mark.parametrize("stride", [1, 2, 3, 7, 35])
@pytest.mark.parametrize("share", [0.05, 1.0])
def test_sums_over_nodes_against_thirty_digits(stride: int, share: float) -> None:
    """Of the highest frequency that the stride allows, and of a low one; weights up to both edges."""
    bins = 200
    weights = np.random.default_rng(stride).normal(size=(bins, 2)) * [[1.0, 1e6]]
    nodes = on_nodes(weights, stride)
    assert nodes.shape == (nodes_for(bins, stride), 2)
    step = share * STEP / stride
    with mpmath.workdps(30):
        at_bins = [mpmath.besselj(0, mpmath.mpf(step) * b) for b in range(bins)]
        at_nodes = [mpmath.besselj(0, mpmath.mpf(step) * stride * b) for b in range(len(nodes))]
        for given, carried in zip(weights.T, nodes.T, strict=True):
            whole = mpmath.fdot(map(mpmath.mpf, given.tolist()), at_bins)
            found = mpmath.fdot(map(mpmath.mpf, carried.tolist()), at_nodes)
            assert abs(found - whole) < 1e-14 * np.abs(given).sum()


@pytest.mark.parametrize("step", [2.0, math.pi / 2, 0.7, 0.05, 1e-4])
def test_nodes_are_near_enough(step: float) -> None:
    stride = stride_for(step)
    assert stride == 1 or stride * step <= STEP
    assert (stride + 1) * step > STEP
