"""The doctor: agrees with an independent oracle, and notices a kernel that is wrong."""

from __future__ import annotations

import os
import re

import numpy as np
import pytest

from gbnbench.analysis.spectrum.evaluators import kept_memory
from gbnbench.core import cache_folder
from gbnbench.core.errors import DeviceError
from gbnbench.doctor import examination, kernel_checks, numpy_references, trust
from gbnbench.doctor.check import Check
from gbnbench.doctor.numpy_discrepancies import numpy_centred_square, numpy_periodic_square, numpy_star_square
from gbnbench.opencl import program
from tests.oracles.discrepancy import squares
from tests.oracles.power import direct_power
from tests.paths import ROOT


def test_its_numpy_twins_are_right_themselves():
    rng = np.random.default_rng(1)
    x, f = rng.random((40, 3)), rng.integers(-20, 21, (30, 3))
    assert numpy_references.numpy_power(x, f) == pytest.approx(direct_power(x, f), rel=1e-11, abs=1e-13)

    def energy(u):
        side = 9 ** (1 / 2)
        difference = u[:, None] - u[None]
        periods = sum(np.exp(-((difference + k * side) ** 2) / (2 * 0.8**2)) for k in range(-8, 9))
        return periods.prod(axis=-1).sum() / 2

    u = rng.random((9, 2)) * 3
    gradient = numpy_references.numpy_gradient(u / 3, 0.8)
    for k in range(3):
        for a in range(2):
            step = np.zeros_like(u)
            step[k, a] = 1e-5
            assert gradient[k, a] == pytest.approx((energy(u + step) - energy(u - step)) / 2e-5, abs=1e-8)


def test_its_discrepancies_are_those_of_exact_fractions():
    x = np.random.default_rng(2).random((9, 3))
    exact = squares(x)
    assert numpy_centred_square(x) == pytest.approx(float(exact["CD"]), rel=1e-13)
    assert numpy_star_square(x) == pytest.approx(float(exact["L2-star"]), rel=1e-12)
    assert numpy_periodic_square(x) == pytest.approx(float(exact["L2-periodic"]), rel=1e-12)


@pytest.mark.parametrize("form", ["centred", "star", "periodic"])
def test_a_wrong_sum_over_pairs_is_named(form, monkeypatch):
    name = f"numpy_{form}_square"
    right = getattr(kernel_checks, name)
    monkeypatch.setattr(kernel_checks, name, lambda x: right(x) * (1 + 1e-9))
    failed = {check.kernel for check in kernel_checks._discrepancies(83, 5, "double") if not check.passed}
    assert failed == {f"discrepancy, {form}"}


def test_a_wrong_count_of_pairs_is_named(monkeypatch):
    right = kernel_checks.numpy_pairs
    monkeypatch.setattr(kernel_checks, "numpy_pairs", lambda *a: right(*a) + (np.arange(40) == 7))
    (check,) = kernel_checks._pairs(333, 3, "double")
    assert (check.kernel, check.error, check.passed) == ("pair distances", 1.0, False)


@pytest.mark.slow
def test_this_device_passes_in_full():
    found = examination.examine_apart()
    assert found.trusted, [c for c in found.checks if not c.passed]
    assert "can be trusted" in found.verdict


def _raises(n, precision):
    yield Check("sound", f"n={n}", precision, 0.0, 1.0)
    raise ValueError("shapes (3,) and (4,)")


def _dies(n, precision):
    os.abort()
    yield n


def test_a_kernel_that_breaks_its_check_or_the_process_is_named(monkeypatch):
    planned = [(_dies, (7,), "double"), (_raises, (8,), "float"), (kernel_checks._pairs, (30, 2), "double")]
    monkeypatch.setattr(examination, "planned_checks", lambda *_: planned)
    died, raised, sound = examination.examine_apart().checks
    assert (died.kernel, died.size, died.passed) == ("dies", "7", False)
    assert died.fault.startswith("its process was killed by SIGABRT")
    assert (raised.kernel, raised.precision, raised.passed) == ("raises", "float", False)
    assert raised.fault == "ValueError: shapes (3,) and (4,)"
    assert sound.passed
    monkeypatch.setattr(examination, "planned_checks", lambda *_: planned[1:])
    assert "raises departs from numpy" in examination.examine().verdict


@pytest.mark.slow
def test_a_wrong_kernel_is_named_and_not_trusted(monkeypatch, tmp_path):
    monkeypatch.setattr(cache_folder, "cache_folder", lambda: tmp_path)
    right = kernel_checks.numpy_gradient
    monkeypatch.setattr(kernel_checks, "numpy_gradient", lambda x, sigma: right(x, sigma) * (1 + 1e-3))
    with pytest.raises(DeviceError, match="gbn gradient"):
        trust.ensure_trusted()
    assert not list(tmp_path.glob("trusted*"))


@pytest.mark.slow
def test_a_device_is_examined_once_and_remembered(monkeypatch, tmp_path):
    monkeypatch.setattr(cache_folder, "cache_folder", lambda: tmp_path)
    trust.ensure_trusted()
    assert len(list(tmp_path.glob("trusted*"))) == 1
    monkeypatch.setattr(examination, "examine", lambda **_: pytest.fail("examined again"))
    trust.ensure_trusted()


KERNELS = re.compile(r"__kernel\s+void\s+(\w+)")
NO_RESULTS = {"probe", "fma_chains"}  # they measure the device: its vectors' widths, and its speed


@pytest.mark.slow
def test_the_doctor_runs_every_kernel_in_the_tree(monkeypatch):
    run = set()

    def noted(method):
        def launch(self, name, *arguments):
            run.add(name)
            return method(self, name, *arguments)

        return launch

    for method in ("run", "prepared"):
        monkeypatch.setattr(program.Program, method, noted(getattr(program.Program, method)))
    kept_memory.forget()
    assert examination.examine(quick=True).trusted
    files = [*ROOT.glob("*/kernels/*.cl"), *ROOT.glob("gbnbench/opencl/kernels/*.cl")]
    assert {name for path in files for name in KERNELS.findall(path.read_text())} - NO_RESULTS <= run
