"""Capacity-constrained distributions: equal capacities, no swap left, sites at centroids."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.measures import measures
from gbnbench.core.errors import InputError
from gbnbench.core.torus import displacement, toroidal_distance, wrap
from gbnbench.generators.ccvt.assignment import sample_lattice, share_out, short_basis, split
from gbnbench.generators.ccvt.generator import MOST, CapacityConstrained
from gbnbench.generators.ccvt.pairs import first_free_groups, touching_pairs
from gbnbench.generators.ccvt.swaps import CHUNK, Swaps, in_chunks, placed
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import generate


def swapped(n: int, capacity: int, seed: int = 1) -> tuple[Swaps, np.ndarray]:
    """Swaps come to rest, with the samples that they began with."""
    rng = np.random.default_rng(seed)
    sites, samples = rng.random((n, 2)), sample_lattice(n * capacity, rng)
    swaps = Swaps(sites, placed(sites, samples[share_out(sites, samples, rng)]))
    energy = [swaps.energy]
    while not swaps.settled and len(energy) < 500:
        swaps.sweep(rng)
        energy.append(swaps.energy)
    assert swaps.settled
    assert np.all(np.diff(energy) <= 1e-15)  # turns and centroids lower it too
    return swaps, samples


@pytest.mark.parametrize("count", [1, 2, 7, 100, 1009, 4096])
def test_the_lattice_is_even_whatever_the_number(count: int) -> None:
    samples = sample_lattice(count, np.random.default_rng(0))
    assert samples.shape == (count, 2)
    for axis in range(2):
        gaps = np.diff(np.sort(samples[:, axis]), append=np.sort(samples[:, axis])[0] + 1)
        assert np.allclose(gaps[gaps > 1e-9].min(), 1 / count) or axis == 1
    others = toroidal_distance(samples[1:], samples[:1])
    assert count == 1 or others.min() > 0.6 * count**-0.5  # .93 is the golden lattice's, 1 a square grid's


@pytest.mark.parametrize(("n", "capacity"), [(1, 5), (2, 1), (7, 10), (50, 16)])
def test_samples_are_shared_out_evenly_and_once(n: int, capacity: int) -> None:
    rng = np.random.default_rng(n)
    sites, samples = rng.random((n, 2)), sample_lattice(n * capacity, rng)
    given = share_out(sites, samples, rng)
    assert given.shape == (n, capacity)
    assert np.array_equal(np.sort(given.ravel()), np.arange(n * capacity))


def test_a_site_with_room_is_left_by_no_sample_for_a_farther_one() -> None:
    """Each sample's site is the nearest of those that had room: the last site to fill has none beyond it."""
    rng = np.random.default_rng(3)
    sites, samples = rng.random((5, 2)), sample_lattice(50, rng)
    given = share_out(sites, samples, rng)
    nearest = np.argmin(toroidal_distance(samples[:, None], sites[None]), axis=1)
    counts = np.bincount(nearest, minlength=5)
    for k in np.flatnonzero(counts <= 10):  # a site that is not wanted by too many has all that want it
        assert set(np.flatnonzero(nearest == k)) <= set(given[k])


@pytest.mark.parametrize(("n", "capacity"), [(12, 25), (60, 16), (61, 7), (9, 3 * CHUNK + 5)])
def test_at_rest_no_swap_of_two_samples_lowers_the_energy(n: int, capacity: int) -> None:
    swaps, samples = swapped(n, capacity)
    places = wrap(swaps.sites[:, None] + np.moveaxis(swaps.offsets, 1, 2))
    for place in places.reshape(-1, 2)[::7]:  # samples are moved about, never changed
        assert toroidal_distance(samples, place[None]).min() < 1e-12
    squares = toroidal_distance(places[:, :, None], swaps.sites) ** 2  # of sample, to every site
    for a in range(n):
        for b in range(a):
            gain = (squares[a, :, a] - squares[a, :, b]).max() + (squares[b, :, b] - squares[b, :, a]).max()
            assert gain < 1e-11


@pytest.mark.parametrize(("n", "capacity"), [(1, 9), (2, 40), (60, 16)])
def test_at_rest_sites_lie_at_the_centroids_of_their_samples(n: int, capacity: int) -> None:
    swaps, _ = swapped(n, capacity)
    assert np.abs(swaps.offsets.mean(axis=2)).max() < 1e-14
    assert np.abs(swaps.offsets).max() <= 0.5


def test_swaps_move_both_sites_to_their_centroids_at_once() -> None:
    rng = np.random.default_rng(5)
    sites = np.array([[0.4, 0.5], [0.6, 0.5]])
    samples = np.array([[[0.35, 0.5], [0.62, 0.5]], [[0.38, 0.5], [0.64, 0.5]]])  # the wrong two are swapped
    swaps = Swaps(sites, placed(sites, samples))
    swaps.sweep(rng)
    order = np.argsort(swaps.sites[:, 0])
    assert np.allclose(swaps.sites[order], [[0.365, 0.5], [0.63, 0.5]], rtol=0, atol=1e-15)
    assert swaps.energy == pytest.approx((0.015**2 + 0.01**2) / 2, rel=1e-12)


