"""A folder of results that a stopped command can go on with: settings come first, the manifest last."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from gbnbench.core import atomic_write
from gbnbench.core.errors import InputError
from gbnbench.core.interruption import is_interruption
from gbnbench.io import data_files
from gbnbench.io.folder_lock import FolderLock

FORMAT = 1  # of the folder; another number is refused
SETTINGS, MANIFEST = "settings.json", "manifest.json"


class ResumableFolder:
    """A folder that keeps the results of one command as they come.

    Parameters
    ----------
    path : Path
        Need not exist.
    identity : mapping
        JSON-ready settings that decide every number in it.

    Raises
    ------
    InputError
        If the folder holds something else, or results of other settings; it is left as it was.
    """

    kind = "results"  # what it holds, in words
    elsewhere = "choose another folder with --out"  # what to do where it holds something else

    def __init__(self, path: Path, identity: Mapping[str, Any]) -> None:
        self.path = path
        self.identity = {"format": FORMAT, **identity}
        if path.exists() and not path.is_dir():
            raise InputError(f"{path} is a file; {self.elsewhere}")
        self._check()

    def _check(self) -> None:
        settings = self.path / SETTINGS
        if settings.exists():
            stored = data_files.read_json(settings)
            if stored != self.identity:
                raise InputError(
                    f"{self.path} holds a {self.kind} with other settings "
                    f"({_difference(stored, self.identity)}); {self.elsewhere}, or delete this one"
                )
        elif self.path.exists() and any(not _is_ours(entry.name) for entry in self.path.iterdir()):
            raise InputError(
                f"{self.path} is not empty and is not a {self.kind} of gbnbench; {self.elsewhere}"
            )

    @property
    def whole(self) -> bool:
        """Return whether everything in it is finished."""
        return (self.path / MANIFEST).exists()

    def lock(self) -> FolderLock:
        """Make the folder where missing and lock it for this process."""
        self.path.mkdir(parents=True, exist_ok=True)
        return FolderLock(self.path)

    def begin(self) -> None:
        """Open it for work, under the lock: from here to ``finish`` it is not whole."""
        self._check()
        (self.path / MANIFEST).unlink(missing_ok=True)
        atomic_write.remove_leftovers(self.path)
        atomic_write.write_whole(self.path / SETTINGS, data_files.to_json(self.identity))

    def finish(self, manifest: Mapping[str, Any]) -> None:
        """Declare it whole: the manifest is the very last file."""
        atomic_write.write_whole(self.path / MANIFEST, data_files.to_json({**manifest, "format": FORMAT}))

    def drop(self, name: str) -> None:
        """Delete a folder below it that is no longer needed."""
        shutil.rmtree(self.path / name, ignore_errors=True)


@contextmanager
def explain_interruption(folder: Path) -> Iterator[None]:
    """Add to an interruption, or a full disk, where the finished results are and that the command goes on."""
    try:
        yield
    except (KeyboardInterrupt, ImportError) as error:
        if not is_interruption(error):
            raise
        kept = f"what is finished is kept in {folder}; the same command continues from there"
        raise KeyboardInterrupt(kept) from None
    except BrokenPipeError:
        raise
    except OSError as error:  # a full disk above all
        text = f"{error.strerror}; what is finished is kept and the same command continues from there"
        raise OSError(error.errno, text, error.filename or str(folder)) from error


def _is_ours(name: str) -> bool:
    """Whether a name may stand in a folder whose run was killed before it wrote its settings."""
    return name == FolderLock.NAME or (name.startswith(".") and name.endswith(".tmp"))


def _difference(stored: Mapping[str, Any], wanted: Mapping[str, Any]) -> str:
    """Name the first setting that differs, with both values."""
    for name in dict.fromkeys([*wanted, *stored]):
        old, new = stored.get(name), wanted.get(name)
        if old == new:
            continue
        if not (name == "sources" and isinstance(old, list) and isinstance(new, list)):
            return _value_difference(name, "", old, new)
        labels = [[f"{s.get('label')} n={s.get('n')} d={s.get('d')}" for s in side] for side in (old, new)]
        if labels[0] != labels[1]:
            return f"sources are {', '.join(labels[0])} there, {', '.join(labels[1])} here"
        for a, b in zip(old, new, strict=True):
            # the sum of files is of how they are read too, which says more
            for field in {"reading": None, **a, **b}:
                if a.get(field) != b.get(field):
                    return _value_difference(field, f" of {b['label']}", a.get(field), b.get(field))
    return "unknown"


def _value_difference(name: str, of: str, old: Any, new: Any) -> str:
    """Say how a value differs, for one with parts how the first part that differs does."""
    if isinstance(old, Mapping) or isinstance(new, Mapping):
        parts = [side if isinstance(side, Mapping) else {} for side in (old, new)]
        for part in dict.fromkeys([*parts[1], *parts[0]]):
            if parts[0].get(part) != parts[1].get(part):
                return _value_difference(
                    part, of or f" of the {name}", parts[0].get(part), parts[1].get(part)
                )
    if name == "sha256":
        return f"the content{of} differs"
    return f"{name}{of} is {_in_words(old)} there, {_in_words(new)} here"


def _in_words(value: Any) -> str:
    """Write a JSON value as a sentence takes it."""
    if isinstance(value, list):
        return ",".join(map(_in_words, value)) or "empty"
    if isinstance(value, bool) or value is None:
        return {True: "on", False: "off", None: "not given"}[value]
    return str(value).removesuffix(".0") if isinstance(value, float) else str(value)
