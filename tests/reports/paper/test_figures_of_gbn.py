"""Figures 3, 4, 6, 7, 13 and depth through the real command, and that what they draw is the library's."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from gbnbench import generate, periodogram, radial, save, shells
from gbnbench.analysis.radial.profile_measures import noise_floor
from gbnbench.cli import gbnbench
from gbnbench.execution.progress import Progress
from gbnbench.generators.monitor import Monitor, Trace
from gbnbench.reports import style
from gbnbench.reports.paper import figure_07, radial_axes
from gbnbench.reports.paper.data import folder_name, obtain
from gbnbench.reports.paper.figure import FigureOptions, compose
from gbnbench.reports.paper.registry import find
from tests.oracles.power import mean_power
from tests.smallest_sizes import smallest_sizes

pytestmark = pytest.mark.slow

NAMES = ("3", "4", "6", "7", "13", "depth")


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, FigureOptions]:
    folder = tmp_path_factory.mktemp("figures")
    theirs = folder / "given.txt"
    save(theirs, generate("jittered", n=100, seed=3))
    arguments = ["figures", *NAMES, "--quick", "--quiet", "--jobs", "1", "--sets", f"bnot={theirs}"]
    with smallest_sizes():
        result = CliRunner().invoke(gbnbench, [*arguments, "--out", str(folder / "out")])
    assert result.exit_code == 0, result.output
    return folder / "out", FigureOptions("tiny", {"bnot": str(theirs)})


@style.styled
def drawn(made: tuple[Path, FigureOptions], name: str) -> tuple[Figure, dict[str, Any], str]:
    """Draw a figure again from what the command kept."""
    folder, options = made
    (figure,) = find([name])
    data = {}
    for what, request in figure.needs(options).items():
        kept = folder / "data" / folder_name(request, options.seed)
        assert kept.is_dir()
        data[what] = obtain(request, kept, options.seed, 1, Progress())
    drawing = figure.draw(data, options)
    return compose(drawing, "", "", captions=False), data, drawing.caption


def panel(figure: Figure, letter: str) -> Axes:
    (found,) = (ax for ax in figure.axes if ax.get_title(loc="left").startswith(f"({letter})"))
    return found


def lines(ax: Axes) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Labelled curves: x and y."""
    return {
        str(line.get_label()): (np.asarray(line.get_xdata()), np.asarray(line.get_ydata()))
        for line in ax.get_lines()
        if not str(line.get_label()).startswith("_")
    }


@pytest.mark.parametrize("name", NAMES)
def test_picture_page_and_caption(made: tuple[Path, FigureOptions], name: str) -> None:
    folder, _ = made
    stem = f"figure-{int(name):02d}" if name.isdigit() else f"figure-{name}"
    assert (folder / f"{stem}.png").read_bytes().startswith(b"\x89PNG")
    assert (folder / f"{stem}.pdf").read_bytes().startswith(b"%PDF")
    about = json.loads((folder / "captions.json").read_text())[stem]
    assert bool(about["paper"]) == (name != "depth")
    assert "Seed 0" in about["caption"]
    assert "nan" not in about["caption"].split()
    if name not in ("4", "6"):
        assert "sets" in about["caption"]
        assert "n = " in about["caption"] or "points" in about["caption"]


def test_widths_and_dimensions_are_the_library_s(made: tuple[Path, FigureOptions]) -> None:
    figure, _, caption = drawn(made, "3")
    widths, dimensions = lines(panel(figure, "a")), lines(panel(figure, "b"))
    assert list(widths) == ["0.5", "0.7", "0.85", "1", "1.25", "1.5"]
    x = generate("gbn[sigma=0.7,gradients=60]", n=64, realizations=2)
    nu, power = widths["0.7"]
    expected = radial(periodogram(x, round(nu[-1] * 8)))
    assert nu == pytest.approx(expected.nu)
    assert power == pytest.approx(expected.power, rel=1e-6)
    assert list(dimensions) == [str(d) for d in range(2, 9)]
    one = shells(generate("gbn[gradients=60]", n=64, d=5))
    assert dimensions["5"][1] == pytest.approx(one.power, rel=1e-6)
    assert "4k points in (b)" in caption  # where this departs from the paper


def test_ideal_profile_is_equation_19() -> None:
    ax = Figure().subplots()
    radial_axes.profile(ax, 1e-9, 4 * math.pi**2, [0.1, 2.0])
    (line,) = ax.get_lines()
    nu, power = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
    assert nu[0] == pytest.approx(0.1)
    assert power[-1] == pytest.approx(1)
    assert np.diff(np.log(power)) / np.diff(nu**2) == pytest.approx(4 * math.pi**2)


