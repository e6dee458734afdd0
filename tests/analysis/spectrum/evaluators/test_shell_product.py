"""Moments of shells from blocks of the two-group product, against every frequency one by one."""

from __future__ import annotations

from itertools import product
from math import isqrt

import numpy as np
import pytest

from gbnbench.analysis.precision import Precision, precision_of
from gbnbench.analysis.spectrum.digits import whole_axes
from gbnbench.analysis.spectrum.evaluators import point_slots, shell_product
from gbnbench.analysis.spectrum.evaluators.shell_product import (
    blocks,
    merged,
    shell_moments,
)
from gbnbench.analysis.spectrum.shell_moments import ShellMoments
from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.analysis.spectrum.sorted_groups import count_pairs, sorted_group, two_sorted_groups
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.opencl import runtime
from tests.devices import gpu_form
from tests.oracles.power import lattice_of, mean_power, on_grid

FORMS = {
    "double": lambda: precision_of("double"),
    "float": lambda: precision_of("float"),
    "gpu, double": lambda: gpu_form(True),
    "gpu, float": lambda: gpu_form(False),
    "gpu, float sums": lambda: gpu_form(False, has_double=False),
    "two lanes": lambda: Precision(runtime(), True, 2),
}


def enumerated(x, fmax, low, high, weights=None):
    """Moments of the shells low .. high over one half space, in long double."""
    f = lattice_of(fmax, x.shape[2])
    f = f[len(f) // 2 + 1 :]
    square = (f**2).sum(axis=1)
    inside = (square >= low) & (square <= high)
    f, square = f[inside], square[inside]
    power = mean_power(x, f, weights)
    shells = np.unique(square)
    held = [power[square == s] for s in shells]
    return ShellMoments(
        shells,
        np.array([len(p) for p in held]),
        np.array([p.mean() for p in held], dtype=np.float64),
        np.array([((p - p.mean()) ** 2).sum() for p in held], dtype=np.float64),
    )


def check(p, x, fmax, low, high, weights=None):
    """Compare moments with the truth; return them."""
    w = None if weights is None else np.atleast_2d(weights)
    got, errors = shell_moments(p, x, fmax, low, high, w)
    truth = enumerated(x, fmax, low, high, weights)
    assert np.array_equal(got.square, truth.square)
    assert np.array_equal(got.count, truth.count)
    assert got.count.dtype == np.int64
    relative = 1e-12 if p.double else 3e-5 if p.sum is np.float32 else 1e-5
    assert np.allclose(got.mean, truth.mean, rtol=relative, atol=0)
    assert np.allclose(got.deviation, truth.deviation, rtol=10 * relative, atol=10 * relative)
    assert 0 < errors.rms < errors.bound
    return got


CASES = (
    *((30, 2, 1, 1, 1), (30, 2, 9, 1, 81), (30, 2, 9, 1, 162), (25, 2, 9, 40, 60), (25, 2, 12, 144, 200)),
    *(
        (40, 3, 3, 1, 9),
        (40, 3, 3, 1, 27),
        (17, 3, 4, 9, 9),
        (20, 5, 1, 1, 5),
        (12, 5, 2, 3, 4),
        (7, 7, 1, 1, 7),
    ),
)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("n", "d", "fmax", "low", "high"), CASES)
def test_ball_band_and_corners(form, n, d, fmax, low, high):
    check(FORMS[form](), on_grid((1, n, d), n), fmax, low, high)


@pytest.mark.parametrize("form", ["double", "float", "gpu, double"])
@pytest.mark.parametrize("shared", [True, False])
def test_sets_and_weights(form, shared):
    x = on_grid((5, 41, 3), 2)
    weights = np.random.default_rng(3).standard_normal((1 if shared else 5, 41))
    weights[:, ::5] = 0
    check(FORMS[form](), x, 3, 2, 20, weights)
    check(FORMS[form](), x, 2, 1, 12)


@pytest.mark.parametrize(("rows", "columns"), [(12, 64), (60, 128)])
@pytest.mark.parametrize("form", ["double", "gpu, double", "gpu, float sums"])
def test_small_blocks(monkeypatch, form, rows, columns):
    x, weights = on_grid((2, 29, 4), 4), np.random.default_rng(5).random((2, 29))
    monkeypatch.setattr(shell_product, "BLOCK_ROWS", rows)
    monkeypatch.setattr(shell_product, "BLOCK_COLUMNS", columns)
    for fmax, low, high in ((3, 1, 9), (3, 1, 36), (4, 13, 17)):
        check(FORMS[form](), x, fmax, low, high, weights)


@pytest.mark.parametrize("strip_bytes", [1, 2000])
def test_any_number_of_strips_merges_to_the_same(monkeypatch, strip_bytes):
    x = on_grid((1, 50, 3), 6)
    monkeypatch.setattr(shell_product, "BIN_BYTES", strip_bytes)
    check(precision_of("double"), x, 4, 1, 48)


def test_points_beyond_one_launch(monkeypatch):
    monkeypatch.setattr(point_slots, "TABLE_BYTES", 1 << 14)
    check(
        precision_of("double"), on_grid((2, 3001, 2), 8), 3, 1, 18, np.random.default_rng(9).random((2, 3001))
    )


