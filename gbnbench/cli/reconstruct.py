"""``gbnbench reconstruct``: the picture that points draw, found from them."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import click

from gbnbench.cli import options
from gbnbench.cli.late_progress import late_progress
from gbnbench.core.atomic_write import check_folder
from gbnbench.core.errors import FormatError, InputError

if TYPE_CHECKING:
    from gbnbench.analysis.reconstruction.density_estimates import Estimate
    from gbnbench.core.torus import FloatArray
    from gbnbench.io.points import ReadingOptions
    from gbnbench.io.points.stippled_points import StippledPoints

METHODS = ("shaping", "kernel", "voronoi")
GCODE = (".gcode", ".nc", ".ngc")
EPILOG = """\b
Examples:
  gbnbench stipple camera -n 10000 -o dots.txt
  gbnbench reconstruct dots.txt -o back.png --against camera    its PSNR and SSIM
  gbnbench reconstruct dots.txt -o large.png --size 1024x1024
  gbnbench reconstruct theirs.csv -o theirs.png --unit pixels --size 768x512
"""


class Size(click.ParamType):  # type: ignore[type-arg]  # takes no argument before click 8.4
    """Pixels along each axis, width first, such as ``768x512``."""

    name = "size"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[int, ...]:
        """Read the text.

        Parameters
        ----------
        value : str or tuple of int
            What the user typed; click may hand back what is read already.
        param, ctx : click.Parameter and click.Context, optional
            For the message.

        Returns
        -------
        tuple of int
            Each >= 1.

        Raises
        ------
        click.BadParameter
            If the text holds anything else.
        """
        if isinstance(value, tuple):
            return value
        if not re.fullmatch(r"[1-9][0-9]{0,8}([x,][1-9][0-9]{0,8}){1,2}", str(value)):
            self.fail(f"must be pixels of width and height, such as 768x512; got {value!r}", param, ctx)
        return tuple(int(side) for side in re.split("[x,]", str(value)))


@click.command(cls=options.Command, epilog=EPILOG)
@click.argument("points", type=click.Path(path_type=Path))
@options.out_file(
    "Picture to write; one that exists is replaced. Formats: .png .tif .jpg .bmp .pgm, or .npy.",
    required=True,
)
@click.option(
    "--size",
    type=Size(),
    metavar="WxH",
    help="Pixels of the picture.  [default: what --against or the file says, else 512x512]",
)
@click.option(
    "--method",
    type=click.Choice(METHODS),
    default="shaping",
    show_default=True,
    help="Shaped kernels, by the amplitudes of the publication; kernels of one width; or Voronoi cells.",
)
@click.option(
    "--against",
    metavar="IMAGE",
    help="Print PSNR and SSIM of the darkness against this image, at the best gain; with --invert, of the "
    "lightness.",
)
@click.option("--invert", is_flag=True, help="Take dense for light, as after stipple --invert.")
@click.option(
    "--coverage",
    type=float,
    help="Mean darkness (with --invert, lightness), before values beyond black are clipped.  "
    "[default: what the file says]",
)
@click.option(
    "--unit",
    type=click.Choice(["square", "pixels"]),
    default="square",
    show_default=True,
    help="Unit of the file: the unit square, y up; or pixels, y down from the upper left.",
)
@click.option(
    "--set", "index", type=click.IntRange(0), help="Number of the set, counted from 0, in a file of several."
)
@click.option("--points-alone", is_flag=True, help="Leave out the amplitudes that the file has.")
@options.reading
@options.json
@options.quiet
@options.device
def reconstruct(
    points: Path, out: Path, size: tuple[int, ...] | None, method: str, against: str | None, invert: bool,
    coverage: float | None, unit: str, index: int | None, points_alone: bool, reading: ReadingOptions,
    as_json: bool, quiet: bool,
) -> None:  # fmt: skip
    """Find the picture that points draw.

    POINTS is a file of points, with or without amplitudes, from any program. Dense is dark. A volume comes
    back as .npy.
    """
    from gbnbench.analysis.reconstruction.image_quality import image_quality
    from gbnbench.api.reconstruct import density_of_points
    from gbnbench.cli.json_text import json_text
    from gbnbench.cli.point_files import naming
    from gbnbench.io.images.arrays import ARRAY_SUFFIX
    from gbnbench.io.images.writing import check_image, write_image
    from gbnbench.studies.stippling.tones import tones

    check_image(out)
    check_folder(out)
    _check(points, out, against)
    dark = None if against is None else _darkness(against, invert)
    told = size if size is not None else None if dark is None else dark.shape[::-1]
    found = _chosen(points, _stipplings(points, reading, unit, told), index)
    if found.points.shape[1] == 3 and out.suffix.lower() != ARRAY_SUFFIX:
        raise FormatError(
            points,
            f"has points of three coordinates, a volume, which is written as .npy; got {out}. If the third "
            "column is no coordinate, such as the size of dots, name the others: --columns 1,2, or x,y",
        )
    header = found.header
    wanted = told or (None if header is None else header.size)
    if dark is not None and wanted != dark.shape[::-1]:
        width, height = dark.shape[::-1]
        raise click.UsageError(f"{against} is {width}x{height}: leave out --size, by which pictures differ")
    if dark is not None and header is not None and tuple(header.size) != dark.shape[::-1]:
        told_size, width_height = (" x ".join(map(str, size)) for size in (header.size, dark.shape[::-1]))
        click.echo(
            f"gbnbench: {points} was drawn of an image of {told_size} pixels, and {against} has "
            f"{width_height}: it may be another image",
            err=True,
        )
    used = None if points_alone or method != "shaping" else found.amplitudes
    with naming(points), late_progress(quiet) as progress:
        density = density_of_points(
            found.points, used, None if wanted is None else wanted[::-1],
            method=cast("Estimate", method), progress=progress,
        )  # fmt: skip
    if header is not None and found.ink == ("black" if invert else "white"):
        change = "leave out" if invert else "add"
        click.echo(
            f"gbnbench: the picture is a negative: {points} holds {found.ink} dots; {change} --invert for "
            "the image itself",
            err=True,
        )
    share = coverage if coverage is not None or header is None else header.coverage
    picture = tones(density, coverage=share, invert=invert)
    quality = None if dark is None else image_quality(density, dark)
    replaced = ", replacing what was there" if out.exists() else ""
    write_image(out, picture)
    n, pixels = len(found.points), picture.shape[::-1]
    if as_json:
        row = {"path": points, "out": out, "n": n, "size": pixels, "method": method}
        row |= {"amplitudes": "found" if used is None else "of the file"} if method == "shaping" else {}
        click.echo(json_text(row | ({} if quality is None else {"psnr": quality.psnr, "ssim": quality.ssim})))
        return
    click.echo(
        f"wrote {out}: {' x '.join(map(str, pixels))} pixels from {n:,} point{'s' * (n != 1)}{replaced}"
    )
    if quality is not None:
        what = "lightness" if invert else "darkness"
        click.echo(f"PSNR {quality.psnr:.2f} dB, SSIM {quality.ssim:.3f} of the {what} of {against}")


def _check(points: Path, out: Path, against: str | None) -> None:
    for given in (points, *(() if against is None else (Path(against),))):
        if out.exists() and given.exists() and out.samefile(given):
            raise click.UsageError(f"{out} is a file that is read: name another file")
    if points.suffix.lower() in GCODE:
        raise FormatError(
            points, "holds the moves of a plotter and no table of points: write the dots as .txt or .csv too"
        )


def _darkness(against: str, invert: bool) -> FloatArray:
    from gbnbench.io.images import read_image
    from gbnbench.studies.stippling.darkness import ToneCurve, image_darkness

    return image_darkness(read_image(against), ToneCurve(invert)).values


def _stipplings(
    path: Path, reading: ReadingOptions, unit: str, size: tuple[int, ...] | None
) -> list[StippledPoints]:
    from gbnbench.io.points.image_stipplings import read_pixel_stipplings
    from gbnbench.io.points.stippled_points import read_stipplings

    if unit == "square":
        try:
            return read_stipplings(path, reading)
        except FormatError as error:
            if "--period" not in str(error):
                raise
            where, _, box = str(error).partition("; scale the points to the unit torus first: ")
            pixels = "pixels, y down as in pictures, are read with --unit pixels"
            raise InputError(f"{where}: {pixels}; or {box}" if box else f"{error}; or {pixels}") from None
    if reading.period is not None or reading.bounds is not None:
        raise click.UsageError("--unit pixels is of pictures of --size: leave out --period and --bounds")
    if size is None:
        raise click.UsageError("--unit pixels needs the size of the picture: --size 768x512, or --against")
    return read_pixel_stipplings(path, reading, size)


def _chosen(path: Path, sets: list[StippledPoints], index: int | None) -> StippledPoints:
    if index is None and len(sets) > 1:
        raise FormatError(path, f"holds {len(sets)} sets: take one by --set 0 to {len(sets) - 1}")
    if index is not None and index >= len(sets):
        raise FormatError(
            path, f"holds {len(sets)} set{'s' * (len(sets) > 1)}, counted from 0; got --set {index}"
        )
    return sets[index or 0]
