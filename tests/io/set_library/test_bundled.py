"""The ready sets that are installed: small, whole, as documented, and as good as their manifest says."""

from __future__ import annotations

from importlib.resources import files

import numpy as np
import pytest

import gbnbench
from gbnbench.io.set_library.entries import ReadySets
from gbnbench.io.set_library.manifest import Manifest
from gbnbench.io.set_library.places import INSTALLED, manifest_of, open_place
from gbnbench.io.set_library.set_file import faults, read_sets
from tests.oracles.power import mean_power

MOST = 2_000_000  # bytes of the archive


@pytest.fixture(scope="module")
def manifest() -> Manifest:
    with open_place() as place:
        return manifest_of(place)


def test_it_is_small_and_whole(manifest):
    content = files("gbnbench.io.set_library").joinpath(INSTALLED).read_bytes()
    assert len(content) < MOST
    with open_place() as place:
        assert faults(place, manifest) == {}
        for entry in manifest.files:
            x = read_sets(place, entry)
            assert np.isfinite(x).all()
            assert x.min() >= 0
            assert x.max() < 1
    assert (manifest.gbnbench, manifest.seed) == (gbnbench.__version__, 0)


def test_it_has_the_sizes_that_are_documented(manifest):
    found = {(e.generator, e.d, e.n): len(e.realizations) for e in manifest.files}
    expected = {}
    for name in ("gbn", "deep", "stealthy", "bnot"):
        for k in range(4, 13):
            expected[name, 2, 2**k] = 8 if k <= 10 else 1
    for name in ("gbn", "deep", "stealthy"):
        for k in range(4, 11):
            expected[name, 3, 2**k] = 8 if k <= 8 else 1
        for k in range(4, 9):
            expected[name, 1, 2**k] = expected[name, 4, 2**k] = 2
    del expected["deep", 4, 16]  # refused: its profile would bind every coordinate
    assert found == expected


# Powers are measured to 1% above 1e-24 and to a factor below; under 1e-27 they are rounding of the points.
@pytest.mark.parametrize("size", [(64, 2), (1024, 2), (4096, 2), (128, 3), (64, 1), (64, 4)])
@pytest.mark.parametrize("name", ["gbn", "deep", "stealthy", "bnot"])
def test_measured_anew_it_is_what_the_manifest_says(manifest, name, size):
    n, d = size
    entry = manifest.entry(name, n, d)
    if name == "bnot" and d != 2:
        assert entry is None
        return
    assert isinstance(entry, ReadySets)
    x = gbnbench.ready_set(name, n, d, None)
    again = gbnbench.measures(x)
    assert set(again.reasons) == set(entry.undefined)
    for measure in ("noise_floor", "power_at_1", "peak", "min_distance", "mean_distance"):
        assert close(again[measure], entry.measures[measure]), measure


@pytest.mark.parametrize("name", ["gbn", "deep", "bnot"])
def test_the_power_at_the_lowest_frequencies_agrees_with_a_slow_sum(manifest, name):
    entry = manifest.entry(name, 256, 2)
    sets = gbnbench.ready_set(name, 256, 2, None)
    axes = np.array([[1, 0], [0, 1]])
    slow = float(np.mean(mean_power(sets, axes)))  # P(-f) = P(f): two of the four suffice
    assert close(slow, entry.measures["power_at_1"])


def close(found: float, said: float) -> bool:
    if said < 1e-27:
        return found < 1e-26
    return abs(found - said) <= (0.01 if said > 1e-24 else 0.5) * said
