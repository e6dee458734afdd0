"""Discrepancies against exact fractions, integers and closed forms: the stated error always holds."""

from __future__ import annotations

import itertools
import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import qmc

from gbnbench.analysis.precision import Precision, double_device
from gbnbench.analysis.spatial import discrepancy, discrepancy_pairs
from gbnbench.analysis.spatial.discrepancy import discrepancies, measure_discrepancies
from gbnbench.analysis.spatial.discrepancy_kernels import KERNELS
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import wrap
from gbnbench.opencl import Runtime
from tests.oracles.discrepancy import diaphony_square, dyadic_squares, lattice_square, squares

SCIPYS = ("CD", "WD", "MD", "L2-star")
LAST = 1 - 2.0**-53  # the largest double below 1


def distance(value: float, square: Fraction | mpmath.mpf, rooted: bool) -> float:
    """|value - exact| in 40 digits."""
    with mpmath.workdps(40):
        exact = mpmath.mpf(square.numerator) / square.denominator if isinstance(square, Fraction) else square
        return float(abs(value - (mpmath.sqrt(exact) if rooted else exact)))


def assert_within_stated_errors(x: np.ndarray, exact: dict[str, Fraction | mpmath.mpf]) -> None:
    found = measure_discrepancies(x, list(exact))
    for kind, square in exact.items():
        one = found[kind]
        assert one.reasons == ("",), kind
        assert distance(one.value[0], square, KERNELS[kind].rooted) <= one.error[0], kind
        assert one.error[0] < 1e-4 * one.value[0], kind


def hard_sets() -> dict[str, np.ndarray]:
    rng = np.random.default_rng(7)
    grid = np.stack(np.meshgrid(*[(np.arange(5) + 0.5) / 5] * 2), -1).reshape(-1, 2)
    return {
        "one point": np.array([[0.3]]),
        "line": rng.random((23, 1)),
        "plane": rng.random((14, 2)),
        "five axes": rng.random((9, 5)),
        "twenty axes": rng.random((5, 20)),
        "coincident": np.full((6, 2), 0.7),
        "coincident on the line": np.full((6, 1), 0.1),
        "cluster": 0.25 + 1e-9 * rng.random((15, 2)),
        "cluster on the line": 0.75 + 1e-12 * rng.random((15, 1)),
        "corners": np.array(list(itertools.product([0.0, LAST], repeat=2))),
        "far corner": np.full((3, 2), LAST),
        "tiny coordinates": 1e-300 * rng.random((4, 2)),
        "grid": grid,
        "grid moved by a rounding": wrap(grid + 1e-16 * rng.standard_normal(grid.shape)),
        "line grid, moved": wrap((np.arange(40)[:, None] + 0.9) / 40),
    }


@pytest.mark.parametrize("name", hard_sets())
def test_errors_hold_against_exact_fractions(name: str) -> None:
    x = hard_sets()[name]
    assert_within_stated_errors(x, {**squares(x), "diaphony": diaphony_square(x)})


