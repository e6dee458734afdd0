"""The pictures and the report that a comparison writes into its folder: all of them, or those that can be."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from gbnbench.runs.comparison_folder import REPORT
from gbnbench.studies.drawing import make_each

FIGURES = "figures"  # in the folder
R = TypeVar("R")
Write = Callable[[R, Path, dict[str, bytes]], object]


def write_files(run: R, folder: Path, write_figures: Write[R], write_report: Write[R]) -> None:
    """Write the figures and report.html of a comparison into its folder.

    Parameters
    ----------
    run : object
        What was measured.
    folder : Path
        Where ``figures`` and report.html are made, or replaced.
    write_figures, write_report : callable
        Take the run, the place, and each picture by its name: the first fills them in.

    Raises
    ------
    UndrawnError
        If any of them cannot be made; all others are.
    """
    drawn: dict[str, bytes] = {}
    make_each(
        [
            (FIGURES, lambda: write_figures(run, folder / FIGURES, drawn)),
            (REPORT, lambda: write_report(run, folder / REPORT, drawn)),
        ]
    )


def report_in(run: R, folder: Path, draw: Callable[[R, Path], None]) -> Path:
    """Return the path of report.html, which is made, with the figures' files, where it is missing.

    Parameters
    ----------
    run : object
        What was measured.
    folder : Path
        Where it is kept.
    draw : callable
        Makes the report and the figures.

    Returns
    -------
    Path

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    path = folder / REPORT
    if not path.exists():
        draw(run, folder)
    return path
