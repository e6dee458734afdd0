"""The file of a library's sets: a NumPy array, and what is wrong with one that was damaged."""

from __future__ import annotations

import hashlib
import io

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.core.torus import FloatArray
from gbnbench.io.set_library.entries import ReadySets
from gbnbench.io.set_library.manifest import Manifest
from gbnbench.io.set_library.places import Place


def encoded(sets: FloatArray) -> bytes:
    """Return the content of the file of sets, (realizations, n, d) float64: version 1.0 of .npy, C order."""
    buffer = io.BytesIO()
    np.lib.format.write_array(
        buffer, np.ascontiguousarray(sets, dtype="<f8"), version=(1, 0), allow_pickle=False
    )
    return buffer.getvalue()


def content(place: Place, entry: ReadySets) -> bytes:
    """Return the content of a file of a library, checked against its manifest.

    Parameters
    ----------
    place : Place
        The library.
    entry : ReadySets
        What its manifest says of the file.

    Returns
    -------
    bytes

    Raises
    ------
    FormatError
        If the file is missing, was changed or cannot be read.
    """
    try:
        found = place.read(entry.file)
    except KeyError:
        raise FormatError(place.path / entry.file, "is missing") from None
    if hashlib.sha256(found).hexdigest() != entry.sha256:
        raise FormatError(place.path / entry.file, "was changed: its SHA-256 is not that of the manifest")
    return found


def faults(place: Place, manifest: Manifest) -> dict[str, str]:
    """List every file of a library that is not what was written.

    Parameters
    ----------
    place : Place
        The library.
    manifest : Manifest
        Its manifest.

    Returns
    -------
    dict of str
        What is wrong, by file; empty where all are whole.
    """
    found = {}
    for entry in manifest.files:
        try:
            content(place, entry)
        except FormatError as error:
            found[entry.file] = str(error).removeprefix(f"{place.path / entry.file}: ")
    return found


def read_sets(place: Place, entry: ReadySets) -> FloatArray:
    """Read all sets of a file, checked against the manifest.

    Parameters
    ----------
    place : Place
        The library.
    entry : ReadySets
        What its manifest says of the file.

    Returns
    -------
    (realizations, n, d) float64

    Raises
    ------
    FormatError
        If the file is missing, was changed, cannot be read, or is no such array of points.
    """
    data = io.BytesIO(content(place, entry))
    try:
        sets: FloatArray = np.lib.format.read_array(data, allow_pickle=False)
    except (ValueError, EOFError, MemoryError) as error:
        raise FormatError(place.path / entry.file, f"holds no array of numbers ({error})") from None
    if sets.shape != entry.shape or sets.dtype != np.float64:
        raise FormatError(place.path / entry.file, f"holds {sets.dtype} of shape {sets.shape}")
    if not ((sets >= 0) & (sets < 1)).all():
        raise FormatError(place.path / entry.file, "holds coordinates that do not lie in [0, 1)")
    return sets
