"""Dither masks as pictures: PNG of 8 or 16 bits whose values give the ranks back, and EXR of thresholds."""

from __future__ import annotations

import importlib
import io
import tempfile
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from gbnbench.core.errors import InputError


def stacked(ranks: NDArray[np.int64]) -> NDArray[np.int64]:
    """Lay the frames of a mask below one another: (frames, rows, columns) to (frames * rows, columns)."""
    return ranks.reshape(-1, ranks.shape[-1])


def thresholds(ranks: NDArray[np.int64]) -> NDArray[np.float32]:
    """Return (rank + 1/2) / pixels as float32, in (0, 1)."""
    return ((ranks + 0.5) / ranks.size).astype(np.float32)


def png_levels(ranks: NDArray[np.int64], bits: int) -> NDArray[Any]:
    """Spread ranks over the values of a PNG.

    Parameters
    ----------
    ranks : (...) int64
        Each of 0 to pixels - 1 once.
    bits : {8, 16}
        Of a value.

    Returns
    -------
    (...) uint8 or uint16
        floor(rank 2^bits / pixels): every value as often as any other, or nearly. Where pixels are at most
        2^bits, all differ, and the rank is ceil(value pixels / 2^bits).
    """
    return ((ranks << bits) // ranks.size).astype(np.uint8 if bits == 8 else np.uint16)


def mask_png(ranks: NDArray[np.int64], bits: int, comment: str, software: str) -> bytes:
    """Make the bytes of a PNG of a mask.

    Parameters
    ----------
    ranks : (rows, columns) or (frames, rows, columns) int64
        Each of 0 to pixels - 1 once; frames are laid below one another.
    bits : {8, 16}
        Of a value.
    comment, software : str
        For the file's chunks of text.

    Returns
    -------
    bytes
    """
    info = PngInfo()
    info.add_itxt("Comment", comment)
    info.add_itxt("Software", software)
    stream = io.BytesIO()
    Image.fromarray(png_levels(stacked(ranks), bits)).save(stream, format="png", pnginfo=info)
    return stream.getvalue()


def check_exr(path: Path) -> None:
    """Refuse an EXR where the library that writes it is missing.

    Raises
    ------
    InputError
        If the package OpenEXR is not installed.
    """
    if find_spec("OpenEXR") is None:
        raise InputError(
            f'{path}: EXR files need the package OpenEXR: pip install "gbnbench[exr]", or write .png'
        )


def mask_exr(ranks: NDArray[np.int64], comment: str, software: str) -> bytes:
    """Make the bytes of an EXR of a mask: one channel Y of float32 thresholds.

    Parameters
    ----------
    ranks : (rows, columns) or (frames, rows, columns) int64
        Each of 0 to pixels - 1 once; frames are laid below one another.
    comment, software : str
        For the file's header.

    Returns
    -------
    bytes
    """
    openexr: Any = importlib.import_module("OpenEXR")  # optional, and without types
    header = {
        "compression": openexr.ZIP_COMPRESSION,
        "type": openexr.scanlineimage,
        "comments": comment,
        "software": software,
    }
    with tempfile.TemporaryDirectory() as folder:  # the library writes to names alone
        there = Path(folder) / "mask.exr"
        openexr.File(header, {"Y": np.ascontiguousarray(thresholds(stacked(ranks)))}).write(str(there))
        return there.read_bytes()
