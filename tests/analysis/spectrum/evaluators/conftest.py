"""What an evaluator keeps is forgotten after each test, since tests change the sizes that it depends on."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from gbnbench.analysis.spectrum.evaluators import kept_memory


@pytest.fixture(autouse=True)
def _nothing_kept() -> Iterator[None]:
    yield
    kept_memory.forget()
