"""``gbnbench.compare_stipplings``: stipplers and stipplings by anybody side by side, for one image."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from gbnbench.api.stippling import Stippling
from gbnbench.api.stippling_comparison import StipplingComparison, draw, load_pictures
from gbnbench.core.errors import InputError
from gbnbench.core.least_values import require
from gbnbench.execution import progress
from gbnbench.execution.executor_choice import use_executor
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.protocol import AdaptiveGenerator
from gbnbench.io.points import ReadingOptions
from gbnbench.opencl import use_device
from gbnbench.runs.sources import DEFAULT_READING
from gbnbench.studies.stippling.darkness import ImageLike, ToneCurve, as_darkness
from gbnbench.studies.stippling_comparison.stippling_sources import StipplingSourceLike, stippling_sources
from gbnbench.studies.stippling_comparison.study import run_stippling_comparison

DEFAULT_STIPPLERS = ("gbn", "bnot", "lbg", "floydsteinberg", "rejection")


def compare_stipplings(
    image: ImageLike,
    sources: StipplingSourceLike
    | Iterable[StipplingSourceLike]
    | Mapping[str, StipplingSourceLike] = DEFAULT_STIPPLERS,
    *,
    n: int | None = None,
    realizations: int = 1,
    seed: int = 0,
    invert: bool = False,
    gamma: float = 1.0,
    white_cutoff: float | None = None,
    shape: tuple[int, ...] | None = None,
    out: str | Path | None = None,
    jobs: int | None = None,
    executor: str | None = None,
    executor_config: str | Path | None = None,
    quiet: bool = False,
    device: str | None = None,
    reading: ReadingOptions = DEFAULT_READING,
    pictures: bool = False,
    command: str = "gbnbench.compare_stipplings",
) -> StipplingComparison:
    """Draw and measure stipplings of one image, in a folder from which the same call continues.

    Parameters
    ----------
    image : str, path, array_like, Density or callable
        As ``stipple`` takes it; two axes, not toroidal.
    sources : str, path, array_like, Stippling or AdaptiveGenerator, or a sequence or mapping of these
        Names of ``ADAPTIVE_GENERATORS`` with settings, such as ``"gbn[sigma=0.85]"``; files and folders of
        points by anybody, in the unit square with y up or, where a number is beyond 1, in pixels with y down;
        what ``stipple`` returned; a list of arrays (n, 2) or (realizations, n, 2) in the unit square. A
        mapping gives labels.
    n : int, optional
        Points a set of generators, at least 1; by default as many as ``stipple`` draws.
    realizations : int
        Sets of each generator, at least 1.
    seed : int
        >= 0; realization k draws from ``SeedSequence(seed, spawn_key=(k,))``, however the work is split.
    invert, gamma, white_cutoff, shape
        As ``stipple`` takes them.
    out : path, optional
        The folder; by default one under ``runs`` named by the settings. One that holds something else is
        refused.
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
        Part of the name of the OpenCL device, or its position, as in ``GBNBENCH_DEVICE``.
    reading : ReadingOptions
        How files are read: columns, box and so on.
    pictures : bool
        Also write report.html and the figures into the folder; ``StipplingComparison.report`` makes them
        later.
    command : str
        What the manifest and the report say was called.

    Returns
    -------
    StipplingComparison
        Of the sources that did not fail; ``failures`` names the others.

    Raises
    ------
    InputError
        If something given is no source or no image, a number is wrong, or the folder holds something else.
    RefusalError
        If no generator can make such sets and nothing else was given.
    DeviceError
        If there is no device, or the name fits none or several.

    Notes
    -----
    Of each set: the relative variance energy, F16, PSNR and SSIM of the picture that Algorithm 2 finds back
    (Ahmed, Ren & Wonka 2022, Sections 4.10 and 5.3), the power of the set less its density, and the same in
    the flattest square of the image; docs/adaptive.md defines them.

    Examples
    --------
    >>> import tempfile, gbnbench
    >>> import numpy as np
    >>> ramp = np.linspace(0, 0.9, 32)[:, None] * np.ones(32)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     made = gbnbench.compare_stipplings(
    ...         ramp, ["gbn[gradients=30]", "rejection"], n=90, out=folder, jobs=1, quiet=True
    ...     )
    ...     again = gbnbench.StipplingComparison.read(folder)
    >>> again.table.equals(made.table)
    True
    >>> made.table.source.tolist(), bool(made.table.psnr[0] > made.table.psnr[1] + 3)
    (['gbn[gradients=30]', 'rejection'], True)
    """
    darkness = as_darkness(image, shape=shape, curve=ToneCurve(invert, gamma, white_cutoff))
    density = darkness.density()
    count = darkness.default_n if n is None else n
    require(n=(count, 1), realizations=(realizations, 1))
    if density.d != 2:
        raise InputError(f"stipplings are compared on images; {darkness.name} is a volume")
    if isinstance(image, Density) and image.toroidal:
        raise InputError("stipplings are compared on bounded images; opposite borders of this density meet")
    with use_device(device), use_executor(executor, executor_config):
        found, skipped, unread = stippling_sources(_labelled(sources), density, count, realizations, reading)
        with progress.choose(quiet) as shown:
            done = run_stippling_comparison(
                found,
                density,
                darkness.name,
                count,
                out,
                seed=seed,
                jobs=jobs,
                command=command,
                skipped=skipped,
                unread=unread,
                progress=shown,
                draw=draw if pictures else None,
                meanwhile=load_pictures if pictures else None,
            )
    return StipplingComparison(done.run, done.folder, done.reused, done.pieces, done.seconds, done.undrawn)


def _labelled(
    sources: Any,
) -> list[tuple[str, StipplingSourceLike]]:
    """Pair sources with their labels, empty where none is given."""
    if isinstance(sources, Mapping):
        pairs = [(str(label), item) for label, item in sources.items()]
    else:
        pairs = [("", item) for item in ([sources] if _is_one(sources) else sources)]
    return [
        _points_of(label, item) if isinstance(item, Stippling) else (label, item) for label, item in pairs
    ]


def _points_of(label: str, made: Stippling) -> tuple[str, StipplingSourceLike]:
    return label or f"{made.method}, seed {made.seed}", made.points


def _is_one(given: object) -> bool:
    """Whether this is one source, not a collection of them."""
    return isinstance(given, (str, Path, AdaptiveGenerator, Stippling)) or hasattr(given, "__array__")
