"""The regression catches what it is there for: each test spoils one thing in a process of its own."""

from __future__ import annotations

import re
import subprocess
import sys
import textwrap

import pytest

pytestmark = pytest.mark.slow

PRELUDE = """
import importlib, re, sys

import numpy as np

from gbnbench.cli import run
from gbnbench.generators.gbn import energy, energy_settings
from gbnbench.generators.gbn.protocol import EnergyGradient

met = []

def alter(pattern, replacement):
    '''Change the first place in every program's text that the pattern meets.'''
    program = importlib.import_module("gbnbench.opencl.program")
    source = program.source
    def altered(package, files):
        text, count = re.subn(pattern, replacement, source(package, files), count=1)
        met.append(count)
        return text
    program.source = altered

def wrap(module, name, make):
    '''Replace a function by one made of it.'''
    function = getattr(module, name)
    def wrapped(*arguments, **named):
        met.append(1)
        return make(function, *arguments, **named)
    setattr(module, name, wrapped)
"""
CODA = """
code = run(["check", "--jobs", "1", "--quiet", *sys.argv[1:]])
if not any(met):
    sys.exit("the change met nothing: what it changes has another name now")
sys.exit(code)
"""
TWO_FIELDS = ("field-2d-64-double", "field-2d-1024-double")


def spoilt(change: str, *cases: str) -> subprocess.CompletedProcess[str]:
    program = PRELUDE + textwrap.dedent(change) + CODA
    only = [word for case in cases for word in ("--only", case)]
    return subprocess.run(
        [sys.executable, "-c", program, *only], capture_output=True, text=True, check=False, timeout=300
    )


def caught(change: str, *cases: str) -> str:
    """Run the cases with something spoilt; each must be named as worse. Returns what was said."""
    done = spoilt(change, *cases)
    assert done.returncode == 1, f"exit code {done.returncode}\n{done.stdout}\n{done.stderr}"
    for case in cases:
        assert f"gbnbench: {case}: " in done.stderr, done.stderr
        assert re.search(rf"▼ worse +{case} ", done.stdout), done.stdout
    return done.stderr


def test_all_is_well_with_nothing_spoilt():
    """What the others spoil is the only reason that they fail."""
    done = spoilt("met.append(1)", *TWO_FIELDS, "gbn-1d-64", "gbn-2d-64", "lattice-2d-256-double")
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stderr == ""


def test_a_kernel_with_one_sign_wrong():
    said = caught(
        r"alter(r'(force\[a\] |force0 )([-+])= (slope|g)', lambda m: m[1] + '-+'[m[2] == '-'] + '= ' + m[3])",
        *TWO_FIELDS,
    )
    assert "gradient departs from the 8 exact values by " in said


def test_a_kernel_with_one_component_of_the_gradient_left_out():
    caught(
        """
        def spoil(field, *arguments):
            evaluate = field(*arguments)
            def without(x):
                at = evaluate(x)
                return EnergyGradient(at.gradient * [1.0, 0.0], at.excess)
            return without
        wrap(energy, "energy_evaluation", spoil)
        """,
        *TWO_FIELDS,
    )


@pytest.mark.parametrize(
    ("kept", "departure"),
    [("-np.rint(u)", "images of a small box"), ("0 * u", "the border")],
    ids=["nearest", "none"],
)
def test_images_left_out(kept, departure):
    """Of a box of eight spacings the nearest image is not enough; without any the border is a wall."""
    cases = TWO_FIELDS[:1] if departure == "images of a small box" else TWO_FIELDS
    caught(
        f"""
        def spoil(field, n, d, sigma, precision=None):
            side = n ** (1 / d)
            def evaluate(x):
                u = x[:, :, None] - x[:, None]
                u = (u + {kept}) * side
                pair = np.exp(-(u**2).sum(axis=-1) / (2 * sigma**2))
                gradient = -(pair[..., None] * u).sum(axis=2) / sigma**2
                uniform = (2 * np.pi) ** (d / 2) * sigma**d
                return EnergyGradient(gradient, (pair.sum(axis=(1, 2)) / n - uniform) / 2)
            return evaluate
        wrap(energy, "energy_evaluation", spoil)
        """,
        *cases,
    )


def test_a_kernel_that_forgets_the_other_side_of_the_border():
    caught("alter('at0 - image', 'at0')", "field-2d-1024-double")


def test_a_kernel_with_one_image_wrong():
    caught("alter('at0 - image', 'at0 + image')", "field-2d-1024-double")


def test_a_kernel_that_leaves_out_a_term():
    caught(r"alter(r'value \* c \+ w\[0\]', 'value * c')", "field-2d-64-double")


@pytest.mark.parametrize("factor", [10, 0.1])
def test_a_wrong_step(factor):
    said = caught(f'wrap(energy_settings, "step_size", lambda size, *a: {factor} * size(*a))', "gbn-2d-64")
    assert "noise floor" in said


def test_float_where_double_was_asked():
    """In the energy, as the optimiser asks for it, and in the spectrum."""
    said = caught(
        """
        def single(make, n, d, sigma, precision=None, **_):
            return make(n, d, sigma, "float")
        wrap(energy, "energy_evaluation", single)
        """,
        *TWO_FIELDS,
    )
    assert "(at most 1.00e-12)" in said
    caught(
        """
        def single(make, n, d, sigma, precision, **_):
            return make(n, d, sigma, "float")
        wrap(energy_settings, "energy_evaluation", single)
        """,
        "gbn-1d-64",
    )


def test_float_in_the_spectrum():
    caught(
        """
        for name in ("spectrum.periodogram.periodogram", "frequency_region.power_of_each"):
            name, _, function = name.rpartition(".")
            module = importlib.import_module("gbnbench.analysis." + name)
            wrap(module, function, lambda power, x, fmax, precision=None: power(x, fmax, "float"))
        """,
        "lattice-2d-256-double",
        "gbn-1d-64",
    )


def test_a_change_that_meets_nothing_is_no_proof():
    done = spoilt("alter(r'no such text', '')", "lattice-3d-64-double")
    assert done.returncode == 1
    assert "the change met nothing" in done.stderr
