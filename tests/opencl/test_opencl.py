"""Choosing devices, proving widths and building programs, on the real runtime."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import numpy as np
import pytest

from gbnbench.core.errors import DeviceError
from gbnbench.opencl import choose, devices, runtime
from gbnbench.opencl.program import OPTIONS
from gbnbench.opencl.runtime import Runtime
from gbnbench.opencl.width_probe import VectorWidths, vector_widths
from tests.processes import python


def test_every_device_can_be_chosen_by_its_index_and_its_label():
    for device in devices():
        assert choose(str(device.index)) == device
        assert choose(device.label) == device
        assert choose(device.label.upper()) == device


def test_an_unknown_device_names_those_there_are():
    with pytest.raises(DeviceError) as refusal:
        choose("no such device")
    assert devices()[0].name in str(refusal.value)


def test_the_environment_variable_chooses(monkeypatch):
    monkeypatch.setenv("GBNBENCH_DEVICE", "no such device")
    with pytest.raises(DeviceError, match="no such device"):
        choose()
    monkeypatch.setenv("GBNBENCH_DEVICE", "0")
    assert choose().index == 0


def test_without_any_device_importing_works_and_the_error_says_what_to_install():
    done = python(
        "import gbnbench\n"
        "print(gbnbench.periodogram([[0.5, 0.5]], 1).device)\n"
        "try:\n    gbnbench.generate('gbn', n=4, d=2)\n"
        "except gbnbench.GbnbenchError as error:\n    print(error)",
        OCL_ICD_VENDORS="/nonexistent",
    )
    assert done.returncode == 0, done.stderr
    numpy, refusal = done.stdout.splitlines()
    assert numpy == "numpy, no OpenCL device"
    assert "no OpenCL device" in refusal
    assert "pip install" in done.stdout


def test_without_pyopencl_the_error_says_what_to_install(tmp_path):
    (tmp_path / "pyopencl.py").write_text("raise ImportError('none here')")
    done = python(
        "import gbnbench\nprint(gbnbench.periodogram([[0.5, 0.5]], 1).device)\n"
        "try:\n    gbnbench.generate('gbn', n=4, d=2)\n"
        "except gbnbench.GbnbenchError as error:\n    print(error)",
        PYTHONPATH=str(tmp_path),
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("numpy, no OpenCL device")
    assert "pyopencl cannot be imported" in done.stdout
    assert "pip install" in done.stdout


def test_importing_gbnbench_loads_no_heavy_library():
    done = python(
        "import sys, gbnbench\n"
        "print([m for m in ('numpy', 'scipy', 'pandas', 'matplotlib', 'pyopencl', 'skimage') if m in "
        "sys.modules])"
    )
    assert done.stdout.strip() == "[]"


@pytest.mark.skipif(os.name != "posix", reason="folders are made unwritable by a file in their way")
def test_an_unwritable_cache_folder_still_leaves_a_device(tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("")
    done = python(
        "import os\nfrom gbnbench.opencl import devices\nprint(len(devices()), os.environ['POCL_CACHE_DIR'])",
        GBNBENCH_CACHE=str(blocked / "cache"),
        XDG_CACHE_HOME=str(blocked / "xdg"),
        POCL_CACHE_DIR=str(blocked / "pocl"),
    )
    count, folder = done.stdout.split()
    assert int(count) >= 1
    assert not folder.startswith(str(blocked))
    assert Path(folder).name == "pocl"


def test_proven_widths_are_remembered_and_a_dead_child_leaves_the_proven_ones(monkeypatch, tmp_path):
    from gbnbench.core import cache_folder
    from gbnbench.opencl import width_probe

    monkeypatch.setattr(cache_folder, "cache_folder", lambda: tmp_path)
    device = choose()
    widths = vector_widths(device)
    assert widths.float32 in (1, 4, 8, 16)
    assert widths.float64 in ((1, 2, 4, 8) if device.has_double else (0,))
    monkeypatch.setattr(width_probe, "_widest", lambda *_: pytest.fail("asked the device again"))
    assert vector_widths(device) == widths

    class Dying:
        stdout, stderr, returncode = b"1\n4\n", b"", -11

    monkeypatch.undo()
    monkeypatch.setattr(cache_folder, "cache_folder", lambda: tmp_path / "other")
    (tmp_path / "other").mkdir()
    monkeypatch.setattr(width_probe.subprocess, "run", lambda *_, **__: Dying)
    assert vector_widths(device) == VectorWidths(4, 4 if device.has_double else 0)


def test_a_probe_that_dies_before_it_proves_anything_says_of_what(monkeypatch, tmp_path):
    from gbnbench.core import cache_folder
    from gbnbench.opencl import width_probe

    device = choose()
    killed = "import os, sys; print('bad binary', file=sys.stderr, flush=True); os.kill(os.getpid(), 11)"
    child = tmp_path / "dying"
    child.write_text(f"#!{sys.executable}\n{killed}\n")
    child.chmod(0o755)
    monkeypatch.setattr(cache_folder, "cache_folder", lambda: tmp_path)
    monkeypatch.setattr(width_probe.sys, "executable", str(child))
    widths = vector_widths(device)
    assert (widths.float32, widths.float64) == (0, 0)
    assert "its process was killed by SIGSEGV: bad binary" in widths.fault
    assert not list(tmp_path.glob("widths-*"))  # what died may be mended: it is asked again
    opened = Runtime(device)
    opened.__dict__["widths"] = widths
    with pytest.raises(DeviceError, match=r"does not compute in float .*killed by SIGSEGV: bad binary"):
        opened.lanes("float")


def test_programs_are_built_once_and_a_compiler_error_is_told():
    chosen = runtime()
    defines = {"DOUBLE": 0, "LANES": 1}
    first = chosen.program("gbnbench.opencl", ("/vector.cl", "/probe.cl"), defines)
    assert chosen.program("gbnbench.opencl", ("/vector.cl", "/probe.cl"), dict(defines)) is first
    with pytest.raises(DeviceError, match=r"cannot build /probe\.cl"):
        chosen.program("gbnbench.opencl", ("/probe.cl",), {"LANES": 1})


def test_wrong_results_are_never_asked_for_by_compiler_options():
    assert not {"-cl-fast-relaxed-math", "-cl-unsafe-math-optimizations"} & set(OPTIONS)


def test_buffers_come_back_as_they_went_and_too_large_ones_are_refused():
    chosen = runtime()
    array = np.random.default_rng(1).random(1001)
    assert np.array_equal(chosen.download(chosen.upload(array), np.empty(1001)), array)
    with pytest.raises(DeviceError, match="at most"):
        chosen.empty(1 << 60)


def test_without_any_writable_home_one_folder_serves_every_process(tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("")
    places = {
        "GBNBENCH_CACHE": str(blocked / "a"),
        "XDG_CACHE_HOME": str(blocked / "b"),
        "TMPDIR": str(tmp_path),
    }
    code = "from gbnbench.core.cache_folder import cache_folder\nprint(cache_folder())"
    first, second = (python(code, **places).stdout.strip() for _ in range(2))
    assert first == second
    assert Path(first).parent == tmp_path
    assert Path(first).stat().st_mode & 0o077 == 0


def test_threads_share_the_device_and_get_what_one_gets():
    from concurrent.futures import ThreadPoolExecutor

    from gbnbench import periodogram

    sets = [np.random.default_rng(k).random((200 + k, 2)) for k in range(40)]
    alone = [periodogram(x, 12).power for x in sets]
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    try:
        with ThreadPoolExecutor(4) as pool:
            together = list(pool.map(lambda x: periodogram(x, 12).power, sets))
    finally:
        sys.setswitchinterval(before)
    assert all(np.array_equal(a, b) for a, b in zip(alone, together, strict=True))


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork here")
def test_a_fork_is_refused_in_words_instead_of_hanging():
    done = python(
        "import os, gbnbench\n"
        "gbnbench.periodogram([[0.5, 0.5]], 1)\n"
        "child = os.fork()\n"
        "if child == 0:\n"
        "    try:\n        gbnbench.periodogram([[0.5, 0.5]], 1)\n"
        "    except gbnbench.GbnbenchError as error:\n        print(error, flush=True)\n"
        "    os._exit(0)\n"
        "os.waitpid(child, 0)"
    )
    assert "spawn" in done.stdout


@pytest.mark.parametrize("selector", [0, 7, 1.5, True])
def test_a_selector_that_is_no_text_is_refused_in_words(selector):
    with pytest.raises(DeviceError, match="device must be a text"):
        choose(selector)


def test_numbers_and_buffers_change_from_launch_to_launch():
    rt = runtime()
    built = rt.program("gbnbench.opencl", ("/vector.cl", "/fma.cl"), {"DOUBLE": 1, "LANES": 1, "CHAINS": 10})
    factors, out = rt.upload(np.array([1.0, 0.5, 1.0])), rt.empty(8 * rt.group)

    def total():
        return rt.download(out, np.empty(1))[0] - sum(range(10)) / 16 - 10

    for steps in (1, 3):
        built.run("fma_chains", (rt.group,), (rt.group,), factors, out, np.uint32(steps))
        assert total() == 5.0 * steps
    prepared = built.prepared("fma_chains", (rt.group,), (rt.group,), None, out, np.uint32(2))
    for rise in (0.5, 0.25):
        prepared(rt.upload(np.array([1.0, rise, 1.0])))
        built.run("fma_chains", (rt.group,), (rt.group,), factors, rt.empty(8 * rt.group), np.uint32(7))
        assert total() == 20.0 * rise  # the other launch set nothing of this one


def test_a_prepared_launch_takes_numbers_that_change_and_numbers_that_stay():
    rt = runtime()
    built = rt.program("gbnbench.opencl", ("/vector.cl", "/fma.cl"), {"DOUBLE": 1, "LANES": 1, "CHAINS": 10})
    factors, first = rt.upload(np.array([1.0, 0.5, 1.0])), sum(range(10)) / 16 + 10
    prepared = built.prepared("fma_chains", (rt.group,), (rt.group,), None, None, np.uint32)
    for steps in (3, 3, 1):
        out = rt.empty(8 * rt.group)
        prepared(factors, out, np.uint32(steps))
        assert rt.download(out, np.empty(1))[0] - first == 5.0 * steps
