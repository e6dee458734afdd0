"""The page of verified figures: it is of the figures that there are, and defines and excuses what it must."""

from __future__ import annotations

import re

import pytest

from gbnbench.core.settings import parse
from gbnbench.generators.registry import GENERATORS
from gbnbench.verification.page import markdown
from gbnbench.verification.published import PUBLISHED
from gbnbench.verification.verify import Verified
from gbnbench.verification.without_reference import WITHOUT_REFERENCE
from tests.paths import DOCS

TEXT = (DOCS / "verification.md").read_text()
ROWS = re.findall(r"^\| `([^|]+)` \| ([^|]+) \| `([^|]+)` \| ([^|]+) \| ([^|]+) \|", TEXT, re.MULTILINE)


@pytest.mark.slow
def test_the_page_has_a_row_for_every_figure() -> None:
    """Where it fails: gbnbench generators --verify -o docs/verification.md makes the page anew."""
    expected = [
        (one.generator, f"{one.sets} of n={one.n}, d={one.d}", one.measure_name, one.kind, one.published)
        for one in PUBLISHED
    ]
    assert expected == ROWS


@pytest.mark.slow
def test_the_page_is_what_the_command_writes_but_for_what_was_measured() -> None:
    """Where it fails: gbnbench generators --verify -o docs/verification.md makes the page anew."""

    def unmeasured(text: str) -> list[str]:
        rest = text.partition("Measured by")[2].partition(".\n")[2]
        return [text.partition("**")[0], *(line for line in rest.splitlines() if not line.startswith("| `"))]

    anew = markdown([Verified(figure, 1.0) for figure in PUBLISHED])
    assert unmeasured(anew) == unmeasured(TEXT)


def test_every_generator_is_held_against_something_or_excused() -> None:
    held = {parse(one.generator)[0] for one in PUBLISHED}
    assert not held & set(WITHOUT_REFERENCE)
    assert held | set(WITHOUT_REFERENCE) == set(GENERATORS)


def test_every_measure_beside_the_scalars_is_defined_in_one_sentence() -> None:
    text = markdown([Verified(figure, 1.0) for figure in PUBLISHED]).partition("## Measures defined here")[2]
    items = [" ".join(item.split()) for item in text.split("\n- ")]
    for name in {one.measure_name for one in PUBLISHED if not isinstance(one.measure, str)}:
        (line,) = [line for line in items if f"`{name}`" in line.partition(": ")[0]]
        assert line.startswith("`")
        assert line.endswith(".")
