"""What every kernel file must avoid, whatever the device."""

from __future__ import annotations

import re

import pytest

from tests.paths import ROOT

KERNELS = sorted(
    path
    for folder in ("gbnbench/opencl", "generators", "analysis")
    for path in (ROOT / folder).glob("**/kernels/*.cl")
)

# What it is -> why it is banned.
BANNED = {
    r"\bfma\s*\(": "software on the PoCL of PyPI: write a*b + c",
    r"\bvload\d|\bvstore\d": "a call around which registers are spilled: LOADV and STOREV",
    r"\(\s*__(global|local|private|constant)\s+(const\s+)?\w+\d\s*\*\s*\)": "crashes when unaligned",
    r"\b(native|half)_(cos|sin|tan|exp\w*|log\w*|r?sqrt|recip|divide|powr)\b": "of no stated error",
    r"\b(float|double)(3|4|8|16)\b": "widths must be proven: REALV (a pair of coordinates may be double2)",
}


@pytest.mark.parametrize("path", KERNELS, ids=lambda path: path.name)
def test_no_kernel_uses_what_fails_somewhere(path):
    code = re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.DOTALL)
    for pattern, why in BANNED.items():
        found = re.search(pattern, code)
        assert not found, f"{path.name}: {found.group()!r}: {why}"


@pytest.mark.parametrize("path", KERNELS, ids=lambda path: path.name)
def test_every_kernel_opens_with_what_it_computes(path):
    assert path.read_text().startswith("/*")
    assert len(path.read_text().split("*/")[0]) > 60


def test_every_launch_says_its_local_size():
    for path in [*ROOT.glob("analysis/*.py"), *ROOT.glob("generators/**/*.py")]:
        assert ".enqueue_nd_range" not in path.read_text(), path
        assert not re.search(r"\.run\([^)]*\bNone\b", path.read_text()), path
