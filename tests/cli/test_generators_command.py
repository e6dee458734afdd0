"""``gbnbench generators``: the list, one described, its picture, and all held against published figures."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from gbnbench.cli import run
from gbnbench.generators.listing import measured_costs
from gbnbench.generators.registry import GENERATORS
from gbnbench.verification import choice
from gbnbench.verification.published_figure import PublishedFigure

Capture = pytest.CaptureFixture[str]


def test_the_list_has_a_line_a_generator(capsys: Capture) -> None:
    assert run(["generators"]) == 0
    out, err = capsys.readouterr()
    head, *lines, last = out.splitlines()
    assert head.split() == ["name", "family", "d", "domain", "CPU", "s", "reference"]
    assert [line.split()[0] for line in lines] == list(GENERATORS)
    (fpo,) = [line for line in lines if line.startswith("fpo ")]
    assert re.split(r"  +", fpo)[1:4] == ["cellular", "2", "torus"]
    assert GENERATORS["fpo"].reference in fpo
    assert "CPU s: of a set of 1,024 points in 2D" in last
    assert err == ""


def test_a_generator_whose_cost_was_not_measured_has_a_dash(
    capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    costs = {name: cost for name, cost in measured_costs().items() if name != "fpo"}
    monkeypatch.setattr("gbnbench.generators.listing.measured_costs", lambda: costs)
    assert run(["generators", "--family", "cellular"]) == 0
    (line,) = [line for line in capsys.readouterr().out.splitlines() if line.startswith("fpo ")]
    assert re.split(r"  +", line)[4] == "–"
    assert run(["generators", "fpo"]) == 0
    assert re.search(r"^cost +not measured$", capsys.readouterr().out, re.MULTILINE)


def test_a_family_alone_and_as_json(capsys: Capture) -> None:
    assert run(["generators", "--family", "lattice", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert {row["family"] for row in rows} == {"lattice"}
    assert {"grid", "hexagonal"} <= {row["name"] for row in rows}
    assert run(["generators", "--family", "latice"]) == 2
    assert "did you mean 'lattice'?" in capsys.readouterr().err


def test_a_generator_is_described(capsys: Capture) -> None:
    assert run(["generators", "fpo[sweeps=50]"]) == 0
    out = capsys.readouterr().out
    assert "  sweeps = 50  (whole number; default 1000)\n    Most sweeps from one start;" in out
    assert "  gain = 0.002  (number)\n" in out
    assert "d = 3, 4, 8  none: fpo works on 2D Delaunay triangulations" in out
    assert "Schlömer, Heck & Deussen" in out
    assert run(["generators", "jittered"]) == 0
    out = capsys.readouterr().out
    assert "It has no settings." in out
    assert "(for 1000: n must be m**2 for a jittered grid; got n=1000, nearest" in " ".join(out.split())


def test_a_description_as_json(capsys: Capture) -> None:
    assert run(["generators", "fpo[target=0.9]", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["name"] == "fpo"
    assert told["settings"][0] == {
        "name": "target", "type": "number", "default": 0.925, "value": 0.9,
        "meaning": "Minimum distance to reach, in densest spacings d_hex.",
    }  # fmt: skip
    assert [served["d"] for served in told["serves"] if served["n"]] == [2]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["loyd"], "no generator is named 'loyd' (did you mean 'lloyd'?)"),
        (["lloyd[iteration=3]"], "did you mean 'iterations'?"),
        (["lloyd", "--verify"], "a name goes with neither --family nor --verify"),
        (["--only", "fpo"], "--only goes with --verify"),
        (["-n", "64"], "-n and -d are those of a picture: name a generator, and a file by --out"),
        (["lloyd", "-n", "64"], "-n and -d are those of a picture"),
        (["-o", "x.png"], "--out goes with the name of a generator, or with --verify"),
        (["lloyd", "-o", "x.txt"], "pictures are written as .png, .pdf; got '.txt'"),
        (["fpo", "-o", "x.png", "-d", "5"], "fpo works on 2D Delaunay triangulations"),
        (["--verify", "-o", "x.txt"], "the table is written as .md; got '.txt'"),
        (["--verify", "--only", "fpoo"], "no generator of gbnbench is named 'fpoo' (did you mean 'fpo'?)"),
        (["--verify", "--only", "grid", "--family", "cellular"], "grid: not of the family 'cellular'"),
        (["--verify", "--only", "targeted"], "there is no figure to hold targeted against: its spectrum is"),
    ],
)
def test_what_cannot_be_done_is_told(here: Path, capsys: Capture, words: list[str], said: str) -> None:
    assert run(["generators", *words]) == 2
    assert said in capsys.readouterr().err
    assert not list(here.iterdir())


@pytest.mark.parametrize(("d", "panels"), [(1, 3), (2, 4), (3, 3)])
def test_a_picture_is_drawn(here: Path, capsys: Capture, d: int, panels: int) -> None:
    assert run(["generators", "random", "-o", "x.png", "-n", "64", "-d", str(d)]) == 0
    assert capsys.readouterr().out.endswith("wrote x.png\n")
    with Image.open("x.png") as image:
        assert abs(image.width / image.height - (panels * 3.02 + 0.1) / 4.0) < 0.6
        grey = np.asarray(image.convert("L"))
    assert 0.02 < (grey < 128).mean() < 0.6  # neither blank nor black


def first_coordinate(x: np.ndarray) -> float:
    return float(x[0, 0])


FIGURES = (
    PublishedFigure("jittered", "noise_floor", "low", 0, 0.5, "a | few", "Cook", n=64, sets=2),
    PublishedFigure("jittered", first_coordinate, "above 1", 1, math.inf, "never", "Cook", n=64, sets=2),
    PublishedFigure("jittered", "noise_floor", "low", 0, 1, "few", "Cook", n=60, sets=1),
    PublishedFigure("lloyd[iterations=2]", "noise_floor", "low", 0, 0.5, "few", "Lloyd", n=16, sets=1),
)


@pytest.mark.slow
def test_figures_that_do_not_agree_end_with_1(
    here: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(choice, "PUBLISHED", FIGURES)
    assert run(["generators", "--verify", "--jobs", "1", "-o", "page.md"]) == 1
    said, err = capsys.readouterr()
    out = said.splitlines()
    assert [line.split()[0] for line in out[1:9:2]] == ["ok", "▼", "▼", "ok"]
    assert re.search(r"2 x 64, 2D +first_coordinate +above 1 .* at least 1.00$", out[3])
    assert out[4] == "      published figure: Cook; room: never"
    reason = "n must be m**2 for a jittered grid; got n=60, nearest is 64"
    assert out[9:] == ["Published figure: 2 of 4 agree.", f"jittered: {reason}", "wrote page.md"]
    assert "measured lloyd[iterations=2], n=16, d=2" in err
    page = Path("page.md").read_text()
    heads = re.findall(r"^## (.*)$", page, re.MULTILINE)
    assert heads == ["Direct", "Cellular", "Without a reference"]
    assert "**Published figure: 2 of 4 agree.**" in page
    assert "| a &#124; few | Cook |" in page
    assert "| at least 1.00 | **no** | never |" in page
    assert f"| **no** {reason} |" in page


@pytest.mark.slow
def test_one_generator_is_verified_alone(capsys: Capture) -> None:
    assert run(["generators", "--verify", "--only", "fpo", "--json", "--quiet"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert {one["generator"].partition("[")[0] for one in told} == {"fpo"}
    assert all(one["agrees"] for one in told)
