"""Makes figures: gets what each asks for, draws it, and keeps PNG, PDF, captions and a page of them all."""

from __future__ import annotations

import html
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gbnbench import __version__
from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import GbnbenchError, UnfinishedError
from gbnbench.execution.progress import Progress
from gbnbench.io import data_files
from gbnbench.opencl import choose, devices_present
from gbnbench.reports import style
from gbnbench.reports.comparison.figure_files import pdf, png
from gbnbench.reports.paper.data import FigureData, folder_name, obtain
from gbnbench.reports.paper.figure import FigureOptions, PaperFigure, compose, signs
from gbnbench.runs.resumable_folder import ResumableFolder, explain_interruption

DPI = 220
PAGE_STYLE = (
    "body{font:15px/1.5 sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#1d2430}"
    "img{max-width:100%}figure{margin:2.5rem 0}figcaption{color:#4a5361}"
)


@dataclass(frozen=True)
class FinishedFigure:
    """One finished figure.

    Attributes
    ----------
    figure : PaperFigure
        Which.
    caption : str
        In full.
    stem : str
        Of its files.
    """

    figure: PaperFigure
    caption: str
    stem: str


def make(
    figures: Sequence[PaperFigure],
    folder: Path,
    options: FigureOptions,
    jobs: int,
    progress: Progress,
    captions: bool = True,
) -> list[FinishedFigure]:
    """Make figures one after the other; what two of them need is made once.

    Parameters
    ----------
    figures : sequence of PaperFigure
        Which.
    folder : Path
        ``figure-03.png`` and ``.pdf`` go there, ``captions.md``, ``index.html``, and everything they are
        drawn from below ``data``, where another call finds it.
    options : FigureOptions
        Scale, sets, seed.
    jobs : int
        Worker processes.
    progress : Progress
        Told what is being done.
    captions : bool
        Whether captions stand in the pictures.

    Returns
    -------
    list of FinishedFigure
        In the order asked for.

    Raises
    ------
    InputError
        If the folder holds something else.
    UnfinishedError
        If some could not be made, when the others are.
    """
    foot = f"Seed {options.seed}; {_device()}; gbnbench {__version__}."
    store = FigureFolder(folder, {"holds": "figures"})
    with store.lock(), explain_interruption(folder):
        store.begin()
        made, failures = _make_all(figures, folder, options, jobs, progress, captions, foot)
        _write_pages(folder, made, captions)
    if failures:
        raise UnfinishedError(
            f"{len(failures)} of {len(figures)} figures could not be made; what is finished is kept in "
            f"{folder}; the first: {failures[0]}"
        )
    return made


class FigureFolder(ResumableFolder):
    """Where figures and what they are drawn from are kept; figures of several calls stand side by side."""

    kind = "folder of figures"


def _device() -> str:
    """Name the device, or say that there is none: some figures are of closed forms alone."""
    return choose().describe()["name"] if devices_present() else "no OpenCL device"


def _make_all(
    figures: Sequence[PaperFigure],
    folder: Path,
    options: FigureOptions,
    jobs: int,
    progress: Progress,
    captions: bool,
    foot: str,
) -> tuple[list[FinishedFigure], list[str]]:
    """Make what can be made; return it, and what could not be."""
    known: dict[str, FigureData] = {}
    made: list[FinishedFigure] = []
    failures: list[str] = []
    for figure in figures:
        progress.say(f"{_heading(figure)} {figure.title}")
        try:
            data: dict[str, Any] = {}
            for name, request in figure.needs(options).items():
                place = folder_name(request, options.seed)
                if place not in known:
                    known[place] = obtain(request, folder / "data" / place, options.seed, jobs, progress)
                data[name] = known[place]
            made.append(_draw(figure, folder, options, data, foot, captions))
        except GbnbenchError as error:
            failures.append(f"{_heading(figure)} {error}")
            progress.say(failures[-1])
    return made, failures


@style.styled
def _draw(
    figure: PaperFigure, folder: Path, options: FigureOptions, data: dict[str, Any], foot: str, captions: bool
) -> FinishedFigure:
    drawing = figure.draw(data, options)
    page = compose(drawing, _heading(figure), foot, captions)
    stem = f"figure-{int(figure.name):02d}" if figure.name.isdigit() else f"figure-{figure.name}"
    write_whole(folder / f"{stem}.png", png(page, DPI))
    write_whole(folder / f"{stem}.pdf", pdf(page))
    return FinishedFigure(figure, signs(f"{drawing.caption} {foot}"), stem)


def _heading(figure: PaperFigure) -> str:
    return f"Figure {figure.name}." if figure.name.isdigit() else f"Figure, ours: {figure.name}."


def _write_pages(folder: Path, made: Sequence[FinishedFigure], captions: bool) -> None:
    """Write captions as text, and one page, of these figures and of those that earlier calls left there."""
    index = folder / "captions.json"
    known: dict[str, dict[str, str]] = json.loads(index.read_bytes()) if index.exists() else {}
    for one in made:
        title = f"{_heading(one.figure)} {one.figure.title}"
        known[one.stem] = {"title": title, "paper": one.figure.paper, "caption": one.caption}
    known = {stem: known[stem] for stem in sorted(known)}
    write_whole(index, data_files.to_json(known))
    texts, parts = [], []
    for stem, about in known.items():
        title, caption = html.escape(about["title"]), html.escape(about["caption"])
        texts.append(f"## {about['title']}\n\n{about['caption']}\n")
        said = f"<p><em>The paper:</em> {html.escape(about['paper'])}</p>" if about["paper"] else ""
        parts.append(
            f'<figure id="{stem}"><h2>{title}</h2>{said}'
            f'<a href="{stem}.pdf"><img src="{stem}.png" alt="{title}"></a>'
            f"{'' if captions else f'<figcaption>{caption}</figcaption>'}</figure>"
        )
    write_whole(folder / "captions.md", "\n".join(texts).encode())
    page = (
        '<!doctype html><html lang="en"><meta charset="utf-8"><title>Gaussian Blue Noise: figures</title>'
        f"<style>{PAGE_STYLE}</style><h1>Gaussian Blue Noise: the paper's figures</h1>{''.join(parts)}</html>"
    )
    write_whole(folder / "index.html", page.encode())
