"""Figures of a comparison as files: whole, named, repeatable, in any dimension."""

import io
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

from gbnbench.core.results.measures import Measures
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.reports import captions, style
from gbnbench.reports.comparison import loglog, radial, spectrum, sweep, voronoi_cells
from gbnbench.reports.comparison.figure_files import FIGURES, pdf, planned, png, write_figures
from gbnbench.runs.comparison_result import Run
from tests.oracles.neighbours import valence_by_empty_circles
from tests.reports import samples

ODD = (
    "<script>alert(1)</script>",
    "$\\frac{1}$ $",
    "_hidden",
    "日本語 \U0001f600 \u202e",
    "x" * 300,
    "a\nb\tc",
    "",
)


def odd_run(sets: np.ndarray, labels: tuple[str, ...], fmax: int = 4) -> Run:
    sources = [samples.source(label, sets, fmax, key=f"s{k}") for k, label in enumerate(labels)]
    return Run(samples.manifest(), tuple(sources))


def every_figure(run: Run) -> list[Figure]:
    return [
        kind.draw(run, None) for kind in FIGURES.values() if any(kind.needs(source) for source in run.sources)
    ]


def assert_drawn(content: bytes) -> None:
    with Image.open(io.BytesIO(content)) as opened:
        picture = opened.convert("RGB")
    assert min(picture.size) > 80
    colours = picture.getcolors(picture.width * picture.height)
    assert len(colours) > 20
    inked = sum(count for count, colour in colours if min(colour) < 250)
    assert 0.001 < inked / (picture.width * picture.height) < 0.95


@pytest.mark.slow
def test_files_are_whole_named_and_repeatable(tmp_path: Path) -> None:
    run = samples.small_run()
    names = [path.name for path in write_figures(run, tmp_path / "pictures")]
    assert names == [f"{name}.png" for name in FIGURES]
    paths = write_figures(run, tmp_path / "figures", with_pdf=True)
    assert sorted(p.name for p in paths) == sorted(
        f"{name}.{end}" for name in FIGURES for end in ("pdf", "png")
    )
    assert sorted((tmp_path / "figures").iterdir()) == sorted(paths)  # no temporary file is left
    for path in paths:
        content = path.read_bytes()
        if path.suffix == ".png":
            assert_drawn(content)
            assert b"Software" not in content
        else:
            assert content.startswith(b"%PDF-")
            assert content.rstrip().endswith(b"%%EOF")
            assert b"CreationDate" not in content
    again = FIGURES["loglog"].draw(run, None)
    assert png(again) == (tmp_path / "figures" / "loglog.png").read_bytes()
    assert pdf(again) == (tmp_path / "figures" / "loglog.pdf").read_bytes()


@pytest.mark.slow
def test_several_n_get_files_each_and_a_sweep() -> None:
    sources = [
        samples.source(label, make(n, 2, 2), 3)
        for n in (16, 36)
        for label, make in (("random", samples.random), ("jittered", samples.jittered))
    ]
    run = Run(samples.manifest(), tuple(sources))
    names = [stem for stem, _, _ in planned(run)]
    assert names == [*(f"{name}_n{n}_d2" for n in (16, 36) for name in FIGURES), "sweep"]
    given = style.strokes(run)
    assert given[sources[0].key] == given[sources[2].key] != given[sources[1].key]
    assert not sweep.several(samples.small_run())
    assert_drawn(png(sweep.figure(run)))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("n", "d", "fmax", "realizations"),
    [(8, 1, 6, 3), (27, 3, 3, 1), (4, 8, 1, 2), (1, 2, 4, 1), (2, 2, 4, 2), (3, 1, 1, 1), (5, 2, 1, 3)],
)
def test_any_dimension_and_few_points(n: int, d: int, fmax: int, realizations: int) -> None:
    run = odd_run(samples.random(n, d, realizations, seed=n), ("random",), fmax)
    for figure in every_figure(run):
        assert_drawn(png(figure, 60))
    needing = [name for name, kind in FIGURES.items() if kind.needs(run.sources[0])]
    assert ("zone-plate" in needing) == ("valence" in needing) == (d == 2)


@pytest.mark.slow
def test_labels_are_drawn_as_they_stand() -> None:
    run = odd_run(samples.random(16, 2, 2), ODD)
    assert_drawn(png(FIGURES["gallery"].draw(run, None), 40))
    assert pdf(loglog.figure(run)).startswith(b"%PDF")
    legend = loglog.figure(run).axes[0].get_legend()
    assert legend is not None
    assert len(legend.get_texts()) >= len(ODD)


@pytest.mark.parametrize("count", [1, pytest.param(20, marks=pytest.mark.slow)])
def test_one_source_and_twenty(count: int) -> None:
    run = odd_run(samples.random(9, 2, 2), tuple(f"source {k}" for k in range(count)), 3)
    assert len(set(style.strokes(run).values())) == count
    for name in ("gallery", "loglog"):
        assert_drawn(png(FIGURES[name].draw(run, None), 40))


@pytest.mark.slow
def test_exact_zeros_and_tall_harmonics_of_a_lattice() -> None:
    source = samples.source("grid", samples.grid(64, 2), 16)
    exact = np.where(source.radial.power < 1e-9, 0.0, source.radial.power)
    zeroed = replace(source, radial=replace(source.radial, power=exact))
    run = Run(samples.manifest(), (zeroed, samples.source("random", samples.random(64, 2, 2), 16)))
    for name in ("spectrum", "radial", "loglog", "valence"):
        assert_drawn(png(FIGURES[name].draw(run, None), 60))
    axes = loglog.figure(run).axes[0]
    low, high = axes.get_ylim()
    assert low > 0
    assert high > 64
    floor = [line for line in axes.get_lines() if line.get_marker() == "v"]
    assert len(floor) == 1
    assert len(floor[0].get_xdata()) == np.sum(exact == 0)
    assert radial.power_limit(run.sources) == radial.CAP


