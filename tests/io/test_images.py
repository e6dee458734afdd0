"""Images of every kind are read as tones from black to white, or refused in one line that names the file."""

from __future__ import annotations

import contextlib
import errno
import os
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as Pillow

from gbnbench.core.errors import FormatError, InputError
from gbnbench.io.images import BUNDLED, read_image
from gbnbench.io.images.arrays import image_of

STEPS = np.array([[0, 51, 102], [153, 204, 255]], np.uint8)  # fifths of the way to white
FIFTHS = np.arange(6).reshape(2, 3) / 5
CLOSE = {"abs": 2e-7}  # samples are float32


@pytest.mark.parametrize("suffix", [".png", ".bmp", ".tif", ".pgm", ".gif", ".webp"])
def test_grey_files_give_their_greys(here, suffix):
    options = {"lossless": True} if suffix == ".webp" else {}
    Pillow.fromarray(STEPS).save(f"x{suffix}", **options)
    assert read_image(f"x{suffix}").tones == pytest.approx(FIFTHS, **CLOSE)


@pytest.mark.parametrize("suffix", [".png", ".tif", ".npy"])
def test_sixteen_bits_are_kept(here, suffix):
    values = np.array([[0, 1, 300], [1000, 65534, 65535]], np.uint16)
    if suffix == ".npy":
        np.save("x.npy", values)
    else:
        Pillow.fromarray(values).save(f"x{suffix}")
    tones = read_image(f"x{suffix}").tones
    assert tones == pytest.approx(values / 65535, **CLOSE)
    assert tones[0, 1] > 0


def test_bilevel_and_real_numbers_are_read(here):
    Pillow.fromarray(STEPS > 127).save("b.png")
    assert (read_image("b.png").tones == (STEPS > 127)).all()
    Pillow.fromarray(FIFTHS.astype(np.float32)).save("f.tif")
    assert read_image("f.tif").tones == pytest.approx(FIFTHS, **CLOSE)


def test_tiff_that_pillow_does_not_know_is_read(here):
    tifffile = pytest.importorskip("tifffile")
    tifffile.imwrite("d.tif", np.stack([FIFTHS, 1 - FIFTHS]), photometric="minisblack")  # 64 bits a pixel
    image = read_image("d.tif")
    assert image.tones == pytest.approx(FIFTHS, **CLOSE)
    assert image.remarks == ("d.tif has 2 pages: the first is taken",)
    tifffile.imwrite("n.tif", FIFTHS - 1)
    with pytest.raises(FormatError, match=r"n\.tif: real numbers of an image go from 0"):
        read_image("n.tif")


@pytest.mark.parametrize("mode", ["RGB", "P"])
def test_colours_give_their_luma(here, mode):
    colours = np.array([[[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255], [0, 0, 0]]], np.uint8)
    picture = Pillow.fromarray(colours)
    (picture if mode == "RGB" else picture.quantize(8)).save("c.png")
    tones = read_image("c.png").tones[0]
    assert tones == pytest.approx([0.2126, 0.7152, 0.0722, 1, 0], **CLOSE)
    assert tones[3] == 1


@pytest.mark.parametrize("mode", ["LA", "RGBA"])
def test_transparency_lies_on_white(here, mode):
    black = np.zeros((1, 3, 2 if mode == "LA" else 4), np.uint8)
    black[0, :, -1] = [0, 51, 255]
    Pillow.fromarray(black).save("a.png")
    assert read_image("a.png").tones == pytest.approx(np.array([[1, 0.8, 0]]), **CLOSE)


def test_a_transparent_colour_is_white(here):
    Pillow.fromarray(STEPS).save("t.png", transparency=51)
    assert read_image("t.png").tones[0] == pytest.approx([0, 1, 0.4], **CLOSE)
    indexed = Pillow.fromarray(STEPS).convert("P")
    indexed.save("t.gif", transparency=int(np.asarray(indexed)[0, 0]))
    assert read_image("t.gif").tones[0] == pytest.approx([1, 0.2, 0.4], **CLOSE)


def test_inks_of_cmyk_files_stay_as_they_are(here):
    inks = np.array([[[255, 0, 0, 0], [0, 0, 255, 51], [0, 0, 0, 255], [0, 0, 0, 0]]], np.uint8)
    Pillow.fromarray(inks, "CMYK").save("k.tif")
    image = read_image("k.tif")
    assert image.inks == pytest.approx(inks / 255, **CLOSE)
    assert image.rgb[0] == pytest.approx(np.array([[0, 1, 1], [0.8, 0.8, 0], [0, 0, 0], [1, 1, 1]]), **CLOSE)


