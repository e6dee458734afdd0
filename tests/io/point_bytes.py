"""Point-set files made of bytes, for the tests of reading and writing."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np

PSA_EPS = (
    b"%!PS-Adobe-3.1 EPSF-3.0\n%%BoundingBox: -3 -3 515 515\n/radius { 0.00585938 } def\n"
    b"/p { radius 0 360 arc closepath fill stroke } def\ngsave 512 512 scale\n0 setgray\n"
    b"0.600459 0.549315 p\n4.62451e-06 1 p\ngrestore\n"
)


def put(folder: Path, name: str, data: bytes | str) -> Path:
    path = folder / name
    path.write_bytes(data.encode() if isinstance(data, str) else data)
    return path


def npy(x: object, **kwargs: bool) -> bytes:
    file = io.BytesIO()
    np.save(file, x, **kwargs)  # type: ignore[arg-type]
    return file.getvalue()


def npz(**arrays: object) -> bytes:
    file = io.BytesIO()
    np.savez_compressed(file, **arrays)  # type: ignore[arg-type]
    return file.getvalue()


A, B = [[0.5, 0.25], [0.125, 0.75]], [[0.0, 0.875]]
