"""The code of docs/choosing.md, run as it stands; its assertions are the page's own figures."""

from __future__ import annotations

import re
from pathlib import Path

PAGE = Path(__file__).parents[2] / "docs" / "choosing.md"


def test_the_examples_give_the_figures_that_the_page_states() -> None:
    blocks = re.findall(r"^```python\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    names: dict[str, object] = {}
    for block in blocks:
        exec(compile(block, PAGE.name, "exec"), names)  # noqa: S102 - our own page
    assert 0.74 < float(names["least"]) < 0.80  # type: ignore[arg-type]
