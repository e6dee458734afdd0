"""Where there is no OpenCL device, numpy evaluates every spectrum, as exactly."""

from __future__ import annotations

import json

import numpy as np

from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.shell_spectrum import shells
from tests.oracles.power import mean_power, root_distance
from tests.processes import NO_DEVICE, python

WITHOUT_DEVICE = """
import json
import numpy as np
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.plan import plan
from gbnbench.analysis.spectrum.shell_spectrum import shells
x = np.random.default_rng(1).integers(0, 2**53, (2, 60, 3)) / 2.0**53
w = np.random.default_rng(2).random((2, 60))
f = [[2**40, -3, 1], [1, 2, 3]]
cube, half = periodogram(x, 3, weights=w), periodogram(x, 3, half=True)
listed, s = periodogram(x, frequencies=f, weights=w), shells(x, 3, weights=w)
single = periodogram(x, 3, "float")
print(json.dumps({
    "methods": [r.method for r in (cube, half, listed, s, single)],
    "device": cube.device,
    "errors": [[r.error_rms, r.error_bound] for r in (cube, half, listed, s, single)],
    "cube": cube.power.tolist(), "half": half.power.tolist(), "listed": listed.power.tolist(),
    "single": single.power.tolist(),
    "shells": [s.count.tolist(), s.power.tolist(), s.deviation.tolist()],
    "why": plan(60, 3, 3).explain(),
    "floors": [plan(60, 3, 3, floor=e).precision for e in (1e-5, 1e-20)],
    "of shells": plan(60, 3, 3, shells=True).method,
    "of a list": plan(60, 3, 3, frequencies=5).method,
}))
"""


def test_without_a_device_numpy_finds_the_same():
    done = python(WITHOUT_DEVICE, **NO_DEVICE)
    assert done.returncode == 0, done.stderr
    got = json.loads(done.stdout)
    x = np.random.default_rng(1).integers(0, 2**53, (2, 60, 3)) / 2.0**53
    w = np.random.default_rng(2).random((2, 60))
    assert set(got["methods"]) == {"numpy"}
    assert "no OpenCL device" in got["device"]
    assert "no OpenCL device" in got["why"]
    assert got["of shells"] == got["of a list"] == "numpy"
    assert got["floors"][1] == "double"
    assert all(0 < rms < bound for rms, bound in got["errors"])
    f = [[2**40, -3, 1], [1, 2, 3]]
    cube, ours = np.array(got["cube"]), periodogram(x, 3, weights=w)
    assert np.allclose(np.sqrt(cube), np.sqrt(ours.power), atol=1e-14)
    assert np.allclose(np.sqrt(got["half"]), np.sqrt(periodogram(x, 3).power[3:]), atol=1e-14)
    assert np.allclose(np.sqrt(got["single"]), np.sqrt(periodogram(x, 3).power), atol=1e-5)
    assert root_distance(np.array(got["listed"]), mean_power(x, f, w)).max() <= got["errors"][2][1]
    s = shells(x, 3, weights=w)
    count, power, deviation = got["shells"]
    assert count == s.count.tolist()
    assert np.allclose(power, s.power, rtol=1e-12)
    assert np.allclose(deviation, s.deviation, rtol=1e-11)
