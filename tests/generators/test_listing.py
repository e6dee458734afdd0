"""The list of generators: a row each, families, costs that were measured, the table of Python."""

from __future__ import annotations

import numpy as np
import pytest

import gbnbench
from gbnbench.core.errors import InputError
from gbnbench.generators.listing import cost_machine, generator_entries, measured_costs
from gbnbench.generators.protocol import FAMILIES
from gbnbench.generators.registry import GENERATORS


def test_every_generator_has_a_row_in_the_order_of_the_registry() -> None:
    table = gbnbench.generator_table()
    assert table.name.tolist() == list(GENERATORS)
    for row in table.itertuples():
        kind = GENERATORS[row.name]
        assert (row.family, row.reference, row.summary) == (kind.family, kind.reference, kind.summary)
        assert row.domain == ("torus" if kind.toroidal else "cube")
        assert row.least_d == kind.dimensions[0]
        assert (row.most_d if kind.dimensions[1] else None) == kind.dimensions[1]
        assert row.origin == "gbnbench"


def test_the_families_part_the_list() -> None:
    parts = [gbnbench.generator_table(family).name.tolist() for family in FAMILIES]
    assert sorted(name for part in parts for name in part) == sorted(GENERATORS)
    assert "lloyd" in gbnbench.generator_table("cellular").name.tolist()
    with pytest.raises(
        InputError, match=r"no family.* 'celular' \(did you mean 'cellular'\?\); the families are"
    ):
        gbnbench.generator_table("celular")


def test_costs_are_of_generators_that_there_are_at_sizes_that_they_serve() -> None:
    assert cost_machine().endswith(", one thread")
    for name, cost in measured_costs().items():
        assert GENERATORS[name]().refusal(cost.n, 2) is None
        assert 512 <= cost.n <= 2048
        assert 0 < cost.cpu_seconds < 1000


def test_a_generator_without_a_measured_cost_has_nan(monkeypatch: pytest.MonkeyPatch) -> None:
    costs = {name: cost for name, cost in measured_costs().items() if name != "fpo"}
    monkeypatch.setattr("gbnbench.generators.listing.measured_costs", lambda: costs)
    table = gbnbench.generator_table().set_index("name")
    assert np.isnan(table.cpu_seconds["fpo"])
    assert table.cpu_seconds["gbn"] == costs["gbn"].cpu_seconds


@pytest.mark.parametrize(
    ("dimensions", "text"), [((1, None), "any"), ((2, 2), "2"), ((1, 3), "1-3"), ((2, None), "2 up")]
)
def test_dimensions_as_lists_show_them(
    dimensions: tuple[int, int | None], text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(GENERATORS["random"], "dimensions", dimensions)
    (first, *_), _ = generator_entries()
    assert first.dimensions_text == text
