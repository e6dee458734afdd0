"""Depth against order of deep sets over c and the edge, from starts of several lengths, with GBN beside them.

python -m gbnbench.benchmarks.experiments.depth_order benchmarks/results/deep/depth_order.csv

Goes on where it was stopped; with --jobs or --executor workers make the sets.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from gbnbench.benchmarks.experiments.depth_order_row import COLUMNS, KEY
from gbnbench.benchmarks.experiments.depth_order_tasks import Map, Start, tasks_of
from gbnbench.benchmarks.experiments.filled_table import add_workers, fill
from gbnbench.benchmarks.timing.machine import describe
from gbnbench.benchmarks.timing.table_store import TableStore
from gbnbench.core.atomic_write import write_whole

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


class RowStore(TableStore):
    """The table of a map, a line a set. Starts are not kept.

    Parameters
    ----------
    path : Path
        Of the table; it need not exist.
    order : sequence of str
        Keys of the tasks.
    """

    def __init__(self, path: Path, order: Sequence[str]) -> None:
        super().__init__(
            path, COLUMNS, lambda row: " ".join(row[name] for name in KEY), order, digits=6, missing="nan"
        )

    def write(self, key: str, result: Mapping[str, Any] | Start) -> None:  # type: ignore[override]
        """Write a row.

        Parameters
        ----------
        key : str
            The task's.
        result : mapping or Start
            The row; a start is not kept.
        """
        if not isinstance(result, Start):
            super().write(key, [result])


def main(arguments: list[str], maps: tuple[Map, ...] = MAPS) -> None:
    """Fill the table in the file named, from where it was left.

    Parameters
    ----------
    arguments : list of str
        The file, and options of workers.
    maps : tuple of Map
        What is drawn.

    Raises
    ------
    GbnbenchError
        If a set cannot be made or measured.
    """
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path)
    add_workers(parser)
    given = parser.parse_args(arguments)
    path = given.out
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path.with_name("machine.json"), (json.dumps(describe(), indent=1) + "\n").encode())
    tasks = [task for plan in maps for task in tasks_of(plan)]
    fill(tasks, RowStore(path, [task.key for task in tasks]), given)


if __name__ == "__main__":
    main(sys.argv[1:])
