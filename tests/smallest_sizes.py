"""Whole commands in seconds: the smallest sizes stand in for those of --quick."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

COMMAND = [sys.executable, str(Path(__file__))]  # gbnbench with these sizes, in a process of its own


@contextmanager
def smallest_sizes() -> Iterator[None]:
    """Let benchmarks and figures that are asked for quick sizes take the smallest."""
    from gbnbench.benchmarks.gbn import floor_cases
    from gbnbench.benchmarks.spectra import cases
    from gbnbench.reports.paper import figure

    options = figure.FigureOptions

    def smallest(scale: str, *rest: Any) -> figure.FigureOptions:
        return options("tiny" if scale == "quick" else scale, *rest)  # type: ignore[arg-type]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cases, "quick", cases.tiny)
        patch.setattr(floor_cases, "quick", floor_cases.tiny)
        patch.setattr(figure, "FigureOptions", smallest)
        yield


if __name__ == "__main__":
    from gbnbench.cli import main

    with smallest_sizes():
        main()
