"""Strata hold their points whatever is drawn: at their ends, rounding would carry points out."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from gbnbench.core.torus import FloatArray
from gbnbench.generators.registry import find
from gbnbench.generators.strata import placed_in_strata


class Edge(np.random.Generator):
    """A stream whose uniform numbers are all the least or the greatest there is."""

    edge = 1 - 2.0**-53

    def random(self, size: Any = None, *_: Any, **__: Any) -> Any:
        return np.full(size, self.edge)


class LeastEdge(Edge):
    edge = 0.0


def strata_of(x: FloatArray, strata: int) -> np.ndarray:
    return np.sort(np.floor(x * strata), axis=0)


@pytest.mark.parametrize("stream", [Edge, LeastEdge])
@pytest.mark.parametrize(
    ("name", "n"), [("latin", 100), ("latinmaximin[steps=0]", 98), ("cmj", 100), ("bluenets", 64)]
)
def test_every_stratum_of_an_axis_holds_one_point(name: str, n: int, stream: type[Edge]) -> None:
    x = find(name)(n, 2, stream(np.random.PCG64(1)))
    assert np.all((x >= 0) & (x < 1))
    assert np.array_equal(strata_of(x, n), np.repeat(np.arange(n)[:, None], 2, axis=1))


@pytest.mark.parametrize("stream", [Edge, LeastEdge])
@pytest.mark.parametrize("m", [10, 49])
def test_every_cell_of_a_jittered_grid_holds_one_point(m: int, stream: type[Edge]) -> None:
    x = find("jittered")(m * m, 2, stream(np.random.PCG64(1)))
    assert len(np.unique(np.floor(x * m), axis=0)) == m * m


def test_places_are_kept_but_for_rounding() -> None:
    stratum, place = np.arange(1000), np.random.default_rng(1).random(1000)
    assert np.array_equal(placed_in_strata(stratum, place, 1000), (stratum + place) / 1000)
