"""Images as tones, whatever file they come in: one image, or one error that names the file."""

from __future__ import annotations

import os
from pathlib import Path

from gbnbench.core.errors import FormatError
from gbnbench.core.settings import nearest
from gbnbench.io.images.arrays import ARRAY_SUFFIX, read_array
from gbnbench.io.images.bundled import BUNDLED, bundled_file
from gbnbench.io.images.files import read_file
from gbnbench.io.images.image import Image
from gbnbench.io.points.file_format import refuse_large, size_limit

__all__ = ["BUNDLED", "Image", "read_image"]


def read_image(source: str | os.PathLike[str]) -> Image:
    """Read an image by its path, or one of scikit-image's by its name.

    Parameters
    ----------
    source : path-like
        A file that Pillow or tifffile reads, an array as .npy, or a name such as ``camera``. A file of that
        name goes first.

    Returns
    -------
    Image
        The first, where the file holds several; ``remarks`` then says so.

    Raises
    ------
    FormatError
        If there is no such image, or it cannot be read, or has no pixels, or too many.

    Examples
    --------
    >>> read_image("camera").tones.shape
    (512, 512)
    """
    path, name = Path(source), os.fspath(source)
    if not path.exists() and name in BUNDLED:
        return read_file(bundled_file(name), name)
    if not path.exists():
        known = nearest(name, BUNDLED) or f"; images by name are {', '.join(BUNDLED)}"
        raise FormatError(path, f"there is no such file{known}")
    if not path.is_file():
        raise FormatError(path, "is a folder" if path.is_dir() else "is no regular file")
    refuse_large(path, path.stat().st_size, size_limit())
    if path.suffix.lower() == ARRAY_SUFFIX:
        return read_array(path)
    return read_file(path, name)