def test_all_nan_and_empty_tables() -> None:
    source = samples.source("random", samples.random(16, 2, 2), 3)
    nothing = replace(
        source,
        measures=Measures(dict.fromkeys(source.measures, float("nan"))),
        anisotropy=source.anisotropy.assign(anisotropy_db=float("nan")),
        radial=replace(source.radial, power=np.full_like(source.radial.power, np.nan)),
        valence=None,
        zone_plate=None,
        rdf=None,
    )
    for figure in every_figure(Run({}, (nothing,))):
        assert png(figure, 50).startswith(b"\x89PNG")


def test_picture_has_x_right_and_y_up() -> None:
    fmax = 5
    power = np.full((11, 11), 1e-3)
    power[fmax + 3, fmax] = 5.0  # f = (3, 0): along x
    source = replace(
        samples.source("x", samples.random(16, 2, 1), fmax), spectrum=Spectrum(power, 16, 2, 1, fmax)
    )
    figure = spectrum.figure(Run({}, (source,)))
    shown = figure.axes[0].images[0]
    row, column = np.argwhere(np.asarray(shown.get_array()) > 1)[0]
    assert (row, column) == (fmax, fmax + 3)
    assert shown.origin == "lower"


def test_plane_of_cubes_and_lists() -> None:
    power = np.arange(5.0**3).reshape(5, 5, 5)
    cut = spectrum.plane(Spectrum(power, 8, 3, 1, 2))
    assert cut is not None
    assert cut[4, 1] == power[4, 1, 2]
    line = spectrum.plane(Spectrum(np.arange(5.0), 8, 1, 1, 2))
    assert line is not None
    assert line.shape == (5, 1)
    listed = np.array([[1, 0, 0], [0, -2, 0], [1, 1, 1]])
    some = spectrum.plane(Spectrum(np.array([7.0, 8.0, 9.0]), 8, 3, 1, 2, listed))
    assert some is not None
    assert (some[3, 2], some[2, 0]) == (7.0, 8.0)
    assert (some[1, 2], some[2, 4]) == (7.0, 8.0)  # of -f
    assert np.isfinite(some).sum() == 4
    assert spectrum.plane(Spectrum(np.array([9.0]), 8, 3, 1, 2, listed[2:])) is None


def test_tone_map_is_that_of_psa() -> None:
    assert spectrum.tone_map(np.array([0.0, 16.0, 100.0, -1e-30])).tolist() == [0.0, 1.0, 1.0, 0.0]
    assert spectrum.tone_map(np.array([1.0]))[0] == pytest.approx(np.log(1.25) / np.log(2))


def test_cells_have_the_sides_of_the_periodic_triangulation() -> None:
    x = samples.random(30, 2, 1, seed=5)[0]
    polygons, degrees = voronoi_cells.cells(x)
    inside = [k for k, p in enumerate(polygons) if _site_inside(p, x)]
    assert np.sort(degrees[inside]).tolist() == valence_by_empty_circles(x).tolist()
    area = [
        0.5 * abs(np.sum(p[:, 0] * np.roll(p[:, 1], -1) - np.roll(p[:, 0], -1) * p[:, 1])) for p in polygons
    ]
    assert sum(area[k] for k in inside) == pytest.approx(1.0)


def _site_inside(polygon: np.ndarray, x: np.ndarray) -> bool:
    """Whether one of the points themselves, not an image, lies in this convex cell."""
    edge = np.roll(polygon, -1, axis=0) - polygon
    offset = x[:, None, :] - polygon
    side = edge[:, 0] * offset[..., 1] - edge[:, 1] * offset[..., 0]
    return bool(np.any(np.all(side > 0, axis=1) | np.all(side < 0, axis=1)))


def test_cells_of_lattices_and_single_points() -> None:
    assert set(voronoi_cells.cells(samples.grid(100, 2)[0])[1]) == {4}
    assert set(voronoi_cells.cells(np.array([[0.3, 0.9]]))[1]) == {4}


def test_cells_of_coincident_points_are_left_out() -> None:
    x = samples.random(20, 2, 1)[0]
    polygons, degrees = voronoi_cells.cells(np.vstack([x, x[:1]]))
    assert len(polygons) == len(degrees)
    assert degrees.min() >= 3


def test_large_sets_show_a_corner() -> None:
    source = samples.source("random", samples.random(20000, 2, 1), 2)
    run = Run({}, (source,))
    for name in ("points", "valence"):
        assert FIGURES[name].draw(run, None).axes[0].get_xlim()[1] == pytest.approx((4096 / 20000) ** 0.5)


@pytest.mark.parametrize("draw", [kind.draw for kind in FIGURES.values()])
def test_caption_has_the_settings(draw: Callable[[Run, None], Figure]) -> None:
    figure = draw(samples.small_run(), None)
    caption = " ".join(text.get_text() for text in figure.texts).replace(captions.NBSP, " ")
    for part in ("n = 64", "d = 2", "4 realizations", "seed 0", "cpu-haswell", "gbnbench 0.1.0"):
        assert part in " ".join(caption.split())
