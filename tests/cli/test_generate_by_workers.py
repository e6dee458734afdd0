"""``gbnbench generate --jobs``: the bytes of one process, refusals in words, pieces that are kept."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gbnbench.cli import run
from gbnbench.generators.registry import generate
from gbnbench.studies import drawn_sets
from gbnbench.studies.drawn_sets import drawing_pieces

pytestmark = pytest.mark.slow


def command(*arguments: object) -> int:
    return run(["generate", *map(str, arguments)])


@pytest.mark.parametrize("realizations", [1, 63, 64, 65, 1000])
@pytest.mark.parametrize("n", [1, 16, 1024, 100_000])
def test_pieces_hold_every_realization_once(n, realizations):
    pieces = drawing_pieces(n, realizations)
    assert [k for first, count in pieces for k in range(first, first + count)] == list(range(realizations))
    assert all(count == 1 or count * n <= drawn_sets.PIECE_POINTS for _, count in pieces)


@pytest.mark.parametrize("suffix", [".npy", ".txt", ".npz", ".npy.gz"])
@pytest.mark.parametrize("realizations", [1, 130])
def test_the_file_is_that_of_one_process_byte_by_byte(here, capsys, suffix, realizations):
    asked = ("jittered", "-n", 16, "--realizations", realizations, "--seed", 3)
    assert command(*asked, "-o", f"alone{suffix}") == 0
    assert command(*asked, "-o", f"spread{suffix}", "--jobs", 2, "--quiet") == 0
    assert Path(f"alone{suffix}").read_bytes() == Path(f"spread{suffix}").read_bytes()
    assert sorted(path.name for path in here.iterdir()) == [f"alone{suffix}", f"spread{suffix}"]
    assert "reused" not in capsys.readouterr().out


def test_sets_that_move_together_are_those_of_one_process(here):
    assert command("gbn[gradients=20]", "-n", 20, "--realizations", 130, "-o", "x.npy", "--jobs", 2) == 0
    assert np.array_equal(np.load("x.npy"), generate("gbn[gradients=20]", n=20, realizations=130))


def test_pieces_of_other_sets_are_refused_and_kept(here, capsys):
    folder = Path("x.npy.pieces")
    folder.mkdir()
    store = drawn_sets.DrawnSetsFolder(folder, {"seed": 9})
    store.begin()
    assert command("random", "-n", 8, "-o", "x.npy", "--jobs", 1) == 2
    said = capsys.readouterr().err
    assert "x.npy.pieces holds a folder of drawn sets with other settings (" in said
    assert "choose another file with --out, or delete this one" in said
    assert (folder / "settings.json").exists()
    assert not Path("x.npy").exists()


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("gbn", "-o", "x.txt", "--jobs", 2, "--checkpoint", "c"), "--checkpoint is of sets that one"),
        (("gbn", "-o", "x.txt", "--executor", "local", "--trace", "t.csv"), "--trace is of sets that one"),
        (("gbn", "-o", "x.txt", "--executor", "cloud"), "no executor is named 'cloud'"),
        (("grid", "-n", "17", "-o", "x.txt", "--jobs", 1), "n must be"),
        (("random", "-o", "x.txt", "--realizations", 10**11, "--jobs", 1), "an .npy is written piece by"),
    ],
)
def test_errors_say_what_was_wrong(here, capsys, arguments, says):
    assert command(*arguments) == 2
    assert says in capsys.readouterr().err
    assert list(here.iterdir()) == []
