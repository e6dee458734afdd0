"""Large sets in slabs have the same distances, bit for bit, and the same neighbours as sets taken whole."""

from __future__ import annotations

import numpy as np
import pytest

import gbnbench
from gbnbench.analysis.spatial import distances, slabs
from gbnbench.analysis.spatial.bond_order import bond_order, psi6
from gbnbench.analysis.spatial.delaunay import neighbours
from gbnbench.analysis.spatial.distances import nearest_distances
from gbnbench.analysis.spatial.plane_order import order_of, plane_order, summed_shares
from gbnbench.analysis.spatial.valence import valence, valence6
from gbnbench.core.errors import RefusalError
from gbnbench.core.sides import as_sides
from tests.oracles.lattices import grid

RNG = np.random.default_rng(14)
SETS = {
    "random": RNG.random((4000, 2)),
    "uneven": np.stack([RNG.random(4000) ** 6, RNG.random(4000)], axis=1),
    "tiny": RNG.random((4000, 2)) * np.where(np.arange(4000)[:, None] < 60, 1e-10, 1.0),
    "grid": gbnbench.wrap(grid(64, 2) + np.array([0.013, 0.027])),
    "coincident": np.repeat(RNG.random((2000, 2)), 2, axis=0),
    "space": RNG.random((4000, 3)),
    "alone": np.concatenate([RNG.random((4000, 2)) * [0.02, 1], [[0.6, 0.5]]]),
}


@pytest.fixture
def small_slabs(monkeypatch: pytest.MonkeyPatch) -> None:
    """Take sets of more than ten points for large ones."""
    monkeypatch.setattr(distances, "WHOLE", 10)
    monkeypatch.setattr(slabs, "SLAB_POINTS", 700)
    monkeypatch.setattr(slabs, "ROWS", 900)


@pytest.mark.parametrize("sides", [None, (3, 1), (1, 3)], ids=["cube", "wide", "tall"])
@pytest.mark.parametrize("kind", SETS)
def test_distances_are_the_same_bits(
    kind: str, sides: tuple[int, ...] | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    x = SETS[kind]
    box = sides if sides is None or x.shape[1] == 2 else (*sides, 2)
    whole = nearest_distances(x, box)
    monkeypatch.setattr(distances, "WHOLE", 10)
    monkeypatch.setattr(slabs, "SLAB_POINTS", 700)
    monkeypatch.setattr(slabs, "ROWS", 900)
    told: list[float] = []
    cut = nearest_distances(x, box, progress=told.append)
    if kind == "grid":  # four neighbours are equally near up to rounding, and either tree may name another
        np.testing.assert_allclose(cut, whole, rtol=1e-12)
    else:
        assert np.array_equal(cut, whole)
    assert told[0] == 0
    assert told[-1] == 1
    assert sorted(told) == told


@pytest.mark.usefixtures("small_slabs")
@pytest.mark.parametrize("sides", [None, (3, 1), (1, 3)], ids=["square", "wide", "tall"])
@pytest.mark.parametrize("kind", ["random", "uneven", "grid"])
def test_neighbours_are_those_of_the_whole_set(kind: str, sides: tuple[int, ...] | None) -> None:
    x = SETS[kind]
    whole = neighbours(x, sides)
    total = plane_order(x, as_sides(sides, 2))
    expected = order_of(whole[0])
    assert (total.points, total.bonds) == (expected.points, expected.bonds)
    assert total.degrees.tolist() == expected.degrees.tolist()
    # Coordinates are rounded once more, to 2^-53 of a side: some 1e-12 of the shortest bonds.
    assert total.bond_order == pytest.approx(bond_order(whole)[0], rel=1e-11, abs=1e-11)
    assert total.psi6 == pytest.approx(psi6(whole)[0], rel=1e-11, abs=1e-11)
    assert total.valence6 == valence6(whole)[0]
    histogram = valence(whole)
    assert summed_shares([total])[0].tolist() == histogram.degree.tolist()
    np.testing.assert_allclose(summed_shares([total])[1], histogram.share, rtol=1e-14)


@pytest.mark.usefixtures("small_slabs")
def test_a_space_too_wide_for_slabs_is_refused_in_words() -> None:
    x = SETS["random"]
    x = x[(np.abs(x - 0.5) > 0.2).any(axis=1)]
    with pytest.raises(RefusalError, match="lies too wide an empty space"):
        plane_order(x)


@pytest.mark.usefixtures("small_slabs")
def test_coincident_points_have_no_neighbours_here_either() -> None:
    with pytest.raises(RefusalError, match="need distinct points"):
        plane_order(SETS["coincident"])


@pytest.mark.usefixtures("small_slabs")
@pytest.mark.parametrize("around", [0.0, 0.03, 0.2])
@pytest.mark.parametrize("kind", SETS)
def test_every_point_is_one_slabs_own_and_its_surroundings_are_whole(kind: str, around: float) -> None:
    x, own = SETS[kind], []
    for part in slabs.slabs(x, around):
        own += part.rows.tolist()
        at = part.points[:, 0] + part.turns
        assert ((at >= part.low) & (at < part.high)).sum() == len(part.rows)
        assert np.array_equal(part.points[: len(part.rows)], x[part.rows])
        everywhere = np.concatenate([x[:, 0] - 1, x[:, 0], x[:, 0] + 1])
        expected = (everywhere >= part.low - part.around) & (everywhere < part.high + part.around)
        assert abs(expected.sum() - len(at)) <= 1  # one that lies on the border itself
        assert np.allclose(np.sort(everywhere[expected]), np.sort(at), atol=1e-15) or expected.sum() != len(
            at
        )
    assert sorted(own) == list(range(len(x)))
