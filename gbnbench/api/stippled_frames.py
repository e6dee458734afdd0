"""Stipplings that form: the dots on their way to their places, or more and more of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points.writer import write_atomically
from gbnbench.reports.stippling.animation import check_animation, gif, mp4
from gbnbench.reports.stippling.page import Page
from gbnbench.reports.stippling.png import pixels

DPI = 100.0
FRAMES = 60


class FormingDots:
    """Some of the states that a method goes through, for ``draw_inks`` to fill as its ``seen``.

    Parameters
    ----------
    steps : int
        That the method takes: with the start it has one state more.
    frames : int
        States to keep, the last among them: first each, then fewer and fewer, since dots move most at the
        start.

    Attributes
    ----------
    states : list of dict of str to (n, 2) float64
        Points of each ink, in pixels.

    Raises
    ------
    InputError
        If there are not so many.

    Examples
    --------
    >>> kept = FormingDots(4, 3)
    >>> for step in range(5):
    ...     kept({"black": np.full((1, 2), step)})
    >>> [int(state["black"][0, 0]) for state in kept.states]
    [0, 1, 4]
    """

    def __init__(self, steps: int, frames: int) -> None:
        if not 1 <= frames <= steps + 1:
            raise InputError(f"{steps} gradients have {steps + 1} states to show; got {frames} frames")
        grown = np.rint((steps + 1) ** np.linspace(0, 1, frames)).astype(int) - 1
        self._wanted = {*np.maximum(grown, np.arange(frames)).tolist()} if frames > 1 else {steps}
        self._step = 0
        self.states: list[dict[str, FloatArray]] = []

    def __call__(self, sets: dict[str, FloatArray]) -> None:
        """Take the next state."""
        if self._step in self._wanted:
            self.states.append({ink: points.copy() for ink, points in sets.items()})
        self._step += 1


def forming(page: Page, states: Iterable[dict[str, FloatArray]], mm: float) -> Iterator[Page]:
    """Put the dots of a page where they were.

    Parameters
    ----------
    page : Page
        The page at the end.
    states : iterable of dict of str to (n, 2) float64
        Points of each layer, in pixels.
    mm : float
        Side of a pixel.

    Yields
    ------
    Page
    """
    for state in states:
        yield replace(
            page,
            layers=tuple(
                replace(layer, centres=state[layer.name] * mm + page.margin) for layer in page.layers
            ),
        )


def growing(page: Page, frames: int) -> Iterator[Page]:
    """Show more and more of each layer's dots, in their order.

    Parameters
    ----------
    page : Page
        The page at the end.
    frames : int
        How many.

    Yields
    ------
    Page
    """
    for number in range(1, frames + 1):
        layers = []
        for layer in page.layers:
            m = max(1, round(len(layer.radii) * number / frames))
            layers.append(replace(layer, centres=layer.centres[:m], radii=layer.radii[:m]))
        yield replace(page, layers=tuple(layers))


def write_frames(
    path: Path,
    pages: Iterator[Page],
    frames: int,
    dpi: float = DPI,
    told: Callable[[int, int, str], None] | None = None,
) -> None:
    """Write pages as a moving picture, whole or not at all.

    Parameters
    ----------
    path : Path
        A .gif or .mp4.
    pages : iterator of Page
        Of one size, at least one.
    frames : int
        How many they are.
    dpi : float
        Pixels an inch.
    told : callable, optional
        Called with (frames drawn, ``frames``, what is being done).

    Raises
    ------
    InputError
        If there are too many pixels, ffmpeg is missing, or the place cannot be written.
    """

    def drawn() -> Iterator[np.ndarray[tuple[int, ...], np.dtype[np.uint8]]]:
        for number, page in enumerate(pages, 1):
            if number == 1:
                check_animation(path, page, dpi, frames)
            yield pixels(page, dpi)
            if told is not None:
                told(number, frames, "frames")

    write_atomically(path, (mp4 if path.suffix.lower() == ".mp4" else gif)(drawn()))
