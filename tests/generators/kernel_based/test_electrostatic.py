"""Electrostatic halftoning: its forces against two charges', its shaking, and that it spreads points."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.measures import measures
from gbnbench.core.errors import InputError
from gbnbench.generators.gbn.ewald import EwaldEnergy
from gbnbench.generators.kernel_based.electrostatic import FORCE, Electrostatic, shaking_length
from gbnbench.generators.registry import generate


@pytest.mark.parametrize(("d", "power"), [(2, 1), (3, 2)])
def test_two_near_charges_repel_as_in_free_space(d: int, power: int) -> None:
    """The background and the images change the force 1/r**power by its share of the box alone."""
    energy = EwaldEnergy(2, d, 2.0 - d)
    x = np.full((2, d), 0.5)
    x[1, 0] += 0.004
    r = 0.004 * energy.side
    force = -FORCE[d] * energy(x)[1]
    assert force[1, 0] * r**power == pytest.approx(1, rel=1e-3)
    assert force[0] == pytest.approx(-force[1], abs=1e-3)


def test_the_shaking_is_that_published() -> None:
    assert shaking_length(10, 64) == 0
    assert shaking_length(10, 128) == pytest.approx(0.1 * math.exp(-0.01))
    assert shaking_length(1000, 256) == pytest.approx(0.2 / math.e)


def test_few_steps_without_shaking_make_blue_noise() -> None:
    found = measures(generate("electrostatic[iterations=25,shaking=0]", n=128))
    assert found["noise_floor"] < 1e-3
    assert found["min_distance"] > 0.6


@pytest.mark.slow
def test_shaking_keeps_order_away() -> None:
    still, shaken = (
        measures(generate("electrostatic", n=512, realizations=3, shaking=s))["psi6"] for s in (0.0, 1.0)
    )
    assert shaken < still - 0.03


@pytest.mark.parametrize("wrong", [{"iterations": -1}, {"tau": 0.0}, {"tau": 0.4}, {"shaking": -1.0}])
def test_wrong_settings_are_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(InputError, match=next(iter(wrong))):
        Electrostatic(**wrong)  # type: ignore[arg-type]
