"""The table of trials on disk: a row for each kind and outcome of a piece, written after every piece."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from pathlib import Path

from gbnbench.benchmarks.reliability.trial import Trials
from gbnbench.core.atomic_write import write_whole

COLUMNS = ("piece", *(field.name for field in fields(Trials)), "seconds")


@dataclass(frozen=True)
class PieceResult:
    """What came of a piece.

    Attributes
    ----------
    trials : tuple of Trials
        By kind and outcome.
    seconds : float
        How long it took.
    """

    trials: tuple[Trials, ...]
    seconds: float


Table = dict[str, PieceResult]


def read(path: Path) -> Table:
    """Read a table; an empty one where there is no file."""
    rows: dict[str, list[dict[str, str]]] = {}
    if path.exists():
        with path.open(newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                rows.setdefault(row["piece"], []).append(row)
    return {
        piece: PieceResult(tuple(map(_trials, of)), float(of[0]["seconds"])) for piece, of in rows.items()
    }


def _trials(row: Mapping[str, str]) -> Trials:
    return Trials(
        row["subject"], row["tried"], row["outcome"], row["verdict"], int(row["count"]), row["note"],
        float(row["slowest"]), float(row["memory"]),
    )  # fmt: skip


def write(path: Path, table: Table) -> None:
    """Write a table whole, its pieces in the order of their keys.

    Parameters
    ----------
    path : Path
        Where it stands.
    table : Table
        Results by piece.
    """
    text = io.StringIO()
    writer: csv.DictWriter[str] = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    writer.writeheader()
    for piece in sorted(table):
        for trials in table[piece].trials:
            cells = {"piece": piece, **asdict(trials), "seconds": f"{table[piece].seconds:.1f}"}
            writer.writerow(cells | {name: f"{cells[name]:.3g}" for name in ("slowest", "memory")})
    write_whole(path, text.getvalue().encode())


class TrialTable:
    """The table as a store of results by piece.

    Parameters
    ----------
    path : Path
        Of the file; it need not exist.
    """

    def __init__(self, path: Path) -> None:
        self.path, self.table = path, read(path)

    def read(self, key: str) -> PieceResult | None:
        """Return what came of a piece; None where it has still to be tried."""
        return self.table.get(key)

    def write(self, key: str, result: PieceResult) -> None:
        """Keep what came of a piece.

        Parameters
        ----------
        key : str
            The piece's.
        result : PieceResult
            Its trials.
        """
        self.table[key] = result
        write(self.path, self.table)
