"""Figures 1, 2, 5, 8, 12 and 14: made by the command, and what is drawn is what the library measured."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from matplotlib.figure import Figure

from gbnbench import save
from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.cli import gbnbench
from gbnbench.execution.progress import Progress
from gbnbench.reports import style
from gbnbench.reports.paper import figure_12, gallery_requests, wording
from gbnbench.reports.paper.data import folder_name, obtain
from gbnbench.reports.paper.figure import Drawing, FigureOptions
from gbnbench.reports.paper.method_columns import user_columns
from gbnbench.reports.paper.method_styles import NAMES as METHOD_NAMES
from gbnbench.reports.paper.method_styles import STROKES, stroke
from gbnbench.reports.paper.registry import find
from tests.smallest_sizes import smallest_sizes

pytestmark = pytest.mark.slow

NAMES = ("1", "2", "5", "8", "12", "14")


@dataclass
class Folder:
    """What the command left, and the same data read again."""

    path: Path
    options: FigureOptions
    captions: dict[str, dict[str, str]]

    def data(self, name: str, options: FigureOptions | None = None) -> Mapping[str, Any]:
        (figure,) = find([name])
        options = options or self.options
        return {
            key: obtain(request, self.path / "data" / folder_name(request, 0), 0, 1, Progress())
            for key, request in figure.needs(options).items()
        }

    def drawing(self, name: str, options: FigureOptions | None = None) -> Drawing:
        (figure,) = find([name])
        return figure.draw(self.data(name, options), options or self.options)

    def axes(self, name: str, options: FigureOptions | None = None) -> list[Any]:
        drawing = self.drawing(name, options)
        page = Figure(figsize=(drawing.width, drawing.height), layout="constrained")
        style.styled(drawing.paint)(page.subfigures(1, 1, squeeze=False)[0, 0])
        return page.axes

    def caption(self, name: str) -> str:
        return self.captions[f"figure-{int(name):02d}"]["caption"]


@pytest.fixture(scope="module", autouse=True)
def no_generators_of_others() -> Iterator[None]:
    """Let the figures show methods of others by the sets given alone, whichever have a generator by now."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(gallery_requests, "generator_of", lambda *_: None)
        yield


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    path = tmp_path_factory.mktemp("figures")
    rng = np.random.default_rng(5)
    cell = np.stack(np.meshgrid(np.arange(10), np.arange(10)), -1).reshape(-1, 2)
    for name in ("bnot", "step", "house"):
        (path / name).mkdir()
        for k in range(3):
            save(path / name / f"{k}.npy", (cell + rng.random((100, 2))) / 10)
    sets = {name: str(path / name) for name in ("bnot", "step", "house")}
    out = path / "out"
    options = [f"--sets={name}={place}" for name, place in sets.items()]
    arguments = ["figures", *NAMES, "--quick", "--quiet", "--jobs", "1", "--out", str(out), *options]
    with smallest_sizes():
        result = CliRunner().invoke(gbnbench, arguments)
    assert result.exit_code == 0, result.output
    return Folder(out, FigureOptions("tiny", sets), json.loads((out / "captions.json").read_bytes()))


def lines(ax):
    """Drawn lines with more than two points, by x and y."""
    return [(line.get_xdata(), line.get_ydata()) for line in ax.get_lines() if len(line.get_xdata()) > 2]


def drawn(ax, power) -> bool:
    """Whether one of the lines in an axes is this radial power, value by value."""
    return any(
        len(x) == len(power.nu) and np.array_equal(x, power.nu) and np.array_equal(y, power.power)
        for x, y in lines(ax)
    )


@pytest.mark.parametrize("name", NAMES)
def test_the_command_writes_both_formats_and_a_caption_that_says_what_is_seen(made, name):
    stem = made.path / f"figure-{int(name):02d}"
    assert stem.with_suffix(".png").read_bytes().startswith(b"\x89PNG")
    assert stem.with_suffix(".pdf").read_bytes().startswith(b"%PDF-")
    caption = made.caption(name)
    assert "d = 2" in caption
    assert "of 100 points" in caption
    assert "nan" not in caption
    assert "  " not in caption