def test_inks_print_the_colours_again():
    colours = np.random.default_rng(1).random((5, 4, 3)).astype(np.float32)
    colours[0, 0], colours[0, 1], colours[0, 2] = 0, 1, 0.5
    inks = image_of(colours).inks
    assert (1 - inks[..., :3]) * (1 - inks[..., 3:]) == pytest.approx(colours, abs=1e-6)
    assert inks[..., :3].min(axis=2) == pytest.approx(0, abs=1e-6)  # black takes what the three share
    assert inks[0, :3].tolist() == [[0, 0, 0, 1], [0, 0, 0, 0], [0, 0, 0, 0.5]]


def test_a_photograph_that_lies_on_its_side_is_turned(here):
    picture = Pillow.fromarray(np.repeat(np.repeat(STEPS, 16, 0), 16, 1))
    exif = Pillow.Exif()
    exif[0x0112] = 6  # to be turned clockwise
    picture.save("e.jpg", exif=exif, quality=95)
    tones = read_image("e.jpg").tones
    assert tones.shape == (48, 32)
    assert tones[8::16, 8::16] == pytest.approx(np.rot90(FIFTHS, -1), abs=0.02)  # a JPEG's losses


@pytest.mark.parametrize(("suffix", "what"), [(".gif", "frames"), (".png", "frames"), (".tif", "pages")])
def test_the_first_of_several_is_taken_and_said(here, suffix, what):
    first, second = Pillow.fromarray(STEPS), Pillow.fromarray(255 - STEPS)
    first.save(f"two{suffix}", save_all=True, append_images=[second])
    image = read_image(f"two{suffix}")
    assert image.tones == pytest.approx(FIFTHS, **CLOSE)
    assert image.remarks == (f"two{suffix} has 2 {what}: the first is taken",)


@pytest.mark.parametrize("name", ["camera", "astronaut", "horse"])
def test_images_of_scikit_image_have_names(name):
    image = read_image(name)
    assert image.samples.ndim == 3
    assert 0 <= image.tones.min() < image.tones.max() <= 1
    assert name in BUNDLED


def test_a_file_goes_before_a_name(here):
    Pillow.fromarray(STEPS).save("camera", format="PNG")
    assert read_image("camera").tones.shape == (2, 3)


