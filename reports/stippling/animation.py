"""Stipplings as moving pictures: pages one after the other, as GIF by Pillow or as MP4 by ffmpeg."""

from __future__ import annotations

import contextlib
import importlib
import importlib.util
import io
import itertools
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any, cast

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError
from gbnbench.core.readable_text import in_one_line
from gbnbench.reports.stippling.page import Page
from gbnbench.reports.stippling.png import picture_size

SUFFIXES = (".gif", ".mp4")
A_SECOND = 20  # frames
HELD = 2.0  # seconds that the last one stays
MOST_PIXELS = 1 << 28  # of all frames
COLOURS = 256  # of a GIF
CRF = 10  # of H.264: rims of dots without blocks
NO_FFMPEG = "MP4 needs ffmpeg: pip install 'gbnbench[video]' or put ffmpeg on the PATH, or write a .gif"

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
    if path.suffix.lower() == ".mp4" and ffmpeg() is None:
        raise InputError(f"{path}: {NO_FFMPEG}")


def ffmpeg() -> str | None:
    """Find the program that writes MP4: that of the package imageio-ffmpeg, or else the one on the PATH.

    Returns
    -------
    str or None
        None where there is neither.
    """
    if importlib.util.find_spec("imageio_ffmpeg") is not None:
        package: Any = importlib.import_module("imageio_ffmpeg")  # optional, and without types
        try:
            return str(package.get_ffmpeg_exe())
        except RuntimeError:  # installed without the program
            pass
    return shutil.which("ffmpeg")


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

    Raises
    ------
    InputError
        If ffmpeg is missing or fails, with the first line of what it says.
    """
    program = ffmpeg()
    if program is None:
        raise InputError(NO_FFMPEG)
    coloured = (_even(frame) for frame in frames)
    first = next(coloured)
    size = f"{first.shape[1]}x{first.shape[0]}"
    with tempfile.TemporaryDirectory() as folder:
        path, errors = Path(folder, "frames.mp4"), Path(folder, "errors.txt")
        pipe = ("-f", "rawvideo", "-pix_fmt", "rgb24", "-s", size, "-r", str(A_SECOND), "-i", "-")
        coded = ("-c:v", "libx264", "-crf", str(CRF), "-pix_fmt", "yuv420p", "-movflags", "+faststart")
        command = [program, "-v", "error", "-y", *pipe, "-an", *coded, str(path)]
        with (
            errors.open("wb") as said,
            subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=said) as run,
        ):
            stdin = cast("IO[bytes]", run.stdin)
            with contextlib.suppress(BrokenPipeError), stdin as taken:  # why it ended stands in its errors
                frame = first
                for frame in itertools.chain([first], coloured):
                    taken.write(frame.tobytes())
                for _ in range(round(HELD * A_SECOND) - 1):
                    taken.write(frame.tobytes())
        if run.returncode != 0 or not path.exists():
            lines = errors.read_text(errors="replace").split("\n")
            why = next((line for line in lines if line.strip()), f"exit code {run.returncode}")
            raise InputError(f"{program} wrote no MP4: {in_one_line(why)}")
        return path.read_bytes()


def _even(frame: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Red, green and blue, with even sides, which the codec wants."""
    coloured = np.broadcast_to(frame.reshape(*frame.shape[:2], -1), (*frame.shape[:2], 3))
    beyond = [(0, side % 2) for side in frame.shape[:2]]
    return np.pad(coloured, [*beyond, (0, 0)], mode="edge")