def test_pairs_are_those_of_overlapping_circles() -> None:
    rng = np.random.default_rng(2)
    sites, radius = rng.random((40, 2)), 0.02 + 0.1 * rng.random(40)
    pairs = touching_pairs(sites, radius)
    found = {frozenset(pair) for pair in zip(pairs.first.tolist(), pairs.second.tolist(), strict=True)}
    assert len(found) == len(pairs.first)
    expected = {
        frozenset((a, b))
        for a in range(40)
        for b in range(a)
        if toroidal_distance(sites[a], sites[b]) < radius[a] + radius[b]
    }
    assert found == expected
    assert np.allclose(
        pairs.between, displacement(sites[pairs.second], sites[pairs.first]), rtol=0, atol=1e-15
    )
    assert np.all(np.diff(pairs.group) >= 0)


def test_groups_hold_no_site_twice_and_are_few() -> None:
    rng = np.random.default_rng(4)
    first = rng.integers(0, 20, 100)
    second = (first + rng.integers(1, 20, 100)) % 20
    group = first_free_groups(first, second, 20)
    for k in range(group.max() + 1):
        inside = np.concatenate([first[group == k], second[group == k]])
        assert 0 < len(np.unique(inside)) == len(inside)
    most = np.bincount(np.concatenate([first, second])).max()
    assert group.max() < 2 * most - 1  # a pair meets at most so many others


@pytest.mark.parametrize("count", [1, 2, 30, 777, 4096])
def test_split_samples_are_a_lattice_again_with_the_same_centroids(count: int) -> None:
    samples, basis = sample_lattice(count, np.random.default_rng(0)), short_basis(count)
    assert abs(np.linalg.det(basis)) == pytest.approx(1 / count, rel=1e-9)
    assert np.linalg.norm(basis, axis=1).max() <= 1.4 * count**-0.5
    fine = split(samples.T[None], basis)
    assert np.allclose(fine.reshape(1, 2, count, 4).mean(axis=3), samples.T, rtol=0, atol=1e-15)
    fine = wrap(fine[0].T)
    for step in basis / 2:  # moved by a vector of the lattice it is the same
        for sample in fine[:: max(1, count // 7)]:
            assert toroidal_distance(fine, wrap(sample + step)[None]).min() < 1e-12
    others = toroidal_distance(fine[1:], fine[:1])
    assert others.min() > 0.5 * (4 * count) ** -0.5


def test_samples_of_a_chunk_are_near_each_other() -> None:
    rng = np.random.default_rng(1)
    offsets = rng.random((3, 2, 16 * CHUNK + 3))
    ordered = in_chunks(offsets)
    for k in range(3):
        assert np.array_equal(np.sort(ordered[k, 0]), np.sort(offsets[k, 0]))
        places = {tuple(place) for place in offsets[k].T.tolist()}
        assert places == {tuple(place) for place in ordered[k].T.tolist()}
    chunks = ordered[:, :, : 16 * CHUNK].reshape(3, 2, 16, CHUNK)
    area = (chunks.max(axis=3) - chunks.min(axis=3)).prod(axis=1)
    assert area.mean() < 2 / 16  # of the square; a sixteenth at the least


def test_samples_that_cannot_be_split_are_shared_out_at_once() -> None:
    for samples in (30, 36, 48):
        x = CapacityConstrained(samples=samples)(20, 2, realization_rng(2, 0))
        assert toroidal_distance(x[:, None], x)[~np.eye(20, dtype=bool)].min() > 0.3 * 20**-0.5


def test_too_few_passes_are_told() -> None:
    with pytest.warns(RuntimeWarning, match="raise passes"):
        CapacityConstrained(samples=64, passes=1)(30, 2, realization_rng(0, 0))


def test_too_many_samples_are_refused_with_what_fits() -> None:
    reason = CapacityConstrained(samples=MOST // 4).refusal(5, 2)
    assert reason is not None
    assert reason.endswith("nearest is 4")
    assert CapacityConstrained(samples=MOST // 4).refusal(4, 2) is None


def test_a_finer_sampling_settles_at_a_lower_energy() -> None:
    """In units of 1/n: a hexagon has .1604, a square .1667."""
    energy = []
    for capacity in (16, 256):
        swaps, _ = swapped(100, capacity)
        energy.append(100 * swaps.energy)
    assert 0.1604 < energy[1] < energy[0] < 0.19


@pytest.mark.slow
def test_a_coarse_sampling_ends_where_the_program_of_the_authors_does() -> None:
    """Their algorithm to the letter, 1,024 samples a point on a grid, gave these figures for five sets.

    It was written anew in C, pairs in order, each after the other, nothing split: mean distance .8608
    and spread .0011; oscillations 1.77 and .025; bond order .406 and .013. Five spreads are allowed,
    and four of the bond order's.
    """
    found = measures(generate("ccvt", n=1024, samples=1024, seed=5, realizations=3))
    assert found["mean_distance"] == pytest.approx(0.8608, abs=0.0055)
    assert found["oscillations"] == pytest.approx(1.77, abs=0.125)
    assert found["bond_order"] == pytest.approx(0.406, abs=0.05)


@pytest.mark.parametrize("settings", [{"samples": 0}, {"passes": 0}])
def test_settings_out_of_range_are_refused(settings: dict[str, int]) -> None:
    with pytest.raises(InputError, match="must be >= 1"):
        generate("ccvt", n=4, **settings)
