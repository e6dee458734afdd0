"""The page of published figures: it is of the figures that there are, and every one agrees or says no."""

from __future__ import annotations

import re

import pytest

from gbnbench.verification.published import PUBLISHED
from tests.paths import DOCS

ROWS = re.findall(
    r"^\| `([^|]+)` \| ([^|]+) \| `([^|]+)` \|", (DOCS / "verification.md").read_text(), re.MULTILINE
)


@pytest.mark.slow
def test_the_page_has_a_row_for_every_figure() -> None:
    """Where it fails: gbnbench generators --verify -o docs/verification.md makes the page anew."""
    expected = [(one.generator, f"{one.sets} of n={one.n}, d={one.d}", one.measure_name) for one in PUBLISHED]
    assert expected == ROWS
