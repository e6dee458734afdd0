"""Points that the device deals out to bands, against sorting by whole numbers of any size."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.precision import precision_of
from gbnbench.analysis.spectrum.coordinate_rounding import coordinates
from gbnbench.analysis.spectrum.evaluators.gridded_fft import bands
from gbnbench.analysis.spectrum.evaluators.gridded_fft.dealt_points import DealtPoints
from gbnbench.analysis.spectrum.evaluators.gridded_fft.errors import most_crowd, too_crowded, usual_crowd
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import real_grid
from gbnbench.core.torus import fixed_point


def bins_of(turns, grid, bits):
    """Bins of a set's points, the last axis fastest: (d, n) turns."""
    along = [[(int(t) * grid.nodes >> bits) // grid.width for t in row] for row in turns]
    found = np.zeros(turns.shape[1], np.int64)
    for row in along:
        found = found * grid.bins + row
    return found


def dealt(p, points, x, weights, most):
    """Turns, weights and beginnings of the bands of dealt points."""
    points(p.runtime.readable(x), weights, len(x), most)
    p.runtime.finish()
    turns, stride, weight, weight_stride, starts, count, *_ = points.arguments
    sets, n, d = x.shape
    held = p.runtime.download(turns, np.empty((sets, d, int(stride)), p.turn))[:, :, :n]
    w = p.runtime.download(weight, np.empty((sets if weight_stride else 1, n), p.real))
    return (
        held,
        np.broadcast_to(w, (sets, n)),
        p.runtime.download(starts, np.empty((sets, int(count) + 1), np.uint32)),
    )


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize(
    ("n", "d", "fmax", "sets"),
    [(1, 2, 130, 1), (1500, 2, 130, 3), (700, 2, 20, 2), (900, 3, 17, 2), (900, 3, 3, 1), (333, 1, 40, 2)],
)
@pytest.mark.parametrize("weighting", ["none", "shared", "own"])
def test_they_are_sorted_by_bin_where_that_is_of_use(n, d, fmax, sets, weighting, precision):
    p, grid = precision_of(precision), real_grid(d, fmax, precision)
    bits = 64 if precision == "double" else 32
    rng = np.random.default_rng(n)
    x = rng.random((sets, n, d))
    x[0, 0] = 1 - 2.0**-53
    x[-1, : n // 2, :] /= 40  # a crowd
    weights = None if weighting == "none" else rng.random((sets if weighting == "own" else 1, n))
    count, rows = bands.division(2, grid, sets, n)
    points = DealtPoints(p, grid, sets + 1, n, count, rows)
    for batch in (x[::-1].copy(), x):  # the second takes the place of the first
        turns, w, starts = dealt(p, points, batch, weights, n)
    crowds = set()
    for k, one in enumerate(fixed_point(x, bits).transpose(0, 2, 1)):
        bin_of = bins_of(one, grid, bits)
        crowd = int(np.bincount(bin_of).max())
        crowds.add((crowd, bands.run_count(grid, n, crowd)))
        in_order = d > 1 and (
            count > 1 or grid.size * grid.itemsize > bands.CACHE_BYTES or bands.run_count(grid, n, crowd) > 1
        )
        order = np.argsort(bin_of, kind="stable") if in_order else np.arange(n)
        assert np.array_equal(turns[k], one[:, order])
        own = np.ones(n) if weights is None else weights[k if len(weights) > 1 else 0]
        assert np.array_equal(w[k], own[order].astype(p.real))
        of_band = bin_of // grid.bins ** (d - 1) * grid.width // rows
        assert starts[k].tolist() == [int((of_band < band).sum()) for band in range(count)] + [n]
    assert points.crowds() == crowds
    wanted = coordinates(x, precision)
    assert points.coordinates().coherent == pytest.approx(wanted.coherent, rel=1e-4)
    assert points.coordinates().scattered == pytest.approx(wanted.scattered, rel=1e-4)


def test_a_set_that_is_too_crowded_is_given_up_and_the_others_are_not():
    p, grid, n = precision_of("double"), real_grid(2, 64, "double"), 2500
    x = np.random.default_rng(1).random((3, n, 2))
    x[1, 500:] = 0.3 + x[1, 500:] / 1000
    points = DealtPoints(p, grid, 3, n, 1, grid.nodes)
    most = most_crowd(p, grid, n, 1e-15)
    assert usual_crowd(grid, n) < most < 2000
    points(p.runtime.readable(x), None, 3, most)
    p.runtime.finish()
    runs = dict(points.crowds())
    assert runs.pop(max(runs)) == 0
    assert set(runs.values()) == {1}


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize(("n", "fmax"), [(300, 64), (2500, 64), (100_000, 16), (3000, 300)])
def test_whatever_is_given_up_is_too_crowded(n, fmax, precision):
    p, grid, unit = (
        precision_of(precision),
        real_grid(2, fmax, precision),
        2.0 ** (-53 if precision == "double" else -24),
    )
    for allowed in (9 * unit, 40 * unit):
        most = most_crowd(p, grid, n, allowed)
        for crowd in {*range(most + 1, min(n, most + 50)), n} - {most}:
            assert crowd <= most or too_crowded(p, grid, n, crowd, bands.run_count(grid, n, crowd), allowed)
    assert most_crowd(p, grid, n, float("inf")) == n
