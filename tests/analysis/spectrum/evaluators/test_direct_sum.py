"""Listed frequencies of any 64 bits against long double sums over exact phases."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.precision import Precision, precision_of
from gbnbench.analysis.spectrum.evaluators.direct_sum import listed_power, run_length
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.errors import InputError
from gbnbench.opencl import runtime
from tests.devices import gpu_form
from tests.oracles.power import mean_power, on_grid, root_distance

FORMS = {
    "double": lambda: precision_of("double"),
    "float": lambda: precision_of("float"),
    "gpu, double": lambda: gpu_form(True),
    "gpu, float": lambda: gpu_form(False),
    "gpu, float sums": lambda: gpu_form(False, has_double=False),
    "one lane": lambda: Precision(runtime(), True, 1),
    "four floats": lambda: Precision(runtime(), False, 4),
}
TYPICAL = {"double": 1e-15, "float": 1e-6}


def check(p, x, f, weights=None, scattered=True):
    w = None if weights is None else np.atleast_2d(weights)
    power, errors = listed_power(p, x, f, w)
    met = root_distance(power, mean_power(x, f, weights))
    assert met.max() <= errors.bound
    assert not scattered or np.sqrt(np.mean(met**2)) <= max(TYPICAL[p.name], 3 * errors.rms)
    return power, errors


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(
    ("n", "d", "m"), [(1, 1, 1), (2, 3, 5), (3, 2, 64), (7, 1, 65), (300, 2, 130), (1025, 4, 9)]
)
def test_every_form_of_the_kernel(form, n, d, m):
    rng = np.random.default_rng(n)
    f = rng.integers(-100, 101, (m, d))
    x, weights = on_grid((3, n, d), n), rng.standard_normal((3, n))
    weights /= np.abs(weights).max(axis=1, keepdims=True)
    check(FORMS[form](), x, f)
    check(FORMS[form](), x, f, weights)
    check(FORMS[form](), x, f, weights[0])


@pytest.mark.parametrize("bits", [20, 40, 62])
@pytest.mark.parametrize("form", ["double", "gpu, double"])
def test_phases_of_any_integer_are_exact_in_double(form, bits):
    f = np.random.default_rng(bits).integers(-(2**bits), 2**bits, (30, 3))
    f[:3] = [[-(2**63), 2**63 - 1, 0], [2**63 - 1] * 3, [-(2**63)] * 3]
    _, errors = check(FORMS[form](), on_grid((1, 200, 3), bits), f)
    assert errors.bound < 1e-12


@pytest.mark.parametrize("form", ["float", "gpu, float", "gpu, float sums"])
def test_phases_of_any_integer_are_exact_in_float_of_coordinates_that_are(form):
    x = np.random.default_rng(1).integers(0, 2**32, (1, 200, 3)) / 2.0**32
    f = np.random.default_rng(2).integers(-(2**62), 2**62, (30, 3))
    f[:2] = [[-(2**63), 2**63 - 1, 0], [2**63 - 1] * 3]
    _, errors = check(FORMS[form](), x, f)
    assert errors.bound < 1e-3


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("m", [1, 3])
def test_few_frequencies_are_split_over_points(form, m):
    p, n = FORMS[form](), 30_001
    assert run_length(p, m, n) < n
    x = on_grid((1, n, 2), m)
    x[0, ::3] = x[0, 0]  # sums are large
    check(p, x, np.array([[5, -3], [0, 0], [1, 40]])[:m], np.random.default_rng(m).random(n), scattered=False)


def test_one_frequency_of_many_points():
    x = on_grid((1, 100_000, 3), 4)
    for precision in ("double", "float"):
        _, errors = check(precision_of(precision), x, np.array([[1, 2, -300]]))
        assert errors.rms < {"double": 5e-16, "float": 2e-6}[precision]


@pytest.mark.parametrize("m", [1, 2, 31, 1000])
@pytest.mark.parametrize("n", [1, 5, 127, 4096, 100_001])
def test_a_run_is_whole_vectors_and_no_shorter_than_a_sum_in_registers(m, n):
    for form in ("double", "gpu, float"):
        p = FORMS[form]()
        length = run_length(p, m, n)
        assert length % p.lanes == 0
        assert length >= min(n, p.sum_points * p.lanes // 2)
        assert length < n + p.lanes


def test_zero_one_and_the_mirror_image():
    x = on_grid((2, 57, 2), 5)
    f = np.array([[0, 0], [4, -9], [-4, 9], [4, -9]])
    power = periodogram(x, frequencies=f).power
    assert power[0] == 57
    assert power[1] == power[2] == power[3]
    one = periodogram(x[0, :1], frequencies=f).power
    assert np.allclose(one, 1, rtol=1e-15)


@pytest.mark.parametrize("dtype", [np.int8, np.uint16, np.int32, np.uint64, np.float64, np.float32])
def test_integers_of_any_type_are_taken(dtype):
    x, f = on_grid((40, 2), 6), np.array([[1, 2], [100, 3]])
    assert np.array_equal(
        periodogram(x, frequencies=f.astype(dtype)).power, periodogram(x, frequencies=f).power
    )


@pytest.mark.parametrize(
    "f",
    [
        *([[2**63, 1]], [[2**64, 1]], [[1.5, 0]], [[np.nan, 0]], [[np.inf, 0]]),
        *([[True, False]], [["a", "b"]], [[]], []),
    ],
)
def test_what_is_no_list_of_integers_is_refused(f):
    with pytest.raises(InputError, match="frequencies must be"):
        periodogram([[0.5, 0.25]], frequencies=f)


def test_weights_in_a_list_agree_with_a_cube():
    x, weights = on_grid((2, 90, 2), 7), np.random.default_rng(8).random((2, 90))
    cube = periodogram(x, 6, weights=weights)
    f = np.indices((13, 13)).reshape(2, -1).T - 6
    listed = periodogram(x, frequencies=f, weights=weights)
    assert np.allclose(np.sqrt(listed.power), np.sqrt(cube.power.ravel()), atol=1e-14)
    assert listed.weighted
    assert cube.weighted
    assert listed.fmax == 6
    assert np.array_equal(listed.frequencies, f)
