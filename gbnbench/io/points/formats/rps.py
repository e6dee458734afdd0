"""PSA's .rps: pairs of little-endian float32, no header, one 2D set; told by its name alone."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.io.points.file_format import NUMERIC
from gbnbench.io.points.formats.float_layouts import better_layout
from gbnbench.io.points.formats.format import Format
from gbnbench.io.points.point_file import PointFile
from gbnbench.io.points.point_sets import Coordinates, FileContent


def _recognises(file: PointFile) -> bool:
    """Bytes of floats can look like anything, so only what is all numbers is text."""
    return file.suffix == ".rps" and bool(file.head.translate(None, NUMERIC + b" \t\r\n,#"))


def _read(file: PointFile) -> FileContent:
    path, data = file.path, file.numbers()
    if len(data) % 8:
        raise FormatError(path, f"{len(data)} bytes are not pairs of float32: truncated, or no .rps")
    if len(data) > 8 and not any(data):
        raise FormatError(path, "all bytes are zero: the file was never written")
    pairs = np.frombuffer(data, "<f4").reshape(-1, 2)
    if file.options.period is None and file.options.bounds is None and not file.options.wrap:
        _refuse_swapped(path, data)
    with np.errstate(invalid="ignore"):  # signalling nan
        return FileContent([Coordinates(pairs.astype(np.float64))])


def _refuse_swapped(path: Path, data: bytes | memoryview) -> None:
    """Name the type where only another one gives points of the unit torus."""
    other = better_layout(data, np.dtype("<f4"))
    if other == ">float32":
        raise FormatError(
            path,
            "its floats are big-endian, the highest byte first, and an .rps has the lowest first: "
            "--raw '>float32,2' reads it",
        )
    if other is not None and len(data) % 16 == 0:
        raise FormatError(path, f"its floats are of 64 bits, and an .rps has 32: --raw '{other},2' reads it")


RPS = Format("PSA's .rps", (".rps",), _recognises, _read)
