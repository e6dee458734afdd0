"""Bond order and psi6 against plain loops, lattices and random points."""

from __future__ import annotations

import cmath
import itertools
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import Voronoi

from gbnbench.analysis.spatial.bond_order import bond_order, psi6
from gbnbench.analysis.spatial.delaunay import neighbours
from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import wrap
from tests.oracles.lattices import grid, hexagonal
from tests.published_sets import published


def slow(x: np.ndarray) -> tuple[float, float]:
    """Bond order and psi6 by loops over the Voronoi cells of the 3x3 tiling."""
    tiled = np.concatenate(
        [x + np.array(s) for s in sorted(itertools.product((0, 1, -1), repeat=2), key=any)]
    )
    around: list[list[complex]] = [[] for _ in x]
    for p, q in Voronoi(tiled).ridge_points:
        for a, b in ((p, q), (q, p)):
            if a < len(x):
                around[a].append(complex(*(tiled[b] - tiled[a])))
    edges, bonds, count = 0.0, 0.0, 0
    for cell in around:
        cycle = sorted(cell, key=cmath.phase)
        total = sum(
            cmath.exp(6j * cmath.phase(cycle[(k + 1) % len(cycle)] - cycle[k])) for k in range(len(cycle))
        )
        edges += abs(total)
        bonds += abs(sum(cmath.exp(6j * cmath.phase(z)) for z in cycle)) / len(cycle)
        count += len(cycle)
    return edges / count, bonds / len(x)


@pytest.mark.parametrize("n", [12, 90, 256])
def test_against_loops_over_voronoi_cells(n: int) -> None:
    x = np.random.default_rng(n).random((2, n, 2))
    expected = np.array([slow(points) for points in x])
    np.testing.assert_allclose(bond_order(x), expected[:, 0], rtol=1e-10)
    np.testing.assert_allclose(psi6(x), expected[:, 1], rtol=1e-10)


def test_hexagonal_lattice() -> None:
    a, b = 26, 15  # strained by 7e-4: the closed form is that of its six bonds
    bonds = np.array([1 / a, 0.5 / a + 0.5j / b, -0.5 / a + 0.5j / b])
    expected = abs(np.mean((bonds / abs(bonds)) ** 6))
    x = wrap(hexagonal(a, b) + 0.013)
    assert psi6(x)[0] == pytest.approx(expected, abs=1e-12)
    assert bond_order(x)[0] == pytest.approx(expected, abs=1e-12)  # its edges are its bonds
    assert expected == pytest.approx(1, abs=1e-4)


def test_square_lattice_has_no_sixfold_order() -> None:
    assert psi6(grid(8, 2))[0] == pytest.approx(0, abs=1e-12)
    assert bond_order(grid(8, 2))[0] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("gap", [1e-6, 1e-12])
def test_near_neighbours_across_the_border_have_their_direction(gap: float) -> None:
    """A pair askew across the corner: its bond has the direction that its exact coordinates have."""
    far, near = 1 - gap, 1.25e-5 * gap
    others = np.array([[0.3, 0.2], [0.7, 0.3], [0.4, 0.6], [0.8, 0.75], [0.1, 0.45], [0.5, 0.9]])
    x = np.concatenate([[[far, far], [near, 0.3 * near]], others])
    (made,) = neighbours(x)
    rows = np.arange(made.indptr[0], made.indptr[1])
    (row,) = rows[(made.index[rows] == 1) & (np.abs(made.vector[rows]).max(axis=1) < 0.1)]
    exact = [float(1 - Fraction(far) + Fraction(v)) for v in (near, 0.3 * near)]
    np.testing.assert_allclose(made.vector[row], exact, rtol=1e-15)


def test_against_forty_digits() -> None:
    x = np.random.default_rng(20).random((60, 2))
    (made,) = neighbours(x)
    with mpmath.workdps(40):
        z = [mpmath.mpc(*v) for v in made.vector.tolist()]
        sixfold = [(v / abs(v)) ** 6 for v in z]
        psi, edges = mpmath.mpf(0), mpmath.mpf(0)
        for a, b in itertools.pairwise(made.indptr.tolist()):
            psi += abs(mpmath.fsum(sixfold[a:b])) / (b - a)
            around = [z[a + (k + 1) % (b - a)] - z[a + k] for k in range(b - a)]
            edges += abs(mpmath.fsum((v / abs(v)) ** 6 for v in around))
        expected = float(psi / 60), float(edges / len(z))
    assert psi6(x)[0] == pytest.approx(expected[0], rel=1e-14)
    assert bond_order(x)[0] == pytest.approx(expected[1], rel=1e-13)


@pytest.mark.parametrize(
    ("name", "expected"),
    [("bnot-1024/bnot-1.txt", 0.432), ("step-1024/step-1.txt", 0.36), ("step-1024/step-2.txt", 0.35)],
)
def test_figures_of_psa(name: str, expected: float) -> None:
    digits = len(str(expected)) - 2
    assert bond_order(published(name))[0] == pytest.approx(expected, abs=0.51 * 10**-digits)


def test_random_points_as_psa_has_them() -> None:
    assert bond_order(np.random.default_rng(8).random((8, 1024, 2))).mean() == pytest.approx(0.36, abs=0.005)


def test_one_triangulation_serves_both() -> None:
    x = np.random.default_rng(9).random((2, 40, 2))
    made = neighbours(x)
    np.testing.assert_array_equal(bond_order(made), bond_order(x))
    np.testing.assert_array_equal(psi6(made), psi6(x))


@pytest.mark.parametrize("measure", [bond_order, psi6])
@pytest.mark.parametrize("d", [1, 3, 4])
def test_only_the_plane(measure, d: int) -> None:
    with pytest.raises(RefusalError, match=f"d *= *{d}"):
        measure(np.random.default_rng(10).random((20, d)))


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 2**32 - 1), st.integers(2, 100))
def test_order_does_not_know_the_origin_or_the_order_of_points(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    x = rng.random((n, 2))
    y = wrap(x + rng.random(2))[rng.permutation(n)]
    for measure in (bond_order, psi6):
        assert measure(x)[0] == pytest.approx(measure(y)[0], abs=1e-9)
        assert 0 <= measure(x)[0] <= 1 + 1e-12
