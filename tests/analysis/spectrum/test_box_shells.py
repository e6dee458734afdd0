"""Spectra of tori with unequal sides: boxes against direct sums, shells against exact fractions."""

from __future__ import annotations

import math
from collections import Counter
from fractions import Fraction
from itertools import product

import numpy as np
import pytest

from gbnbench.analysis.radial.radial_power import shells_from_cube
from gbnbench.analysis.spectrum import ball_power
from gbnbench.analysis.spectrum.box_shells import (
    box_annuli,
    box_shells,
    harmonics_within,
    pooled,
    pooled_spectrum,
)
from gbnbench.analysis.spectrum.limits import default_radius
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.core.errors import InputError
from gbnbench.core.sides import as_sides, wave_numbers
from tests.oracles.power import direct_power
from tests.oracles.stretched import repeated


def box_of(harmonics: tuple[int, ...]) -> np.ndarray:
    """Frequencies of a box, in the order of its flattened powers."""
    return np.array(list(product(*(range(-f, f + 1) for f in harmonics))))


@pytest.mark.parametrize("half", [False, True])
@pytest.mark.parametrize(
    ("sides", "fmax"), [((2, 1), 6), ((1, 9), 4), ((math.sqrt(3), 1), 5), ((1, 2, 1.5), 3), ((30, 1), 4)]
)
def test_a_box_against_direct_sums(sides: tuple[float, ...], fmax: int, half: bool) -> None:
    d = len(sides)
    x = np.random.default_rng(d).random((2, 30, d))
    found = periodogram(x, fmax, sides=sides, half=half)
    box = np.array(sides) / math.prod(sides) ** (1 / d)
    assert found.harmonics == tuple(math.floor(fmax * side + 1e-9) for side in box)
    assert found.fmax == fmax
    expected = np.mean([direct_power(one, box_of(found.harmonics)) for one in x], axis=0)
    np.testing.assert_allclose(found.whole().power.ravel(), expected, atol=1e-12)


@pytest.mark.parametrize("half", [False, True])
@pytest.mark.parametrize("method", ["gridded", "numpy", "product"])
def test_every_method_gives_the_same_box(method: str, half: bool) -> None:
    x = np.random.default_rng(3).random((2, 200, 2))
    expected = periodogram(x, 20, sides=(1, 3)).power
    found = periodogram(x, 20, sides=(1, 3), method=method, half=half)  # type: ignore[arg-type]
    assert found.method == method
    np.testing.assert_allclose(found.whole().power, expected, atol=1e-11)


