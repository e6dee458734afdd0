"""Farthest-point sweeps on the device against a plain oracle that triangulates afresh for every move."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import Delaunay, cKDTree

from gbnbench.core.torus import FloatArray
from gbnbench.generators.fpo import relocation
from gbnbench.generators.fpo.relocation import Sweeps, minimum_distance

TILES = np.array([(i, j) for i in (0, -1, 1) for j in (0, -1, 1)], dtype=float)
ALL = np.array([True])


def gaps(x: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Corners, centre and radius of every Delaunay triangle of the nine tiles that is centred in the box."""
    tiled = (x[:, None, :] + TILES).reshape(-1, 2)
    corners = Delaunay(tiled).simplices
    a, b, c = (tiled[corners[:, k]] for k in range(3))
    keep = np.abs(np.linalg.det(np.stack([b - a, c - a], axis=1))) > 1e-13
    a, b, c, corners = a[keep], b[keep], c[keep], corners[keep]
    matrix = 2 * np.stack([b - a, c - a], axis=1)
    right = np.stack([np.sum(b * b - a * a, axis=1), np.sum(c * c - a * a, axis=1)], axis=1)
    centre = np.linalg.solve(matrix, right[..., None])[..., 0]
    inside = np.all((centre >= 0) & (centre < 1), axis=1)
    return corners[inside] // 9, centre[inside], np.linalg.norm(centre - a, axis=1)[inside]


def oracle_sweep(x: FloatArray) -> FloatArray:
    x = x.copy()
    for v in range(len(x)):
        rest = np.delete(x, v, axis=0)
        _, centre, radius = gaps(rest)
        far = int(np.argmax(radius))
        step = rest - x[v]
        if radius[far] > np.linalg.norm(step - np.round(step), axis=1).min():
            x[v] = centre[far]
    return x


# 13 and 30 points pass between the host's moves and the device's; 64 begin with wide gaps.
@pytest.mark.parametrize(("n", "count"), [(13, 3), (30, 3), (64, 3), (150, 1)])
def test_sweeps_move_every_point_to_the_farthest_place(n: int, count: int):
    x = np.random.default_rng(n).random((n, 2))
    work = Sweeps(x[None])
    for _ in range(count):
        work.sweep(ALL)
        x = oracle_sweep(x)
    np.testing.assert_allclose(work.download()[0], x, atol=1e-9)
    assert work.nearest[0] == pytest.approx(minimum_distance(x), abs=1e-9)


def local_oracle_sweep(x: FloatArray) -> FloatArray:
    x = x.copy()
    for v in range(len(x)):
        corners, _, _ = gaps(x)
        neighbours = set(corners[np.any(corners == v, axis=1)].ravel().tolist()) - {v}
        others = np.delete(np.arange(len(x)), v)
        corners, centre, radius = gaps(x[others])
        near = np.isin(others[corners], sorted(neighbours)).any(axis=1)
        far = int(np.argmax(np.where(near, radius, 0)))
        step = x[others] - x[v]
        if radius[far] > np.linalg.norm(step - np.round(step), axis=1).min():
            x[v] = centre[far]
    return x


def test_local_sweeps_look_beside_former_neighbours():
    work = Sweeps(np.random.default_rng(0).random((1, 90, 2)))
    work.sweep(ALL)
    x = work.download()[0]
    local, everywhere = Sweeps(x[None], local=True), Sweeps(x[None])
    local.sweep(ALL)
    everywhere.sweep(ALL)
    np.testing.assert_allclose(local.download()[0], local_oracle_sweep(x), atol=1e-9)
    assert np.abs(local.download() - everywhere.download()).max() > 1e-3


def test_maintained_triangulation_is_the_delaunay_triangulation():
    n = 300
    work = Sweeps(np.random.default_rng(7).random((1, n, 2)))
    for _ in range(25):
        work.sweep(ALL)
    assert work.fresh_moves[0] == 0
    for buffer, array in zip(work._buffers, work._arrays, strict=True):
        work._runtime.download(buffer, array)
    x, origin, twin, leaving, centre, tree, mark = (array[0] for array in work._arrays)
    squared = tree[work._leaves :][: 2 * n]
    edges = (4 * np.arange(2 * n)[:, None] + np.arange(3)).ravel()
    following = np.where(edges % 4 == 2, edges - 2, edges + 1)
    np.testing.assert_array_equal(twin[twin[edges]], edges)
    np.testing.assert_array_equal(origin[twin[edges]], origin[following])
    np.testing.assert_array_equal(origin[leaving], np.arange(n))
    assert not mark.any()
    assert tree[1] == squared.max()
    distance = cKDTree(x, boxsize=[1.0, 1.0]).query(centre)[0]
    np.testing.assert_allclose(distance, np.sqrt(squared), atol=1e-13)

    mine = {frozenset(t) for t in origin.reshape(-1, 4)[:, :3].tolist()}
    corners, centre, radius = gaps(x)
    theirs = {frozenset(t): k for k, t in enumerate(corners.tolist())}
    assert len(mine) == 2 * n
    for triangle in theirs.keys() - mine:  # only four points on one circle may be split the other way
        k = theirs[triangle]
        step = x - centre[k]
        distances = np.linalg.norm(step - np.round(step), axis=1)
        assert np.sum(np.abs(distances - radius[k]) < 1e-9) >= 4
    assert len(mine & theirs.keys()) > 1.9 * n


def test_lost_triangulation_is_noticed_and_made_anew():
    x = np.random.default_rng(3).random((1, 90, 2))
    work, broken = Sweeps(x), Sweeps(x)
    assert work.sweep(ALL) == broken.sweep(ALL)
    broken._runtime.update(broken._buffers[2], np.zeros_like(broken._arrays[2]))  # every twin
    assert work.sweep(ALL) == broken.sweep(ALL)
    assert broken.fresh_moves[0] >= 1
    np.testing.assert_allclose(broken.download(), work.download(), atol=1e-12)


def test_result_does_not_depend_on_launches_or_companions(monkeypatch: pytest.MonkeyPatch):
    x = np.random.default_rng(4).random((3, 100, 2))
    together = Sweeps(x)
    moved = [together.sweep(np.array([True, True, False])) for _ in range(2)]
    monkeypatch.setattr(relocation, "MOVES_PER_LAUNCH", 7)
    alone = Sweeps(x[1:2])
    assert [int(m[1]) for m in moved] == [int(alone.sweep(ALL)[0]) for _ in range(2)]
    np.testing.assert_array_equal(together.download()[1], alone.download()[0])
    np.testing.assert_array_equal(together.download()[2], x[2])


def test_a_jammed_set_stays_as_it_is():
    work = Sweeps(np.random.default_rng(2).random((1, 32, 2)))
    for _ in range(400):
        if work.sweep(ALL)[0] == 0:
            break
    assert work.fresh_moves[0] < 32  # the last sweeps were the device's
    jammed = work.download()
    assert work.sweep(ALL)[0] == 0
    np.testing.assert_array_equal(work.download(), jammed)
    np.testing.assert_allclose(oracle_sweep(jammed[0]), jammed[0], atol=1e-5)


def test_minimum_distance_crosses_the_border():
    assert minimum_distance(np.array([[0.01, 0.5], [0.98, 0.5], [0.5, 0.1]])) == pytest.approx(0.03)
    assert minimum_distance(np.array([[0.3, 0.3]])) == 1.0
