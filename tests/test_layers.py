"""The layers that import-linter holds: the tree keeps them, and a planted wrong import is found."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.paths import ROOT, copy_packages


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """A copy of the source tree that a test may spoil."""
    copy_packages(tmp_path)
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    return tmp_path


def lint(tree: Path) -> subprocess.CompletedProcess[str]:
    program = Path(sys.executable).with_name("lint-imports")
    if not program.exists():
        pytest.skip("import-linter is not installed")
    return subprocess.run(
        [program, "--no-cache"], cwd=tree, capture_output=True, text=True, check=False, timeout=100
    )


def plant(tree: Path, module: str, line: str) -> None:
    path = tree / module
    path.write_text(f"{path.read_text(encoding='utf-8')}\n\n{line}\n", encoding="utf-8")


def test_the_tree_keeps_its_layers(tree):
    done = lint(tree)
    assert done.returncode == 0, done.stdout
    assert "0 broken" in done.stdout


@pytest.mark.parametrize(
    ("module", "line", "says"),
    [
        (
            "gbnbench/core/torus.py",
            "from gbnbench.reports import style",
            "core is not allowed to import gbnbench.reports",
        ),
        (
            "generators/registry.py",
            "import gbnbench.analysis.measures",
            "generators is not allowed to import gbnbench.analysis",
        ),
        (
            "gbnbench/runs/sources.py",
            "def late():\n    from gbnbench.studies import comparison",
            "runs is not allowed to import gbnbench.studies",
        ),
        (
            "analysis/spectrum/shells.py",
            "import gbnbench.analysis.radial.anisotropy",
            "No cycles are allowed in gbnbench.analysis",
        ),
    ],
)
def test_a_planted_import_is_found(tree, module, line, says):
    plant(tree, module, line)
    done = lint(tree)
    assert done.returncode == 1
    assert says in done.stdout
