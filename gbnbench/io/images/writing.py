"""Images as files: tones from 0 to 1 as greys of eight bits, or as they are."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points.writer import write_atomically

FORMATS = {
    ".png": "PNG", ".tif": "TIFF", ".tiff": "TIFF",
    ".jpg": "JPEG", ".jpeg": "JPEG", ".bmp": "BMP", ".pgm": "PPM",
}  # fmt: skip
ARRAY = ".npy"


def check_image(path: Path) -> None:
    """Refuse a file whose suffix names nothing that is written.

    Parameters
    ----------
    path : Path
        The file.

    Raises
    ------
    InputError
        If it names no format.
    """
    if path.suffix.lower() not in (*FORMATS, ARRAY):
        known = " ".join((*FORMATS, ARRAY))
        raise InputError(f"{path}: pictures are written as {known}; got extension {path.suffix!r}")


def write_image(path: Path, tones: FloatArray) -> None:
    """Write an image or a volume, whole or not at all.

    Parameters
    ----------
    path : Path
        Its suffix names the format: .npy holds float64, the others greys of eight bits.
    tones : (rows, columns) or (slices, rows, columns) float64
        0 black to 1 white.

    Raises
    ------
    InputError
        If the suffix names no format, a volume is no .npy, or the place cannot be written.
    """
    from PIL import Image

    check_image(path)
    buffer, suffix = io.BytesIO(), path.suffix.lower()
    if suffix == ARRAY:
        np.save(buffer, tones)
    elif tones.ndim != 2:
        raise InputError(f"{path}: a volume is written as {ARRAY}")
    else:
        picture = Image.fromarray(np.rint(255 * tones).astype(np.uint8))
        try:
            picture.save(buffer, FORMATS[suffix])
        except (OSError, ValueError) as error:  # JPEG has at most 65,535 pixels a side
            raise InputError(f"{path}: no {FORMATS[suffix]} can hold it ({error})") from None
    write_atomically(path, buffer.getvalue())
