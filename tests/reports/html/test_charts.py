"""The data of the charts: those of the pictures, and thinned so that they look the same."""

import json

import numpy as np
import pytest

from gbnbench.reports.comparison import loglog, radial
from gbnbench.reports.html.charts import SHELLS, loglog_chart, radial_chart, thinned
from gbnbench.reports.html.environment import json_data
from gbnbench.runs.comparison_result import Run
from tests.reports import samples


@pytest.fixture(scope="module")
def run():
    sources = (
        samples.source("random", samples.random(64, 2, 4)),
        samples.source("grid", samples.grid(64, 2)),
        samples.source("wide", samples.random(64, 2, 2), fmax=12),
    )
    return Run(samples.manifest(), sources)


def test_log_log_curves_are_the_saved_powers(run):
    chart = loglog_chart(run, (64, 2))
    assert len(chart["grids"]) == 2  # random and grid share their shells
    for curve, source in zip(chart["curves"], run.sources, strict=True):
        assert chart["grids"][curve["grid"]] == pytest.approx(source.radial.nu, rel=1e-5)
        zero = np.flatnonzero(loglog.zero_to_rounding(source))
        assert curve["zero"] == zero.tolist()
        for k, value in enumerate(curve["y"]):
            assert value is None if k in zero else value == pytest.approx(source.radial.power[k], rel=1e-5)
    grid = run.sources[1].radial.frequency
    assert np.delete(grid, chart["curves"][1]["zero"]).tolist() == [8.0]  # its harmonics
    bottom, top = chart["panels"][0]["range"]
    powers = [y for curve in chart["curves"] for y in curve["y"] if y is not None]
    assert bottom < min(powers)
    assert top > max(powers)
    assert json.loads(str(json_data(chart))) == chart


def test_radial_curves_have_shells_above_and_rings_below(run):
    chart = radial_chart(run, (64, 2))
    assert [panel["log"] for panel in chart["panels"]] == [False, False]
    assert chart["panels"][1]["rules"] == pytest.approx([-10 * np.log10(m) for m in (4, 2, 1)], abs=1e-4)
    for number, source in enumerate(run.sources):
        above, below = (c for c in chart["curves"] if c["source"] == number)
        assert above["y"] == pytest.approx(source.radial.power, rel=1e-5)
        rings = source.anisotropy["anisotropy_db"].to_numpy(dtype=float)
        assert below["y"] == pytest.approx([None if np.isnan(v) else v for v in rings], rel=1e-5)
    assert chart["x"]["range"][1] == max(map(radial.reach, run.sources))


def test_thinned_curves_keep_their_envelope():
    rng = np.random.default_rng(0)
    x = np.linspace(1, 5, 50_000)
    values = [rng.exponential(size=x.size), rng.exponential(size=x.size) * x]
    kept = thinned(x, values)
    assert len(kept) <= SHELLS + 2
    assert np.all(np.diff(kept) > 0)
    assert {0, x.size - 1} <= set(kept.tolist())
    strips = np.minimum(((x - 1) / 4 * 1000).astype(int), 999)  # as wide as a pixel
    for value in values:
        for k in range(1000):
            inside, shown = value[strips == k], value[kept][strips[kept] == k]
            assert shown.min() == inside.min()
            assert shown.max() == inside.max()


def test_few_shells_are_all_kept():
    assert thinned(np.arange(SHELLS), [np.ones(SHELLS)]).tolist() == list(range(SHELLS))


def test_json_cannot_end_its_element():
    text = str(json_data({"name": "</script><!--&\u2028"}))
    assert not set("<>&\u2028") & set(text)
    assert json.loads(text) == {"name": "</script><!--&\u2028"}