def test_transforms_are_those_of_the_kernels_drawn(made: tuple[Path, FigureOptions]) -> None:
    """By the trapezoid over the kernel's own curve, which shares nothing with the closed forms."""
    figure, _, _ = drawn(made, "4")
    kernels = list(panel(figure, "a").get_lines())
    transforms = panel(figure, "b").get_lines()
    logarithmic = panel(figure, "c").get_lines()
    for kernel, transform, log in zip(kernels, transforms, logarithmic, strict=False):
        x, g = np.asarray(kernel.get_xdata()), np.asarray(kernel.get_ydata())
        nu, found = np.asarray(transform.get_xdata()), np.asarray(transform.get_ydata())
        wave = np.cos(2 * np.pi * np.outer(nu, x))
        expected = np.trapezoid(wave * g, x, axis=1) / math.sqrt(2 * math.pi)
        assert found == pytest.approx(expected, abs=0.012)  # the cut lies between two samples 0.02 apart
        assert np.asarray(log.get_ydata()) == pytest.approx(np.abs(found))


def test_energy_profiles_are_sums_of_images(made: tuple[Path, FigureOptions]) -> None:
    figure, _, _ = drawn(made, "6")
    found = lines(figure.axes[0])
    assert list(found) == ["1", "2", "4", "8", "16", "32", "64"]
    for points, (u, energy) in found.items():
        images = (u[:, None] + np.arange(-20, 21)) * int(points)
        total = np.exp(-(images**2) / 2).sum(axis=1)
        assert energy == pytest.approx(total / total.max(), rel=1e-9)


def test_evolution_is_that_of_the_points(made: tuple[Path, FigureOptions]) -> None:
    figure, data, caption = drawn(made, "7")
    assert [figure_07.gradients(steps) for steps in (1, 100, 10_000)] == [3, 30, 300]
    trace = Trace(keep_at=(30,))
    generate("gbn[iterations=300]", n=64, realizations=2, monitor=Monitor(trace=trace))
    expected = shells(trace.points(30)).radial()
    raw = lines(panel(figure, "a"))
    assert list(raw) == ["1", "3", "10", "30", "100", "300"]
    assert raw["30"][1] == pytest.approx(expected.power, rel=1e-6)
    filtered = np.asarray(panel(figure, "b").get_lines()[3].get_ydata())
    assert filtered == pytest.approx(raw["30"][1] * np.exp(-((2 * np.pi * raw["30"][0]) ** 2)), rel=1e-9)
    floors = data["evolution"]["descent_000"]["floor"]
    assert floors[3] == pytest.approx(noise_floor(expected), rel=1e-6)
    assert np.all(np.diff(floors) < 0)
    excess = data["evolution"]["descent_000"]["excess"]
    assert len(excess) == 300
    assert np.all(np.diff(excess) < 0)
    assert "Eq. 14" in caption


def test_line_is_empty_below_the_edge(made: tuple[Path, FigureOptions]) -> None:
    figure, data, _ = drawn(made, "13")
    power = next(line for line in panel(figure, "c").get_lines() if len(np.asarray(line.get_xdata())) > 2)
    nu, found = np.asarray(power.get_xdata()), np.asarray(power.get_ydata())
    sets = data["line"]["000"]["points"]
    f = np.arange(1, len(nu) + 1)
    expected = mean_power(sets[..., None], f[:, None]).astype(float)
    assert nu == pytest.approx(f / sets.shape[1])
    assert found == pytest.approx(expected, rel=1e-6, abs=1e-20)
    assert found[nu <= 0.3].max() < 1e-8
    assert found[nu > 0.3].mean() > 0.5
    beads = panel(figure, "a").get_lines()[0]
    turns = np.arctan2(np.asarray(beads.get_ydata()), np.asarray(beads.get_xdata())) / (2 * np.pi) % 1
    assert np.sort(turns) == pytest.approx(np.sort(sets[0]))


def test_depth_draws_what_was_measured(made: tuple[Path, FigureOptions]) -> None:
    figure, data, caption = drawn(made, "depth")
    spectra = lines(panel(figure, "a"))
    deep = next(source for source in data["sets"].sources if source.label == "deep")
    assert spectra["Deep"][1] == pytest.approx(deep.radial.power)
    assert "BNOT" in spectra
    assert "BNOT" in caption
    for letter, name in zip("cde", ("valence6", "psi6", "peak"), strict=True):
        ax = panel(figure, letter)
        dots = {(float(x), float(y)) for line in ax.get_lines()
                for x, y in zip(line.get_xdata(), line.get_ydata(), strict=True)}  # fmt: skip
        assert (deep.measures["noise_floor"], deep.measures[name]) in dots
        assert ax.xaxis_inverted()
    variance = data["study"].variance
    assert set(variance["source"]) == {"random", "gbn[gradients=60]", "deep"}
