"""Stipplings as moving pictures: pages one after the other, as GIF by Pillow or as MP4 by ffmpeg."""

from __future__ import annotations

import importlib
import importlib.util
import io
import itertools
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError
from gbnbench.reports.stippling.page import Page
from gbnbench.reports.stippling.png import picture_size

SUFFIXES = (".gif", ".mp4")
A_SECOND = 20  # frames
HELD = 2.0  # seconds that the last one stays
MOST_PIXELS = 1 << 28  # of all frames
COLOURS = 256  # of a GIF

Frames = Iterator[NDArray[np.uint8]]


def check_animation(path: Path, page: Page, dpi: float, frames: int) -> None:
    """Refuse what cannot be written.

    Parameters
    ----------
    path : Path
        The file.
    page : Page
        Of the size that the frames have.
    dpi : float
        Pixels an inch.
    frames : int
        How many.

    Raises
    ------
    InputError
        If there are too many pixels, or ffmpeg is missing.
    """
    columns, rows = picture_size(page, dpi)
    if frames * columns * rows > MOST_PIXELS:
        raise InputError(
            f"{frames} frames of {columns:,} x {rows:,} pixels are more than {MOST_PIXELS:,} pixels: "
            "fewer frames, or a lower dpi"
        )
    if path.suffix.lower() == ".mp4" and importlib.util.find_spec("imageio_ffmpeg") is None:
        raise InputError(f"{path}: MP4 needs ffmpeg: pip install imageio-ffmpeg, or write a .gif")


def gif(frames: Frames) -> bytes:
    """Write pictures as a GIF that starts over again.

    Parameters
    ----------
    frames : iterator of (rows, columns) or (rows, columns, 3) uint8
        The pictures, at least one.

    Returns
    -------
    bytes
    """
    from PIL import Image

    *early, last = (Image.fromarray(frame) for frame in frames)
    if last.mode == "RGB":  # one table of colours for all, the richest picture's
        table = last.quantize(COLOURS)
        early = [picture.quantize(palette=table, dither=Image.Dither.NONE) for picture in early]
        last = table
    first, *others = [*early, last]
    durations = [1000 // A_SECOND] * len(early) + [round(1000 * HELD)]
    buffer = io.BytesIO()
    first.save(buffer, "GIF", save_all=True, append_images=others, duration=durations, loop=0)
    return buffer.getvalue()


def mp4(frames: Frames) -> bytes:
    """Write pictures as H.264 in MP4.

    Parameters
    ----------
    frames : iterator of (rows, columns) or (rows, columns, 3) uint8
        The pictures, at least one; where a side is odd, its last pixels are there twice.

    Returns
    -------
    bytes
    """
    imageio_ffmpeg: Any = importlib.import_module("imageio_ffmpeg")  # optional, and without types

    coloured = (_even(frame) for frame in frames)
    first = next(coloured)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "frames.mp4")
        writer: Any = imageio_ffmpeg.write_frames(
            str(path), (first.shape[1], first.shape[0]), fps=A_SECOND, quality=8, macro_block_size=2
        )
        writer.send(None)
        frame = first
        for frame in itertools.chain([first], coloured):
            writer.send(frame)
        for _ in range(round(HELD * A_SECOND) - 1):
            writer.send(frame)
        writer.close()
        return path.read_bytes()


def _even(frame: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Red, green and blue, with even sides, which the codec wants."""
    coloured = np.broadcast_to(frame.reshape(*frame.shape[:2], -1), (*frame.shape[:2], 3))
    beyond = [(0, side % 2) for side in frame.shape[:2]]
    return np.pad(coloured, [*beyond, (0, 0)], mode="edge")
