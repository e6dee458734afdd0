"""CPU seconds on pages are those of the measured table, and the docstrings of generators name none."""

from __future__ import annotations

import re

import pytest

from gbnbench.generators.listing import measured_costs
from gbnbench.generators.registry import GENERATORS
from tests.paths import ROOT

COLUMNS = {
    "README.md": -1,
    "docs/generators.md": 1,
    "docs/choosing.md": 1,
}  # of the cost, in rows that have one
CELLS = {"README.md": 11, "docs/generators.md": 5, "docs/choosing.md": 12}


@pytest.mark.parametrize("page", CELLS)
def test_costs_are_those_of_the_table(page: str) -> None:
    found = set()
    for line in (ROOT / page).read_text().splitlines():
        cells = [cell.strip(" *`") for cell in line.strip("|").split("|")]
        name = cells[0].partition("`")[0]
        if len(cells) != CELLS[page] or name not in GENERATORS:
            continue
        written = cells[COLUMNS[page]]
        digits, _, exponent = written.partition("e")
        unit = 10.0 ** (int(exponent or 0) - len(digits.partition(".")[2]))
        assert abs(float(written) - measured_costs()[name].cpu_seconds) <= 0.501 * unit, line
        found.add(name)
    assert len(found) >= (6 if page == "README.md" else 36)
    assert page != "docs/generators.md" or found == set(GENERATORS)


@pytest.mark.parametrize("kind", GENERATORS.values(), ids=GENERATORS)
def test_docstrings_leave_the_cost_to_the_table(kind: type) -> None:
    assert not re.search(r"CPU\s+s(econds?)?\b", kind.__doc__ or "")
