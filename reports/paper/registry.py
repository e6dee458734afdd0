"""Every figure by name."""

from __future__ import annotations

import importlib
from collections.abc import Sequence

from gbnbench.core.errors import InputError
from gbnbench.reports.paper.figure import PaperFigure

MODULES = {
    "1": "figure_01", "2": "figure_02", "3": "figure_03", "4": "figure_04", "5": "figure_05",
    "6": "figure_06", "7": "figure_07", "8": "figure_08", "9": "figure_09", "10": "figure_10",
    "11": "figure_11", "12": "figure_12", "13": "figure_13", "14": "figure_14", "15": "figure_15",
    "16": "figure_16", "17": "figure_17", "depth": "depth",
}  # fmt: skip


def find(names: Sequence[str]) -> tuple[PaperFigure, ...]:
    """Figures by name, each once, in the paper's order; all for no name.

    Raises
    ------
    InputError
        If one is not there.
    """
    asked = {name.lower().removeprefix("fig").removeprefix("ure").strip(". ").lstrip("0") for name in names}
    if unknown := sorted(asked - MODULES.keys()):
        raise InputError(f"there is no figure {', '.join(unknown)}; there are {', '.join(MODULES)}")
    wanted = [name for name in MODULES if not asked or name in asked]
    return tuple(_load(name) for name in wanted)


def _load(name: str) -> PaperFigure:
    module = importlib.import_module(f"gbnbench.reports.paper.{MODULES[name]}")
    figure: PaperFigure = module.FIGURE
    return figure
