"""Points of several classes: one energy whose gradient is exact, blue class by class and all together."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench import measures
from gbnbench.core.errors import RefusalError
from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.gbn.energy import AdaptiveEnergy
from gbnbench.generators.adaptive.gbn.generator import AdaptiveGaussianBlueNoise
from gbnbench.generators.adaptive.gbn.joint_energy import JointEnergy, Part, union_density
from gbnbench.opencl import runtime

COUNTS = [20, 40]


def _streams(classes=2):
    return [np.random.default_rng([5, k]) for k in range(classes)]


@pytest.mark.parametrize("toroidal", [False, True])
def test_the_gradient_is_the_slope_of_the_joint_energy(toroidal):
    i, j = np.indices((40, 48))
    densities = [
        as_density(values, toroidal=toroidal)
        for values in (1.2 + np.sin(i / 7) * np.sin(j / 6), 1 + 0.02 * i)
    ]

    def energy_of(density, n):
        return AdaptiveEnergy(runtime(), density, n, sigma=1.0, smoothing=0.5, spread=0.8, precision="double")

    whole = union_density(densities, COUNTS)
    assert whole.of_points(60) == pytest.approx(densities[0].of_points(20) + densities[1].of_points(40))
    parts = [
        Part(slice(0, 60), energy_of(whole, 60), 0.7),
        Part(slice(0, 20), energy_of(densities[0], 20), 9.0),
        Part(slice(20, 60), energy_of(densities[1], 40), 2.25),
    ]
    energy = JointEnergy(whole, parts)
    rng = np.random.default_rng(1)
    x = 0.5 + rng.random((60, 2)) * np.array([39, 47])
    found = energy(x)
    assert found.energy == pytest.approx(sum(p.weight * p.energy(x[p.points]).energy for p in parts))
    step = 1e-4
    for k in (3, 19, 20, 55):
        for a in (0, 1):
            moved = np.zeros((60, 2))
            moved[k, a] = step
            slope = (energy(x + moved).energy - energy(x - moved).energy) / (2 * step)
            assert slope == pytest.approx(found.gradient[k, a], abs=1e-7 * np.abs(found.gradient).max())


def test_classes_keep_to_their_own_ink():
    left, right = np.zeros((2, 24, 30))
    left[:, :20], right[:, 12:] = 1, 1
    x = AdaptiveGaussianBlueNoise(gradients=20).classes(
        [as_density(left), as_density(right)], [30, 50], _streams()
    )
    assert [len(one) for one in x] == [30, 50]
    assert x[0][:, 1].max() < 20
    assert x[1][:, 1].min() >= 12


def test_one_class_is_the_plain_method():
    ramp = as_density(np.linspace(0.1, 1, 30)[:, None] * np.ones(20))
    generator = AdaptiveGaussianBlueNoise(gradients=5)
    (x,) = generator.classes([ramp], [50], _streams(1))
    assert np.array_equal(x, generator(ramp, 50, _streams(1)[0]))


def test_too_many_points_of_all_classes_are_refused():
    flat = as_density(np.ones((2000, 2000)))
    with pytest.raises(RefusalError, match="fewer points"):
        AdaptiveGaussianBlueNoise().classes([flat, flat], [10, 500_000_000], _streams())


def test_two_inks_of_a_grey_are_blue_and_so_is_their_union():
    flat = as_density(np.ones((64, 64)), toroidal=True)
    floors, least = {}, {}
    for union in (0, 1):
        x = AdaptiveGaussianBlueNoise(union=union).classes([flat, flat], [128, 128], _streams())
        sets = [*x, np.concatenate(x)]
        found = [measures(one / 64) for one in sets]
        floors[union] = [one["noise_floor"] for one in found]
        least[union] = found[-1]["min_distance"]
    # At 1,024 points 3e-7 and 4e-5 (docs/adaptive.md); white noise has 1.
    assert max(floors[0]) < 1e-5
    assert max(floors[1]) < 3e-4
    assert least[0] < 0.15
    assert least[1] > 0.3
