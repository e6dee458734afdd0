"""What is built is what stands in the tree: every module, kernel and template, under its installed name."""

from __future__ import annotations

import subprocess
import sys
import tomllib
import zipfile
from importlib import metadata
from pathlib import Path

import pytest
from packaging.specifiers import SpecifierSet

import gbnbench
from tests.paths import ROOT

FOLDERS = ("generators", "analysis", "benchmarks", "reports")
INSTALLED = {"gbnbench": "gbnbench", **{f: f"gbnbench/{f}" for f in FOLDERS}}
STAYS = (
    "benchmarks/README.md",
    "benchmarks/results/",
    "benchmarks/claims/",
    "benchmarks/experiments/",
    "benchmarks/reliability/",
)  # in the checkout

pytestmark = pytest.mark.skipif(not (ROOT / ".git").exists(), reason="not a git checkout")


def tracked() -> set[str]:
    listing = subprocess.run(
        ["git", "ls-files", *INSTALLED], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.split()
    files = [Path(n) for n in listing if not (ROOT / n).is_symlink() and not n.startswith(STAYS)]
    return {f"{INSTALLED[f.parts[0]]}/{'/'.join(f.parts[1:])}" for f in files}


@pytest.mark.slow
def test_the_wheel_holds_every_file_of_the_tree_and_nothing_else(tmp_path):
    subprocess.run(
        [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(tmp_path), str(ROOT)],
        capture_output=True,
        check=True,
        timeout=300,
    )
    (wheel,) = tmp_path.glob("*.whl")
    held = {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name}
    assert held == tracked()


def test_the_version_is_said_once_in_each_place_and_agrees():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert gbnbench.__version__ == project["version"]
    assert f"## {project['version']}" in (ROOT / "CHANGELOG.md").read_text()


def test_the_pinned_versions_install_on_the_oldest_python_that_is_promised():
    """One that wants a later patch of it stops ``make compare`` at its set-up, on Debian's Python too."""
    promised = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["requires-python"]
    oldest = promised.removeprefix(">=") + ".0"
    pinned = [line.split("==")[0] for line in (ROOT / "constraints.txt").read_text().split() if "==" in line]
    assert pinned
    for name in pinned:
        try:
            wanted = metadata.metadata(name).get("Requires-Python")
        except metadata.PackageNotFoundError:  # for another system
            continue
        assert SpecifierSet(wanted or "").contains(oldest), f"{name} needs Python {wanted}"


def test_every_package_of_the_tree_is_named():
    """Setuptools drops a package that is not named, and says nothing."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    named = set(project["tool"]["setuptools"]["packages"])
    inits = {Path(name).parent for name in tracked() if name.endswith("/__init__.py")}
    assert named == {path.as_posix().replace("/", ".") for path in inits}