@pytest.mark.parametrize("name", [name for name, x in hard_sets().items() if x.shape[1] == 2])
def test_divide_and_conquer_s_errors_hold_against_exact_fractions(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(discrepancy, "PLANE_FROM", 1)
    x = hard_sets()[name]
    assert measure_discrepancies(x, ["CD"])["CD"].method == "divide and conquer"
    assert_within_stated_errors(x, {**squares(x), "diaphony": diaphony_square(x)})


def test_divide_and_conquer_counts_every_pair_once_among_many_ties(monkeypatch: pytest.MonkeyPatch) -> None:
    numerators = np.random.default_rng(2).integers(0, 32, (1500, 2))
    exact = dyadic_squares(numerators, 5)
    monkeypatch.setattr(discrepancy, "PLANE_FROM", 1)
    assert_within_stated_errors(numerators / 32, exact)


def test_a_large_lattice_of_the_plane_has_its_exact_value() -> None:
    n = 75_025
    x = np.stack([np.arange(n), np.arange(n) * 46_368 % n], axis=1) / n
    exact = {"WD": lattice_square(n, (1, 46_368), Fraction(3, 2))}
    assert_within_stated_errors(x, exact)
    assert discrepancies(x, ["WD"])["WD"][0] == pytest.approx(float(exact["WD"]), rel=1e-6, abs=0)


def test_errors_hold_for_several_blocks_against_exact_integers() -> None:
    numerators = np.random.default_rng(1).integers(0, 256, (2600, 2))
    assert_within_stated_errors(numerators / 256, dyadic_squares(numerators, 8))


@pytest.mark.parametrize("n", [16_384, 20_000, 99_991, 200_000])
def test_centred_grids_of_the_line_have_their_closed_forms(n: int) -> None:
    found = discrepancies((np.arange(n)[:, None] + 0.5) / n)
    expected = {"WD": 1 / (6 * n**2), "CD": 1 / (12 * n**2), "MD": 1 / (8 * n**2)}
    roots = {"L2-star": 1 / 12, "L2-periodic": 1 / 6, "diaphony": math.pi**2 / 3}
    expected |= {kind: math.sqrt(square) / n for kind, square in roots.items()}
    for kind, value in expected.items():
        assert found[kind][0] == pytest.approx(value, rel=1e-13, abs=0)  # type: ignore[index]


@pytest.mark.parametrize(
    ("n", "generator"), [(610, (1, 377)), (4001, (1, 1478, 2000)), (17_711, (1, 10_946))]
)
def test_lattices_have_their_exact_values(n: int, generator: tuple[int, ...]) -> None:
    x = (np.arange(n)[:, None] * np.array(generator) % n) / n
    exact = {
        "WD": lattice_square(n, generator, Fraction(3, 2)),
        "L2-periodic": lattice_square(n, generator, Fraction(1, 2)),
    }
    assert_within_stated_errors(x, exact)
    found = discrepancies(x, ["WD", "L2-periodic"])
    assert found["WD"][0] == pytest.approx(float(exact["WD"]), rel=1e-7, abs=0)
    assert found["L2-periodic"][0] ** 2 == pytest.approx(float(exact["L2-periodic"]), rel=1e-7, abs=0)


@pytest.mark.parametrize(("n", "d"), [(1, 1), (9, 1), (20, 2), (15, 5), (40, 12)])
def test_agrees_with_scipy_where_scipy_keeps_its_digits(n: int, d: int) -> None:
    x = np.random.default_rng(n).random((2, n, d))
    found = discrepancies(x)
    assert list(found) == [*SCIPYS, "L2-periodic", "diaphony"]
    for k, kind in itertools.product(range(2), SCIPYS):
        assert found[kind][k] == pytest.approx(qmc.discrepancy(x[k], method=kind), rel=1e-10, abs=0)  # type: ignore[index]


def test_wrap_around_is_the_sum_of_periodic_squares_over_projections() -> None:
    x = np.random.default_rng(3).random((57, 3))
    parts = [
        discrepancies(x[:, axes], ["L2-periodic"])["L2-periodic"][0] ** 2
        for size in (1, 2, 3)
        for axes in itertools.combinations(range(3), size)
    ]
    assert discrepancies(x, ["WD"])["WD"][0] == pytest.approx(math.fsum(parts), rel=1e-11, abs=0)


def test_diaphony_is_its_series_over_frequencies() -> None:
    x = np.random.default_rng(4).random((12, 1))
    f = np.arange(1, 200_001)
    amplitude = np.exp(-2j * math.pi * f[:, None] * x[:, 0]).mean(axis=1)
    series = 2 * np.sum(np.abs(amplitude) ** 2 / f**2)
    # The rest of the series is some 2 / (n 200,000).
    assert discrepancies(x, ["diaphony"])["diaphony"][0] ** 2 == pytest.approx(series, abs=2e-6)


def test_a_gpu_s_groups_and_numpy_agree_with_vectors(monkeypatch: pytest.MonkeyPatch) -> None:
    here = double_device()
    if here is None:
        pytest.skip("no OpenCL device of double precision")
    monkeypatch.setattr(discrepancy_pairs, "COLUMNS", 256)
    for n, d in ((701, 2), (130, 3)):
        x = np.random.default_rng(n).random((n, d))
        vectors = measure_discrepancies(x)
        with monkeypatch.context() as without:
            without.setattr(discrepancy_pairs, "double_device", lambda: None)
            plain = measure_discrepancies(x)
        with monkeypatch.context() as gpu:
            gpu.setattr(Runtime, "group", 64)
            gpu.setattr(discrepancy_pairs, "double_device", lambda: Precision(here.runtime, True, 1))
            scalars = measure_discrepancies(x)
        for kind, one in vectors.items():
            assert plain[kind].value == pytest.approx(one.value, rel=0, abs=2 * one.error[0])
            assert scalars[kind].value == pytest.approx(one.value, rel=0, abs=2 * one.error[0])


def test_too_many_points_are_refused_before_the_sum_with_the_cost() -> None:
    with pytest.raises(RefusalError, match="at most 115470, got n=200000: some 16 seconds"):
        discrepancies(np.full((200_000, 3), 0.5))
    with pytest.raises(RefusalError, match="at most 4194304; got n=5000000: some 50 seconds of one core"):
        discrepancies(np.full((5_000_000, 2), 0.5))


def test_an_unknown_kind_is_named() -> None:
    with pytest.raises(InputError, match="got 'AD'"):
        discrepancies([[0.5]], ["AD"])  # type: ignore[list-item]


def test_a_value_below_its_error_is_nan_with_the_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    x = np.random.default_rng(0).random((2, 8, 2))
    monkeypatch.setattr(discrepancy, "WORST_ERROR", 1e-20)
    found = measure_discrepancies(x, ["CD"])["CD"]
    assert np.isnan(found.value).all()
    assert np.isnan(found.error).all()
    assert all("CD: its square, 0." in reason and "known to" in reason for reason in found.reasons)


def test_dimensions_beyond_the_range_of_double_are_nan_with_the_reason() -> None:
    found = measure_discrepancies(np.random.default_rng(0).random((3, 2000)))
    for one in found.values():
        assert np.isnan(one.value).all()
        assert "beyond the range of double precision" in one.reasons[0]


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.integers(1, 4))
def test_those_of_the_torus_do_not_know_the_origin_and_none_knows_the_order(
    seed: int, n: int, d: int
) -> None:
    rng = np.random.default_rng(seed)
    x = rng.random((n, d))
    moved = discrepancies(wrap(x + rng.random(d)), ["WD", "L2-periodic", "diaphony"])
    permuted, here = discrepancies(rng.permutation(x)), discrepancies(x)
    for kind, value in moved.items():
        assert value[0] == pytest.approx(here[kind][0], rel=1e-10, abs=0)
    for kind, value in here.items():
        assert permuted[kind][0] == pytest.approx(value[0], rel=1e-10, abs=0)
