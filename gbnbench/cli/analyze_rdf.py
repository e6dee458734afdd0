"""``gbnbench analyze --rdf``: the radial distribution function of the sets in a file, as a table."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from gbnbench.cli.point_files import naming, read_torus
from gbnbench.cli.share_progress import share_bar
from gbnbench.core.errors import InputError

if TYPE_CHECKING:
    from gbnbench.io.points import ReadingOptions

STEPS = 100  # of a bar


def write_rdf(
    files: tuple[Path, ...],
    out: Path,
    reading: ReadingOptions,
    reach: float | None,
    bins: int | None,
    *,
    quiet: bool,
) -> None:
    """Write g(r) of the sets in one file, averaged.

    Parameters
    ----------
    files : tuple of Path
        One file of sets of one size.
    out : Path
        The .csv, of columns r, in densest spacings, and g.
    reading : ReadingOptions
        How the file is read.
    reach : float, optional
        Longest distance, in densest spacings.
    bins : int, optional
        Number of bins up to there.
    quiet : bool
        Whether to show no progress.

    Raises
    ------
    GbnbenchError
        If the file or an option is not what it must be.
    """
    import numpy as np

    from gbnbench.analysis.spatial.rdf import RANGE, rdf
    from gbnbench.cli.spectrum_output import check_outs
    from gbnbench.core.sides import as_sides
    from gbnbench.io import data_files
    from gbnbench.io.points.writer import write_atomically

    if len(files) != 1:
        raise InputError(f"--rdf is of the sets in one file; got {len(files)} files")
    if out.suffix.lower() != ".csv":
        raise InputError(f"--rdf writes a .csv; got {out}")
    if not out.parent.is_dir():
        raise InputError(f"cannot write {out}: there is no folder {out.parent}")
    check_outs([out], [path for path in files if path.exists()], each=False)
    read = read_torus(files[0], reading)
    if len({x.shape for x in read.sets}) > 1:
        raise InputError(f"--rdf averages sets of one size, and those in {files[0]} differ; part the file")
    x = np.stack(read.sets) if len(read.sets) > 1 else read.sets[0][None]
    with naming(files[0]), share_bar(STEPS, "hundredths of the pairs", quiet) as tell:
        found = rdf(
            x,
            as_sides(read.sides, x.shape[2]),
            reach=RANGE if reach is None else reach,
            bins=bins,
            progress=tell,
        )
    write_atomically(out, data_files.to_csv(found.to_frame()))
    count = len(found.r)
    bins_of = f"{count:,} bin{'' if count == 1 else 's'} of {found.width:.4g} densest spacings"
    click.echo(f"wrote {out}: {bins_of}, up to {count * found.width:.4g}; r is where a bin begins")