def huge_png() -> bytes:
    """A few bytes that say they hold a picture of 65,000 by 65,000 pixels."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", 65000, 65000, 8, 0, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(b"")) + chunk(b"IEND", b"")
    )


def test_a_bomb_is_refused_unopened(here):
    Path("bomb.png").write_bytes(huge_png())
    with pytest.raises(FormatError, match=r"bomb\.png: has more than 89,478,485 pixels"):
        read_image("bomb.png")


@pytest.mark.parametrize("suffix", [".png", ".jpg", ".gif", ".tif", ".bmp", ".webp"])
def test_a_part_of_a_file_is_refused_by_name(here, suffix):
    noise = np.random.default_rng(2).integers(0, 256, (60, 70, 3), np.uint8)
    Pillow.fromarray(noise).save(f"whole{suffix}")
    data = Path(f"whole{suffix}").read_bytes()
    for share in (0.9, 0.5, 0.1):
        Path(f"part{suffix}").write_bytes(data[: int(share * len(data))])
        with pytest.raises(FormatError, match=rf"part\{suffix}: ") as caught:
            read_image(f"part{suffix}")
        assert "\n" not in str(caught.value)


@pytest.mark.slow
def test_damaged_bytes_are_an_image_or_one_error(here):
    rng = np.random.default_rng(3)
    for suffix in (".png", ".jpg", ".gif", ".tif"):
        Pillow.fromarray(rng.integers(0, 256, (9, 11, 3), np.uint8)).save(f"whole{suffix}")
        data = np.frombuffer(Path(f"whole{suffix}").read_bytes(), np.uint8)
        for _ in range(25):
            damaged = data.copy()
            damaged[rng.integers(0, len(data), 3)] = rng.integers(0, 256, 3)
            Path(f"bad{suffix}").write_bytes(damaged.tobytes())
            with contextlib.suppress(FormatError):
                tones = read_image(f"bad{suffix}").tones
                assert ((tones >= 0) & (tones <= 1)).all()


@pytest.mark.parametrize(
    ("array", "says"),
    [
        (np.zeros((0, 5)), "an image has pixels"),
        (np.zeros(5), "an image is (rows, columns)"),
        (np.zeros((3, 4, 5)), "an image is (rows, columns)"),
        (np.array([[0.5, np.nan]]), "1 of the pixels' values are nan or infinite"),
        (np.array([[0, 255.0]]), "from 0 (black) to 1 (white); these from 0 to 255: scale them"),
        (np.array([[0, 255]]), "unsigned whole numbers (uint8, uint16)"),
        (np.array([["a"]]), "unsigned whole numbers (uint8, uint16)"),
    ],
)
def test_arrays_that_are_no_image_are_refused(here, array, says):
    with pytest.raises(InputError) as caught:
        image_of(array)
    assert says in str(caught.value)
    np.save("x.npy", array)
    with pytest.raises(FormatError) as caught:
        read_image("x.npy")
    assert str(caught.value).startswith("x.npy: ")
    assert says in str(caught.value)


@pytest.mark.parametrize(
    ("content", "name", "says"),
    [
        (b"", "x.png", "the file is empty"),
        (b"hello", "x.png", "is no image that Pillow reads"),
        (b"x,y\n1,2\n", "x.csv", "is no image that Pillow reads"),
        (b"hello", "x.npy", "is no array that can be read"),
        (b"\x93NUMPY\x01\x00", "x.npy", "is no array that can be read"),
    ],
)
def test_files_that_are_no_image_are_refused(here, content, name, says):
    Path(name).write_bytes(content)
    with pytest.raises(FormatError) as caught:
        read_image(name)
    assert str(caught.value).startswith(f"{name}: {says}")


def test_what_is_not_there_is_told_with_the_names(here):
    with pytest.raises(FormatError, match=r"^kamera: there is no such file \(did you mean 'camera'\?\)$"):
        read_image("kamera")
    with pytest.raises(FormatError, match=r"^x\.png: there is no such file; images by name are astronaut, "):
        read_image("x.png")
    with pytest.raises(FormatError, match=r"is a folder"):
        read_image(here)


@pytest.mark.parametrize("name", ["x.png", "x.tif", "x.npy"])
@pytest.mark.parametrize("error", [errno.EACCES, errno.EIO])
def test_what_the_system_will_not_read_is_not_called_damaged(here, monkeypatch, name, error):
    np.save("x.npy", FIFTHS) if name == "x.npy" else Pillow.fromarray(STEPS).save(name)
    opened = open

    def refused(path, *arguments, **settings):
        if Path(str(path)).name == name:
            raise OSError(error, os.strerror(error), path)
        return opened(path, *arguments, **settings)

    monkeypatch.setattr("builtins.open", refused)  # root may read what nobody may
    said = {errno.EACCES: "permission denied", errno.EIO: "input/output error"}[error]
    with pytest.raises(FormatError, match=rf"^{name}: cannot be read: {said}$"):
        read_image(name)


@pytest.mark.filterwarnings("ignore:.*photometric:DeprecationWarning")
def test_pages_and_planes_of_real_numbers_are_read(here):
    tifffile = pytest.importorskip("tifffile")
    stack = np.random.default_rng(4).random((4, 30, 40)).astype(np.float32)
    tifffile.imwrite("pages.tif", stack, photometric="minisblack")
    assert read_image("pages.tif").tones == pytest.approx(stack[0], **CLOSE)
    assert read_image("pages.tif").remarks == ("pages.tif has 4 pages: the first is taken",)
    tifffile.imwrite("grey.tif", stack.astype(float), photometric="minisblack", planarconfig="separate")
    assert read_image("grey.tif").tones == pytest.approx(stack[0], **CLOSE)
    assert read_image("grey.tif").remarks == ("grey.tif has 4 planes: the first is taken",)
    tifffile.imwrite("rgb.tif", stack[:3], photometric="rgb")
    assert read_image("rgb.tif").rgb == pytest.approx(np.moveaxis(stack[:3], 0, -1), **CLOSE)
    tifffile.imwrite("rgba.tif", stack, photometric="rgb", extrasamples=["unassalpha"])
    image = read_image("rgba.tif")
    assert image.rgb == pytest.approx(np.moveaxis(1 - stack[3] * (1 - stack[:3]), 0, -1), abs=1e-6)
    assert "4 planes, taken for red, green, blue and opacity as the file says" in image.remarks[0]


def test_whole_numbers_of_32_bits_are_told_as_they_are(here):
    tifffile = pytest.importorskip("tifffile")
    tifffile.imwrite("u.tif", np.array([[0, 4_250_000_000]], np.uint32))
    with pytest.raises(FormatError, match=r"u\.tif: its pixels are whole numbers from 0 to 4250000000, of"):
        read_image("u.tif")
    tifffile.imwrite("s.tif", np.array([[-5, 4]], np.int32))
    with pytest.raises(FormatError, match=r"s\.tif: its pixels are whole numbers from -5 to 4, of"):
        read_image("s.tif")
    tifffile.imwrite("small.tif", np.array([[0, 65535]], np.uint32))
    assert read_image("small.tif").tones.tolist() == [[0, 1]]


def test_whole_numbers_without_a_white_are_refused(here):
    Pillow.fromarray(np.array([[0, 100_000]], np.int32)).save("i.tif")
    with pytest.raises(FormatError, match=r"i\.tif: its pixels are whole numbers from 0 to 100000"):
        read_image("i.tif")
