"""Arrays as images: whole numbers over the range of their type, and fractions as they are."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import FormatError, InputError
from gbnbench.core.readable_text import in_one_line
from gbnbench.io.images.image import Image, Samples
from gbnbench.io.points.file_format import reason

ARRAY_SUFFIX = ".npy"
COLOURS = (1, 2, 3, 4)  # values a pixel: grey, grey and alpha, colours, colours and alpha


def load_array(path: Path) -> NDArray[Any]:
    """Load an array of a .npy file, never a pickle.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    ndarray

    Raises
    ------
    FormatError
        If it cannot be read, is no such file, or a damaged one.
    """
    try:
        loaded = np.load(path, allow_pickle=False)
    except OSError as error:
        raise FormatError(path, f"cannot be read: {reason(error)}") from None
    except (ValueError, EOFError, SyntaxError, TypeError) as error:
        raise FormatError(path, f"is no array that can be read ({error})") from None
    if not isinstance(loaded, np.ndarray):
        raise FormatError(path, "is an .npz of several arrays by its content: save one as .npy")
    return loaded


def read_array(path: Path) -> Image:
    """Read an image from a .npy file.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    Image

    Raises
    ------
    FormatError
        If it holds no image.
    """
    loaded = load_array(path)
    try:
        return image_of(loaded, in_one_line(path))
    except InputError as error:
        raise FormatError(path, str(error)) from None


def image_of(array: NDArray[Any], name: str = "the array") -> Image:
    """Take an array as an image.

    Parameters
    ----------
    array : (rows, columns) or (rows, columns, 1 to 4) ndarray
        Grey, grey and alpha, colours, or colours and alpha: unsigned whole numbers up to the largest of their
        type, bools, or real numbers from 0 to 1.
    name : str
        What it is called in messages.

    Returns
    -------
    Image

    Raises
    ------
    InputError
        If the array cannot be meant so.
    """
    if array.ndim not in (2, 3) or (array.ndim == 3 and array.shape[2] not in COLOURS):
        raise InputError(f"an image is (rows, columns) or (rows, columns, 3); got an array {array.shape}")
    if array.size == 0:
        raise InputError(f"an image has pixels; got an array {array.shape}")
    samples = fractions(array)
    if samples.ndim == 2:
        samples = samples[..., None]
    if samples.shape[2] in (2, 4):
        samples = over_white(samples[..., :-1], samples[..., -1:])
    return Image(samples, name)


def fractions(array: NDArray[Any]) -> Samples:
    """Bring samples to 0 to 1.

    Parameters
    ----------
    array : ndarray
        Unsigned whole numbers, bools, or real numbers from 0 to 1.

    Returns
    -------
    float32 or float64 ndarray
        Of the same shape; float64 where float32 would round what is given, such as faint ink on white.

    Raises
    ------
    InputError
        If they are of another type, nan, or outside.
    """
    if array.dtype.kind == "b":
        return array.astype(np.float32)
    if array.dtype.kind == "u":
        return np.asarray(
            array / np.float64(np.iinfo(array.dtype).max), np.float32 if array.itemsize <= 2 else np.float64
        )
    if array.dtype.kind != "f":
        raise InputError(
            "an image's pixels are unsigned whole numbers (uint8, uint16) or real numbers from 0 to 1; "
            f"got {array.dtype}"
        )
    if not np.isfinite(array).all():
        raise InputError(f"{int((~np.isfinite(array)).sum()):,} of the pixels' values are nan or infinite")
    if array.min() < 0 or array.max() > 1:
        raise InputError(
            "real numbers of an image go from 0 (black) to 1 (white); "
            f"these from {array.min():g} to {array.max():g}: scale them"
        )
    return array.astype(np.float32 if array.itemsize <= 4 else np.float64)


def over_white(samples: Samples, alpha: Samples) -> Samples:
    """Lay transparent samples on white paper.

    Parameters
    ----------
    samples : (rows, columns, channels) float32 or float64
        From 0 to 1.
    alpha : (rows, columns, 1) float32 or float64
        From 0, transparent, to 1, opaque.

    Returns
    -------
    (rows, columns, channels) float32 or float64
    """
    return 1 - alpha * (1 - samples)
