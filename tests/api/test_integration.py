"""gbnbench.integrate from Python: names, arrays, resuming, the picture and wrong use."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

import gbnbench
from gbnbench.core.errors import InputError

MINE = np.random.default_rng(4).random((3, 64, 2))


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("integrated")
    return integrate(folder / "out")


def integrate(out, **more):
    settings = {"n": [16, 64], "realizations": 3, "integrands": "korobov", "instances": 4, "jobs": 1}
    return gbnbench.integrate(["random", MINE], out=out, quiet=True, **{**settings, **more})


def test_names_and_arrays_are_rows(made):
    rows = list(zip(made.table.source, made.table.n, strict=True))
    assert rows == [("random", 16), ("random", 64), ("array", 64)]
    assert made.slopes.source.tolist() == ["random"]


def test_the_same_call_finds_it(made):
    again = integrate(made.folder)
    assert again.reused == again.pieces > 0
    assert again.table.equals(made.table)
    with pytest.raises(InputError):
        integrate(made.folder, instances=5)


def test_the_picture_is_made_when_it_is_missing(made):
    assert isinstance(made.figure(), Figure)
    assert not (made.folder / "integration.png").exists()
    assert made.picture().read_bytes().startswith(b"\x89PNG")
    assert (made.folder / "integration.pdf").is_file()
    assert "data:image/png;base64," in made._repr_html_()


def test_a_family_that_is_none_is_refused(tmp_path):
    with pytest.raises(InputError, match="korobow"):
        integrate(tmp_path / "out", integrands="korobow")
