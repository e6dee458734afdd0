"""Images and methods of the figures of adaptive sampling, and the requests for their sets."""

from __future__ import annotations

from collections.abc import Sequence

from gbnbench.generators.adaptive.registry import ADAPTIVE_GENERATORS
from gbnbench.reports.paper.data import StipplingRequest
from gbnbench.reports.paper.figure import FigureOptions
from gbnbench.reports.paper.wording import listed
from gbnbench.studies.stippling_comparison.stippling_results import StipplingResult, StipplingRun

IMAGES = {"10": "camera", "15": "astronaut", "16": "chelsea", "17": "coffee"}  # in place of the paper's
TITLES = {
    "bnot": "BNOT", "kdm": "KDM", "electrostatic": "Electrostatic", "secord": "Secord", "lbg": "LBG",
    "gbn": "GBN",
}  # fmt: skip
INSTEAD = ("secord", "lbg")  # of methods that have no generator here


def methods_shown(paper: Sequence[str]) -> tuple[str, ...]:
    """Choose methods to stand beside Gaussian blue noise.

    Parameters
    ----------
    paper : sequence of str
        Names of those that the paper shows.

    Returns
    -------
    tuple of str
        Those that have an adaptive generator, and others in place of the rest.
    """
    there = [name for name in paper if name in ADAPTIVE_GENERATORS]
    return (*there, *INSTEAD[: len(paper) - len(there)])


def request(
    options: FigureOptions, figure: str, sources: Sequence[str], counts: tuple[int, int, int]
) -> StipplingRequest:
    """Ask for stipplings of a figure's image.

    Parameters
    ----------
    options : FigureOptions
        Scale, and images of the user.
    figure : str
        Its number.
    sources : sequence of str
        Generators with settings.
    counts : (int, int, int)
        Points for tests, for minutes, and in full.

    Returns
    -------
    StipplingRequest
    """
    pixels = options.pick(48, 256, None)
    return StipplingRequest(image_of(options, figure), tuple(sources), options.pick(*counts), pixels)


def image_of(options: FigureOptions, figure: str) -> str:
    """Return the image of a figure: the user's, else ours.

    Parameters
    ----------
    options : FigureOptions
        Images of the user.
    figure : str
        Its number.

    Returns
    -------
    str
        A file or a name.
    """
    return options.images.get(figure, IMAGES[figure])


def sources_of(run: StipplingRun, labels: Sequence[str]) -> list[StipplingResult]:
    """Find the sources of these labels that are there, in this order.

    Parameters
    ----------
    run : StipplingRun
        The comparison.
    labels : sequence of str
        Generators with settings.

    Returns
    -------
    list of StipplingResult
    """
    found = {source.label: source for source in run.sources}
    return [found[label] for label in labels if label in found]


def title_of(label: str) -> str:
    """Name of a method, from a generator's text."""
    name = label.partition("[")[0]
    return TITLES.get(name, name)


def left_out_note(run: StipplingRun, paper: Sequence[str], options: FigureOptions, figure: str) -> str:
    """Say what differs from the paper's figure: its image, methods that are not there.

    Parameters
    ----------
    run : StipplingRun
        What is shown.
    paper : sequence of str
        Methods that the paper shows beside ours.
    options : FigureOptions
        Images of the user.
    figure : str
        Its number.

    Returns
    -------
    str
        Sentences for the caption.
    """
    shown = [source.label.partition("[")[0] for source in run.sources]
    missing = [TITLES[name] for name in paper if name not in ADAPTIVE_GENERATORS]
    others = [title_of(name) for name in INSTEAD if name in shown]
    text = []
    if figure not in options.images:
        text.append(
            f"In place of the paper's image: {IMAGES[figure]} of scikit-image's (--image {figure}=FILE)."
        )
    if missing:
        verb = "has" if len(missing) == 1 else "have"
        instead = f": in place of {'it' if len(missing) == 1 else 'them'} {listed(others)}" if others else ""
        text.append(f"{listed(missing)} {verb} no adaptive generator here{instead}.")
    told = [*(run.manifest.get("skipped") or ()), *run.failures]
    if told:
        text.append(f"Left out: {'; '.join(told)}.")
    return " ".join(text)


def quality(sources: Sequence[StipplingResult], titles: Sequence[str]) -> str:
    """Write PSNR, F16 and variance of the first sets in a sentence each.

    Parameters
    ----------
    sources : sequence of StipplingResult
        What is shown.
    titles : sequence of str
        Their names.

    Returns
    -------
    str
        For the caption.
    """
    each = [
        f"{title} {one.measures['psnr']:.1f} dB, {one.measures['blurred_difference']:.2g}, "
        f"{one.measures['relative_variance']:.2g}"
        for one, title in zip(sources, titles, strict=True)
    ]
    return (
        "PSNR of the picture found back, difference from the density when both are blurred by 16 pixels, and "
        f"relative variance: {'; '.join(each)}."
    )
