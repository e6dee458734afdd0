"""``gbnbench.export_mask``: a void-and-cluster dither mask as a picture or as numbers for renderers."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench import __version__
from gbnbench.analysis.radial.pattern_power import LEVELS, PatternPower, pattern_power
from gbnbench.api.exports import ExportedMask
from gbnbench.core.atomic_write import check_folder
from gbnbench.core.errors import InputError
from gbnbench.core.number_text import number
from gbnbench.generators.kernel_based.dither_mask import checked_shape, dither_mask
from gbnbench.io.exports.c_header import c_header, c_name
from gbnbench.io.exports.mask_pictures import check_exr, mask_exr, mask_png
from gbnbench.io.exports.raw_numbers import raw_numbers
from gbnbench.io.points.writer import write_atomically
from gbnbench.opencl import use_device

LONGEST = 16  # times as long as wide, of a mask that is drawn
SUFFIXES = (".png", ".exr", ".h", ".bin", ".raw", ".json")


def export_mask(
    path: str | Path,
    shape: int | Sequence[int] = 64,
    *,
    seed: int = 0,
    sigma: float = 1.5,
    sigma_time: float = 1.5,
    bits: int | None = None,
    picture: str | Path | None = None,
    progress: Callable[[int, int, str], None] | None = None,
    device: str | None = None,
) -> ExportedMask:
    """Make a void-and-cluster dither mask, write it, and measure the patterns that it makes.

    Parameters
    ----------
    path : path-like
        Ends in .png (values spread over 8 or 16 bits), .exr (thresholds in (0, 1) as float32, which needs
        ``gbnbench[exr]``), .h (a C header of ranks), .bin or .raw (ranks alone, lowest byte first, with a
        description beside them in FILE.json), or .json.
    shape : int or sequence of int
        Side of a square, or (rows, columns), or (frames, rows, columns); frames are laid below one another in
        pictures.
    seed, sigma, sigma_time
        As in ``dither_mask``.
    bits : {8, 16}, optional
        Of a value of a .png: by default 8 for at most 256 pixels, else 16, which tell all ranks of up to
        256 x 256 pixels apart.
    picture : path-like, optional
        PNG or PDF of the mask, three patterns, their spectra and radial power.
    progress : callable, optional
        Called with (ranks given, ranks in all, what is being done).
    device : str, optional
        Part of the name of the OpenCL device, or its position, as in ``GBNBENCH_DEVICE``.

    Returns
    -------
    ExportedMask
        The ranks, and the power of patterns at nine grey levels; of a mask with frames that of the first.

    Raises
    ------
    InputError
        If an argument breaks its rule, a library is missing, or a file cannot be written.
    DeviceError
        If a device is named and fits none or several.

    Examples
    --------
    >>> import tempfile
    >>> from PIL import Image
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     made = export_mask(f"{folder}/mask.png", 16)
    ...     values = np.asarray(Image.open(f"{folder}/mask.png"))
    >>> bool((values == made.ranks).all())  # 256 ranks are the values of 8 bits
    True
    """
    path, picture = Path(path), None if picture is None else Path(picture)
    sides = checked_shape(shape)
    depth = _checked_bits(path, bits, int(np.prod(sides)))
    for place in (path, picture):
        check_folder(place)
    if picture is not None and picture.suffix.lower() not in (".png", ".pdf"):
        raise InputError(f"{picture}: the picture of a mask is a .png or .pdf; got {picture.suffix!r}")
    if picture is not None and max(sides[-2:]) > LONGEST * min(sides[-2:]):
        raise InputError(
            f"{picture}: a mask that is drawn must be at most {LONGEST} times as long as wide; got "
            f"{sides[-1]} x {sides[-2]} pixels: leave the picture out"
        )
    if picture is not None and picture.absolute() == path.absolute():
        raise InputError(f"{picture}: the picture needs a file of its own")
    ranks = dither_mask(sides, seed=seed, sigma=sigma, sigma_time=sigma_time, progress=progress)
    one = ranks if ranks.ndim == 2 else ranks[0]
    with use_device(device):
        some = (level for level in LEVELS if 0 < round(level * one.size) < one.size)
        levels = tuple(pattern_power(one, level) for level in some)
        drawn = {} if picture is None else {picture: _picture(picture, one)}
    widths = {"sigma": float(sigma)} | ({"sigma_time": float(sigma_time)} if ranks.ndim == 3 else {})
    settings = {"seed": int(seed), **widths}
    files = {**drawn, **_encoded(path, ranks, depth, settings, levels)}
    for file, data in files.items():
        write_atomically(file, data)
    remarks = []
    if path.suffix.lower() == ".png" and ranks.size > 2**depth:
        remarks.append(f"{ranks.size:,} ranks share the {2**depth:,} values of {depth} bits")
    if ranks.ndim == 3:
        remarks.append("ranks are of all frames: the ones of a level differ between frames by a few pixels")
    return ExportedMask(tuple(reversed(files)), ranks, depth, levels, tuple(remarks))


def _checked_bits(path: Path, bits: int | None, pixels: int) -> int:
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        known = ", ".join(SUFFIXES)
        raise InputError(f"{path}: masks are exported as {known}; got extension {path.suffix!r}")
    if suffix == ".exr":
        check_exr(path)
    if suffix != ".png":
        if bits is not None:
            raise InputError(f"bits are those of a .png; leave them out for {path}")
        return 32 if suffix == ".exr" or pixels > 2**16 else 16
    if bits is None:
        return 8 if pixels <= 2**8 else 16
    if bits not in (8, 16) or isinstance(bits, float):
        raise InputError(f"bits must be 8 or 16; got {bits!r}")
    return bits


def _encoded(
    path: Path, ranks: NDArray[np.int64], bits: int, settings: dict[str, Any], levels: Sequence[PatternPower]
) -> dict[Path, bytes]:
    suffix, software = path.suffix.lower(), f"gbnbench {__version__}"
    *frames, rows, columns = ranks.shape
    size = f"{columns} x {rows} pixels" + (f" in {frames[0]} frames, one below the other" if frames else "")
    told = ", ".join(f"{name} {value:g}" for name, value in settings.items())
    made = f"void-and-cluster mask of {size}, {told}"
    if suffix == ".png":
        meaning = f"value = floor(rank 2^{bits} / {ranks.size}), rank = 0 ... {ranks.size - 1}"
        return {path: mask_png(ranks, bits, f"{made}; {meaning}", software)}
    if suffix == ".exr":
        return {path: mask_exr(ranks, f"{made}; Y = (rank + 1/2) / {ranks.size}", software)}
    numbers = ranks.astype(np.uint16 if bits == 16 else np.uint32)
    if suffix == ".h":
        name = c_name(path.stem)
        constants = {"frames": frames[0]} if frames else {}
        index = "[frame][row][column]" if frames else "[row][column]"
        of = ", first frame" if frames else ""
        below = "power below half the principal frequency"
        comments = [
            f"{name}_ranks{index}: {made}.",
            f"Written by {software}. Thresholds are (rank + 0.5) / {ranks.size}, in (0, 1).",
            *(f"Level {one.level:g}{of}: {below} {number(one.low)} of white." for one in levels),
        ]
        constants |= {"rows": rows, "columns": columns, "pixels": ranks.size}
        return {path: c_header(name, "ranks", numbers, constants, comments)}
    about = {
        "gbnbench": __version__,
        "what": made,
        "thresholds": f"(rank + 1/2) / {ranks.size}",
        "settings": settings,
        "levels": [vars(one) for one in levels],
        **({"levels_of": "the first frame"} if frames else {}),
    }
    if suffix == ".json":
        return {path: json.dumps({**about, "ranks": ranks.tolist()}).encode() + b"\n"}
    return raw_numbers(path, numbers, about)


def _picture(path: Path, ranks: NDArray[np.int64]) -> bytes:
    from gbnbench.reports.plotting_library import import_matplotlib

    import_matplotlib()
    from gbnbench.reports import dither_mask as drawn  # matplotlib loads slowly
    from gbnbench.reports.comparison import figure_files

    figure = drawn.figure(ranks)
    return figure_files.png(figure) if path.suffix.lower() == ".png" else figure_files.pdf(figure)
