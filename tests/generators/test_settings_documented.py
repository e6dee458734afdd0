"""The page of generators names every generator with every setting and its default."""

from __future__ import annotations

import dataclasses

import pytest

from gbnbench.generators.registry import GENERATORS
from tests.paths import DOCS

PAGE = (DOCS / "generators.md").read_text()


@pytest.mark.parametrize("name", GENERATORS)
def test_every_setting_is_on_the_page(name):
    (row,) = [line for line in PAGE.splitlines() if line.startswith(f"| `{name}` |")]
    for field in dataclasses.fields(GENERATORS[name]):
        plain = field.default is None or isinstance(field.default, bool | str)
        shown = str(field.default).lower() if plain else f"{field.default:g}"
        assert f"`{field.name}` ({shown}" in row.replace("(1.0 ", "(1 "), field.name
