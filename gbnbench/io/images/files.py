"""Image files by Pillow, and by tifffile the TIFF that it does not know: upright and on white."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image as Pillow
from PIL import ImageOps, UnidentifiedImageError

from gbnbench.core.errors import FormatError, InputError
from gbnbench.io.images.arrays import fractions, image_of, over_white
from gbnbench.io.images.image import Image, Samples
from gbnbench.io.points.file_format import reason

MOST_PIXELS = 89_478_485  # of a file: where Pillow begins to suspect a decompression bomb
TRANSPARENT = {"L": "LA", "RGB": "RGBA", "P": "RGBA", "1": "LA"}  # modes with a transparent colour
PREMULTIPLIED = {"La": "LA", "RGBa": "RGBA"}
DEEP = 65535  # the white of sixteen bits
RGB = 2  # of TIFF's photometric interpretations
COLOURED = {3: "red, green and blue", 4: "red, green, blue and opacity"}  # by planes
BITS, SAMPLE_FORMAT, UNSIGNED = 258, 339, 1  # tags of TIFF, and a value
TIFF = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")  # how files of TIFF and BigTIFF begin


def read_file(path: Path, name: str) -> Image:
    """Read an image file.

    Parameters
    ----------
    path : Path
        The file.
    name : str
        What the image is called in messages.

    Returns
    -------
    Image

    Raises
    ------
    FormatError
        If it cannot be read, is no image, is damaged, or has too many pixels.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of tags that do not matter here
            warnings.simplefilter("error", Pillow.DecompressionBombWarning)
            return _by_pillow(path, name)
    except FormatError:
        raise
    except UnidentifiedImageError:
        with path.open("rb") as file:
            first = file.read(4)
        if first not in TIFF:
            said = "is no image that Pillow reads" if first else "the file is empty"
            raise FormatError(path, said) from None
        return _by_tifffile(path, name)
    except (Pillow.DecompressionBombWarning, Pillow.DecompressionBombError):
        raise _too_large(path) from None
    except InputError as error:
        raise FormatError(path, str(error)) from None
    except MemoryError:
        raise FormatError(path, "needs more memory than there is: scale the image down") from None
    except Exception as error:  # decoders raise almost anything when a file is damaged
        if isinstance(error, OSError) and error.errno is not None:  # the system's, not a decoder's
            raise FormatError(path, f"cannot be read: {reason(error)}") from None
        raise FormatError(path, f"is a damaged image, or only a part of one ({reason(error)})") from None


def _by_pillow(path: Path, name: str) -> Image:
    remarks = []
    with Pillow.open(path) as opened:
        frames = int(getattr(opened, "n_frames", 1))
        if frames > 1:
            what = "frames" if getattr(opened, "is_animated", False) and opened.format != "TIFF" else "pages"
            remarks.append(f"{name} has {frames} {what}: the first is taken")
            opened.seek(0)
        if 0 in opened.size:
            raise FormatError(path, f"an image has pixels; this is {opened.width} x {opened.height}")
        opened.load()
        unsigned = opened.format == "TIFF" and opened.mode == "I" and _is_unsigned(opened)
        samples = _samples(ImageOps.exif_transpose(opened), unsigned=unsigned)
        return Image(samples, name, tuple(remarks))


def _is_unsigned(opened: Any) -> bool:
    """Whether a TIFF holds whole numbers of 32 bits without a sign, to which Pillow gives one."""
    tags = opened.tag_v2
    return bool(tags.get(BITS) == (32,) and tags.get(SAMPLE_FORMAT, (UNSIGNED,))[0] == UNSIGNED)


def _samples(picture: Pillow.Image, *, unsigned: bool) -> Samples:
    """Values from 0 to 1 of any of Pillow's modes: (rows, columns, channels)."""
    if "transparency" in picture.info and picture.mode in TRANSPARENT:
        picture = picture.convert(TRANSPARENT[picture.mode])
    elif picture.mode in PREMULTIPLIED:
        picture = picture.convert(PREMULTIPLIED[picture.mode])
    elif picture.mode in ("P", "YCbCr", "HSV", "RGBX"):
        picture = picture.convert("RGB")
    elif picture.mode == "PA":
        picture = picture.convert("RGBA")
    elif picture.mode == "LAB":
        raise InputError("its colours are L*a*b*: save it as RGB or grey")
    values: NDArray[Any] = np.asarray(picture)
    if values.ndim == 2:
        values = values[..., None]
    if values.dtype.kind == "i":
        values = _whole_numbers(values.astype(np.int32).view(np.uint32) if unsigned else values)
    samples = fractions(values.astype(values.dtype.newbyteorder("="), copy=False))
    return over_white(samples[..., :-1], samples[..., -1:]) if picture.mode in ("LA", "RGBA") else samples


def _whole_numbers(values: NDArray[Any]) -> NDArray[np.uint16]:
    """Take whole numbers of 32 bits for the 16 bits that they fit in."""
    if values.min() < 0 or values.max() > DEEP:
        raise InputError(
            f"its pixels are whole numbers from {values.min()} to {values.max()}, of which nothing says "
            f"what is white: scale them to 0 to {DEEP}"
        )
    return values.astype(np.uint16)


def _by_tifffile(path: Path, name: str) -> Image:
    """TIFF of the kinds that Pillow does not know, such as real numbers of 64 bits."""
    import tifffile

    try:
        with tifffile.TiffFile(path) as opened:
            first, pages = opened.pages[0], len(opened.pages)
            if int(np.prod(first.shape[:2], dtype=float)) > MOST_PIXELS:
                raise _too_large(path)
            pixels, remarks = _planes(np.asarray(first.asarray()), first, name)
            image = image_of(pixels, name)
    except FormatError:
        raise
    except InputError as error:
        raise FormatError(path, str(error)) from None
    except Exception as error:  # as above
        raise FormatError(
            path, f"is a TIFF that neither Pillow nor tifffile reads ({reason(error)})"
        ) from None
    if pages > 1:
        remarks = (f"{name} has {pages} pages: the first is taken", *remarks)
    return Image(image.samples, name, remarks)


def _planes(pixels: NDArray[Any], page: Any, name: str) -> tuple[NDArray[Any], tuple[str, ...]]:
    """Take the planes of a page as colours where the file says that they are, else the first of them."""
    if pixels.ndim != 3 or page.axes[0] not in "SZ":
        return pixels, ()
    count = len(pixels)
    if page.axes[0] == "S" and page.photometric == RGB and count in COLOURED:
        said = f"{name} has {count} planes, taken for {COLOURED[count]} as the file says"
        return np.moveaxis(pixels, 0, -1), (f"{said}; pages are to be saved as grey, minisblack",)
    return pixels[0], (f"{name} has {count} planes: the first is taken",)


def _too_large(path: Path) -> FormatError:
    return FormatError(path, f"has more than {MOST_PIXELS:,} pixels: scale the image down")
