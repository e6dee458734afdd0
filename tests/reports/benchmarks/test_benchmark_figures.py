"""The benchmark's two pictures, from tables made up here: whole, legible, and no label on another."""

from __future__ import annotations

import itertools

import numpy as np
import pandas as pd
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

from gbnbench.generators.registry import GENERATORS
from gbnbench.reports.benchmarks import generators, scaling, speed_error
from gbnbench.reports.comparison.figure_files import pdf, png

MACHINE = {
    "processor": "A processor", "cores": 2, "device": "a device", "versions": {"finufft": "2.5", "numpy": "2"}
}  # fmt: skip
CASES = ("n=1024 2D F=64", "n=1024 2D F=64, 16 sets", "n=4096 3D F=16", "n=4096 8D F=1")


def speed_rows(finufft=True, quoted=True):
    ways = [
        ("gbnbench double", "gbnbench", "double", 3e-16, 1.0),
        ("gbnbench float", "gbnbench", "float", 1e-7, 0.6),
        ("naive kernel", "naive kernel", "double", 3e-16, 300.0),
        ("numpy separable", "numpy separable", "double", 1e-14, 9.0),
        ("something new", "new", "double", 1e-5, 2.0),
    ]  # fmt: skip
    if finufft:
        ways += [
            (f"FINUFFT {t:.0e}", "FINUFFT", "double", t / 2, 1 - np.log10(t) / 10)
            for t in (1e-3, 1e-6, 1e-12)
        ]
    rows = [
        {
            "case": case,
            "method": m,
            "family": f,
            "precision": p,
            "cpu_ms": 2 * ms,
            "cpu_ms_median": 2.4 * ms,
            "error_rms": e,
        }
        for case, (m, f, p, e, ms) in itertools.product(CASES, ways)
    ]
    if quoted:
        rows.append(
            {
                "case": CASES[0],
                "method": "PSA (quoted)",
                "family": "PSA (quoted)",
                "precision": "float",
                "cpu_ms": 1550.0,
            }
        )
    return pd.DataFrame(rows)


def scaling_rows(share=0.6):
    rows = []
    for sweep, size, values in (
        ("n", "n", (64, 512, 4096)),
        ("d", "d", (1, 3, 8)),
        ("realizations", "sets", (1, 8)),
    ):
        for value in values:
            for precision in ("double", "float"):
                fixed = {"n": 1024, "d": 2, "F": 64, "sets": 1, size: value}
                flops = 2e7 if sweep == "d" else 1e5 * value**1.5
                method = {"method": f"gbnbench {precision}", "family": "gbnbench", "precision": precision}
                rows.append(
                    {
                        "sweep": sweep,
                        **fixed,
                        **method,
                        "flops": flops,
                        "cpu_ms": 0.3 + flops / 3e7,
                        "share_of_peak": share,
                    }
                )
    return pd.DataFrame(rows)


def beyond(axis):
    """Labels of ticks that the view leaves out, which matplotlib keeps but does not draw."""
    low, high = sorted(axis.get_view_interval())
    ticks = [*axis.get_major_ticks(), *axis.get_minor_ticks()]
    return [t.label1 for t in ticks if not low * (1 - 1e-9) <= t.get_loc() <= high * (1 + 1e-9)]


def texts(figure):
    figure.set_dpi(100)
    FigureCanvasAgg(figure).draw()
    ticks = {tick for ax in figure.axes for axis in (ax.xaxis, ax.yaxis) for tick in beyond(axis)}
    drawn = [t for t in figure.findobj(Text) if t.get_visible() and t.get_text().strip() and t not in ticks]
    return {t: t.get_window_extent() for t in drawn}


def overlaps(figure):
    boxes = texts(figure)
    return [
        (a.get_text(), b.get_text())
        for a, b in itertools.combinations(boxes, 2)
        if boxes[a].shrunk(0.9, 0.8).overlaps(boxes[b].shrunk(0.9, 0.8))
    ]


