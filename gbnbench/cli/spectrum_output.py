"""Files that ``gbnbench spectrum`` writes: their names, what is refused beforehand, tables and pictures."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gbnbench.cli.spectrum_text import exactness, headline
from gbnbench.core.errors import InputError
from gbnbench.core.results.radial import ShellSpectrum
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.io.points.writer import write_atomically
from gbnbench.runs.spectrum_files import DATA, check_writable, encode

if TYPE_CHECKING:
    from gbnbench.analysis.spectrum.spectrum_plan import SpectrumPlan

PICTURES = (".png", ".pdf")


def places(out: Path, sets: int, *, each: bool) -> list[Path]:
    """Return the files that will be written.

    Parameters
    ----------
    out : Path
        As the user gave it.
    sets : int
        Number of spectra.
    each : bool
        Whether every set has a file of its own, OUT with its number.

    Returns
    -------
    list of Path
    """
    digits = len(str(sets - 1))
    return [out.with_name(f"{out.stem}_{k:0{digits}d}{out.suffix}") for k in range(sets)] if each else [out]


def check_outs(outs: Sequence[Path], inputs: Sequence[Path], *, each: bool) -> None:
    """Refuse to write where an input is, by whatever name or link.

    Parameters
    ----------
    outs, inputs : sequence of Path
        Files that will be written and read.
    each : bool
        Whether every set has a file of its own, for the message.

    Raises
    ------
    InputError
        If a file is among both.
    """
    read_here = {_identity(path) for path in inputs}
    for path in outs:
        if path.exists() and _identity(path) in read_here:
            how = "--each" if each else "writing"
            raise InputError(f"{path} is read here, and {how} would replace it; choose another name")


def _identity(path: Path) -> tuple[int, int]:
    """Device and inode, which every link to a file has in common."""
    status = path.stat()
    return status.st_dev, status.st_ino


def check_place(out: Path) -> None:
    """Refuse a place or format that cannot be written, before anything is read."""
    if out.suffix.lower() not in DATA + PICTURES:
        known = ", ".join(DATA + PICTURES)
        raise InputError(f"{out}: spectra are written as {known}; got extension {out.suffix!r}")
    if not out.parent.is_dir():
        raise InputError(f"cannot write {out}: there is no folder {out.parent}")


def check_format(out: Path, plan: SpectrumPlan, *, shells: bool) -> None:
    """Refuse what the format cannot hold.

    Parameters
    ----------
    out : Path
        File to write.
    plan : SpectrumPlan
        Of the spectrum.
    shells : bool
        Whether shells are made of the plan's frequencies, which in many dimensions are listed.

    Raises
    ------
    InputError
        If the format has no room for such a spectrum.
    """
    suffix, request = out.suffix.lower(), plan.request
    what = "shells" if shells else request.what
    if suffix in PICTURES and what == "listed":
        raise InputError(f"{out}: listed frequencies make no picture; write .csv, .npz or .npy")
    within = request.high - max(request.low, 1) + 1  # of |f|^2, which are the most shells that there can be
    rows = min(within, request.frequencies) if request.what == "shells" else request.frequencies
    if suffix in DATA:
        check_writable(suffix, what, rows)


def write(path: Path, result: Spectrum | ShellSpectrum, label: str, sources: Sequence[str]) -> None:
    """Write a spectrum, whole or not at all, and say so.

    Parameters
    ----------
    path : Path
        Its suffix says which format.
    result : Spectrum or ShellSpectrum
        The spectrum.
    label : str
        Name of the sets, for the user.
    sources : sequence of str
        Names of the files that the points are from.
    """
    suffix = path.suffix.lower()
    if suffix in DATA:
        data = encode(suffix, result, sources)
    else:
        from gbnbench.reports.comparison import figure_files
        from gbnbench.reports.comparison.single_spectrum import figure

        drawn = figure(result, label)
        data = figure_files.png(drawn) if suffix == ".png" else figure_files.pdf(drawn)
    replaced = ", replacing what was there" if path.exists() else ""
    write_atomically(path, data)
    click.echo(f"wrote {path}: {headline(result, label)}{replaced}\n  {exactness(result)}")
