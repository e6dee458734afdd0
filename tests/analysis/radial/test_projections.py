"""Projections' spectra against the whole set's own frequencies."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.measures import measures
from gbnbench.analysis.radial.projections import frame, projections
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.errors import InputError
from gbnbench.generators.registry import generate


def test_a_projections_power_is_the_whole_sets_on_its_axes():
    x = np.random.default_rng(0).random((3, 50, 3))
    (line, plane) = projections(x, [(1,), (0, 2)], fmax=13)
    cube = periodogram(x, 13).power
    assert line.radial.power == pytest.approx(cube[13, 14:, 13], rel=1e-9)
    assert line.radial.nu == pytest.approx(np.arange(1, 14) / 50)
    assert plane.radial.power[0] == pytest.approx((cube[14, 13, 13] + cube[13, 13, 14]) / 2, rel=1e-9)
    assert plane.power_at_1 == pytest.approx(plane.radial.power[0])


def test_scalars_are_those_of_the_projected_sets():
    x = generate("jittered", n=256, d=2, realizations=4)
    row = frame(projections(x, [(0, 1), (1,)]))
    of_plane, of_axis = measures(x), measures(x[:, :, 1:])
    assert row.projection.tolist() == ["0+1", "1"]
    for name in ("noise_floor", "power_at_1", "peak", "peak_nu"):
        assert row[name].tolist() == pytest.approx([of_plane[name], of_axis[name]], rel=1e-9)
        if not name.startswith("peak"):
            assert row[f"{name}_error"][0] == pytest.approx(of_plane.standard_error[name], rel=1e-6)


def test_a_latin_hypercube_is_stratified_on_each_axis_alone():
    """E P(f) = 1 - sinc(f / n)^2 on an axis; white on the plane."""
    line, plane = projections(generate("latin", n=64, d=2, realizations=300), [(0,), (0, 1)], fmax=16)
    expected = 1 - np.sinc(np.arange(1, 17) / 64) ** 2
    assert line.radial.power == pytest.approx(expected, rel=0.4)
    assert plane.radial.power[1] == pytest.approx(1, abs=0.2)
    assert plane.noise_floor > 10 * line.power_at_1


def test_one_set_has_no_standard_error_and_a_short_spectrum_no_peak():
    (line,) = projections(np.random.default_rng(0).random((64, 2)), [(0,)], fmax=20)
    assert math.isnan(line.noise_floor_error)
    assert math.isnan(line.peak)


@pytest.mark.parametrize("axes", [(), (0, 0), (2,), (-1,)])
def test_axes_that_are_not_there_are_refused(axes):
    with pytest.raises(InputError, match="coordinates 0 to 1"):
        projections(np.zeros((4, 2)), [axes])
