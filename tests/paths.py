"""Where the checkout's folders are, for tests that read its files, and copies of them to change."""

from __future__ import annotations

import shutil
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
PACKAGES = ("gbnbench", "generators", "analysis", "benchmarks", "reports")


def copy_packages(place: Path) -> None:
    """Copy the source tree, without the kept results of benchmarks, to where a test may spoil it."""
    measured = str(ROOT / "benchmarks" / "results")

    def skipped(folder: str, names: list[str]) -> set[str]:
        return {name for name in names if name == "__pycache__" or f"{folder}/{name}" == measured}

    for package in PACKAGES:
        shutil.copytree(ROOT / package, place / package, symlinks=True, ignore=skipped)
