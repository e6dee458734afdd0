"""The manifest of a library of ready sets, ``manifest.json``, and the same as a table, ``manifest.csv``."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gbnbench.core.errors import FormatError
from gbnbench.io.set_library.entries import ReadySets, RefusedSets

if TYPE_CHECKING:
    import pandas as pd

FORMAT = 1
MANIFEST, TABLE = "manifest.json", "manifest.csv"
CONVENTION = (
    "Each file is a NumPy array, float64, of shape (realizations, n, d): points on the unit torus [0, 1)^d, "
    "whose opposite sides meet. Distances are toroidal; n^(-1/d) is the spacing. Realization k is drawn from "
    "numpy.random.SeedSequence(seed, spawn_key=(k,)). Measures are of the realizations of a file together."
)


@dataclass(frozen=True)
class Manifest:
    """What a library holds.

    Attributes
    ----------
    gbnbench : str
        The version that made it.
    seed : int
        Of all sets.
    device : mapping or None
        The OpenCL device; None where there was none.
    versions : mapping
        Of Python and the libraries.
    files : tuple of ReadySets
        By generator, d and n.
    refused : tuple of RefusedSets
        What could not be made, in the same order.
    """

    gbnbench: str
    seed: int
    device: Mapping[str, str] | None
    versions: Mapping[str, str] = field(default_factory=dict)
    files: tuple[ReadySets, ...] = ()
    refused: tuple[RefusedSets, ...] = ()

    def entry(self, generator: str, n: int, d: int) -> ReadySets | RefusedSets | None:
        """Find the file of a generator at n and d, or why there is none.

        Parameters
        ----------
        generator : str
            In canonical text, such as ``gbn`` or ``gbn[sigma=0.8]``.
        n, d : int
            Points and dimension.

        Returns
        -------
        ReadySets or RefusedSets or None
            None where the library knows nothing of it.
        """
        entries: tuple[ReadySets | RefusedSets, ...] = (*self.files, *self.refused)
        return next((e for e in entries if (e.generator, e.n, e.d) == (generator, n, d)), None)

    def with_entries(self, entries: Iterable[ReadySets | RefusedSets]) -> Manifest:
        """Return it with further entries, which take the place of those of the same generator, n and d."""
        every = {_order(entry): entry for entry in (*self.files, *self.refused, *entries)}
        ordered = [every[key] for key in sorted(every)]
        return replace(
            self,
            files=tuple(entry for entry in ordered if isinstance(entry, ReadySets)),
            refused=tuple(entry for entry in ordered if isinstance(entry, RefusedSets)),
        )

    def record(self) -> dict[str, Any]:
        """Return it as JSON has it."""
        return {
            "format": FORMAT,
            "kind": "library of gbnbench",
            "convention": CONVENTION,
            "gbnbench": self.gbnbench,
            "seed": self.seed,
            "device": self.device,
            "versions": dict(self.versions),
            "files": [entry.record() for entry in self.files],
            "refused": [asdict(entry) for entry in self.refused],
        }

    def to_frame(self) -> pd.DataFrame:
        """Return a row a file: what made it, n, d, realizations (how many), the measures, its SHA-256."""
        import pandas as pd

        rows = [
            {
                "file": entry.file, "generator": entry.generator, "n": entry.n, "d": entry.d,
                "realizations": len(entry.realizations), "cpu_seconds": entry.cpu_seconds,
                **{name: entry.measures.get(name, float("nan")) for name in self._measures()},
                "sha256": entry.sha256,
            }
            for entry in self.files
        ]  # fmt: skip
        head = ["file", "generator", "n", "d", "realizations", "cpu_seconds", *self._measures(), "sha256"]
        return pd.DataFrame(rows, columns=head)

    def _measures(self) -> list[str]:
        """Names of all measures that a file has, in the order in which they were measured."""
        return list(dict.fromkeys(name for e in self.files for name in {**e.measures, **e.undefined}))


def decoded(data: bytes, path: Path) -> Manifest:
    """Read a manifest.

    Parameters
    ----------
    data : bytes
        The content of ``manifest.json``.
    path : Path
        Where it stands, for messages.

    Returns
    -------
    Manifest

    Raises
    ------
    FormatError
        If it is not one that gbnbench wrote, or one of another format.
    """
    try:
        record = dict(json.loads(data))
        if record.get("kind") != "library of gbnbench":
            raise FormatError(path, "is not the manifest of a library")
        if record["format"] != FORMAT:
            raise FormatError(path, f"has format {record['format']!r}; this version reads {FORMAT}")
        return Manifest(
            str(record["gbnbench"]),
            int(record["seed"]),
            record["device"],
            dict(record["versions"]),
            tuple(map(ReadySets.of_record, record["files"])),
            tuple(map(RefusedSets.of_record, record["refused"])),
        )
    except FormatError:
        raise
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise FormatError(path, f"is not what gbnbench wrote ({type(error).__name__}: {error})") from None


def _order(entry: ReadySets | RefusedSets) -> tuple[str, int, int]:
    return entry.generator, entry.d, entry.n
