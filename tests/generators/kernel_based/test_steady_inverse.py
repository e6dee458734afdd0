"""Inverses that do not depend on threads: against LAPACK's, and the bits of what is drawn by them."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest

from gbnbench.generators.kernel_based.spectral_sampling import kernels
from gbnbench.generators.kernel_based.steady_inverse import steady_inverse


@pytest.mark.parametrize("n", [1, 63, 64, 65, 200, 300])
def test_it_is_the_inverse(n: int) -> None:
    a = np.random.default_rng(n).normal(size=(n, n + 9))
    a = a @ a.T
    assert steady_inverse(a) @ a == pytest.approx(np.eye(n), abs=1e-15 * np.linalg.cond(a))


def test_it_is_as_exact_as_lapack_where_the_condition_is_bad() -> None:
    """A grid of 12**2 points under Gaussians 1.5 spacings wide: a condition of 1e7."""
    i, j = np.indices((12, 12)).reshape(2, -1)
    x = np.stack([i, j], axis=1) / 12
    k = kernels(x, x, 1.5 / 12)[0]
    error = np.abs(k @ steady_inverse(k) - np.eye(144)).max()
    assert error < 10 * np.abs(k @ np.linalg.inv(k) - np.eye(144)).max()


@pytest.mark.slow
def test_a_set_does_not_depend_on_the_number_of_threads() -> None:
    program = """
import hashlib, gbnbench
x = gbnbench.generate("oztireli[iterations=2]", n=600)
print(hashlib.sha256(x.tobytes()).hexdigest())
"""
    printed = {
        subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "OPENBLAS_NUM_THREADS": threads},
            capture_output=True,
            check=True,
        ).stdout
        for threads in ("1", "2", "3")
    }
    assert len(printed) == 1
