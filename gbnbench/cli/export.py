"""``gbnbench export``: point sets and dither masks as files for renderers."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from gbnbench.cli import options
from gbnbench.cli.late_progress import stages
from gbnbench.core.errors import InputError

if TYPE_CHECKING:
    from gbnbench.io.points import ReadingOptions

EPILOG = """\b
Examples:
  gbnbench export gbn -n 64 -o sets.h                          a C header of one set
  gbnbench export sets.npz -o sets.h --copies 8 --seed 1       eight for each, told apart
  gbnbench export gbn -n 256 -d 4 -o sets.bin --type uint32    with projections told
  gbnbench export --mask 64 -o mask.png --picture look.png     a void-and-cluster dither mask
  gbnbench export --mask 64x64x16 -o mask.exr                  for animations, 16 frames
"""
OF_SETS = (
    "points", "dimension", "realizations", "number_type", "swap", "flip", "shift", "copies", "repeat"
)  # fmt: skip
OF_MASKS = ("sigma", "bits", "picture")
NAMES = {"points": "-n", "dimension": "-d", "number_type": "--type"}


@click.command(cls=options.Command, epilog=EPILOG)
@click.argument("sources", nargs=-1, metavar="[SETS]...")
@options.out_file(
    "File to write; one that exists is replaced. Formats: .h, .bin, .raw, .json and other files of "
    "points; masks .png and .exr too.",
    required=True,
)
@click.option("-n", "points", type=click.IntRange(1), help="Points in a set of a generator.  [default: 1024]")
@click.option("-d", "dimension", type=click.IntRange(1), help="Dimension of its sets.  [default: 2]")
@click.option(
    "--type", "number_type", type=click.Choice(["float32", "float64", "uint32"]),
    help="Numbers of the file; uint32 counts 2^-32.  [default: float32 in .h, .bin and .raw, else float64]",
)  # fmt: skip
@click.option(
    "--swap",
    metavar="A,B",
    multiple=True,
    help="Exchange two axes, counted from 0; may be given several times.",
)
@click.option("--flip", metavar="AXES", help="Reflect axes, such as 0 or 0,1.")
@click.option(
    "--shift", metavar="VECTOR", help="Shift on the torus: random, or a vector such as 0.5,0.25 in sides."
)
@click.option(
    "--copies",
    type=click.IntRange(1),
    help="Copies of each set, told apart by random swaps, flips and shifts.",
)
@click.option("--repeat", metavar="COUNTS", help="Lay the tile side by side, such as 2x2.")
@click.option("--mask", metavar="PIXELS", help="A dither mask: 64, 128x64 (wide x high), 64x64x16 (frames).")
@click.option("--sigma", type=float, help="Width of the mask's Gaussian in pixels.  [default: 1.5]")
@click.option(
    "--bits",
    type=click.Choice(["8", "16"]),
    help="Bits of a pixel in a .png.  [default: 16 for over 256 pixels]",
)
@click.option(
    "--picture", type=click.Path(path_type=Path, dir_okay=False),
    help="PNG or PDF to draw the mask in, with its patterns and their spectra.",
)  # fmt: skip
@click.option("--realizations", type=click.IntRange(1), help="Sets of a generator.  [default: 1]")
@options.seed
@options.json
@options.quiet
@options.device
@options.reading
def export(
    sources: tuple[str, ...], out: Path, mask: str | None, seed: int, as_json: bool, quiet: bool,
    reading: ReadingOptions, **given: Any,
) -> None:  # fmt: skip
    """Write point sets or a dither mask for a renderer.

    SETS are files, folders or a generator, as in "gbnbench compare", all of one n and d. What has been
    written is measured: the noise floor after rounding, and for d > 2 the projections on every axis and
    every pair of axes.
    """
    if (mask is None) == (not sources):
        raise InputError("name sets, such as gbn or sets.npz, or a mask by --mask 64: one of the two")
    foreign = OF_SETS if mask is not None else OF_MASKS
    if wrong := [NAMES.get(name, f"--{name}") for name in foreign if given[name] not in (None, ())]:
        raise InputError(f"{wrong[0]} belongs to {'sets' if mask is not None else 'masks'}: leave it out")
    if mask is not None:
        _mask(out, mask, seed, given, as_json=as_json, quiet=quiet)
    else:
        _sets(sources, out, seed, reading, given, as_json=as_json, quiet=quiet)


def _sets(
    sources: tuple[str, ...], out: Path, seed: int, reading: ReadingOptions, given: dict[str, Any], *,
    as_json: bool, quiet: bool,
) -> None:  # fmt: skip
    from gbnbench.api.export_files import written_files
    from gbnbench.api.set_export import export_sets
    from gbnbench.cli.export_text import set_lines, sets_record
    from gbnbench.cli.spectrum_output import check_outs
    from gbnbench.runs.file_sets import files_of
    from gbnbench.runs.source_names import generator_named
    from gbnbench.runs.sources import resolve

    n, d = given["points"] or 1024, given["dimension"] or 2
    found, skipped = resolve(sources, [n], [d], given["realizations"] or 1, reading)
    for remark in skipped:
        click.echo(f"gbnbench: warning: left out {remark}", err=True)
    paths = [Path(name) for name in sources if Path(name).exists() and generator_named(name) is None]
    check_outs(written_files(out), [file for path in paths for file in files_of(path)], each=False)
    replaced = out.exists()
    with stages(quiet) as told:
        made = export_sets(
            out,
            found,
            seed=seed,
            number_type=given["number_type"],
            swap=[_numbers("swap", pair, int) for pair in given["swap"]],
            flip=() if given["flip"] is None else _numbers("flip", given["flip"], int),
            shift=_shift(given["shift"]),
            copies=given["copies"] or 1,
            repeat=None if given["repeat"] is None else _sizes("repeat", given["repeat"]),
            progress=told,
        )
    _tell(sets_record(made), set_lines(made, replaced=replaced), made.remarks, as_json=as_json)


def _mask(out: Path, size: str, seed: int, given: dict[str, Any], *, as_json: bool, quiet: bool) -> None:
    from gbnbench.api.mask_export import export_mask
    from gbnbench.cli.export_text import mask_lines, mask_record

    pixels = _sizes("mask", size)
    shape = pixels[0] if len(pixels) == 1 else tuple(reversed(pixels))
    replaced = out.exists()
    with stages(quiet) as told:
        made = export_mask(
            out,
            shape,
            seed=seed,
            sigma=1.5 if given["sigma"] is None else given["sigma"],
            bits=None if given["bits"] is None else int(given["bits"]),
            picture=given["picture"],
            progress=told,
        )
    _tell(mask_record(made), mask_lines(made, replaced=replaced), made.remarks, as_json=as_json)


def _tell(record: dict[str, Any], lines: Any, remarks: tuple[str, ...], *, as_json: bool) -> None:
    from gbnbench.cli.json_text import json_text

    for remark in remarks:
        click.echo(f"gbnbench: warning: {remark}", err=True)
    if as_json:
        click.echo(json_text(record))
        return
    for line in lines:
        click.echo(line)


def _shift(text: str | None) -> Literal["random"] | list[float] | None:
    if text is None or text == "random":
        return text  # type: ignore[return-value]
    return _numbers("shift", text, float)


def _numbers(name: str, text: str, kind: type[Any]) -> list[Any]:
    try:
        return [kind(word) for word in text.split(",")]
    except ValueError:
        example = {"shift": "random or numbers, such as 0.5,0.25", "swap": "two axes, such as 0,1"}
        meant = example.get(name, "axes counted from 0, such as 0,1")
        raise InputError(f"--{name} takes {meant}; got {text!r}") from None


def _sizes(name: str, text: str) -> tuple[int, ...]:
    try:
        return tuple(int(word) for word in text.lower().split("x"))
    except ValueError:
        example = "2x2" if name == "repeat" else "64, 128x64 or 64x64x16"
        raise InputError(f"--{name} takes whole numbers, such as {example}; got {text!r}") from None
