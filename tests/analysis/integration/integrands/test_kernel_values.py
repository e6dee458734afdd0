"""Kernels of integrands as a GPU runs them, one lane an item in groups of 64, and without any device."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.integration.integrands import kernel_values
from gbnbench.analysis.integration.integrands.gaussians import GaussianSum
from gbnbench.analysis.integration.integrands.registry import find
from gbnbench.analysis.integration.integrands.waves import WaveSum
from gbnbench.analysis.precision import Precision, double_device
from gbnbench.opencl import Runtime

TEXTS = ("gaussians[count=4]", "gaussians[count=4,points=1000000]", "waves[count=9]")


@pytest.mark.parametrize("text", TEXTS)
@pytest.mark.parametrize("d", [1, 2, 4])
def test_one_lane_in_groups_of_64_has_the_values_of_vectors_and_numpy(
    text: str, d: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    here = double_device()
    if here is None:
        pytest.skip("no OpenCL device of double precision")
    rng = np.random.default_rng(d)
    one = find(text).draw(d, rng)
    assert isinstance(one, GaussianSum | WaveSum)
    x = rng.random((701, d))
    vectors = one(x)
    monkeypatch.setattr(Runtime, "group", 64)
    scalars = one.on_device(x, Precision(here.runtime, True, 1))
    assert scalars.shape == (701,)
    assert vectors == pytest.approx(scalars, rel=4e-15, abs=4e-15)
    assert vectors == pytest.approx(one.by_numpy(x), rel=4e-15, abs=4e-15)


def test_a_call_of_several_launches_is_one_of_many_points(monkeypatch: pytest.MonkeyPatch) -> None:
    one = find("gaussians[count=2]").draw(2, np.random.default_rng(0))
    x = np.random.default_rng(1).random((1000, 2))
    whole = one(x)
    monkeypatch.setattr(kernel_values, "DEVICE_POINTS", 64)
    monkeypatch.setattr(kernel_values, "NUMPY_POINTS", 64)
    assert (one(x) == whole).all()
    assert one(np.empty((0, 2))).shape == (0,)
