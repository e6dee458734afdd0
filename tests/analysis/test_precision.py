"""Precisions of a device: types, lanes, programs, and coordinates as turns."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gbnbench.analysis import precision as module
from gbnbench.analysis.precision import Precision, padded, precision_of
from gbnbench.analysis.spectrum.evaluators.nufft import transform as nufft
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.plan import plan
from gbnbench.core.errors import DeviceError, InputError
from gbnbench.opencl import Runtime, runtime
from tests.devices import gpu_form
from tests.oracles.power import direct_power, lattice_of, root_distance


@pytest.fixture
def without_double(monkeypatch):
    """Let the device at hand say that it has no double; the non-uniform FFTs, which have, are not there."""
    device = replace(runtime().device, is_cpu=False, has_double=False)
    poor = Runtime(device)
    monkeypatch.setattr(module, "runtime", lambda: poor)
    monkeypatch.setattr(nufft, "installed", lambda: ())
    return device


def test_types_of_the_two():
    double, single = precision_of("double"), precision_of("float")
    assert (double.name, double.real, double.turn, double.sum) == (
        "double",
        np.float64,
        np.uint64,
        np.float64,
    )
    assert (single.name, single.real, single.turn, single.sum) == ("float", np.float32, np.uint32, np.float64)
    assert gpu_form(False, has_double=False).sum is np.float32
    assert double.lanes == runtime().lanes("double")
    assert single.lanes == runtime().lanes("float")


def test_coordinates_become_turns_by_axis_and_padding_is_zero():
    x = np.array([[[0.5, 0.25], [0.75, 1 - 2.0**-53], [2.0**-64, 5e-324]], [[0.0, 0.125]] * 3])
    turns = precision_of("double").turns(x, 8)
    assert turns.shape == (2, 2, 8)
    assert turns.dtype == np.uint64
    assert turns[0, 0].tolist() == [2**63, 3 * 2**62, 1, 0, 0, 0, 0, 0]
    assert turns[0, 1].tolist() == [2**62, 2**64 - 2**11, 0, 0, 0, 0, 0, 0]
    assert turns[1, 1].tolist() == [2**61] * 3 + [0] * 5
    turns = precision_of("float").turns(x, 3)
    assert turns.dtype == np.uint32
    assert turns[0].tolist() == [[2**31, 3 * 2**30, 0], [2**30, 0, 0]]  # 1 - 2^-53 is the next turn


def test_programs_are_built_once_for_a_precision_and_definitions():
    p, again = precision_of("double"), precision_of("double")
    assert p == again
    assert p.program("selected.cl") is again.program("selected.cl")
    assert p.program("selected.cl") is not precision_of("float").program("selected.cl")
    assert p.program("shells.cl", ROWS=3) is not p.program("shells.cl", ROWS=4)
    assert Precision(p.runtime, True, 1).program("selected.cl") is not p.program("selected.cl")


def test_padding():
    assert [padded(k, 4) for k in (0, 1, 4, 5, 8)] == [0, 4, 4, 8, 8]


@pytest.mark.parametrize("name", ["half", "", "Double", None, 64])
def test_another_name_is_refused(name):
    with pytest.raises(InputError, match='"double" or "float"'):
        precision_of(name)


def test_a_device_without_double_offers_float(without_double):
    x = np.random.default_rng(1).random((100, 2))
    for call in (
        lambda: precision_of("double"),
        lambda: periodogram(x, 4),
        lambda: periodogram(x, 4, "double"),
        lambda: plan(100, 2, 4),
    ):
        with pytest.raises(DeviceError, match='no double precision; use precision="float"'):
            call()


def test_a_device_without_double_computes_in_float(without_double):
    x = np.random.default_rng(2).integers(0, 2**32, (300, 2)) / 2.0**32
    got = periodogram(x, 6, "float")
    assert got.device == without_double.label
    f = lattice_of(6, 2)
    assert root_distance(got.power.ravel(), direct_power(x, f)).max() <= got.error_bound
    assert periodogram(x, 6, floor=1e-6).precision == "float"
    with pytest.raises(InputError, match="out of reach"):
        periodogram(x, 6, floor=1e-22)
