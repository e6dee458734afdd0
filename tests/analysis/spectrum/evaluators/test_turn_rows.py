"""Turns that are written in place are those of ``torus.fixed_point``, at every edge of a rounding."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.precision import precision_of
from gbnbench.analysis.spectrum.coordinate_rounding import coordinates
from gbnbench.analysis.spectrum.evaluators.turn_rows import TurnRows
from gbnbench.core.torus import fixed_point
from tests.devices import gpu_form


@pytest.mark.parametrize("double", [True, False], ids=["double", "float"])
@pytest.mark.parametrize("gpu", [False, True], ids=["cpu", "gpu"])
def test_they_are_the_fixed_point_coordinates(double, gpu):
    p = gpu_form(double) if gpu else precision_of("double" if double else "float")
    bits = 64 if double else 32
    x = np.random.default_rng(1).random((3, 50, 2))
    edges = [0.5, 0.5 - 2.0**-33, 0.5 + 2.0**-33, 1 - 2.0**-33, 1 - 3 * 2.0**-34, 2.0**-33, 2.0**-65, 0.25]
    near = [np.nextafter(edge, to) for edge in edges for to in (0.0, 1.0)]
    x[0, : len(edges) + len(near), 1] = edges + near
    x[1, :, 0] = np.arange(50) / 50
    x[2, :, 1] *= 2.0 ** -np.arange(50)
    turns = TurnRows(p, 4, 50, 2, 64, None if gpu else 32)
    for batch in (np.ascontiguousarray(x[:1, :, ::-1]), x):  # the second takes the place of the first
        turns(p.runtime.readable(batch), len(batch))
        held = p.runtime.download(turns.buffer, np.empty((4, 2, 64), p.turn))[: len(batch)]
        assert np.array_equal(held[:, :, :50], fixed_point(batch, bits).transpose(0, 2, 1))
        assert not held[:, :, 50:].any()
        found, wanted = turns.coordinates(len(batch)), coordinates(batch, p.name)
        assert found.coherent == pytest.approx(wanted.coherent, rel=1e-5)
        assert found.scattered == pytest.approx(wanted.scattered, rel=1e-5)
        assert found.share == wanted.share
