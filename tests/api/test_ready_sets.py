"""Ready sets from Python: the right points, or one sentence with what there is and how it is made."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gbnbench
from gbnbench.core.errors import FormatError, InputError, RefusalError
from tests.io.set_library.small_library import small_library


@pytest.fixture
def library(tmp_path: Path) -> Path:
    small_library(tmp_path / "sets")
    return tmp_path / "sets"


def test_sets_are_found_by_generator_n_d_and_realization(library):
    both = np.random.default_rng(8).random((2, 8, 3))  # realizations 0 and 3
    assert np.array_equal(gbnbench.ready_set("random", 8, 3, library=library), both[0])
    assert np.array_equal(
        gbnbench.ready_set("random", n=8, d=3, realization=3, library=str(library)), both[1]
    )
    assert np.array_equal(gbnbench.ready_set("random", 8, 3, None, library=library), both)


def test_the_table_has_a_row_a_file(library):
    table = gbnbench.ready_sets(library)
    assert table[["generator", "n", "d", "realizations"]].values.tolist() == [
        ["random", 16, 2, 2],
        ["random", 8, 3, 2],
    ]
    assert table.noise_floor.tolist() == [1.0, 1.0]


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("random", 32), r"random, n=32, d=2 is not in the library .*: in d=2 there are n = 16\. "),
        (("random", 16, 4), r"there is d = 2, 3\. "),
        (
            ("gbn[sigma=0.8]", 16),
            r"of the generators there are random\. gbnbench library 'gbn\[sigma=0\.8\]' ",
        ),
        (("random", 16, 2, 1), r"has the realizations 0, 3 in the library .*; got 1\. "),
        (("random", 16, 2, 9), r" --realizations 10 -o FOLDER makes it, for library=FOLDER"),
        (("bnot", 8, 3), "bnot, n=8, d=3 cannot be made: bnot is 2D"),
    ],
)
def test_a_set_that_is_not_there_is_refused_with_what_is(library, arguments, says):
    with pytest.raises(RefusalError, match=says):
        gbnbench.ready_set(*arguments, library=library)


def test_a_wrong_name_or_place_or_file_is_told(library):
    with pytest.raises(InputError, match=r"no generator is named 'bnto' \(did you mean 'bnot'"):
        gbnbench.ready_set("bnto", 16)
    with pytest.raises(InputError, match="there is no folder or archive"):
        gbnbench.ready_sets(library / "nothing")
    (library / "random/2d/random-2d-16.npy").unlink()
    with pytest.raises(FormatError, match=r"random-2d-16\.npy: is missing"):
        gbnbench.ready_set("random", 16, library=library)
