"""Lists of frequencies and of weights: read to the last bit, or refused with file and line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gbnbench.core.errors import FormatError
from gbnbench.io.lists import read_frequencies, read_weights


def test_frequencies_are_read_exactly_in_any_layout(tmp_path: Path) -> None:
    expected = np.array([[1, -2], [0, 7], [2**63 - 1, -(2**63)]])
    texts = (
        "1 -2\n0 7\n9223372036854775807 -9223372036854775808\n",
        "\ufefff0,f1\r\n1,-2\r\n\r\n0, +7 # a comment\r\n9223372036854775807,-9223372036854775808",
    )
    for text in texts:
        (tmp_path / "list").write_text(text, encoding="utf-8")
        found = read_frequencies(tmp_path / "list", 2)
        assert found.dtype == np.int64
        np.testing.assert_array_equal(found, expected)
    np.save(tmp_path / "list.npy", expected)
    np.testing.assert_array_equal(read_frequencies(tmp_path / "list.npy"), expected)


@pytest.mark.parametrize(
    ("text", "d", "words"),
    [
        ("1 2\n3 4.0\n", 2, "line 2: '4.0' is not an integer"),
        ("1 2\n\n3\n", None, "line 3: 1 integer where line 1 has 2"),
        ("1 2\n", 3, "line 1: 2 integers where the points have d=3"),
        ("1,,2\n", 2, "line 1: an empty cell"),
        ("1 2\nnan 4\n", 2, "line 2: 'nan' is not an integer"),
        ("0 9223372036854775808\n", 2, "line 1: '9223372036854775808' does not fit in 64 bits"),
        ("1 " + "9" * 5000, 2, "does not fit in 64 bits"),
        ("# nothing\n", 2, "no frequencies"),
        ("", 2, "is empty"),
    ],
)
def test_a_bad_list_is_refused_with_its_line(tmp_path: Path, text: str, d: int | None, words: str) -> None:
    (tmp_path / "list.txt").write_text(text)
    with pytest.raises(FormatError, match=r"list\.txt") as refused:
        read_frequencies(tmp_path / "list.txt", d)
    assert words in str(refused.value)


def test_weights_are_read_exactly_for_one_set_or_every(tmp_path: Path) -> None:
    weights = np.random.default_rng(5).normal(size=(3, 4))
    for name, rows, sets in (("one", weights[0], 1), ("one", weights[0], 3), ("all", weights, 3)):
        (tmp_path / name).write_text("weight\n" + "\n".join(map(repr, rows.ravel().tolist())))
        np.testing.assert_array_equal(read_weights(tmp_path / name, 4, sets), rows)
        np.save(tmp_path / "w.npy", rows)
        np.testing.assert_array_equal(read_weights(tmp_path / "w.npy", 4, sets), rows)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1\n2 3\n", "line 2: 2 numbers in a line"),
        ("1\nnan\n", "line 2: 'nan' is not a number"),
        ("nan\n1\n", "line 1: 'nan' is not a number"),
        ("1\n1e999\n", "line 2: '1e999' is beyond the range"),
        ("1\n2\n", "2 numbers where 3 points need 3, one a line, or 6 for the 2 sets"),
    ],
)
def test_bad_weights_are_refused_with_their_line(tmp_path: Path, text: str, words: str) -> None:
    (tmp_path / "w.csv").write_text(text)
    with pytest.raises(FormatError, match=r"w\.csv") as refused:
        read_weights(tmp_path / "w.csv", 3, 2)
    assert words in str(refused.value)


def test_bad_arrays_are_refused(tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", np.ones((3, 2)))
    with pytest.raises(FormatError, match="must be integers"):
        read_frequencies(tmp_path / "a.npy")
    with pytest.raises(FormatError, match=r"shape \(3, 2\) where 2 points need 2"):
        read_weights(tmp_path / "a.npy", 2, 2)
    np.save(tmp_path / "a.npy", np.array([1.0, np.nan]))
    with pytest.raises(FormatError, match=r"must be finite; got nan \(index \(1,\)\)"):
        read_weights(tmp_path / "a.npy", 2)
    whole = (tmp_path / "a.npy").read_bytes()
    for broken in (whole[:-3], whole[:30], whole[:10] + b"{" * 50, b"\x93NUMPY"):
        (tmp_path / "a.npy").write_bytes(broken)
        with pytest.raises(FormatError, match=r"a damaged \.npy"):
            read_weights(tmp_path / "a.npy", 2)
    np.savez(tmp_path / "at.npz", f=np.array([[1, 2]]))
    for read in (read_frequencies, read_weights):
        with pytest.raises(FormatError, match=r"\.npz lists are not read; write \.txt, \.csv or \.npy"):
            read(tmp_path / "at.npz", 2)
    with pytest.raises(FormatError, match="is a folder"):
        read_frequencies(tmp_path)