def test_figure_1_lays_every_method_s_exact_shells_over_one_another(made):
    data = made.data("1")
    plot = made.axes("1")[-1]
    for key, label in [(k, None) for k in ("bnot", "house")] + [
        ("large", name) for name in ("jittered", "sobol", "fpo", "gbn")
    ]:
        (source,) = [s for s in data[key].sources if label in (None, s.label)]
        assert drawn(plot, source.radial), (key, label)
    assert plot.get_xscale() == plot.get_yscale() == "log"
    titles = [text.get_text() for text in plot.get_legend().get_texts()]
    assert titles == ["Owen-Sobol", "Stratified", "BNOT", "FPO", "house", "GBN", "GBN, 1M"]
    caption = made.caption("1")
    assert "KDM, VnC and BlueNets of the paper are left out" in caption
    floor = data["bnot"].sources[0].measures["noise_floor"]
    assert f"{wording.rounded(floor)} (BNOT)" in caption


def test_figure_1_s_guides_are_the_ideal_profiles(made):
    ax = made.axes("1")[-1]
    dotted = [line for line in ax.get_lines() if line.get_linestyle() == ":"]
    strata, ideal = (np.stack(line.get_data()) for line in dotted)
    assert strata[1] == pytest.approx((math.pi * strata[0]) ** 2 / 3)
    (gbn,) = [s for s in made.data("1")["large"].sources if s.label == "gbn"]
    slope = np.polyfit(ideal[0] ** 2, np.log(ideal[1]), 1)
    assert slope[0] == pytest.approx(4 * math.pi**2)
    assert math.exp(slope[1]) == pytest.approx(gbn.measures["profile_epsilon"])


def test_without_sets_the_column_is_left_out_and_the_caption_says_so(made):
    plain = FigureOptions("tiny")
    drawing = made.drawing("1", plain)
    assert "BNOT, KDM, VnC and BlueNets of the paper are left out" in drawing.caption
    assert "Shaded" in made.caption("1")
    assert "Shaded" not in drawing.caption
    assert drawing.height < made.drawing("1").height  # three columns have the plot beside them
    assert len(made.axes("1", plain)) == 3 * 3 + 2  # and a colour bar
    assert len(made.axes("1")) == 3 * 5 + 2
    assert "GBN; sets given as --sets bnot=PATH" in made.drawing("14", plain).caption
    assert "Heck et al. in the paper is left out" in made.drawing("12", plain).caption


def test_figure_2_draws_both_settings_and_names_their_floors(made):
    run = made.data("2")["sets"]
    narrow, wide = run.sources
    plot = made.axes("2")[-1]
    assert drawn(plot, narrow.radial)
    assert drawn(plot, wide.radial)
    for source in run.sources:
        assert wording.rounded(source.measures["noise_floor"]) in made.caption("2")
    assert narrow.label == "gbn[sigma=0.5,iterations=30]"
    assert wide.measures["noise_floor"] < narrow.measures["noise_floor"] / 100


def test_figure_5_has_a_column_for_each_cut_off_with_the_whole_kernel_behind(made):
    data = made.data("5")
    (whole,) = [s for s in data["whole"].sources if s.label == "gbn"]
    plots = made.axes("5")[12:]
    for plot, source in zip(plots, [*data["cvt"].sources, *data["cut"].sources, whole], strict=True):
        assert drawn(plot, source.radial)
        assert drawn(plot, whole.radial)
    floors = [source.measures["noise_floor"] for source in data["cut"].sources]
    assert floors[0] > 100 * floors[3] > 100 * whole.measures["noise_floor"]


