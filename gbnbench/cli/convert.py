"""``gbnbench convert``: point sets of files in one file of another format."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from gbnbench.cli import options
from gbnbench.core.errors import FormatError, InputError
from gbnbench.core.readable_text import counted

if TYPE_CHECKING:
    from gbnbench.io.points import PointSets, ReadingOptions

EPILOG = """\b
Examples:
  gbnbench convert dots.csv --period 512,512 -o dots.txt     pixels to the unit torus
  gbnbench convert dump.lammpstrj -o atoms.xyz               with its box
  gbnbench convert sets/*.txt -o all.npz                     many files to one
"""


@click.command(cls=options.Command, epilog=EPILOG)
@click.argument("files", nargs=-1, required=True, type=click.Path(path_type=Path), metavar="FILE...")
@click.option("--fractions", is_flag=True, help="Write fractions of the box and leave the box out.")
@options.reading
@options.out_file("File to write; one that exists is replaced. Its suffix says the format.", required=True)
def convert(files: tuple[Path, ...], out: Path, fractions: bool, reading: ReadingOptions) -> None:
    """Write the sets of files in another format.

    Coordinates stay in the unit of their box where the format can hold the box; otherwise they become
    fractions of it. What the format cannot hold is refused, such as sides that differ or a box that is no
    torus.
    """
    from gbnbench.cli.spectrum_output import check_outs
    from gbnbench.io.points import PointSets, read_sets
    from gbnbench.io.points.writer import check_suffix, encode, lost_box, write_atomically

    check_suffix(out)
    check_outs([out], [path for path in files if path.exists()], each=False)
    read = {path: read_sets(path, reading) for path in files}
    first = read[files[0]]
    d = first.sets[0].shape[1]
    for path, found in read.items():
        if found.sets[0].shape[1] != d:
            said = f"its points have d={found.sets[0].shape[1]}, those of {files[0]} d={d}: write two files"
            raise FormatError(path, said)
        if not fractions and _box(found) != _box(first):
            raise FormatError(path, f"its box is not that of {files[0]}: write two files, or --fractions")
    sets = [x for path in files for x in read[path].sets]
    given = PointSets(sets) if fractions else PointSets(sets, first.sides, first.low, first.toroidal)
    if (lost := lost_box(out, given)) is not None:
        raise InputError(f"{out}: {lost}, and --fractions leaves the box out")
    replaced = ", replacing what was there" if out.exists() else ""
    write_atomically(out, encode(out, given))
    counts = sorted({len(x) for x in sets})
    points = counted(counts[0], "point") if len(counts) == 1 else f"{counts[0]} to {counts[-1]} points"
    many = counted(len(sets), "set")
    click.echo(f"wrote {out}: {many} of {points}, d={d}{_unit(out, first, given)}{replaced}")


def _box(x: PointSets) -> tuple[object, ...]:
    return x.sides, x.low, x.toroidal


def _unit(out: Path, read: PointSets, given: PointSets) -> str:
    """Say whether the box is in the file, where there was one."""
    from gbnbench.io.points.writer import WRITTEN, suffix_of

    if read.sides is None:
        return ""
    sides = " x ".join(f"{side:g}" for side in read.sides)
    kept = given.sides is not None and WRITTEN[suffix_of(out)].keeps_box
    return f", in their box of {sides}" if kept else f", as fractions of their box of {sides}"
