"""Radial and scalar measures on tori with unequal sides."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.measures import analyse, measures
from gbnbench.analysis.radial.anisotropy import anisotropy, anisotropy_db
from gbnbench.analysis.radial.profile_measures import evacuated_energy
from gbnbench.analysis.radial.projections import projections
from gbnbench.analysis.radial.psa import spectral_statistics
from gbnbench.analysis.radial.radial_power import radial, shells_of
from gbnbench.analysis.spectrum.box_shells import pooled
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.core.errors import InputError, RefusalError
from tests.oracles.power import direct_power
from tests.oracles.stretched import darts, hexagonal_rectangle, repeated

BOXES = [(2, 1), (1, 3), (math.sqrt(3), 1), (12, 1), (1, 2, 1), (1, 1.3, 0.6)]


def wave_vectors(sides: tuple[float, ...], radius: float) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies 0 < |k| <= radius of a box of volume 1, and their |k|, by enumeration."""
    box = np.array(sides) / math.prod(sides) ** (1 / len(sides))
    largest = [math.floor(radius * side) for side in box]
    f = np.stack(np.meshgrid(*(np.arange(-m, m + 1) for m in largest), indexing="ij"), -1)
    f = f.reshape(-1, len(sides))
    k = np.sqrt(((f / box) ** 2).sum(axis=1))
    inside = (k > 0) & (k <= radius)
    return f[inside], k[inside]


@pytest.mark.parametrize("sides", BOXES)
@pytest.mark.parametrize("sets", [1, 10])
def test_uniform_points_are_isotropic_in_every_box(sides: tuple[float, ...], sets: int) -> None:
    d, n = len(sides), 120
    found = []
    for x in np.random.default_rng(11).random((20, sets, n, d)):
        spectrum = periodogram(x, math.ceil(n ** (1 / d)) + 1, sides=sides)
        groups = pooled(shells_of(spectrum), d)
        found.append(anisotropy_db(spectrum.power, groups, sets, spectrum.spacing))
    error = np.std(found, ddof=1) / math.sqrt(len(found))
    # The mean of a logarithm, and of powers of 120 points, which are not quite exponentially distributed.
    assert abs(np.mean(found) + 10 * math.log10(sets)) < 4 * error + 0.1


@pytest.mark.slow
def test_a_rectangle_called_a_square_shows_anisotropy_and_none_when_its_sides_are_told() -> None:
    n, sets = 300, 12
    x = np.stack(
        [darts((2**0.5, 0.5**0.5), n, 0.68 * math.sqrt(2 / math.sqrt(3) / n), k) for k in range(sets)]
    )
    told, square = measures(x, sides=(200, 100)), measures(x)
    assert abs(told["anisotropy_db"] + 10 * math.log10(sets)) < 4 * told.standard_error["anisotropy_db"]
    assert square["anisotropy_db"] > told["anisotropy_db"] + 4
    assert told["min_distance"] >= 0.68
    assert square["min_distance"] < 0.55
    # The same process on the square.
    plain = measures(
        np.stack([darts((1, 1), n, 0.68 * math.sqrt(2 / math.sqrt(3) / n), k) for k in range(sets)])
    )
    for name in ("noise_floor", "peak", "mean_distance", "psi6", "valence6", "oscillations", "bond_order"):
        error = math.hypot(told.standard_error[name], plain.standard_error[name])
        assert abs(told[name] - plain[name]) < 5 * error, name


