"""Files that ``gbnbench stipple`` writes: the one that is named, or one for each image in a folder."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import click

from gbnbench.api.stippled_page import ANIMATIONS
from gbnbench.cli.executor_option import workers_wanted
from gbnbench.core.errors import InputError


def is_folder(out: str) -> bool:
    """Whether ``-o`` names a folder: one that is there, or a name that ends as that of a folder does."""
    return out.endswith(("/", os.sep)) or Path(out).is_dir()


def file_of(out: str, file_format: str | None) -> Path:
    """Give the one file that ``-o`` names.

    Parameters
    ----------
    out : str
        As the command takes it.
    file_format : str or None
        Likewise.

    Returns
    -------
    Path

    Raises
    ------
    click.UsageError
        If options of a folder stand beside it.
    """
    if file_format is not None:
        raise click.UsageError(
            f"--format is of the files in a folder: leave it out for {out}, or name a folder, {out}/"
        )
    if workers_wanted():
        told = "--jobs and --executor share out the images of a folder"
        raise click.UsageError(f"{told}: leave them out for {out}")
    return Path(out)


def check(out: str, frames: int | None, *, preview: bool) -> None:
    """Refuse options that are of one image.

    Parameters
    ----------
    out : str
        The folder.
    frames : int or None
        As the command takes them.
    preview : bool
        Likewise.

    Raises
    ------
    click.UsageError
        If one is given.
    """
    for option, given in (("--frames", frames is not None), ("--preview", preview)):
        if given:
            raise click.UsageError(f"{option} is of one image and one file; got the folder {out}")


def files_of(images: Sequence[str], out: str, file_format: str | None) -> dict[str, Path]:
    """Name the file of each image.

    Parameters
    ----------
    images : sequence of str
        As the command takes them.
    out : str
        The folder.
    file_format : str or None
        The suffix of all, with or without its dot.

    Returns
    -------
    dict of str to Path
        By the images.

    Raises
    ------
    click.UsageError
        If out is a file, or the suffix is that of a moving picture.
    InputError
        If two images would be written as one file.
    """
    folder = Path(out)
    if folder.is_file():
        raise click.UsageError(f"several images are drawn into a folder, and {out} is a file")
    if folder.suffix and not is_folder(out):
        raise click.UsageError(
            f"several images are drawn into a folder: write -o {folder.stem}/ --format {folder.suffix[1:]}, "
            f"or -o {out}/"
        )
    suffix = f".{(file_format or 'png').removeprefix('.').lower()}"
    if suffix in ANIMATIONS:
        raise click.UsageError(f"{suffix} is drawn of one image at a time: name one, and a file with -o")
    files: dict[str, Path] = {}
    for image in dict.fromkeys(images):
        file = folder / f"{Path(image).stem or image}{suffix}"
        if file in files.values():
            other = next(name for name, taken in files.items() if taken == file)
            raise InputError(f"{other} and {image} would both be written as {file}: draw them in two folders")
        files[image] = file
    return files
