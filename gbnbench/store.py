"""The run folder: settings first, finished pieces whole, the manifest last: any stop can be resumed."""

from __future__ import annotations

import hashlib
import json
import re
import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from gbnbench import archive, disk
from gbnbench.analysis.catalogue import BY_NAME, CATALOGUE
from gbnbench.errors import FormatError, InputError
from gbnbench.run import Run, SourceResult
from gbnbench.torus import FloatArray

FORMAT = 1  # of the folder; another number is refused
SETTINGS, MANIFEST = "settings.json", "manifest.json"


@dataclass(frozen=True)
class Part:
    """One generated realization.

    Attributes
    ----------
    x : (n, d) float64
        The points.
    cpu_seconds : float
        What they cost, one thread.
    first : bool
        Whether it was its worker's first with that generator, n and d, so that its cost may hold set-up.
    """

    x: FloatArray
    cpu_seconds: float
    first: bool


class RunFolder:
    """One comparison on disk.

    Parameters
    ----------
    path : Path
        Need not exist.
    identity : mapping
        JSON-ready settings that decide every number in it.

    Raises
    ------
    InputError
        If the folder holds something else, or a run with other settings; it is left as it was.
    """

    def __init__(self, path: Path, identity: Mapping[str, Any]) -> None:
        self.path = path
        self.identity = {"format": FORMAT, **identity}
        if path.exists() and not path.is_dir():
            raise InputError(f"{path} is a file; choose another folder with --out")
        self._check()

    def _check(self) -> None:
        settings = self.path / SETTINGS
        if settings.exists():
            there = _read_json(settings)
            if there != self.identity:
                raise InputError(
                    f"{self.path} holds a run with other settings ({_difference(there, self.identity)}); "
                    "choose another folder with --out, or delete this one"
                )
        elif self.path.exists() and any(not _is_ours(entry.name) for entry in self.path.iterdir()):
            raise InputError(
                f"{self.path} is not empty and is not a run of gbnbench; choose another folder with --out"
            )

    @property
    def whole(self) -> bool:
        """Whether everything in it is finished."""
        return (self.path / MANIFEST).exists()

    def lock(self) -> disk.FolderLock:
        """Make the folder where missing and lock it for this process."""
        self.path.mkdir(parents=True, exist_ok=True)
        return disk.FolderLock(self.path)

    def begin(self) -> None:
        """Open it for work, under the lock: from here to ``finish`` it is not whole."""
        self._check()
        (self.path / MANIFEST).unlink(missing_ok=True)
        disk.remove_leftovers(self.path)
        disk.write_whole(self.path / SETTINGS, archive.to_json(self.identity))

    def write_part(self, key: str, k: int, part: Part) -> None:
        """Keep realization k of a source."""
        cost = {"cpu_seconds": np.asarray(part.cpu_seconds), "first": np.asarray(part.first)}
        disk.write_whole(self._part(key, k), archive.to_npz(points=part.x, **cost))

    def read_part(self, key: str, k: int) -> Part | None:
        """Realization k of a source, None where it has still to be made."""
        try:
            arrays = archive.reading(self._part(key, k), archive.read_npz)
            return Part(arrays["points"], float(arrays["cpu_seconds"]), bool(arrays["first"]))
        except (FormatError, KeyError):  # absent, or spoilt after it was written: made again
            return None

    def write_source(self, result: SourceResult) -> None:
        """Keep everything of one source; its parts are then no longer needed."""
        disk.write_folder_whole(self.path / "sources" / result.key, archive.encode(result))
        shutil.rmtree(self.path / "parts" / result.key, ignore_errors=True)

    def read_source(self, key: str) -> SourceResult | None:
        """All that was measured of a source, None where it has still to be measured."""
        try:
            return archive.decode(self.path / "sources" / key)
        except FormatError:
            return None

    def write_tables(self, run: Run) -> None:
        """Write ``measures.csv`` (a row a source and measure) and ``table.csv`` (a row a source)."""
        for name, rows in (("measures.csv", long_table(run)), ("table.csv", wide_table(run))):
            disk.write_whole(self.path / name, _csv(rows))

    def finish(self, manifest: Mapping[str, Any]) -> None:
        """Declare it whole: checksums of the data, and the manifest as the very last file."""
        shutil.rmtree(self.path / "parts", ignore_errors=True)
        data = sorted((self.path / "sources").rglob("*.*"))
        sums = {p.relative_to(self.path).as_posix(): _sha256(p) for p in data if p.is_file()}
        content = {**manifest, "format": FORMAT, "sha256": sums}
        disk.write_whole(self.path / MANIFEST, archive.to_json(content))

    def _part(self, key: str, k: int) -> Path:
        return self.path / "parts" / key / f"{k:06d}.npz"