def test_figure_8_shows_five_rows_a_column_a_method(made):
    axes = made.axes("8")
    titles = ["Stratified", "CVT", "BNOT", "house", "FPO", "GBN"]
    assert [ax.get_title() for ax in axes[:6]] == titles
    data = made.data("8")
    (gbn,) = [s for s in data["classic"].sources if s.label == "gbn"]
    points, grey, power, plate, cells = axes[5::6]
    assert np.array_equal(np.column_stack(points.get_lines()[0].get_data()), gbn.points[0])
    assert grey.get_images()[0].get_array().shape == gbn.spectrum.power.shape
    assert drawn(power, gbn.radial)
    assert np.array_equal(plate.get_images()[0].get_array(), gbn.zone_plate)
    assert len(cells.patches) + len(cells.artists) >= 2  # a patch a valence
    assert f"{100 * gbn.measures['valence6']:.0f} (GBN)" in made.caption("8")


def test_figure_12_s_bands_are_as_low_as_the_caption_says(made):
    data = made.data("12")
    for edge, source in zip((*figure_12.EDGES, 0.7), data["sets"].sources, strict=True):
        assert source.label.endswith(f"[edge={edge}]")
        power = radial(periodogram(source.points, 12))
        highest = power.power[power.nu < edge - 1e-9].max()
        assert figure_12.band(source.radial, edge) == pytest.approx(highest, rel=1e-6, abs=1e-26)
    assert figure_12.band(data["sets"].sources[-1].radial, 0.7) < 1e-26
    plots = made.axes("12")[10:]
    sources = [*data["sets"].sources, *data["step"].sources]
    assert all(drawn(plot, source.radial) for plot, source in zip(plots, sources, strict=True))
    low = figure_12.band(data["step"].sources[0].radial, 0.5)
    assert f"the highest below 0.5 is {wording.rounded(low)}" in made.caption("12")


def test_figure_14_s_annuli_are_the_means_of_its_exact_shells(made):
    exact, _, rings, _ = (lines(ax)[0] for ax in made.axes("14"))
    source = made.data("14")["bnot"].sources[0]
    assert np.array_equal(exact[1], source.radial.power)
    frequency, power, count = (getattr(source.radial, name) for name in ("frequency", "power", "count"))
    ring = np.floor(frequency / 2)
    for k, (nu, value) in enumerate(zip(*rings, strict=True)):
        mine = ring == k
        assert value == pytest.approx(np.average(power[mine], weights=count[mine]))
        assert 2 * k <= nu * 10 < 2 * k + 2
    assert f"{wording.rounded(float(rings[1][0]))} at a mean |f| of" in made.caption("14")


def test_one_method_has_one_colour_and_no_two_share_colour_and_dash():
    strokes = list(STROKES.values())
    assert len({(s.colour, str(s.dash)) for s in strokes}) == len(strokes)
    for name in STROKES:
        assert stroke(name) == STROKES[name]
        assert stroke(f"{name}[a=1]").colour == STROKES[name].colour
    assert STROKES.keys() <= METHOD_NAMES.keys() | {"latin", "grid", "hexagonal"}


def test_sets_of_another_size_are_taken_where_there_are_none_of_this_one(tmp_path):
    for n in (30, 50):
        save(tmp_path / f"{n}.npy", np.random.default_rng(n).random((n, 2)))
    save(tmp_path / "solid.npy", np.random.default_rng(1).random((20, 3)))
    options = FigureOptions("tiny", {"kdm": str(tmp_path)})
    request = gallery_requests.user_set_requests(options, ("bnot", "kdm"))["kdm"]
    run = obtain(request, tmp_path / "run", 0, 1, Progress())
    assert sorted((s.n, s.d) for s in run.sources) == [(20, 3), (30, 2), (50, 2)]
    assert [c.source.n for c in user_columns({"kdm": run}, ("bnot", "kdm"), 30)] == [30]
    assert [c.source.n for c in user_columns({"kdm": run}, ("kdm",), 100)] == [50]
    only_solid = type(run)({}, tuple(s for s in run.sources if s.d == 3))
    assert user_columns({"kdm": only_solid}, ("kdm",), 20) == []
