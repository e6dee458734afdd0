"""Map of depth against order, looks and integration: closed forms, resuming, and the picture."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from gbnbench.analysis.integration.integrands.korobov import Korobov
from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.benchmarks.experiments import depth_integration as integration
from gbnbench.benchmarks.experiments import depth_looks, depth_order, depth_order_row, depth_order_tasks
from gbnbench.execution.progress import Progress
from gbnbench.reports.benchmarks.depth_order import figure
from gbnbench.runs.resumable import TaskRun

TINY = depth_order_tasks.Map(144, 2, (4, 8), (0.5, 0.6), (20,), (20, 60), 2, 0.6)


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    path = tmp_path_factory.mktemp("deep") / "results" / "depth_order.csv"
    depth_order.main([str(path)], (TINY, replace(TINY, n=125, d=3, c=(8,), edges=(0.6,), gbn=(20,), seeds=1)))
    return path


def test_every_point_of_the_map_has_its_row_and_its_depth(path):
    table = pd.read_csv(path)
    assert tuple(table.columns) == depth_order_row.COLUMNS
    assert table.groupby(["d", "generator"]).size().to_dict() == {
        (2, "deep"): 8, (2, "gbn"): 4, (3, "deep"): 1, (3, "gbn"): 1,
    }  # fmt: skip
    deep = table[(table.generator == "deep") & (table.d == 2)]
    assert deep.converged.all()
    target = np.exp(-deep.c_pi2 * math.pi**2 * (deep.edge**2 - 0.25**2))
    assert (deep.noise_floor < target).all()  # a mean below nu = 0.25 of a profile that rises
    assert (deep.noise_floor > target / 40).all()
    steep = deep[(deep.edge == 0.6) & (deep.c_pi2 == 8)]
    assert steep.noise_floor.max() < 1e-3 * table[table.generator == "gbn"].noise_floor.min()
    assert deep.groupby("edge").excess.mean().is_monotonic_decreasing
    assert table[table.d == 3].psi6.isna().all()
    assert table.drop(columns=["psi6", "valence6", "c_pi2", "edge", "chi"]).notna().all(axis=None)


def test_it_goes_on_where_it_was_stopped(path):
    whole = path.read_text().splitlines()
    part = path.with_name("part.csv")
    part.write_text("\n".join(whole[:6]) + "\n")
    depth_order.main([str(part)], (TINY,))
    again = part.read_text().splitlines()
    assert again[:6] == whole[:6]
    column = depth_order_row.COLUMNS.index("cpu_s")
    timeless = [
        [cell for k, cell in enumerate(line.split(",")) if k != column] for line in (*again, *whole[:13])
    ]
    assert timeless[:13] == timeless[13:]


def test_a_set_off_its_target_is_told_and_not_measured():
    plan = replace(TINY, n=16, c=(8,), edges=(0.95,), gbn=(20,), seeds=1)
    (_, off) = [done.value for done in TaskRun(depth_order_tasks.tasks_of(plan)).complete(None, Progress())][
        1:
    ]
    assert off["converged"] is False
    assert math.isnan(off["noise_floor"])
    assert off["chi"] == pytest.approx(math.pi * 0.95**2 / 4)


def test_the_band_beyond_the_edge_is_that_of_the_shells():
    x = np.random.default_rng(1).random((64, 2))
    spectrum = periodogram(x, 9)
    f = np.indices((19, 19)).reshape(2, -1) - 9
    length = np.hypot(*f)
    band = (length >= 0.5 * 8) & (length <= 0.65 * 8)
    mean, ring = depth_order_row.beyond(radial(spectrum), 0.5)
    power = spectrum.power.ravel()
    assert mean == pytest.approx(power[band].mean())
    assert ring == pytest.approx(max(power[band & (np.rint(length) == k)].mean() for k in (4, 5)))


def test_a_lattice_has_waves_and_noise_has_none():
    rng = np.random.default_rng(2)
    square = np.stack(np.meshgrid(*[np.arange(32) / 32] * 2), axis=-1).reshape(1, -1, 2)
    _, lattice = depth_looks.waves(square)
    _, noise = depth_looks.waves(rng.random((8, 1024, 2)))
    assert min(lattice) > 1
    assert max(noise) < 0.05
    new = depth_looks.row("noise", rng.random((4, 256, 2)))
    assert tuple(new) == depth_looks.COLUMNS
    assert new["anisotropy_edge_db"] == pytest.approx(-10 * math.log10(4), abs=1.2)


def test_measured_variance_is_what_the_spectrum_predicts():
    rng = np.random.default_rng(5)
    x = rng.random((3, 40, 2))
    drawn = [Korobov().draw(2, rng) for _ in range(40)]
    variance, error = integration.measured(drawn, x, 40, rng)
    predicted = integration.predicted(Korobov().mean_energy, x, 12)
    assert variance == pytest.approx(predicted, abs=4 * error)
    assert error < 0.1 * variance


def test_integration_writes_a_row_a_source_and_family(tmp_path, monkeypatch):
    monkeypatch.setattr(integration, "SOURCES", ("random", "deep[edge={lower}]"))
    few = {name: replace(drawn, count=3) for name, drawn in integration.FAMILIES.items()}
    monkeypatch.setattr(integration, "FAMILIES", few)
    found = pd.DataFrame(integration.rows(((100, 2, {"lower": 0.5}, 20),), sets=2, shifts=4))
    assert list(found.columns) == list(integration.COLUMNS)
    assert len(found) == 6
    assert found[found.integrand == "half space"].predicted.isna().all()
    smooth = found[found.integrand == "64 Gaussians"].set_index("source")
    assert smooth.variance["deep[edge=0.5]"] < 0.1 * smooth.variance["random"]
    assert smooth.variance.to_numpy() == pytest.approx(smooth.predicted.to_numpy(), rel=0.6)


def test_the_picture_is_drawn_from_the_table(path):
    drawn = figure(pd.read_csv(path), n=144, d=2, start=20)
    axes = drawn.axes
    assert len(axes) == 6
    assert [len(ax.containers) for ax in axes[:4]] == [2, 2, 2, 2]
    assert "of 8" in "".join(text.get_text() for text in drawn.texts)
