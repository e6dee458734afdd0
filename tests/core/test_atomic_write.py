"""Files that are whole or absent: a fault names the file that was meant, and leaves nothing behind."""

from __future__ import annotations

from pathlib import Path

import pytest

from gbnbench.core.atomic_write import write_whole


def test_a_fault_names_the_file_and_leaves_nothing(tmp_path: Path) -> None:
    place = tmp_path / "report.html"
    place.mkdir()
    with pytest.raises(OSError, match=r"report\.html'$") as caught:
        write_whole(place, b"content")
    assert caught.value.filename == str(place)
    assert list(tmp_path.iterdir()) == [place]
