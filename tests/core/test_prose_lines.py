"""Prose in lines: no line begins as something else than prose does, and no word is lost."""

from __future__ import annotations

import pytest

from gbnbench.core.prose_lines import WIDTH, paragraph


@pytest.mark.parametrize("mark", ["-", "+", "*", "1.", "12)", ">", "#", "|", "="])
def test_no_line_of_a_paragraph_begins_as_another_block_does(mark):
    for length in range(WIDTH - 12, WIDTH + 3):
        text = f"{'a' * (length - 2)} b {mark} c d"
        lines = paragraph(text, "> ").splitlines()
        assert all(line.startswith("> ") and not line[2:].startswith(mark) for line in lines)
        assert " ".join(line[2:] for line in lines) == text


def test_an_item_of_a_list_goes_on_below_its_text():
    text = "a word " * 40
    lines = paragraph(text.strip(), "- ", "  ").splitlines()
    assert lines[0].startswith("- a")
    assert all(line.startswith(("  a", "  w")) for line in lines[1:])
    assert " ".join(line[2:] for line in lines) == text.strip()
    assert max(map(len, lines)) <= WIDTH
