"""Archives of a library: the same bytes for the same files, whenever and by whomever they are packed."""

from __future__ import annotations

import contextlib
import gzip
import io
import shutil
import tarfile
import zipfile
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

from gbnbench.core.atomic_write import is_temporary, write_whole
from gbnbench.core.errors import InputError
from gbnbench.io.set_library.manifest import MANIFEST, TABLE
from gbnbench.io.set_library.places import Place, manifest_of
from gbnbench.io.set_library.set_file import content

EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest time that a .zip can say


def pack(folder: Path, names: Sequence[str], path: Path) -> None:
    """Pack files of a folder.

    Parameters
    ----------
    folder : Path
        The library.
    names : sequence of str
        Paths of its files below it, in the order of the archive.
    path : Path
        The archive, whose suffix says its kind; one that is there is replaced at the very end.
    """
    temporary = folder / f".{path.name}.tmp"  # a killed process's is removed at the next start
    if path.name.lower().endswith(".zip"):
        with zipfile.ZipFile(temporary, "w", zipfile.ZIP_DEFLATED, compresslevel=6) as archive:
            for name in names:
                archive.writestr(_zip_info(name), (folder / name).read_bytes())
    elif path.name.lower().endswith(".tar"):
        with tarfile.open(temporary, "w") as tar:
            _add(tar, folder, names)
    else:
        with (
            temporary.open("wb") as raw,
            gzip.GzipFile("", "wb", compresslevel=6, fileobj=raw, mtime=0) as packed,
            tarfile.open(fileobj=packed, mode="w") as tar,
        ):
            _add(tar, folder, names)
    shutil.move(temporary, path)


def unpack(place: Place, folder: Path, others: Sequence[str] = ()) -> int:
    """Write the files of a library into a folder, each checked against the manifest.

    Parameters
    ----------
    place : Place
        The library.
    folder : Path
        Made where it is missing. It must be empty, or hold what an interrupted call left.
    others : sequence of str
        Names of other files that are taken along where they are there.

    Returns
    -------
    int
        Files of sets.

    Raises
    ------
    InputError
        If the folder holds anything else, or a whole library.
    FormatError
        If a file of sets is missing or was changed.
    """
    manifest = manifest_of(place)
    wanted: dict[str, Callable[[], bytes]] = {
        **{entry.file: partial(content, place, entry) for entry in manifest.files},
        **{name: partial(place.read, name) for name in (TABLE, *others, MANIFEST)},  # the manifest is last
    }
    there = _left_unfinished(folder, wanted)
    folder.mkdir(parents=True, exist_ok=True)
    for name, data in wanted.items():
        if name not in there:
            with contextlib.suppress(KeyError):  # not every library has a table
                write_whole(folder / name, data())
    return len(manifest.files)


def _left_unfinished(folder: Path, wanted: Mapping[str, Callable[[], bytes]]) -> set[str]:
    """Name the files that an interrupted call wrote; refuse a folder with any that it did not."""
    if not folder.exists():
        return set()
    refused = f"{folder} is not an empty folder"
    if not folder.is_dir() or (folder / MANIFEST).exists():
        raise InputError(f"{refused}; choose another with --out")
    found = set()
    for path in folder.rglob("*"):
        if (path.is_dir() and not path.is_symlink()) or is_temporary(path):
            continue
        name = path.relative_to(folder).as_posix()
        try:
            same = path.is_file() and path.read_bytes() == wanted[name]()
        except KeyError:
            same = False
        if not same:
            raise InputError(f"{refused}: its {name} is not of this library; choose another with --out")
        found.add(name)
    return found


def _zip_info(name: str) -> zipfile.ZipInfo:
    info = zipfile.ZipInfo(name, EPOCH)
    info.compress_type = zipfile.ZIP_DEFLATED
    info.external_attr = 0o644 << 16
    info.create_system = 3  # the same on every system
    return info


def _add(tar: tarfile.TarFile, folder: Path, names: Sequence[str]) -> None:
    for name in names:
        data = (folder / name).read_bytes()
        info = tarfile.TarInfo(name)
        info.size, info.mode = len(data), 0o644
        tar.addfile(info, io.BytesIO(data))
