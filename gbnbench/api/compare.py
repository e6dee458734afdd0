"""Comparing generators, files and arrays side by side, from Python."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path

from numpy.typing import ArrayLike

from gbnbench.api.comparison import Comparison, draw, draw_unfinished, load_pictures
from gbnbench.api.report_files import FIGURES
from gbnbench.api.source_arguments import SourceLike, as_sources
from gbnbench.execution import progress
from gbnbench.execution.executor_choice import use_executor
from gbnbench.io.points import ReadingOptions
from gbnbench.opencl import use_device
from gbnbench.runs.sources import DEFAULT_READING, DEFAULT_SOURCES
from gbnbench.studies.comparison import run_comparison


def compare(
    sources: SourceLike | Iterable[SourceLike] | Mapping[str, SourceLike] = DEFAULT_SOURCES,
    *,
    n: int | Sequence[int] = 1024,
    d: int | Sequence[int] = 2,
    realizations: int = 16,
    seed: int = 0,
    out: str | Path | None = None,
    baseline: str | Path | None = None,
    jobs: int | None = None,
    executor: str | None = None,
    executor_config: str | Path | None = None,
    quiet: bool = False,
    device: str | None = None,
    reading: ReadingOptions = DEFAULT_READING,
    sides: ArrayLike | None = None,
    pictures: bool = False,
    pdf: bool = False,
    command: str = "gbnbench.compare",
) -> Comparison:
    """Make and measure every source, in a folder from which the same call continues if it is stopped.

    Parameters
    ----------
    sources : str, path, array_like, Generator or Source, or a sequence or mapping of these
        Generators such as ``"gbn[iterations=1000]"``, files and folders, points (n, d) or
        (realizations, n, d) on the unit torus, and instances of generators of your own. A mapping gives
        labels: ``{"mine": x, "theirs": "their.txt"}``. By default six classics.
    n, d : int or sequence of int
        Points a set and dimensions for the generators: each is made at every pair. Files and arrays bring
        their own.
    realizations : int
        Sets of each generator, >= 1.
    seed : int
        >= 0; realization k draws from ``SeedSequence(seed, spawn_key=(k,))``.
    out : path, optional
        The folder; by default one under ``runs`` named by the settings. One that holds another comparison,
        such as of another array, is refused.
    baseline : path, optional
        Folder of a finished comparison against which this one is judged.
    jobs : int, optional
        Worker processes, each with one thread; by default one a core.
    executor : str, optional
        Who does the work: ``"local"``, ``"dask:tcp://HOST:PORT"``, ``"dask:local"``, ``"mpi"`` or
        ``"slurm"``; by default processes on this machine.
    executor_config : path, optional
        A TOML file with settings of the executor.
    quiet : bool
        No progress on standard error.
    device : str, optional
        Part of the name of the OpenCL device, or its position, as in ``GBNBENCH_DEVICE``, which it overrides.
    reading : ReadingOptions
        How files are read: columns, box and so on, as ``load`` takes them; the same for all.
    sides : (d,) array_like, optional
        Lengths of the sides of the torus on which the arrays lie, whose ratios count; a cube if not given.
        Files tell their own, or ``reading`` does; generators make cubes.
    pictures : bool
        Also write report.html and the figures into the folder; ``Comparison.report`` makes them later.
    pdf : bool
        Write the figures also as PDF, in a finished folder too; ``gbnbench report FOLDER --pdf`` does
        it later.
    command : str
        What the manifest and the report say was called.

    Returns
    -------
    Comparison

    Raises
    ------
    InputError
        If something given is no source, a number is wrong, the folder holds something else, or the baseline
        is no finished comparison.
    RefusalError
        If no generator can make such sets and nothing else was given.
    DeviceError
        If there is no device, or the name fits none or several.
    UnfinishedError
        If a piece of the work failed; what is finished is kept, and the same call tries only the rest.

    Examples
    --------
    >>> import tempfile, gbnbench
    >>> x = gbnbench.generate("jittered", n=64, realizations=2)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     comparison = gbnbench.compare(
    ...         {"white": "random", "mine": x}, n=64, realizations=2, out=folder, jobs=1, quiet=True
    ...     )
    >>> comparison.table[["source", "n", "d", "realizations"]].values.tolist()
    [['white', 64, 2, 2], ['mine', 64, 2, 2]]
    >>> bool(comparison.table.noise_floor[1] < comparison.table.noise_floor[0])
    True
    """
    with use_device(device), use_executor(executor, executor_config):
        found, skipped = as_sources(sources, n, d, realizations, reading, sides)
        with progress.choose(quiet) as shown:
            done = run_comparison(
                found,
                None if out is None else Path(out),
                seed=seed,
                jobs=jobs,
                baseline=None if baseline is None else Path(baseline),
                command=command,
                skipped=skipped,
                progress=shown,
                draw=partial(draw, pdf=pdf) if pictures else None,
                grow=draw_unfinished if pictures else None,
                meanwhile=load_pictures if pictures else None,
            )
            if pictures and pdf and not any((done.folder / FIGURES).glob("*.pdf")):
                draw(done.run, done.folder, pdf=True)  # the folder was finished, without them
    return Comparison(
        done.run,
        done.folder,
        done.changes,
        done.notes,
        done.reused,
        done.pieces,
        done.seconds,
        done.undrawn,
    )
