"""The gridded FFT against the product and long double, on scattered points and on hard ones."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.fft import next_fast_len

from gbnbench.analysis.precision import Precision, precision_of
from gbnbench.analysis.spectrum.evaluators.cube_product import cube_powers
from gbnbench.analysis.spectrum.evaluators.gridded_fft import bands as bands_module
from gbnbench.analysis.spectrum.evaluators.gridded_fft import host_transform
from gbnbench.analysis.spectrum.evaluators.gridded_fft import powers as powers_module
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import next_fast_length, real_grid, window_terms
from gbnbench.analysis.spectrum.evaluators.gridded_fft.powers import fft_powers
from gbnbench.analysis.spectrum.evaluators.kaiser_bessel import window
from gbnbench.analysis.spectrum.evaluators.kept_memory import forget
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.plan import plan
from gbnbench.core.errors import InputError
from gbnbench.generators.registry import generate
from tests.oracles.power import direct_power

UNIT = {"double": 2.0**-53, "float": 2.0**-24}


def on_grid(rng, shape):
    return rng.integers(0, 2**32, shape) / 2.0**32


def away(power, exact):
    return np.abs(np.sqrt(power) - np.sqrt(exact))


@pytest.fixture
def nothing_kept():
    """No kernels of other constants, before and after."""
    forget()
    yield
    forget()


@pytest.fixture(params=["scipy", "ducc0"])
def library(request, monkeypatch):
    """Each library of transforms in turn."""
    if request.param == "ducc0" and not host_transform.ducc_available():
        pytest.skip("ducc0 is not installed")
    monkeypatch.setattr(host_transform, "ducc_available", lambda: request.param == "ducc0")


def test_lengths_of_fast_transforms_are_those_of_scipy():
    for least in (*range(1, 3000), 10**6 + 1, 2**20, 2**20 + 1, 3**13 - 1):
        assert next_fast_length(least) == next_fast_len(least, real=True)


@pytest.mark.usefixtures("library")
@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize(
    ("n", "d", "fmax", "sets"),
    [
        *((1, 1, 1, 1), (50, 1, 700, 3), (300, 2, 40, 1), (1, 2, 12, 1), (57, 2, 12, 70), (4099, 2, 33, 2)),
        *((131, 3, 10, 3), (300, 2, 200, 1), (2000, 3, 20, 1), (5, 3, 1, 2)),
    ],
)
def test_it_is_the_two_group_product(n, d, fmax, sets, precision):
    x = on_grid(np.random.default_rng(n), (sets, n, d))
    exact, _ = cube_powers(precision_of("double"), x, fmax)
    power, errors = fft_powers(precision_of(precision), x, fmax)
    off = away(power, exact)
    assert off.max() <= errors.bound
    assert np.sqrt(np.mean(off**2)) <= 2 * errors.rms <= 16 * UNIT[precision]
    assert power[(fmax,) * d] == pytest.approx(n, rel=1e-15 if precision == "double" else 1e-6)
    assert np.array_equal(power, np.flip(power))
    half, _ = fft_powers(precision_of(precision), x, fmax, half=True)
    assert np.array_equal(half, power[fmax:])


@pytest.mark.parametrize("precision", ["double", "float"])
def test_transforms_of_all_lengths_in_the_plane(precision):
    """Radices 2, 3, 4, 5 and 8 in every order that comes up, for rows and for columns."""
    x = on_grid(np.random.default_rng(11), (2, 40, 2))
    p = precision_of(precision)
    for fmax in (*range(1, 31), 55, 100, 223):
        exact, _ = cube_powers(precision_of("double"), x, fmax)
        power, errors = fft_powers(p, x, fmax)
        assert away(power, exact).max() <= min(errors.bound, 200 * UNIT[precision])


def test_where_columns_do_not_fit_in_local_memory_a_library_transforms(monkeypatch):
    x = on_grid(np.random.default_rng(12), (2, 60, 2))
    p = precision_of("double")
    usual, _ = fft_powers(p, x, 37)
    monkeypatch.setitem(vars(p.runtime), "local_bytes", 1 << 10)
    other, _ = fft_powers(p, x, 39)
    exact, _ = cube_powers(p, x, 39)
    assert away(other, exact).max() <= 1e-14
    assert away(other[2:-2, 2:-2], usual).max() <= 1e-14


@pytest.mark.parametrize("weighting", ["shared", "own"])
@pytest.mark.parametrize("crowded", [False, True])
@pytest.mark.usefixtures("nothing_kept")
def test_weights_halves_and_single_sets(weighting, crowded, monkeypatch):
    if crowded:
        monkeypatch.setattr(bands_module, "CROWDED", 1)
        monkeypatch.setattr(bands_module, "RUN_SHARE", 100.0)
    rng = np.random.default_rng(1)
    p = precision_of("double")
    x = on_grid(rng, (5, 200, 2))
    w = rng.normal(size=(1 if weighting == "shared" else 5, 200))
    w[:, :3] = 0
    exact, _ = cube_powers(p, x, 20, w, mean=False)
    power, errors = fft_powers(p, x, 20, w, mean=False)
    assert away(power, exact).max() <= errors.bound
    assert np.sqrt(np.mean(away(power, exact) ** 2)) <= 1e-15
    half, _ = fft_powers(p, x, 20, w, half=True)
    assert half == pytest.approx(exact.mean(axis=0)[20:], rel=1e-9, abs=1e-13)


def test_against_long_double_at_the_edge_of_the_cube():
    x = np.random.default_rng(2).random((1, 1500, 2))
    power, errors = fft_powers(precision_of("double"), x, 50)
    rng = np.random.default_rng(3)
    f = np.column_stack([rng.choice([-50, -49, 50], 40), rng.integers(-50, 51, 40)])
    off = away(power[f[:, 0] + 50, f[:, 1] + 50], direct_power(x[0], f))
    assert np.sqrt(np.mean(off**2)) <= 1.5e-15
    assert errors.rms <= 1e-15


def test_many_points_to_a_node_cost_no_digits():
    """Runs leave out their mean, so that what is rounded is the noise and not the density."""
    n = 100_000
    x = on_grid(np.random.default_rng(4), (1, n, 2))
    p = precision_of("double")
    exact, _ = cube_powers(p, x, 16)
    power, errors = fft_powers(p, x, 16)
    off = away(power, exact)
    off[16, 16] = 0
    assert np.sqrt(np.mean(off**2)) <= 1e-15
    assert errors.rms <= 1e-15


@pytest.mark.parametrize("d", [1, 2, 3])
@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize("kind", ["coincident", "pairs", "cluster", "line", "lattice", "seam"])
def test_hard_sets_stay_within_their_bound(d, precision, kind):
    rng = np.random.default_rng(d)
    n, fmax = 1728 if d == 3 else 1600, {1: 400, 2: 30, 3: 7}[d]
    side = round(n ** (1 / d))
    x = {
        "coincident": np.repeat(rng.random((1, d)), n, axis=0),
        "pairs": np.repeat(rng.random((n // 2, d)), 2, axis=0),
        "cluster": (0.3 + 1e-3 * rng.normal(size=(n, d))) % 1,
        "line": np.column_stack([rng.random(n), np.full((n, d - 1), 0.3)]),
        "lattice": np.stack(np.meshgrid(*[np.arange(side) / side] * d), axis=-1).reshape(-1, d),
        "seam": rng.choice([0, 1 - 2.0**-32, 2.0**-30, 0.5], (n, d)),
    }[kind]
    x = np.rint(x * 2.0**32) / 2.0**32 % 1
    exact, other = cube_powers(precision_of("double"), x[None], fmax)
    power, errors = fft_powers(precision_of(precision), x[None], fmax)
    assert away(power, exact).max() <= errors.bound + other.bound
    if kind == "coincident":
        assert errors.bound <= 100 * away(power, exact).max()


def test_crowded_sets_go_to_the_product():
    rng = np.random.default_rng(5)
    x = rng.random((4096, 2))
    assert periodogram(x, 64).method == "fft"
    clump = x.copy()
    clump[:1000] = x[0]
    assert periodogram(clump, 64).method == "product"
    assert periodogram(clump, 64, method="fft").method == "fft"
    assert periodogram(clump, 64, floor=1e-20).method == "fft"  # which its errors still resolve
    assert periodogram(clump, 64, floor=1e-25).method == "product"


def test_deep_powers_are_read_as_by_the_product():
    """The floor of a deep set, 4e-21, and the least powers of a stealthy one, 1e-29."""
    for name, low in (("deep", 6.0), ("stealthy", 6.0)):
        x = generate(name, n=256, d=2, seed=1)
        f = np.indices((41, 41)).reshape(2, -1).T - 20
        near = (f**2).sum(axis=1) <= low**2
        near &= f.any(axis=1)
        exact = np.asarray(direct_power(x, f[near]), float)
        spectrum = periodogram(x, 20, method="fft")
        off = away(spectrum.power.ravel()[near], exact)
        assert np.sqrt(np.mean(off**2)) <= 1e-15


@pytest.mark.usefixtures("nothing_kept")
def test_bands_and_batches_change_nothing_but_rounding(monkeypatch):
    rng = np.random.default_rng(6)
    p = precision_of("double")
    for d, fmax in ((2, 60), (3, 12)):
        x = on_grid(rng, (3, 900, d))
        usual, errors = fft_powers(p, x, fmax, mean=False)
        with monkeypatch.context() as patch:
            patch.setattr(bands_module, "DIVIDED_FROM", 0)
            patch.setattr(bands_module, "CACHE_BYTES", 1 << 10)
            patch.setattr(bands_module, "BAND_ROWS", 32)
            patch.setattr(powers_module, "BATCH_BYTES", 1)
            forget()
            divided, _ = fft_powers(p, x, fmax, mean=False)
            forget()
        assert away(divided, usual).max() <= 1e-13 <= errors.bound


def test_other_widths_of_vectors_give_the_same():
    p = precision_of("double")
    x = on_grid(np.random.default_rng(7), (2, 300, 2))
    usual, _ = fft_powers(p, x, 20)
    assert away(fft_powers(Precision(p.runtime, True, 1), x, 20)[0], usual).max() <= 1e-14


@pytest.mark.parametrize("precision", ["double", "float"])
def test_the_halves_of_the_window_are_its_polynomials(precision):
    grid = real_grid(2, 10, precision)
    shape, terms = grid.window, window_terms(precision)
    place = np.array([0.0, 0.25, 0.9])
    s = place[:, None] - 0.5
    half = shape.width // 2
    even, odd = (np.polynomial.polynomial.polyval(s[:, 0] ** 2, part[::-1]).T for part in
                 (terms[:, :half], terms[:, half:]))  # fmt: skip
    exact = shape.values(place)
    assert (even + odd * s) == pytest.approx(exact[:, :half], abs=1e-15)
    assert (even - odd * s)[:, ::-1] == pytest.approx(exact[:, half:], abs=1e-15)
    assert window(shape.width, shape.degree).left_out < shape.left_out * 10


def test_what_it_does_not_serve_is_said():
    x = np.random.default_rng(9).random((20, 4))
    with pytest.raises(InputError, match="up to 3 dimensions; got d=4"):
        periodogram(x, 3, method="fft")
    assert plan(1024, 2, 64).method == "fft"
    assert plan(1024, 4, 4).method != "fft"
