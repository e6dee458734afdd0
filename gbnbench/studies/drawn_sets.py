"""Many sets of one generator drawn by workers, by pieces that the same call finds again."""

from __future__ import annotations

import errno
import os
import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from gbnbench import __version__
from gbnbench.core.errors import RefusalError
from gbnbench.core.settings import specification
from gbnbench.core.torus import FloatArray
from gbnbench.execution.progress import Progress
from gbnbench.generators.monitor import Monitor, MonitoredGenerator
from gbnbench.generators.protocol import Generator, checked_draw, realization_rng
from gbnbench.generators.third_parties.faults import faults_in_words, refusal_of
from gbnbench.runs.device_proof import run_device
from gbnbench.runs.every_task import run_tasks
from gbnbench.runs.resumable_folder import explain_interruption
from gbnbench.runs.sources import Source
from gbnbench.runs.task import Task
from gbnbench.runs.task_folder import FOLDER, Arrays, TaskFolder

PIECE_POINTS = 16_384  # most points of a piece of several sets
PIECES = 64  # into which sets are cut where there are so many: enough to share among workers


class DrawnSetsFolder(TaskFolder):
    """The pieces of a file of sets that is not whole yet."""

    kind = "folder of drawn sets"
    elsewhere = "finish them by the command that began them, choose another file with --out"


@dataclass(frozen=True)
class DrawnSets:
    """Sets that are drawn already, by pieces.

    Attributes
    ----------
    shape : (realizations, n, d)
        Of all together.
    folder : DrawnSetsFolder
        That keeps them.
    reused, pieces : int
        Pieces that were there before, of how many.
    """

    shape: tuple[int, int, int]
    folder: DrawnSetsFolder
    reused: int
    pieces: int

    def parts(self) -> Iterator[FloatArray]:
        """Read the pieces one after another, (sets, n, d) each, in the order of the realizations."""
        realizations, n, _ = self.shape
        for first, _ in drawing_pieces(n, realizations):
            piece = self.folder.read(_key(first))
            if piece is None:
                raise OSError(errno.EIO, "a piece cannot be read back", str(self.folder.path))
            yield piece["points"]


def drawing_pieces(n: int, realizations: int) -> list[tuple[int, int]]:
    """Cut realizations in pieces, by the request alone; the sets are the same however they are cut.

    Parameters
    ----------
    n, realizations : int
        Points of a set, and number of sets.

    Returns
    -------
    list of (first, count)
        The first realization of each piece, and how many it has.

    Examples
    --------
    >>> drawing_pieces(1024, 3), len(drawing_pieces(1024, 1000)), drawing_pieces(64, 100_000)[1]
    ([(0, 1), (1, 1), (2, 1)], 67, (256, 256))
    """
    size = max(1, min(PIECE_POINTS // n, realizations // PIECES))
    return [(first, min(size, realizations - first)) for first in range(0, realizations, size)]


def draw_by_workers(
    generator: Generator,
    n: int,
    d: int,
    realizations: int,
    seed: int,
    folder: Path,
    save: Callable[[DrawnSets], None],
    jobs: int | None,
    progress: Progress,
) -> DrawnSets:
    """Draw sets by the workers of the executor in force, and have them saved.

    Parameters
    ----------
    generator : Generator
        What draws them.
    n, d, realizations : int
        Points a set, dimension, number of sets.
    seed : int
        Realization k draws from ``SeedSequence(seed, spawn_key=(k,))``.
    folder : Path
        Where pieces are kept until all are saved; the same call finds them again.
    save : callable
        Writes the sets where they shall stand.
    jobs : int or None
        Worker processes, each with one thread; by default one a core.
    progress : Progress
        Counts a step a piece.

    Returns
    -------
    DrawnSets
        What was saved: the same bits as ``generate`` draws in one process, by any number of workers of any
        executor. Its folder is gone.

    Raises
    ------
    RefusalError
        If the generator cannot make n points in d dimensions.
    InputError
        If the folder holds pieces of other sets.
    UnfinishedError
        If pieces failed; every other one is kept.
    OSError
        If the disk is full; what is finished is kept.
    """
    if reason := refusal_of(generator, n, d):
        raise RefusalError(reason)
    jobs = jobs or os.cpu_count() or 1
    text = specification(generator)
    settings: dict[str, Any] = {
        "gbnbench": __version__,
        "seed": seed,
        "device": run_device(jobs) or "numpy",
        "sources": [Source("", text, n, d, realizations, generator).identity()],
    }
    store = DrawnSetsFolder(folder, settings)
    tasks = [
        Task(
            _key(first),
            f"{text}, n={n}, d={d}, sets {first} to {first + count - 1}",
            draw_piece,
            (generator, n, d, first, count, seed),
            done=f"drew {text}, n={n}, d={d}",
        )
        for first, count in drawing_pieces(n, realizations)
    ]
    with store.lock(), explain_interruption(folder):
        store.begin()
        work = run_tasks(tasks, store, jobs, progress, f"drawing {text}, n={n}, d={d}", hold=False)
        drawn = DrawnSets((realizations, n, d), store, work.reused, len(tasks))
        save(drawn)
        store.drop(FOLDER)
    shutil.rmtree(folder, ignore_errors=True)
    return drawn


def draw_piece(generator: Generator, n: int, d: int, first: int, count: int, seed: int) -> Arrays:
    """Draw consecutive realizations in a worker.

    Parameters
    ----------
    generator : Generator
        What draws them.
    n, d : int
        Points a set and dimension.
    first, count : int
        The first realization, and how many.
    seed : int
        Of them all.

    Returns
    -------
    dict of arrays
        ``points``, (count, n, d).
    """
    return {"points": realizations_of(generator, n, d, first, count, seed)}


def realizations_of(generator: Generator, n: int, d: int, first: int, count: int, seed: int) -> FloatArray:
    """Draw consecutive realizations, together where the generator moves many sets at once.

    Parameters
    ----------
    generator, n, d, first, count, seed
        As ``draw_piece`` takes them.

    Returns
    -------
    (count, n, d) float64
    """
    rngs = [realization_rng(seed, first + k) for k in range(count)]
    with faults_in_words(type(generator), f"drawing n={n}, d={d}"):
        if isinstance(generator, MonitoredGenerator):
            return generator.draw(n, d, rngs, Monitor())
        return np.stack([checked_draw(generator, generator(n, d, rng), n, d) for rng in rngs])


def _key(first: int) -> str:
    return f"{first:08d}"