@pytest.mark.parametrize(("d", "fmax"), [(1, 5), (2, 3), (3, 2), (4, 1)])
@pytest.mark.parametrize("most", [0, 1, 3, 100])
def test_a_sorted_group_is_the_half_space_within_a_ball(d, fmax, most):
    group = sorted_group(whole_axes(d, fmax), most)
    f = lattice_of(fmax, d)
    squares = (f**2).sum(axis=1)
    wanted = [k for k in range(len(f) // 2, len(f)) if squares[k] <= most]
    assert sorted(group.order.tolist()) == wanted
    assert np.array_equal(group.square, squares[group.order.astype(int)])
    assert (np.diff(group.square) >= 0).all()


@pytest.mark.parametrize(
    ("d", "fmax", "low", "high"), [(2, 7, 1, 49), (3, 3, 5, 14), (4, 2, 16, 16), (2, 9, 3, 3)]
)
def test_blocks_hold_every_pair_of_the_band_once(monkeypatch, d, fmax, low, high):
    monkeypatch.setattr(shell_product, "BLOCK_ROWS", 6)
    monkeypatch.setattr(shell_product, "BLOCK_COLUMNS", 5)
    a, b = two_sorted_groups(d, fmax, high)
    met = np.zeros((len(a.order), len(b.order)), int)
    evaluated = 0
    for rows, columns, bounds in blocks(a, b, low, high, 3):
        first = range(len(a.order))[rows]
        for i, j in product(range(len(first)), range(columns.stop - columns.start)):
            if bounds[i // 3, 0] <= j < bounds[i // 3, 1]:
                met[rows.start + i, columns.start + j] += 1
                evaluated += 1
    square = a.square[:, None] + b.square
    wanted = (square >= low) & (square <= high)
    assert (met <= 1).all()
    assert (met[wanted] == 1).all()
    assert count_pairs(a, b, low, high) == wanted.sum()


def test_merging_is_that_of_the_whole():
    rng = np.random.default_rng(10)
    held = [[rng.random(rng.integers(0, 9)) for _ in range(7)] for _ in range(4)]
    for strip in held:
        strip[3] = np.zeros(0)
    parts = np.array(
        [
            [[len(v), v.mean() if len(v) else 0, ((v - v.mean()) ** 2).sum() if len(v) else 0] for v in strip]
            for strip in held
        ]
    )
    count, mean, deviation = (parts[..., k] for k in range(3))
    moments = merged(count.astype(np.int64), mean, deviation, 20)
    together = [np.concatenate([strip[k] for strip in held]) for k in range(7) if k != 3]
    assert moments.square.tolist() == [20, 21, 22, 24, 25, 26]
    assert moments.count.tolist() == [len(v) for v in together]
    assert np.allclose(moments.mean, [v.mean() for v in together])
    assert np.allclose(moments.deviation, [((v - v.mean()) ** 2).sum() for v in together])


def test_progress_rises_to_one():
    seen = []
    shell_moments(precision_of("double"), on_grid((1, 20, 4)), 4, 1, 64, progress=seen.append)
    assert seen == sorted(seen)
    assert seen[-1] == 1


def test_a_group_beyond_64_bits_is_refused():
    with pytest.raises(RefusalError, match=r"beyond 2\^63"):
        sorted_group(whole_axes(40, 1), 1)


@pytest.mark.parametrize("d", [30, 36])
def test_many_dimensions(d):
    x = on_grid((1, 9, d), d)
    got, _ = shell_moments(precision_of("double"), x, 1, 1, 1)
    assert got.count.tolist() == [d]
    assert np.isclose(got.mean[0], float(mean_power(x, np.eye(d, dtype=int)).mean()), rtol=1e-13)


def test_groups_of_too_many_table_entries_are_refused_by_their_dimension():
    with pytest.raises(InputError, match="d=39"):  # a smaller fmax than 1 is no way out
        shells(on_grid((9, 39)), 1)


def test_large_harmonics_in_a_narrow_band():
    fmax, x = 65535, on_grid((1, 8, 2), 1)
    high = fmax**2
    got, errors = shell_moments(precision_of("double"), x, fmax, high - 2, high)
    f = [
        (a, s * b)
        for a in range(fmax + 1)
        for b in {isqrt(high - a * a), isqrt(max(high - 2 - a * a, 0))}
        for s in (1, -1)
        if high - 2 <= a * a + b * b <= high and b and a
    ]
    power = mean_power(x, [*f, (0, fmax), (fmax, 0)])
    assert got.square.tolist() == [high]
    assert got.count.tolist() == [len(power)]
    assert np.isclose(got.mean[0], float(power.mean()), rtol=1e-12)
    assert errors.bound < 1e-12


@pytest.mark.parametrize(("sets", "n"), [(3000, 1), (300, 8)])
def test_many_small_sets_take_no_more_memory_than_few(sets, n):
    p = precision_of("double")
    rows, columns = shell_product.BLOCK_ROWS, shell_product.BLOCK_COLUMNS
    slots = point_slots.choose_slots(p, n, sets, rows, columns)
    assert slots.count * rows * columns * 4 * 8 <= 300e6
