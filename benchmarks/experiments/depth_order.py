"""Depth against order of deep sets over c and the edge, from starts of several lengths, with GBN beside them.

python -m gbnbench.benchmarks.experiments.depth_order benchmarks/results/deep/depth_order.csv
"""

from __future__ import annotations

import csv
import json
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Self

from gbnbench.benchmarks.experiments.depth_order_row import COLUMNS, KEY, key_text
from gbnbench.benchmarks.experiments.depth_order_tasks import Map, Start, tasks_of
from gbnbench.benchmarks.timing.machine import Rows, describe
from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import GbnbenchError
from gbnbench.execution.progress import Progress
from gbnbench.runs.resumable import TaskRun

MAPS = (
    Map(
        1024, 2, (4, 6, 8, 10, 12, 16), (0.55, 0.6, 0.65, 0.7, 0.72, 0.74, 0.76, 0.78), (25, 50, 100, 200),
        (100, 320, 1000), 3, 0.72,
    ),
    Map(1000, 3, (4, 8, 12), (0.72, 0.76, 0.8, 0.835, 0.86, 0.88), (15, 60, 240), (60, 320, 1000), 2, 0.8),
    # Few points and starts from none on: where sets fail.
    Map(64, 2, (8, 12), (0.72, 0.76, 0.78), (0, 25, 100), (), 8, 0.72),
    Map(256, 2, (8, 12), (0.72, 0.76, 0.78), (0, 25, 100), (), 4, 0.72),
)  # fmt: skip


class RowStore:
    """The table of a map as a store of results: a line a set. Starts are not kept.

    Parameters
    ----------
    path : Path
        Of the table; it need not exist.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        earlier: list[dict[str, str]] = []
        if path.exists():
            with path.open(newline="", encoding="utf-8") as file:
                earlier = list(csv.DictReader(file))
        self._earlier = {" ".join(line[name] for name in KEY): line for line in earlier}

    def __enter__(self) -> Self:
        """Open the table and write what it held before."""
        self._rows = Rows(self.path, COLUMNS).__enter__()
        for line in self._earlier.values():
            self._rows.add(line)
        return self

    def __exit__(self, *exception: object) -> None:
        """Close the table; the rows are there already."""
        self._rows.__exit__(None, None, None)

    def read(self, key: str) -> Mapping[str, Any] | None:
        """Return the row that an earlier run left."""
        return self._earlier.get(key)

    def write(self, key: str, result: Mapping[str, Any] | Start) -> None:  # noqa: ARG002 - the row holds it
        """Write a row.

        Parameters
        ----------
        key : str
            The row's, which it holds itself.
        result : mapping or Start
            The row; a start is not kept.
        """
        if not isinstance(result, Start):
            self._rows.add(result)


def main(arguments: list[str], maps: tuple[Map, ...] = MAPS) -> None:
    """Fill the table in the file named, from where it was left.

    Parameters
    ----------
    arguments : list of one str
        The file.
    maps : tuple of Map
        What is drawn.

    Raises
    ------
    GbnbenchError
        If a set cannot be made or measured.
    """
    path = Path(arguments[0])
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path.with_name("machine.json"), (json.dumps(describe(), indent=1) + "\n").encode())
    with RowStore(path) as store:
        for done in TaskRun([task for plan in maps for task in tasks_of(plan)], store).complete(
            None, Progress()
        ):
            if done.failure:
                raise GbnbenchError(f"{done.key} failed: {done.failure}")
            if not isinstance(done.value, Start):
                shown = tuple(done.value[name] for name in (*KEY, "converged", "noise_floor"))
                print(*key_text(shown), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
