"""Names of files as text, and their width on a terminal."""

from __future__ import annotations

import os

import pytest

from gbnbench.core.errors import FormatError
from gbnbench.core.readable_text import display_width, in_one_line, left, right, without_bytes
from gbnbench.core.text_table import aligned


@pytest.mark.parametrize(
    ("name", "text"),
    [(b"caf\xe9", r"caf\xe9"), (b"\xff\xfe", r"\xff\xfe"), ("café 点".encode(), "café 点")],
)
def test_bytes_that_are_no_utf_8_become_text_that_any_file_holds(name: bytes, text: str) -> None:
    found = without_bytes(os.fsdecode(name))
    assert found == text
    assert found.encode().decode() == text
    assert without_bytes("\ud800") == r"\ud800"  # no byte, and no sign either


def test_a_name_never_leaves_its_line_or_colours_the_terminal() -> None:
    assert in_one_line("a\nb\r\x1b[31m\N{RIGHT-TO-LEFT OVERRIDE}c") == r"a\nb\r\x1b[31m\u202ec"
    assert in_one_line("a\u3000b\N{NO-BREAK SPACE}c") == "a\u3000b\N{NO-BREAK SPACE}c"
    assert str(FormatError("two\nlines", "is empty", 3)) == r"two\nlines, line 3: is empty"


@pytest.mark.parametrize(
    ("text", "columns"),
    [("gbn", 3), ("蓝噪声", 6), ("ブルー", 6), ("노이즈", 6), ("e\u0301", 1), ("ﾊﾝｶｸ", 4)],
)
def test_width_is_that_of_a_terminal(text: str, columns: int) -> None:
    rich = pytest.importorskip("rich.cells")
    assert display_width(text) == columns == rich.cell_len(text)
    assert display_width(left(text, 9)) == display_width(right(text, 9)) == 9


def test_columns_stay_aligned_beside_wide_signs() -> None:
    lines = list(aligned(("source", "n"), [("蓝噪声", 16), ("gbn", 256)]))
    assert {display_width(line) for line in lines} == {11}
