"""The reference of the hard cases against mpmath with plenty of digits."""

from __future__ import annotations

import mpmath as mp
import numpy as np
import pytest

from gbnbench.benchmarks.spectra.reference import exact_sum, reference_amplitudes, reference_roots

EXTENDED = np.finfo(np.longdouble).nmant >= 63
ALLOWED = 4e-19 if EXTENDED else 2e-16  # of an amplitude over sqrt(n)


def true_amplitudes(x, frequencies, weights=None):
    with mp.workdps(400):  # 2^-1074 times 2^62 beside whole turns
        found = []
        for f in frequencies:
            total = mp.mpc(0)
            for k, point in enumerate(x):
                turns = sum(int(a) * mp.mpf(float(c)) for a, c in zip(f, point, strict=True))
                weight = 1 if weights is None else mp.mpf(float(weights[k]))
                total += weight * mp.expjpi(-2 * (turns - mp.nint(turns)))
            found.append(abs(total))
        return found


def away(found, true):
    """Largest departure; a long double is the sum of two doubles."""
    with mp.workdps(60):
        return max(
            float(abs(mp.mpf(float(a)) + mp.mpf(float(a - np.longdouble(float(a)))) - b))
            for a, b in zip(found, true, strict=True)
        )


@pytest.mark.parametrize(("d", "reach"), [(1, 2**62), (2, 2**20), (5, 50)])
@pytest.mark.parametrize("weighted", [False, True])
def test_it_is_right_to_the_last_digits_for_any_double(d, reach, weighted):
    rng = np.random.default_rng(d)
    x = rng.random((30, d))
    x[::3] *= 10.0 ** rng.uniform(-320, 0, x[::3].shape)
    x[0], x[1], x[2] = 5e-324, 1 - 2.0**-53, 2.0**-65
    f = rng.integers(-reach, reach + 1, (6, d))
    w = rng.normal(size=30) * 1e3 if weighted else None
    scale = np.linalg.norm(w) if weighted else np.sqrt(30)
    assert away(reference_amplitudes(x, f, w), true_amplitudes(x, f, w)) <= 3 * ALLOWED * scale
    assert np.array_equal(reference_amplitudes(x, -f, w), reference_amplitudes(x, f, w))


def test_zero_is_exactly_zero():
    lattice = np.arange(64)[:, None] / 64
    roots = reference_roots(lattice, [[1], [63], [64], [2**40 + 1], [0]])
    assert roots[[2, 4]].tolist() == [8.0, 8.0]
    assert np.abs(roots[[0, 1, 3]]).max() <= (1e-18 if EXTENDED else 1e-15)


def test_sums_do_not_round():
    tiny = np.longdouble(2.0) ** -60
    terms = np.array([1.0, tiny, -1.0] * 1000, np.longdouble)
    assert exact_sum(terms) == 1000 * tiny
    assert exact_sum(np.zeros(5, np.longdouble)) == 0
