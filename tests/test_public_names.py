"""What ``import gbnbench`` offers: the public names alone, documented with an example, at hardly any cost."""

from __future__ import annotations

import inspect
import subprocess
import sys

import pytest

import gbnbench


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
