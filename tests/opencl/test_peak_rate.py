"""The multiply-add peak of the device at hand: plausible, repeatable in kind, remembered."""

from __future__ import annotations

import pytest

from gbnbench.core import cache_folder
from gbnbench.core.errors import DeviceError, InputError
from gbnbench.opencl import choose, peak_rate, runtime
from tests.processes import NO_DEVICE, python


@pytest.fixture
def empty_cache(monkeypatch, tmp_path):
    runtime().widths  # noqa: B018 - known before the cache is put aside
    monkeypatch.setattr(cache_folder, "cache_folder", lambda: tmp_path)
    return tmp_path


def precisions():
    return ("float", "double") if choose().has_double else ("float",)


def test_the_peak_is_in_the_range_of_what_there_is():
    for precision in precisions():
        assert 0.5e9 < peak_rate.fma_peak(precision) < 1e14


def test_float_is_faster_than_double_in_vectors():
    opened = runtime()
    if not (opened.device.is_cpu and opened.device.has_double) or opened.lanes("float") <= opened.lanes(
        "double"
    ):
        pytest.skip("vectors of as many floats as doubles")
    best = {precision: max(peak_rate.fma_peak(precision) for _ in range(3)) for precision in precisions()}
    assert best["float"] > 1.3 * best["double"]


def test_no_chain_is_left_out_and_none_waits():
    opened = runtime()
    for precision in precisions():
        run = peak_rate._Chains(opened, precision)
        for steps in (1, 1000, peak_rate.MANY):
            run(steps)
            run.check(steps)
        with pytest.raises(DeviceError, match="adds up wrong"):
            run.check(peak_rate.MANY + 100)


@pytest.mark.usefixtures("empty_cache")
def test_what_was_measured_is_remembered_and_nonsense_is_not(monkeypatch):
    first = peak_rate.peak("float"), peak_rate.launch_seconds()
    assert 0 < first[1] < 0.1
    monkeypatch.setattr(peak_rate, "fma_peak", lambda *_: 1e9)
    monkeypatch.setattr(peak_rate, "_launch", lambda: 1e-3)
    assert (peak_rate.peak("float"), peak_rate.launch_seconds()) == first
    fingerprint = choose().fingerprint
    for nonsense in (None, "fast", -1.0, float("nan"), [1.0]):
        cache_folder.remember(f"peak-float-{fingerprint}", nonsense)
        assert peak_rate.peak("float") == 1e9


def test_another_precision_is_refused():
    for call in (peak_rate.fma_peak, peak_rate.peak):
        with pytest.raises(InputError, match='"double" or "float"'):
            call("half")


def test_without_a_device_it_says_so():
    code = (
        "from gbnbench.core.errors import DeviceError\nfrom gbnbench.opencl import peak_rate\n"
        "for call in (\n    lambda: peak_rate.fma_peak('float'), lambda: peak_rate.peak('float'),\n"
        "    peak_rate.launch_seconds,\n):\n"
        "    try:\n        call()\n    except DeviceError as error:\n        print(error)"
    )
    done = python(code, **NO_DEVICE)
    assert done.stdout.count("no OpenCL device") == 3