@pytest.mark.parametrize("times", [(2, 1), (1, 5), (3, 2), (2, 1, 1), (1, 2, 3)])
def test_repeated_sets_have_the_power_of_one_at_its_frequencies_and_none_between(
    times: tuple[int, ...],
) -> None:
    d, copies = len(times), math.prod(times)
    x = np.random.default_rng(1).random((2, 40, d))
    # Cycles per side of the short torus, which is copies^(-1/d) of the long one's unit.
    fmax = math.ceil(4 * copies ** (1 / d))
    long = periodogram(repeated(x, times), fmax, sides=times)
    f = box_of(long.harmonics)
    own = (f % times == 0).all(axis=1)
    short = np.mean([direct_power(one, f[own] // times) for one in x], axis=0)
    np.testing.assert_allclose(long.power.ravel()[own], copies * short, atol=1e-11)
    np.testing.assert_allclose(long.power.ravel()[~own], 0, atol=1e-24)


@pytest.mark.parametrize("squares", [(4, 1), (1, 3), (2, 5), (1, 2, 3), (9, 4, 4)])
def test_shells_are_those_of_exact_fractions(squares: tuple[int, ...]) -> None:
    """Sides sqrt(squares): |k|^2 is a fraction, up to a factor that all frequencies share."""
    d, radius = len(squares), {2: 9.0, 3: 5.0}[len(squares)]
    sides = as_sides(np.sqrt(squares), d)
    assert sides is not None
    harmonics = harmonics_within(radius, sides)
    shared = math.prod(squares) ** (1 / d)
    expected: Counter[Fraction] = Counter()
    for f in box_of(harmonics).tolist():
        square = sum((Fraction(c * c, s) for c, s in zip(f, squares, strict=True)), Fraction())
        if 0 < square * shared <= radius**2 * (1 + 1e-12):
            expected[square] += 1
    found = box_shells(harmonics, sides, radius)
    assert found.count.tolist() == [expected[square] for square in sorted(expected)]
    np.testing.assert_allclose(
        found.radius, [math.sqrt(square * shared) for square in sorted(expected)], rtol=1e-13
    )
    lengths = wave_numbers(box_of(harmonics), sides)
    np.testing.assert_allclose(found.mean(lengths), found.radius, rtol=1e-14)
    rings = box_annuli(harmonics, sides, radius, 1.0)
    assert rings.count.sum() == found.count.sum()
    assert (np.diff(np.floor(rings.radius)) > 0).all()


@pytest.mark.parametrize("sides", [(2, 1), (math.pi, 1), (1, 2, 1), (1, math.e, math.pi)])
def test_pools_have_enough_frequencies_and_lose_none(sides: tuple[float, ...]) -> None:
    d = len(sides)
    x = np.random.default_rng(0).random((3, 50, d))
    spectrum = periodogram(x, 6, sides=sides)
    exact = shells_from_cube(spectrum)
    wide = pooled_spectrum(exact)
    assert wide.count.min() >= 2 ** (d + 1)
    assert wide.count.sum() == exact.count.sum()
    assert (np.diff(wide.frequency) > 0).all()
    assert spectrum.sides is not None
    groups = pooled(box_shells(spectrum.harmonics, spectrum.sides, 6.0), d)
    mean, deviation = groups.moments(spectrum.power)
    np.testing.assert_allclose(wide.power, mean, rtol=1e-12)
    np.testing.assert_allclose(wide.deviation, deviation, rtol=1e-10)
    np.testing.assert_allclose(wide.frequency, groups.radius, rtol=1e-13)
    np.testing.assert_array_equal(wide.count, groups.count)


def test_crowded_points_are_the_products_in_boxes_and_shells_too() -> None:
    x = np.random.default_rng(0).random((2500, 2))
    x[500:] = 0.3 + x[500:] / 1000
    boxed, ringed = periodogram(x, 64, sides=(1.5, 1)), shells(x, 64, sides=(1.5, 1))
    assert boxed.method == ringed.method == "product"
    np.testing.assert_allclose(ringed.power, shells_from_cube(boxed).power, rtol=1e-9)


@pytest.mark.parametrize("sides", [(2, 1), (math.sqrt(3), 1), (1, 1, 2), (1, 2, 1, 3)])
@pytest.mark.parametrize("band", [None, (1.5, 3.2)])
def test_listed_or_as_a_box_shells_are_the_same(
    sides: tuple[float, ...], band: tuple[float, float] | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    x = np.random.default_rng(0).random((2, 64, len(sides)))
    done: list[float] = []
    boxed = shells(x, 4, sides=sides, band=band)
    monkeypatch.setattr(ball_power, "box_request", lambda *_: (_ for _ in ()).throw(InputError("no room")))
    listed = shells(x, 4, sides=sides, band=band, progress=done.append)
    assert done[-1] == 1
    assert boxed.method != listed.method
    np.testing.assert_array_equal(boxed.count, listed.count)
    for field in ("frequency", "power", "deviation"):
        np.testing.assert_allclose(getattr(boxed, field), getattr(listed, field), rtol=1e-11, atol=1e-12)
    if band is None:
        cube = shells_from_cube(periodogram(x, 4, sides=sides))
        np.testing.assert_array_equal(cube.count, boxed.count)
        np.testing.assert_allclose(cube.power, boxed.power, rtol=1e-12)
    else:
        assert band[0] <= boxed.frequency[0] <= boxed.frequency[-1] <= band[1]


def test_shells_in_twelve_dimensions_list_their_ball() -> None:
    x = np.random.default_rng(0).random((16, 12))
    found = shells(x, 1, sides=(1,) * 11 + (4,))
    # The long side has harmonics 1 to 3 within |k| <= 1, the others have one each at 1.12.
    box = 4 / 4 ** (1 / 12)
    np.testing.assert_allclose(found.frequency, np.arange(1, 4) / box, rtol=1e-14)
    f = np.zeros((3, 12), int)
    f[:, -1] = [1, 2, 3]
    np.testing.assert_allclose(found.power, direct_power(x, f), atol=1e-12)


@pytest.mark.parametrize(
    ("n", "d", "sides"), [(1024, 2, (4, 1)), (4096, 3, (10, 1, 1)), (512, 6, (2,) + (1,) * 5)]
)
def test_the_default_holds_the_floor_and_is_affordable(n: int, d: int, sides: tuple[float, ...]) -> None:
    box = as_sides(sides, d)
    assert box is not None
    radius = default_radius(n, d, 1, box)
    assert radius >= 0.25 * n ** (1 / d)
    assert math.prod(2 * f + 1 for f in harmonics_within(radius, box)) <= 6e6
    if d == 2:
        assert radius == 65  # as for the square


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"corners": True}, "corners"),
        ({"band": (0.1, 0.2)}, "no frequency of this torus"),
        ({"band": (1, 9)}, "beyond the whole shells"),
        ({"sides": (1, 2, 3)}, "sides must be 2 lengths"),
        ({"fmax": 0}, "fmax must be an integer"),
    ],
)
def test_what_no_box_has_is_refused(arguments: dict[str, object], says: str) -> None:
    x = np.random.default_rng(0).random((10, 2))
    with pytest.raises(InputError, match=says):
        shells(x, **{"fmax": 4, "sides": (2, 1), **arguments})  # type: ignore[arg-type]


def test_a_box_that_fits_no_memory_is_refused() -> None:
    with pytest.raises(InputError, match="fit in memory"):
        periodogram(np.random.default_rng(0).random((10, 3)), 100_000, sides=(1, 2, 1))


def test_filtering_knows_the_wave_vector() -> None:
    x = np.random.default_rng(0).random((50, 2))
    spectrum = periodogram(x, 4, sides=(2, 1))
    k = wave_numbers(box_of(spectrum.harmonics), spectrum.sides) / math.sqrt(50)
    expected = spectrum.power.ravel() * np.exp(-((2 * math.pi * 0.4 * k) ** 2))
    np.testing.assert_allclose(spectrum.filtered(0.4).power.ravel(), expected, rtol=1e-12)
    half = periodogram(x, 4, sides=(2, 1), half=True).filtered(0.4)
    np.testing.assert_allclose(half.whole().power, spectrum.filtered(0.4).power, rtol=1e-12)
    listed = periodogram(x, frequencies=[[1, 1], [0, 2]], sides=(2, 1))
    k = wave_numbers([[1, 1], [0, 2]], spectrum.sides) / math.sqrt(50)
    np.testing.assert_allclose(
        listed.filtered(0.4).power, listed.power * np.exp(-((2 * math.pi * 0.4 * k) ** 2)), rtol=1e-12
    )
