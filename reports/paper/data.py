"""Data that figures are drawn from: comparisons, studies of integration and tables, made once and kept."""

from __future__ import annotations

import dataclasses
import hashlib
import json
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

from numpy.typing import NDArray

from gbnbench import __version__
from gbnbench.execution.progress import Progress
from gbnbench.generators.adaptive.density import as_density
from gbnbench.io.points import ReadingOptions
from gbnbench.reports.paper.averaged_pixels import averaged
from gbnbench.runs.comparison_result import Run
from gbnbench.runs.every_task import run_tasks
from gbnbench.runs.sources import DEFAULT_READING, resolve
from gbnbench.runs.task import Task
from gbnbench.runs.task_folder import Arrays, TaskFolder
from gbnbench.studies.comparison import run_comparison
from gbnbench.studies.integration.study import run_integration_study
from gbnbench.studies.integration.study_folder import IntegrationStudy
from gbnbench.studies.stippling.darkness import as_darkness
from gbnbench.studies.stippling_comparison.stippling_results import StipplingRun
from gbnbench.studies.stippling_comparison.stippling_sources import stippling_sources
from gbnbench.studies.stippling_comparison.study import run_stippling_comparison


@dataclass(frozen=True)
class ComparisonRequest:
    """A run of ``gbnbench compare``; becomes a ``Run``.

    Attributes
    ----------
    sources : tuple of str
        Generators with settings, files, folders.
    n, d : tuple of int
        Sizes and dimensions for the generators.
    realizations : int
        Sets of each generator.
    reading : ReadingOptions
        How the files are read.
    """

    sources: tuple[str, ...]
    n: tuple[int, ...] = (1024,)
    d: tuple[int, ...] = (2,)
    realizations: int = 16
    reading: ReadingOptions = DEFAULT_READING


@dataclass(frozen=True)
class IntegrationRequest:
    """A run of ``gbnbench integrate``; becomes an ``IntegrationStudy``.

    Attributes
    ----------
    sources : tuple of str
        Generators with settings, files, folders.
    n, d : tuple of int
        Sizes and dimensions for the generators.
    realizations : int
        Sets of each generator.
    integrands : tuple of str
        Families of integrands, with or without settings.
    instances : int
        Integrands of each family.
    shifts : int
        Random toroidal shifts of each set.
    reading : ReadingOptions
        How the files are read.
    """

    sources: tuple[str, ...]
    n: tuple[int, ...]
    d: tuple[int, ...]
    realizations: int
    integrands: tuple[str, ...]
    instances: int
    shifts: int = 0
    reading: ReadingOptions = DEFAULT_READING


@dataclass(frozen=True)
class StipplingRequest:
    """A run of ``gbnbench compare --density``; becomes a ``StipplingRun``.

    Attributes
    ----------
    image : str
        A file, or a name of one of scikit-image's.
    sources : tuple of str
        Adaptive generators with settings.
    n : int
        Points a set.
    most_pixels : int, optional
        Along the longer side: squares of pixels of a larger image are averaged.
    """

    image: str
    sources: tuple[str, ...]
    n: int
    most_pixels: int | None = None


@dataclass(frozen=True)
class TableRequest:
    """Calls of one library function, each in a worker; become a mapping from key to arrays by name.

    Attributes
    ----------
    function : callable
        A public function of a module that returns arrays by name.
    calls : mapping
        Key (safe as a file name) -> arguments, JSON-ready.
    """

    function: Callable[..., Arrays]
    calls: Mapping[str, tuple[Any, ...]]


DataRequest: TypeAlias = ComparisonRequest | IntegrationRequest | StipplingRequest | TableRequest
KINDS = {  # words of the settings on disk
    ComparisonRequest: "Comparison", IntegrationRequest: "Study", StipplingRequest: "Stipplings"
}  # fmt: skip
FigureData: TypeAlias = Run | IntegrationStudy | StipplingRun | dict[str, dict[str, NDArray[Any]]]


