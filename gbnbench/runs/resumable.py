"""Work in pieces: done side by side in workers, each kept as it comes, only what is missing done again."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

from gbnbench.core import atomic_write
from gbnbench.core.errors import DeviceError, FormatError, UnfinishedError
from gbnbench.execution.progress import Progress
from gbnbench.execution.worker_pool import Pool
from gbnbench.execution.worker_tasks import prove_device
from gbnbench.runs import source_files
from gbnbench.runs.resumable_folder import ResumableFolder

FOLDER = "pieces"
Arrays = Mapping[str, NDArray[Any]]


@dataclass(frozen=True)
class Task:
    """One call in a worker.

    Attributes
    ----------
    key : str
        Unique among the pieces and safe as a path below the folder, such as ``gbn_n64_d2/000000``.
    what : str
        What it is, in words, such as ``gbn, n=64, d=2``.
    work : callable
        A function of a module, that returns arrays by name.
    arguments : tuple
        Of the call; they can be pickled.
    """

    key: str
    what: str
    work: Callable[..., Arrays]
    arguments: tuple[Any, ...] = ()


class TaskFolder(ResumableFolder):
    """A folder that keeps pieces as ``pieces/KEY.npz``."""

    def write(self, key: str, arrays: Arrays) -> None:
        """Keep a piece."""
        atomic_write.write_whole(self.path / FOLDER / f"{key}.npz", source_files.to_npz(**arrays))

    def read(self, key: str) -> dict[str, NDArray[Any]] | None:
        """Return a piece; None where it is absent, or was spoilt and has to be made again."""
        try:
            return source_files.reading(self.path / FOLDER / f"{key}.npz", source_files.read_npz)
        except FormatError:
            return None


def run_tasks(folder: TaskFolder, pieces: Sequence[Task], jobs: int, progress: Progress) -> int:
    """Do the pieces that the folder lacks.

    Parameters
    ----------
    folder : TaskFolder
        Open for work.
    pieces : sequence of Task
        All of them; the longest first leaves the least idle at the end.
    jobs : int
        Most worker processes, each with one thread.
    progress : Progress
        A step a piece.

    Returns
    -------
    int
        How many were there already.

    Raises
    ------
    UnfinishedError
        If pieces failed, the first named; every other piece is kept.
    DeviceError
        If there is an OpenCL device and it cannot be used.
    """
    missing = [piece for piece in pieces if folder.read(piece.key) is None]
    there = len(pieces) - len(missing)
    if not missing:
        return there
    if there:
        progress.say(f"resuming {folder.path}: {there} of {len(pieces)} pieces are there")
    what = {piece.key: piece.what for piece in missing}
    failures: list[str] = []
    with Pool(min(jobs, len(missing))) as pool:
        _prove_device(pool, progress, len(pieces), there)
        progress.start(len(pieces), there, missing[0].what)
        for piece in missing:
            pool.submit(piece.key, piece.work, *piece.arguments)
        while pool.pending:
            done = pool.next()
            key = str(done.key)
            if done.failure:
                failures.append(f"{what[key]}: {done.failure}")
                progress.say(failures[-1])
                progress.advance(f"failed: {what[key]}")
            else:
                folder.write(key, done.value)
                progress.advance(what[key])
    if failures:
        raise UnfinishedError(
            f"{len(failures)} of {len(missing)} pieces failed (what is finished is kept in {folder.path}; "
            f"the same command tries only the rest); the first: {failures[0]}"
        )
    return there


def _prove_device(pool: Pool, progress: Progress, total: int, there: int) -> None:
    """Have the device proven, if there is one."""
    from gbnbench.opencl import choose

    try:
        choose()
    except DeviceError:
        return
    progress.start(total, there, "checking the device (kernels of a new one are compiled, once)")
    prove_device(pool)
