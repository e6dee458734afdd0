"""Every figure of a run as PNG files, and as PDF where asked for, each written whole or not at all."""

from __future__ import annotations

import io
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import NamedTuple

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from gbnbench.core.atomic_write import write_whole
from gbnbench.reports import fonts, style
from gbnbench.reports.comparison import (
    gallery,
    loglog,
    points,
    radial,
    rdf,
    spectrum,
    sweep,
    valence,
    zone_plate,
)
from gbnbench.reports.fonts_in_pdf import lean_fonts
from gbnbench.reports.source_groups import Group, groups, members
from gbnbench.runs.comparison_result import Run, SourceResult
from gbnbench.studies.drawing import make_each

COMPRESSION = 1  # of PNG: pictures of noise take twice as long at 4 and become no smaller


class Kind(NamedTuple):
    """A kind of figure: the function that draws it, and the condition on a source to appear in it."""

    draw: Callable[[Run, Group | None], Figure]
    needs: Callable[[SourceResult], bool]


def _always(source: SourceResult) -> bool:  # noqa: ARG001 - asked as the others are
    return True


FIGURES: dict[str, Kind] = {
    "gallery": Kind(gallery.figure, _always),
    "points": Kind(points.figure, _always),
    "spectrum": Kind(spectrum.figure, _always),
    "radial": Kind(radial.figure, _always),
    "loglog": Kind(loglog.figure, _always),
    "zone-plate": Kind(zone_plate.figure, lambda s: s.zone_plate is not None),
    "valence": Kind(valence.figure, lambda s: s.d == 2 or s.valence is not None),
    "rdf": Kind(rdf.figure, lambda s: s.rdf is not None),
}


@style.styled
def png(figure: Figure, dpi: float = style.DPI) -> bytes:
    """Render a figure as PNG, without a date, so that equal figures give equal bytes.

    Parameters
    ----------
    figure : Figure
        Figure to render.
    dpi : float
        Pixels an inch.

    Returns
    -------
    bytes
        Content of the file.
    """
    stream = io.BytesIO()
    pixels(figure, dpi).save(stream, format="png", dpi=(dpi, dpi), compress_level=COMPRESSION)
    return stream.getvalue()


@style.styled
def pixels(figure: Figure, dpi: float = style.DPI) -> Image.Image:
    """Render a figure.

    Parameters
    ----------
    figure : Figure
        Figure to render.
    dpi : float
        Pixels an inch.

    Returns
    -------
    Image
        Red, green and blue: figures are opaque, and without a fourth channel they are packed in half the
        time.
    """
    drawn = io.BytesIO()
    _leave_empty_labels(figure)
    fonts.renew(figure)
    FigureCanvasAgg(figure)
    figure.savefig(drawn, format="rgba", dpi=dpi)
    width, height = (int(inches * dpi) for inches in figure.get_size_inches())
    return Image.frombytes("RGBA", (width, height), drawn.getvalue()).convert("RGB")


@style.styled
def pdf(figure: Figure) -> bytes:
    """Render a figure as PDF, without a date, so that equal figures give equal bytes."""
    stream = io.BytesIO()
    _leave_empty_labels(figure)
    fonts.renew(figure)
    with lean_fonts():
        figure.savefig(stream, format="pdf", dpi=200, metadata={"CreationDate": None, "Producer": None})
    return stream.getvalue()


def _leave_empty_labels(figure: Figure) -> None:
    """Give axes without a label a fixed place for it: to find one, all their numbers are laid out again."""
    for ax in figure.axes:
        for axis in (ax.xaxis, ax.yaxis):
            if not axis.get_label_text():
                axis.set_label_coords(0.5, 0.5)


def stem(run: Run, name: str, group: Group) -> str:
    """Name the files of a figure of one (n, d), which the name tells in a run of several.

    Parameters
    ----------
    run : Run
        The comparison.
    name : str
        One of ``FIGURES``.
    group : (n, d)
        Size and dimension of the sources that it shows.

    Returns
    -------
    str
        Without a suffix.
    """
    return name + (f"_n{group[0]}_d{group[1]}" if len(groups(run)) > 1 else "")


def planned(run: Run) -> list[tuple[str, Callable[[Run, Group | None], Figure], Group | None]]:
    """List the figures of a run as (file stem, drawing function, (n, d)); stems tell several (n, d) apart."""
    plan: list[tuple[str, Callable[[Run, Group | None], Figure], Group | None]] = []
    for group in groups(run):
        for name, kind in FIGURES.items():
            if any(map(kind.needs, members(run, group))):
                plan.append((stem(run, name, group), kind.draw, group))
    if sweep.several(run):
        plan.append(("sweep", sweep.figure, None))
    return plan


@style.styled
def write_figures(
    run: Run, folder: str | Path, drawn: dict[str, bytes] | None = None, *, with_pdf: bool = False
) -> list[Path]:
    """Draw every figure that the run has data for.

    Parameters
    ----------
    run : Run
        The comparison. Nothing in it is measured again.
    folder : path
        Folder of the files, made where missing. Files of the same names are replaced.
    drawn : dict of bytes, optional
        Takes each PNG by the stem of its file, as ``write_report`` can use them.
    with_pdf : bool
        Write each also as PDF, which takes as long again.

    Returns
    -------
    list of Path
        ``gallery.png`` and so on, ``gallery.pdf`` beside it where asked for. In a run of several sizes or
        dimensions the names end in ``_n1024_d2``, and the figure ``sweep`` shows the measures against n.

    Raises
    ------
    UndrawnError
        If a figure cannot be made or written; every other one is.
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    written: list[Path] = []

    def make(name: str, draw: Callable[[Run, Group | None], Figure], group: Group | None) -> None:
        figure = draw(run, group)
        picture = png(figure)
        if drawn is not None:
            drawn[name] = picture
        files = {"png": picture, **({"pdf": pdf(figure)} if with_pdf else {})}
        for ending, content in files.items():
            path = folder / f"{name}.{ending}"
            write_whole(path, content)
            written.append(path)

    make_each((f"figure {one[0]}", partial(make, *one)) for one in planned(run))
    return written