def _is_ours(name: str) -> bool:
    """Whether a name may stand in a folder whose run was killed before it wrote its settings."""
    return name == disk.FolderLock.NAME or (name.startswith(".") and name.endswith(".tmp"))


def default_folder(identity: Mapping[str, Any]) -> Path:
    """Name a run by its settings, so that the same command finds the same folder."""
    sources = identity["sources"]
    labels = dict.fromkeys(source["label"].lower() for source in sources)
    words = "-".join(re.sub(r"[^a-z0-9]+", "-", label).strip("-") for label in labels)
    sizes = "-".join(dict.fromkeys(f"n{s['n']}" for s in sources))
    stamp = hashlib.sha256(json.dumps(identity, sort_keys=True).encode()).hexdigest()[:8]
    return Path("runs") / f"{words[:48].strip('-')}_{sizes[:24].strip('-')}_{stamp}"


def read_run(folder: str | Path) -> Run:
    """Read a finished run.

    Parameters
    ----------
    folder : path
        As written by ``gbnbench compare``.

    Raises
    ------
    InputError
        If it is no run or an unfinished one.
    FormatError
        If a file in it is missing or was changed.
    """
    path = Path(folder)
    if not (path / MANIFEST).is_file():
        if (path / SETTINGS).is_file():
            raise InputError(f"{path} is an unfinished run; the same gbnbench compare command finishes it")
        raise InputError(f"{path} is not a run of gbnbench: it has no {MANIFEST}")
    manifest = _read_json(path / MANIFEST)
    if manifest.get("format") != FORMAT:
        found = manifest.get("format")
        raise FormatError(path / MANIFEST, f"has format {found!r}; this version reads {FORMAT}")
    try:
        sums = dict(manifest.pop("sha256"))
        del manifest["format"]  # both speak of the files, not of the run
        keys = [str(source["key"]) for source in manifest["settings"]["sources"]]
        verdicts = {(v["source"], v["measure"]): v["verdict"] for v in manifest["verdicts"]}
    except (KeyError, TypeError, ValueError) as error:
        raise FormatError(path / MANIFEST, f"is not what gbnbench wrote ({error!r})") from None
    for name, expected in sums.items():
        if not (path / name).is_file():
            raise FormatError(path / name, "is missing from the run")
        if _sha256(path / name) != expected:
            raise FormatError(path / name, "was changed after the run was written")
    return Run(manifest, tuple(archive.decode(path / "sources" / key) for key in keys), verdicts)


def long_table(run: Run) -> list[dict[str, object]]:
    """One row a source and measure, with its standard error, direction and reason."""
    return [
        {
            "source": source.label,
            "n": source.n,
            "d": source.d,
            "realizations": source.realizations,
            "measure": name,
            "value": value,
            "standard_error": source.measures.standard_error.get(name, float("nan")),
            "better": BY_NAME[name].better,
            "unit": BY_NAME[name].unit,
            "verdict": run.verdicts.get((source.key, name), ""),
            "reason": source.measures.reasons.get(name, ""),
        }
        for source in run.sources
        for name, value in source.measures.items()
    ]


def wide_table(run: Run) -> list[dict[str, object]]:
    """One row a source, a column a measure."""
    return [
        {
            "source": source.label,
            "n": source.n,
            "d": source.d,
            "realizations": source.realizations,
            **{definition.name: source.measures[definition.name] for definition in CATALOGUE},
            "cpu_seconds": source.cpu_seconds,
        }
        for source in run.sources
    ]


def _csv(rows: list[dict[str, object]]) -> bytes:
    import pandas as pd

    return archive.to_csv(pd.DataFrame(rows))


def _read_json(path: Path) -> dict[str, Any]:
    return archive.reading(path, lambda p: dict(json.loads(p.read_text(encoding="utf-8"))))


def _sha256(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _difference(there: Mapping[str, Any], asked: Mapping[str, Any]) -> str:
    """Name the first setting that differs, with both values."""
    for name in dict.fromkeys([*asked, *there]):
        old, new = there.get(name), asked.get(name)
        if old == new:
            continue
        if not (name == "sources" and isinstance(old, list) and isinstance(new, list)):
            return f"{name} is {old!r} there, {new!r} here"
        labels = [[f"{s.get('label')} n={s.get('n')} d={s.get('d')}" for s in side] for side in (old, new)]
        if labels[0] != labels[1]:
            return f"sources are {', '.join(labels[0])} there, {', '.join(labels[1])} here"
        for a, b in zip(old, new, strict=True):
            for field in b:
                if a.get(field) != b[field]:
                    return f"{field} of {b['label']} is {a.get(field)!r} there, {b[field]!r} here"
    return "unknown"
