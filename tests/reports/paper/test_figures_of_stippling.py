"""Figures 10, 11 and 15 to 17: through the command, of the user's image, and drawn from the library."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from gbnbench.cli import run
from gbnbench.generators.adaptive.gbn.descent import descend
from gbnbench.generators.adaptive.gbn.energy import AdaptiveEnergy
from gbnbench.generators.adaptive.registry import ADAPTIVE_GENERATORS, adaptive_points
from gbnbench.opencl import runtime
from gbnbench.reports.paper.averaged_pixels import averaged
from gbnbench.reports.paper.figure import FigureOptions
from gbnbench.reports.paper.figure_11 import adaptive_evolution, hill
from gbnbench.reports.paper.registry import find
from gbnbench.reports.paper.stippling_requests import methods_shown
from tests.smallest_sizes import smallest_sizes


@pytest.mark.slow
def test_the_command_makes_them_in_small(here: Path):
    np.save(here / "stripes.npy", (np.arange(48) // 6 % 2)[:, None] * np.full(40, 0.8))
    names = ["10", "11", "15", "16", "17"]
    with smallest_sizes():
        assert (
            run(["figures", *names, "--quick", "--image", "16=stripes.npy", "--out", "out", "--quiet"]) == 0
        )
    captions = json.loads((here / "out" / "captions.json").read_bytes())
    assert list(captions) == [f"figure-{name}" for name in names]
    for name in names:
        assert (here / "out" / f"figure-{name}.pdf").stat().st_size > 1000
    assert "In place of the paper's image: camera" in captions["figure-10"]["caption"]
    assert "In place of the paper's image" not in captions["figure-16"]["caption"]


def test_methods_of_the_paper_come_in_once_they_have_generators(monkeypatch):
    for name in ("bnot", "kdm"):
        monkeypatch.delitem(ADAPTIVE_GENERATORS, name, raising=False)
    assert methods_shown(("bnot", "kdm")) == ("secord", "lbg")
    monkeypatch.setitem(ADAPTIVE_GENERATORS, "kdm", ADAPTIVE_GENERATORS["rejection"])
    assert methods_shown(("bnot", "kdm")) == ("kdm", "secord")
    (figure,) = find(["10"])
    assert figure.needs(FigureOptions("tiny"))["sets"].sources == ("kdm", "secord", "gbn")


def test_the_evolution_is_the_descent_of_the_library():
    found = adaptive_evolution(60, 5, [0, 1, 4], 1)
    density = hill()
    start = adaptive_points("rejection", density, 60, seed=5)
    energy = AdaptiveEnergy(runtime(), density, 60, sigma=1.0, smoothing=1.0, spread=1.0, precision="double")
    assert np.array_equal(found["points"][0], start)
    for place, count in ((1, 1), (2, 4)):
        # A descent of fewer gradients is the head of a longer one; sums may come in another order.
        assert found["points"][place] == pytest.approx(descend(energy, start, count), abs=1e-9)
    assert found["paths"].shape == (5, 60, 2)
    assert (found["power"][2] < 0.5 * found["power"][0])[:2].all()


def test_pixels_are_averaged_in_squares():
    image = np.arange(35.0).reshape(5, 7)
    assert np.array_equal(averaged(image, None), image)
    assert np.array_equal(averaged(image, 7), image)
    assert averaged(image, 4).tolist() == [
        [4.0, 6.0, 8.0],
        [18.0, 20.0, 22.0],
    ]  # squares of two pixels a side


def test_an_image_for_no_figure_is_refused(here: Path, capsys):
    for wrong, message in (
        ("11=camera", "N being one of 10, 15, 16, 17; got '11=camera'"),
        ("10", "--image must read N=IMAGE"),
        ("10=none.png", "none.png: there is no such file"),
    ):
        assert run(["figures", "10", "--image", wrong, "--out", "x"]) == 2
        assert message in capsys.readouterr().err
    assert list(here.iterdir()) == []