def folder_name(request: DataRequest, seed: int) -> str:
    """Name the folder of a request: words for its content and a digest of all that decides it.

    Parameters
    ----------
    request : DataRequest
        What is kept there.
    seed : int
        Of its sets.

    Returns
    -------
    str
    """
    content = {"seed": seed, "version": __version__, **_content(request)}
    digest = hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:8]
    if isinstance(request, TableRequest):
        words = request.function.__name__
    elif isinstance(request, StipplingRequest):
        words = f"stipplings_{Path(request.image).stem}_{'-'.join(request.sources)[:40]}_n{request.n}"
    else:
        kind = "compare" if isinstance(request, ComparisonRequest) else "integrate"
        sizes = "-".join(f"n{n}" for n in request.n) + "-" + "-".join(f"d{d}" for d in request.d)
        sources = "-".join(Path(source).name for source in request.sources)[:40]
        words = f"{kind}_{sources}_{sizes[:32]}"
    return re.sub(r"[^a-z0-9_.]+", "-", words.lower()).strip("-") + f"_{digest}"


def obtain(request: DataRequest, folder: Path, seed: int, jobs: int, progress: Progress) -> FigureData:
    """Make the data of a request, or read them where the folder holds them whole.

    Parameters
    ----------
    request : DataRequest
        What to make.
    folder : Path
        Where it is kept; the same call goes on with what a stopped one left.
    seed, jobs, progress
        As in ``compare`` and ``integrate``. A table's function has its seed among its arguments.

    Returns
    -------
    Run, IntegrationStudy, StipplingRun or dict
        By the kind of request.

    Raises
    ------
    GbnbenchError
        As ``compare``, ``integrate`` and ``run_tasks`` do.
    """
    if isinstance(request, StipplingRequest):
        return _stipplings(request, folder, seed, jobs, progress)
    if not isinstance(request, TableRequest):
        sources, skipped = resolve(
            request.sources, request.n, request.d, request.realizations, request.reading
        )
    if isinstance(request, ComparisonRequest):
        return run_comparison(
            sources, folder, seed=seed, jobs=jobs, command="gbnbench figures", skipped=skipped,
            progress=progress,
        ).run  # fmt: skip
    if isinstance(request, IntegrationRequest):
        return run_integration_study(
            sources, folder, integrands=request.integrands, instances=request.instances,
            shifts=request.shifts, seed=seed, jobs=jobs, command="gbnbench figures", skipped=skipped,
            progress=progress,
        ).study  # fmt: skip
    store = TaskFolder(folder, {"gbnbench": __version__, **_content(request)})
    name = request.function.__name__.replace("_", " ")
    tasks = [
        Task(key, _label(name, key, k, len(request.calls)), request.function, arguments)
        for k, (key, arguments) in enumerate(request.calls.items())
    ]
    with store.lock():
        whole = store.whole
        if not whole:
            store.begin()
        results = run_tasks(tasks, store, jobs, progress).results
        if not whole:
            store.finish({"version": __version__})
        return results


def _label(name: str, key: str, k: int, calls: int) -> str:
    """Say what call k makes; a key that is its number only says which part."""
    return f"{name}, part {k + 1} of {calls}" if key.isdigit() and int(key) == k else f"{name}: {key}"


def _stipplings(
    request: StipplingRequest, folder: Path, seed: int, jobs: int, progress: Progress
) -> StipplingRun:
    darkness = as_darkness(request.image)
    density = as_density(averaged(darkness.density().values, request.most_pixels))
    given = [("", source) for source in request.sources]
    sources, skipped, unread = stippling_sources(given, density, request.n, 1, DEFAULT_READING)
    return run_stippling_comparison(
        sources, density, darkness.name, request.n, folder, seed=seed, jobs=jobs, command="gbnbench figures",
        skipped=skipped, unread=unread, progress=progress,
    ).run  # fmt: skip


def _content(request: DataRequest) -> dict[str, Any]:
    """JSON-ready form of a request."""
    if isinstance(request, TableRequest):
        function = f"{request.function.__module__}.{request.function.__name__}"
        calls = {key: list(arguments) for key, arguments in request.calls.items()}
        content: dict[str, Any] = {"function": function, "calls": calls}
    else:
        content = {"kind": KINDS[type(request)], **dataclasses.asdict(request)}
        if not isinstance(request, StipplingRequest):
            content["reading"] = request.reading.record()
        if not content.get("reading"):
            content.pop("reading", None)
    done: dict[str, Any] = json.loads(json.dumps(content))  # as it will be read back
    return done
