"""Entries of a library's manifest: files of ready sets, and what could not be made, with the reason."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

NAME = re.compile(r"[A-Za-z0-9][\w.-]*(/[A-Za-z0-9][\w.-]*)*")  # of a file, below the library


def set_file_stem(slug: str, n: int, d: int) -> str:
    """Name the file of sets, without its suffix: ``gbn/2d/gbn-2d-1024``.

    Parameters
    ----------
    slug : str
        The generator as a word that is safe for a file.
    n, d : int
        Points and dimension.

    Returns
    -------
    str

    Examples
    --------
    >>> set_file_stem("gbn", 1024, 2)
    'gbn/2d/gbn-2d-1024'
    """
    return f"{slug}/{d}d/{slug}-{d}d-{n}"


@dataclass(frozen=True)
class ReadySets:
    """One file of a library: the realizations of a generator at one n and d.

    Attributes
    ----------
    file : str
        Its path below the library, with ``/`` between folders.
    generator : str
        With settings in brackets where they are not the defaults.
    settings : mapping
        All settings of the generator.
    n, d : int
        Points a set, and dimension.
    realizations : tuple of int
        The numbers of the streams of the seed that the sets were drawn from, in the order of the file.
    refused : mapping
        Number of a stream, as text, to the reason why there is no set of it.
    cpu_seconds : float
        Mean CPU time of a set, one thread.
    measuring_cpu_seconds : float
        CPU time of measuring all of them.
    measures : mapping
        Name of a measure to its value; without those that are undefined.
    standard_errors : mapping
        The same of standard errors over the realizations; without those that are unknown.
    undefined : mapping
        Name of a measure to the reason why it has no value.
    sha256 : str
        Of the content of the file.
    """

    file: str
    generator: str
    settings: Mapping[str, Any]
    n: int
    d: int
    realizations: tuple[int, ...]
    refused: Mapping[str, str]
    cpu_seconds: float
    measuring_cpu_seconds: float
    measures: Mapping[str, float]
    standard_errors: Mapping[str, float]
    undefined: Mapping[str, str]
    sha256: str

    @property
    def shape(self) -> tuple[int, int, int]:
        """Realizations, n, d: the shape of the array in the file."""
        return len(self.realizations), self.n, self.d

    @property
    def tried(self) -> int:
        """Streams that were drawn from."""
        return len(self.realizations) + len(self.refused)

    def record(self) -> dict[str, Any]:
        """Return it as JSON has it, the shape and the type of the numbers included."""
        return {**asdict(self), "shape": list(self.shape), "dtype": "float64",
                "realizations": list(self.realizations)}  # fmt: skip

    @classmethod
    def of_record(cls, record: Mapping[str, Any]) -> ReadySets:
        """Read it from JSON; raises ValueError, KeyError or TypeError where that is something else."""
        entry = cls(
            file=checked_name(record["file"]),
            generator=str(record["generator"]),
            settings=dict(record["settings"]),
            n=int(record["n"]),
            d=int(record["d"]),
            realizations=tuple(int(k) for k in record["realizations"]),
            refused={str(k): str(reason) for k, reason in record["refused"].items()},
            cpu_seconds=float(record["cpu_seconds"]),
            measuring_cpu_seconds=float(record["measuring_cpu_seconds"]),
            measures={str(name): float(value) for name, value in record["measures"].items()},
            standard_errors={str(name): float(value) for name, value in record["standard_errors"].items()},
            undefined={str(name): str(reason) for name, reason in record["undefined"].items()},
            sha256=str(record["sha256"]),
        )
        if tuple(record["shape"]) != entry.shape or record["dtype"] != "float64":
            raise ValueError(f"{entry.file} is said to be {record['dtype']} of shape {record['shape']}")
        return entry


@dataclass(frozen=True)
class RefusedSets:
    """Sets that a library lacks because their generator cannot make them.

    Attributes
    ----------
    generator : str
        With settings in brackets where they are not the defaults.
    n, d : int
        Points a set, and dimension.
    reason : str
        In the generator's words.
    tried : int
        Streams that were drawn from, none of which gave a set; 0 where its rule refuses n and d.
    """

    generator: str
    n: int
    d: int
    reason: str
    tried: int = field(default=0)

    @classmethod
    def of_record(cls, record: Mapping[str, Any]) -> RefusedSets:
        """Read it from JSON; raises ValueError, KeyError or TypeError where that is something else."""
        return cls(
            str(record["generator"]), int(record["n"]), int(record["d"]), str(record["reason"]),
            int(record["tried"]),
        )  # fmt: skip


def checked_name(name: object) -> str:
    """Return the name of a file below a library; ValueError where it could lead out of it."""
    if not isinstance(name, str) or not NAME.fullmatch(name):
        raise ValueError(f"{name!r} names no file below a library")
    return name