@pytest.mark.parametrize("sides", BOXES)
def test_scalars_of_frequencies_are_what_their_definitions_say(sides: tuple[float, ...]) -> None:
    d, n = len(sides), 60
    x = np.random.default_rng(4).random((n, d))
    found = measures(x, sides=sides)
    f, k = wave_vectors(sides, 2 * n ** (1 / d))
    nu, power = k * n ** (-1 / d), direct_power(x, f)
    lowest = k <= k.min() * (1 + 1e-12)
    floor = nu <= 0.25 if (nu <= 0.25).any() else lowest
    assert found["noise_floor"] == pytest.approx(power[floor].mean(), rel=1e-10)
    assert found["power_at_1"] == pytest.approx(power[lowest].mean(), rel=1e-10)
    low = power[(nu < 1 - 1e-9) & (power < 1)]
    assert found["evacuated_energy"] == pytest.approx(-np.log(low).sum() / n, rel=1e-10)
    ring = np.rint(k)
    means = {
        j: power[ring == j].mean() for j in np.unique(ring) if 0.5 <= j * n ** (-1 / d) <= 2 - n ** (-1 / d)
    }
    assert found["peak"] >= max(means.values()) * (1 - 1e-10)


@pytest.mark.parametrize("sides", [(2, 1), (1, 3), (1, 2, 1)])
def test_a_cube_told_its_sides_later_has_the_same_shells(sides: tuple[float, ...]) -> None:
    x = np.random.default_rng(4).random((2, 60, len(sides)))
    box = periodogram(x, 6, sides=sides)
    cube = periodogram(x, max(box.harmonics))
    for by in ("shells", "annuli", "pooled"):
        told, made = radial(cube, by=by, sides=sides), radial(box, by=by)
        shared = min(len(told.count), len(made.count)) - 1  # the last may be cut or hold a remainder
        np.testing.assert_array_equal(told.count[:shared], made.count[:shared])
        np.testing.assert_allclose(told.power[:shared], made.power[:shared], rtol=1e-11)
        np.testing.assert_allclose(told.frequency[:shared], made.frequency[:shared], rtol=1e-13)
    longest = max(sides) / math.prod(sides) ** (1 / len(sides))
    assert radial(cube, sides=sides).frequency[-1] <= max(box.harmonics) / longest * (1 + 1e-12)
    assert radial(box, sides=sides).power.tolist() == radial(box).power.tolist()


def test_shells_and_the_cube_have_the_same_anisotropy_and_pools() -> None:
    x = np.random.default_rng(4).random((2, 60, 2))
    box, streamed = periodogram(x, 12, sides=(3, 1)), shells(x, 12, sides=(3, 1))
    np.testing.assert_allclose(anisotropy(box), anisotropy(streamed), rtol=1e-9)
    np.testing.assert_allclose(
        radial(box, by="pooled").power, radial(streamed, by="pooled").power, rtol=1e-10
    )


def test_the_hexagonal_lattice_of_a_rectangle_has_one_first_shell() -> None:
    x, sides = hexagonal_rectangle(6, 4), (6, 4 * math.sqrt(3))
    found = radial(periodogram(x, 10, sides=sides))
    peak = np.flatnonzero(found.power > 1)[0]
    # Six reciprocal vectors at nu = 1 / (row distance over spacing) = sqrt(2 / sqrt(3)), each with P = n.
    assert found.nu[peak] == pytest.approx(math.sqrt(2 / math.sqrt(3)), rel=1e-12)
    assert found.power[peak] * found.count[peak] == pytest.approx(6 * len(x), rel=1e-10)
    told = measures(x, sides=sides)
    assert told["psi6"] == pytest.approx(1, abs=1e-9)
    assert told["valence6"] == 1
    assert told["min_distance"] == pytest.approx(1, rel=1e-12)


def test_equal_sides_change_no_bit() -> None:
    x = np.random.default_rng(4).random((2, 100, 2))
    plain, told = measures(x), measures(x, sides=(7.0, 7.0))
    assert np.array_equal(list(plain.values()), list(told.values()), equal_nan=True)
    assert plain.standard_error == told.standard_error or plain.reasons == told.reasons
    assert np.array_equal(shells(x, 5).deviation, shells(x, 5, sides=(2, 2)).deviation)
    assert np.array_equal(radial(periodogram(x, 5), sides=(3, 3)).power, radial(periodogram(x, 5)).power)