FIGURES = {
    "all": lambda: speed_error.figure(speed_rows(), MACHINE),
    "no finufft": lambda: speed_error.figure(speed_rows(finufft=False, quoted=False), MACHINE),
    "one case": lambda: speed_error.figure(speed_rows()[lambda t: t.case == CASES[0]], {}),
    "scaling": lambda: scaling.figure(scaling_rows(), MACHINE),
    "no peak": lambda: scaling.figure(scaling_rows(share=float("nan")), MACHINE),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", FIGURES)
def test_pictures_are_whole_and_their_words_apart(kind):
    figure = FIGURES[kind]()
    width, height = figure.get_size_inches() * 100
    if kind != "one case":  # a single narrow panel
        for text, box in texts(figure).items():
            assert -1 <= box.x0 <= box.x1 <= width + 1, text.get_text()
            assert -1 <= box.y0 <= box.y1 <= height + 1, text.get_text()
        assert overlaps(figure) == []
    assert png(figure).startswith(b"\x89PNG")
    assert pdf(figure).rstrip().endswith(b"%%EOF")


@pytest.mark.slow
def test_panels_say_the_case_the_quoted_time_and_the_machine():
    figure = FIGURES["all"]()
    words = " ".join(t.get_text() for t in texts(figure)).replace("\n", " ")
    for part in (
        *CASES,
        "PSA (quoted): 1,550 ms",
        "A processor, 2 cores",
        "finufft 2.5",
        "1e-03, 1e-06, 1e-12",
        "double",
    ):
        assert part in words
    bare = " ".join(t.get_text() for t in texts(FIGURES["no finufft"]())).replace("\n", " ")
    assert "FINUFFT, one thread" not in bare
    assert "tolerances" not in bare
    curve = next(
        line for line in figure.axes[0].lines if line.get_color() == speed_error.LOOKS["gbnbench"][0]
    )
    assert curve.get_xdata().tolist() == [3e-16, 1e-7]
    assert curve.get_ydata().tolist() == [2.0, 1.2]


@pytest.mark.slow
@pytest.mark.parametrize("error", [1e-7, 7e-7, 1e-4])
def test_the_name_of_a_precision_stays_in_its_panel(error):
    rows = speed_rows(finufft=False, quoted=False)[lambda t: t.family != "new"]
    last = (rows.case == CASES[-1]) & (rows.precision == "float")
    figure = speed_error.figure(rows.assign(error_rms=rows.error_rms.where(~last, error)), MACHINE)
    boxes = texts(figure)
    for ax in figure.axes:
        panel = ax.get_window_extent()
        names = [t for t in ax.texts if t.get_text() in ("double", "float")]
        assert len(names) == 2
        for name in names:
            assert panel.x0 <= boxes[name].x0 < boxes[name].x1 <= panel.x1


def test_without_a_peak_the_panel_says_so():
    words = [t.get_text() for t in texts(FIGURES["no peak"]())]
    assert words.count("peak not measured") == 3
    assert "n = 4,096" in words
    assert "n = 64" in words


def test_floors_against_time_name_every_generator():
    names = list(GENERATORS)
    seconds = np.geomspace(3e-4, 10, len(names))
    floors = np.geomspace(1, 1e-30, len(names))
    rows = [(1024, 2, *row) for row in zip(names, seconds, floors, strict=True)]
    table = pd.DataFrame(rows, columns=["n", "d", "generator", "cpu_s", "noise_floor"])
    table.loc[len(table)] = (1024, 2, "lloyd", np.nan, np.nan)  # refused
    drawn = generators.figure(table)
    shown = [text.get_text() for ax in drawn.axes for text in ax.texts]
    assert sorted(shown) == sorted(names)
    assert png(drawn)


def test_a_name_stands_left_of_its_mark_where_it_would_cover_another():
    rows = [
        (1024, 2, "gbn", 0.1, 6e-10),
        (1024, 2, "progressivegbn", 0.2, 6e-10),
        (1024, 2, "deep", 0.1, 1e-20),
    ]
    drawn = generators.figure(pd.DataFrame(rows, columns=["n", "d", "generator", "cpu_s", "noise_floor"]))
    sides = {text.get_text(): text.get_ha() for text in drawn.axes[0].texts}
    assert sides == {"gbn": "right", "progressivegbn": "left", "deep": "left"}
