"""Sets that the user gives to figures: shown under their method's name, or refused before any work."""

from __future__ import annotations

import pandas as pd
import pytest
from matplotlib.figure import Figure

from gbnbench import generate, save
from gbnbench.cli import run as command
from gbnbench.core.errors import InputError
from gbnbench.reports.paper.figure import FigureOptions
from gbnbench.reports.paper.method_styles import stroke
from gbnbench.reports.paper.registry import find
from gbnbench.reports.paper.user_sets import check_sets
from gbnbench.studies.integration.study_folder import IntegrationStudy
from tests.smallest_sizes import smallest_sizes


@pytest.fixture
def flat(tmp_path):
    path = tmp_path / "flat.txt"
    save(path, generate("random", n=16, d=2))
    return str(path)


@pytest.mark.parametrize(
    ("figures", "name", "message"),
    [
        (["1"], "gbn", "has a generator here"),
        (["1"], "bnott", "did you mean bnot"),
        (["2"], "bnot", "figure 2 shows no sets of it"),
        (["4", "6"], "mine", "figure 4, 6 shows no sets of it"),
        (["12"], "bnot", "figure 12 shows no sets of it"),
    ],
)
def test_sets_that_would_not_be_seen_are_refused(figures, name, message, flat):
    with pytest.raises(InputError, match=message):
        check_sets(find(figures), FigureOptions("tiny", {name: flat}))


def test_sets_of_another_dimension_are_refused_where_no_figure_shows_it(tmp_path):
    solid = tmp_path / "solid.npy"
    save(solid, generate("random", n=16, d=3))
    with pytest.raises(InputError, match=r"its sets are of d=3, and figure 1 shows d=2"):
        check_sets(find(["1"]), FigureOptions("tiny", {"bnot": str(solid)}))
    check_sets(find(["9"]), FigureOptions("tiny", {"bnot": str(solid)}))


def test_sets_that_figures_show_pass(flat):
    for name in ("bnot", "mine"):
        check_sets(find(["1", "2", "9"]), FigureOptions("tiny", {name: flat}))


def test_figure_9_names_the_users_sets_by_their_method_whatever_their_folder_is_called():
    """A folder called gbn holds VnC's sets: neither takes the other's name."""
    (figure,) = find(["9"])
    options = FigureOptions("tiny", {"vnc": "sets/gbn"})

    def study(source, n, d, variance):
        rows = [
            {"source": source, "n": m, "d": d, "integrand": family, "instances": 2, "realizations": 2,
             "shifts": 0, "variance": variance, "standard_error": 0.0, "low": variance, "high": variance,
             "foretold": float("nan"), "beyond": float("nan")}
            for m in n for family in ("gaussians", "half-space")
        ]  # fmt: skip
        slopes = pd.DataFrame(columns=["source", "d", "integrand", "slope", "standard_error"])
        return IntegrationStudy({}, pd.DataFrame(rows), slopes)

    data = {f"d{d}": study("gbn", (16, 64), d, 1e-3) for d in (2, 3, 8)}
    data["sets of vnc"] = study("gbn", (16,), 2, 1e-5)
    flat = [[0.0, 1.0], [1.0, 0.0]]
    data["integrands"] = {"plane": {"gaussians": flat, "half-space": flat}}
    page = Figure(layout="constrained").subfigures(1, 1, squeeze=False)[0, 0]
    figure.draw(data, options).paint(page)
    drawn = {
        line.get_color(): list(line.get_ydata()) for line in page.axes[0].lines if line.get_marker() == "o"
    }
    assert drawn[stroke("gbn").colour] == [1e-3, 1e-3]
    assert drawn[stroke("vnc").colour] == [1e-5]
    assert [text.get_text() for text in page.legends[0].get_texts()] == ["GBN", "VnC", "1/n"]


def test_the_users_sets_take_the_place_of_ours_in_figure_9():
    requests = find(["9"])[0].needs(FigureOptions("tiny", {"bnot": "sets/theirs"}))
    assert "bnot" in find(["9"])[0].needs(FigureOptions("tiny"))["d2"].sources
    assert "bnot" not in requests["d2"].sources
    assert requests["sets of bnot"].sources == ("sets/theirs",)


def test_a_folder_of_something_else_is_left_alone(tmp_path, capsys):
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "thesis.txt").write_text("mine")
    assert command(["figures", "6", "--quick", "--out", str(folder), "--quiet"]) == 2
    assert "is not empty and is not a folder of figures" in capsys.readouterr().err
    assert [p.name for p in folder.iterdir()] == ["thesis.txt"]


@pytest.mark.slow
def test_the_page_keeps_figures_of_earlier_calls(tmp_path, capsys):
    folder = tmp_path / "figures"
    common = ["--quick", "--out", str(folder), "--quiet"]
    with smallest_sizes():
        assert command(["figures", "6", *common]) == 0
        assert command(["figures", "4", *common, "--no-captions"]) == 0
    page = (folder / "index.html").read_text()
    assert "figure-04.png" in page
    assert "figure-06.png" in page
    assert "<figcaption>" in page
    assert "## Figure 6" in (folder / "captions.md").read_text()
    assert str(folder / "figure-04.png") in capsys.readouterr().out


@pytest.mark.parametrize(("name", "message"), [("18", "no figure 18"), ("99", "no figure 99")])
def test_figures_that_are_not_there_are_refused(name, message, capsys, tmp_path):
    assert command(["figures", name, "--out", str(tmp_path / "x")]) == 2
    assert message in capsys.readouterr().err