def test_discrepancies_do_not_change() -> None:
    x = np.random.default_rng(4).random((2, 100, 2))
    plain, told = measures(x), measures(x, sides=(3, 1))
    for name in ("discrepancy_wd", "discrepancy_star"):
        assert plain[name] == told[name]


def test_an_analysis_holds_the_box() -> None:
    x = np.random.default_rng(4).random((2, 100, 2))
    found = analyse(x, sides=(2, 1))
    assert found.spectrum.sides is not None
    assert found.spectrum.harmonics[0] > found.spectrum.harmonics[1]
    assert found.radial.count.min() >= 8
    assert found.warnings == ()


def test_points_kept_from_the_border_are_warned_of_in_a_rectangle_too() -> None:
    x = 0.1 + 0.8 * np.random.default_rng(0).random((10, 500, 2))
    assert "not toroidal?" in analyse(x, sides=(3, 1)).warnings[0]


def test_a_projection_has_the_sides_of_its_axes() -> None:
    x = np.random.default_rng(4).random((3, 80, 3))
    both, alone = projections(x, [(0, 2), (1,)], sides=(2, 5, 1))
    assert both.noise_floor == pytest.approx(
        np.mean([measures(one[:, [0, 2]], sides=(2, 1))["noise_floor"] for one in x]), rel=1e-12
    )
    assert alone.noise_floor == projections(x, [(1,)])[0].noise_floor


def test_psa_statistics_are_refused_where_their_disc_does_not_fit() -> None:
    x = np.random.default_rng(4).random((100, 2))
    assert spectral_statistics(x, (3.9, 1)).effective_nyquist >= 0
    with pytest.raises(RefusalError, match=r"half the shorter side is 0\.224"):
        spectral_statistics(x, (5, 1))
    found = measures(x, sides=(5, 1))
    assert math.isnan(found["oscillations"])
    assert "four times the other" in found.reasons["oscillations"]


def test_distances_of_repeated_sets_are_those_of_one() -> None:
    x = np.random.default_rng(4).random((2, 60, 2))
    one, long = measures(x), measures(repeated(x, (3, 1)), sides=(3, 1))
    for name in ("min_distance", "mean_distance", "psi6", "bond_order", "valence6"):
        assert long[name] == pytest.approx(one[name], rel=1e-11), name


def test_evacuated_energy_needs_the_whole_disc() -> None:
    x = np.random.default_rng(4).random((100, 2))
    spectrum = periodogram(x, 9, sides=(2, 1))
    with pytest.raises(RefusalError, match="fmax >= 10, here 9"):
        evacuated_energy(spectrum.power, 100, 2, 9, spectrum.sides)


def test_bad_requests_are_refused() -> None:
    x = np.random.default_rng(0).random((20, 2))
    box = periodogram(x, 4, sides=(2, 1))
    for call, says in (
        (lambda: radial(box, sides=(3, 1)), "evaluated for sides 2:1"),
        (lambda: radial(box, by="digits"), "equal digits"),
        (lambda: radial(shells(x, 4), sides=(2, 1)), "shells are of one torus"),
        (lambda: measures(x, sides=(2, 1, 1)), "sides must be 2 lengths"),
        (lambda: measures(x, sides=(2, 0)), "positive"),
    ):
        with pytest.raises(InputError, match=says):
            call()


@pytest.mark.slow
@pytest.mark.parametrize(("n", "d"), [(64, 20), (128, 9)])
def test_many_dimensions_list_the_ball_as_far_as_it_goes(n: int, d: int) -> None:
    x = np.random.default_rng(4).random((2, n, d))
    sides = (3, *(1,) * (d - 1))
    found = measures(x, sides=sides)
    f = np.zeros((1, d), int)
    f[0, 0] = 1  # the longest side alone has the lowest |k|
    assert found["power_at_1"] == pytest.approx(np.mean([direct_power(one, f) for one in x]), rel=1e-10)
    assert found["noise_floor"] == found["power_at_1"]
    assert abs(found["anisotropy_db"] + 10 * math.log10(2)) < 1
