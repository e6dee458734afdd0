"""The reference names what there is."""

from __future__ import annotations

import re

import pytest

import gbnbench
from gbnbench.analysis.measure_definitions import DEFINITIONS
from gbnbench.generators.registry import GENERATORS
from tests.paths import DOCS


@pytest.mark.parametrize("name", gbnbench.__all__)
def test_every_public_name_is_in_the_reference(name):
    assert re.search(rf"^\.\. auto\w+:: {name}$", (DOCS / "api" / "gbnbench.rst").read_text(), re.MULTILINE)


@pytest.mark.parametrize("kind", GENERATORS.values(), ids=list(GENERATORS))
def test_every_generator_is_in_the_reference(kind):
    named = re.findall(r"gbnbench\.[\w.*]+", (DOCS / "api" / "generators.rst").read_text())
    assert kind.__module__ in named or kind.__module__.rpartition(".")[0] + ".*" in named
    assert kind.__doc__


@pytest.mark.parametrize("definition", DEFINITIONS, ids=lambda definition: definition.name)
def test_every_measure_is_defined_on_its_page(definition):
    cells = re.findall(r"^\| (`.*?) \| (.+) \|$", (DOCS / "measures.md").read_text(), re.MULTILINE)
    assert any(f"`{definition.name}`" in name and text for name, text in cells)
