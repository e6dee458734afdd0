"""What ``import gbnbench`` offers: the public names alone, documented with an example, at hardly any cost."""

from __future__ import annotations

import dataclasses
import inspect
import subprocess
import sys

import numpy as np
import pytest

import gbnbench
from gbnbench.generators.registry import GENERATORS


def test_dir_shows_the_public_names_and_nothing_else():
    assert dir(gbnbench) == sorted([*gbnbench.__all__, "__version__"])
    assert all(hasattr(gbnbench, name) for name in gbnbench.__all__)


def test_a_name_that_is_not_there_is_an_attribute_error():
    with pytest.raises(AttributeError, match="no attribute 'peridogram'"):
        _ = gbnbench.peridogram


@pytest.mark.parametrize("name", gbnbench.__all__)
def test_every_name_is_documented_with_an_example(name):
    value = getattr(gbnbench, name)
    text = inspect.getdoc(value)
    assert "Examples\n--------\n" in text
    assert ">>> " in text
    if inspect.isfunction(value):
        assert "Parameters\n----------\n" in text
        assert "Returns\n-------\n" in text or value.__annotations__["return"] in (None, "None")
        assert "Raises\n------\n" in text


@pytest.mark.parametrize("name", gbnbench.__all__)
def test_every_parameter_of_a_function_is_documented(name):
    value = getattr(gbnbench, name)
    if inspect.isfunction(value):
        text = inspect.getdoc(value)
        for parameter in inspect.signature(value).parameters:
            assert any(parameter in line.split(" : ")[0] for line in text.splitlines()), parameter


def test_the_import_loads_no_heavy_library():
    script = (
        "import sys, gbnbench\n"
        "heavy = {'numpy', 'scipy', 'pandas', 'matplotlib', 'pyopencl', 'skimage', 'rich', 'click'}\n"
        "sys.exit(' '.join(heavy & set(sys.modules)) or 0)\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_no_setting_of_a_generator_has_the_name_of_an_argument_of_generate():
    own = {*inspect.signature(gbnbench.generate).parameters} - {"settings"}
    for kind in GENERATORS.values():
        assert not own & {field.name for field in dataclasses.fields(kind)}, kind.name


@pytest.mark.parametrize(
    "name",
    [
        "compare",
        "generate",
        "integrate",
        "measures",
        "periodogram",
        "plan",
        "reconstruct",
        "shells",
        "stipple",
    ],
)
def test_a_device_can_be_named_wherever_a_kernel_runs(name):
    assert inspect.signature(getattr(gbnbench, name)).parameters["device"].default is None


def test_a_device_that_is_not_there_is_named():
    with pytest.raises(gbnbench.GbnbenchError, match="'no such' fits no device"):
        gbnbench.measures(np.full((1, 2), 0.5), device="no such")
    with pytest.raises(gbnbench.GbnbenchError, match="'no such' fits no device"):
        gbnbench.generate("gbn", n=16, device="no such")
