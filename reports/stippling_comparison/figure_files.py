"""Every figure of a comparison of stipplings as PNG and PDF files."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

from matplotlib.figure import Figure

from gbnbench.core.atomic_write import write_whole
from gbnbench.reports import style
from gbnbench.reports.comparison.figure_files import pdf, png
from gbnbench.reports.stippling_comparison import curves, gallery, stipplings
from gbnbench.studies.drawing import make_each
from gbnbench.studies.stippling_comparison.stippling_results import StipplingRun

FIGURES: dict[str, Callable[[StipplingRun], Figure]] = {
    "gallery": gallery.figure,
    "stipplings": stipplings.figure,
    "spectra": curves.figure,
}


@style.styled
def write_figures(run: StipplingRun, folder: str | Path, drawn: dict[str, bytes] | None = None) -> list[Path]:
    """Draw every figure.

    Parameters
    ----------
    run : StipplingRun
        The comparison. Nothing in it is measured again.
    folder : path
        Folder of the files, made where missing. Files of the same names are replaced.
    drawn : dict of bytes, optional
        Takes each PNG by its name.

    Returns
    -------
    list of Path
        ``gallery.png``, ``gallery.pdf`` and so on.

    Raises
    ------
    UndrawnError
        If a figure cannot be made or written; every other one is.
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    written: list[Path] = []

    def make(name: str) -> None:
        figure = FIGURES[name](run)
        picture = png(figure)
        if drawn is not None:
            drawn[name] = picture
        for ending, content in (("png", picture), ("pdf", pdf(figure))):
            path = folder / f"{name}.{ending}"
            write_whole(path, content)
            written.append(path)

    make_each((f"figure {name}", partial(make, name)) for name in FIGURES)
    return written
