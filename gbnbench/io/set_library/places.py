"""Places where a library may stand: a folder, a .zip or .tar archive, and the choice that is installed."""

from __future__ import annotations

import io
import lzma
import tarfile
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from importlib.resources import files
from pathlib import Path
from typing import Protocol

from gbnbench.core.errors import FormatError, InputError
from gbnbench.io.set_library.manifest import MANIFEST, Manifest, decoded

BUNDLED = "bundled"  # the name of the choice that is installed
INSTALLED = "ready_sets.zip"  # its file, beside this module
TAR = (".tar.gz", ".tgz", ".tar")
ARCHIVES = (".zip", *TAR)
UNREADABLE = (  # raised of archives that are damaged, locked by a password or of other kinds
    zipfile.BadZipFile, tarfile.TarError, zlib.error, lzma.LZMAError, EOFError, RuntimeError
)  # fmt: skip


class Place(Protocol):
    """A place from which the files of a library are read.

    Attributes
    ----------
    path : Path
        For messages.
    """

    path: Path

    def read(self, name: str) -> bytes:
        """Return the content of a file.

        Parameters
        ----------
        name : str
            Its path below the library.

        Raises
        ------
        KeyError
            If there is none of this name.
        FormatError
            If what is there cannot be read.
        """
        ...


class Folder:
    """A library in a folder.

    Parameters
    ----------
    path : Path
        The folder.
    """

    def __init__(self, path: Path) -> None:
        self.path = path

    def read(self, name: str) -> bytes:
        """Return the content of a file, as ``Place.read`` does."""
        try:
            return (self.path / name).read_bytes()
        except (FileNotFoundError, IsADirectoryError, NotADirectoryError):
            raise KeyError(name) from None
        except OSError as error:
            raise FormatError(self.path / name, f"cannot be read ({error.strerror})") from None


class Zip:
    """A library in a .zip archive.

    Parameters
    ----------
    path : Path
        For messages.
    archive : zipfile.ZipFile
        Open for reading.
    """

    def __init__(self, path: Path, archive: zipfile.ZipFile) -> None:
        self.path, self._archive = path, archive

    def read(self, name: str) -> bytes:
        """Return the content of a file, as ``Place.read`` does."""
        try:
            return self._archive.read(name)
        except (*UNREADABLE, OSError) as error:
            raise FormatError(self.path / name, f"cannot be read ({error})") from None


class Tar:
    """A library in a .tar archive, packed by gzip or not.

    Parameters
    ----------
    path : Path
        For messages.
    archive : tarfile.TarFile
        Open for reading.

    Notes
    -----
    A packed archive is unpacked up to the file that is read: for many single reads a .zip or a folder is
    quicker.
    """

    def __init__(self, path: Path, archive: tarfile.TarFile) -> None:
        self.path, self._archive = path, archive

    def read(self, name: str) -> bytes:
        """Return the content of a file, as ``Place.read`` does."""
        try:
            member = self._archive.extractfile(name)
            if member is None:
                raise KeyError(name)
            return member.read()
        except (*UNREADABLE, OSError) as error:
            raise FormatError(self.path / name, f"cannot be read ({error})") from None


def is_archive(path: Path) -> bool:
    """Return whether a name is that of an archive: .zip, .tar, .tar.gz or .tgz."""
    return path.name.lower().endswith(ARCHIVES)


@contextmanager
def open_place(where: str | Path = BUNDLED) -> Iterator[Place]:
    """Open a library for reading, within a ``with`` block.

    Parameters
    ----------
    where : str or path
        A folder, an archive, or ``"bundled"``: the choice that is installed with gbnbench.

    Yields
    ------
    Place

    Raises
    ------
    InputError
        If there is nothing.
    FormatError
        If an archive cannot be read.
    """
    if where == BUNDLED:
        content = files("gbnbench.io.set_library").joinpath(INSTALLED).read_bytes()
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            yield Zip(Path(BUNDLED), archive)
        return
    path = Path(where)
    if path.is_dir():
        yield Folder(path)
        return
    if not path.exists():
        raise InputError(
            f"there is no folder or archive {path}; gbnbench library -o {path} makes one, and "
            f"{BUNDLED!r} is the choice that is installed"
        )
    if not is_archive(path):
        raise InputError(f"a library is a folder or an archive ({', '.join(ARCHIVES)}); got the file {path}")
    with ExitStack() as stack:
        try:
            place: Place
            if path.suffix.lower() == ".zip":
                place = Zip(path, stack.enter_context(zipfile.ZipFile(path)))
            else:
                place = Tar(path, stack.enter_context(tarfile.open(path)))
        except UNREADABLE as error:
            raise FormatError(path, f"is no archive that can be read ({error})") from None
        yield place


def manifest_of(place: Place) -> Manifest:
    """Read the manifest of a library.

    Raises
    ------
    InputError
        If there is none, so that it is no library.
    FormatError
        If it is damaged.
    """
    try:
        data = place.read(MANIFEST)
    except KeyError:
        raise InputError(f"{place.path} is not a library of gbnbench: it has no {MANIFEST}") from None
    return decoded(data, place.path / MANIFEST)
