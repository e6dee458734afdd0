"""``gbnbench stipple`` of several images into a folder: by workers, each kept as soon as it is drawn."""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path

import click

from gbnbench import __version__
from gbnbench.api.stippled_page import encoded
from gbnbench.cli.stipple_drawing import StippleOptions, drawn, planned
from gbnbench.cli.stipple_record import StippledFile, StippledFolder
from gbnbench.core.errors import FormatError, GbnbenchError, InputError, UnfinishedError
from gbnbench.core.settings import nearest, specification
from gbnbench.execution import progress
from gbnbench.execution.progress import Progress
from gbnbench.io.images import BUNDLED
from gbnbench.io.points.file_format import reason
from gbnbench.runs.device_proof import run_device
from gbnbench.runs.resumable import TaskRun
from gbnbench.runs.resumable_folder import explain_interruption
from gbnbench.runs.task import Task

IMAGES_AT_A_TIME = 64  # whose files are held in memory together


def stipple_folder(
    files: Mapping[str, Path], given: StippleOptions, jobs: int | None, *, quiet: bool
) -> None:
    """Draw every image that can be drawn by the workers of the executor in force, and say what was drawn.

    Parameters
    ----------
    files : mapping of str to Path
        The file of each image, all in one folder.
    given : StippleOptions
        How they are drawn.
    jobs : int or None
        Worker processes; by default one a core.
    quiet : bool
        Show no progress.

    Raises
    ------
    UnfinishedError
        If some could not be drawn; all others are written.
    """
    jobs = jobs or os.cpu_count() or 1
    common = {
        "gbnbench": __version__,
        "device": run_device(jobs),
        **asdict(given),
        "generator": specification(given.generator),
    }
    folder = next(iter(files.values())).parent
    folder.mkdir(parents=True, exist_ok=True)
    failures: list[str] = []
    names = list(files)
    with StippledFolder(folder) as store, explain_interruption(folder), progress.choose(quiet) as teller:
        for start in range(0, len(names), IMAGES_AT_A_TIME):
            tasks = []
            for image in names[start : start + IMAGES_AT_A_TIME]:
                try:
                    content = content_of(image)
                except GbnbenchError as error:
                    failures.append(in_words(image, str(error)))
                    continue
                key = files[image].name
                sum_ = hashlib.sha256(json.dumps(common, sort_keys=True, default=str).encode())
                sum_.update(image.encode("utf-8", "surrogateescape") + b"\0" + (content or b""))
                store.expect(key, sum_.hexdigest())
                arguments = (image, content, files[image].suffix, given)
                tasks.append(Task(key, image, drawn_file, arguments, done=f"drew {image}"))
            if not tasks:
                continue
            run = TaskRun(tasks, store, hold=False)
            if run.missing:
                _draw(run, jobs, teller, folder)
            labels = {task.key: task.label for task in tasks}
            failures += [in_words(labels[key], why) for key, why in run.failures.items()]
    _report(files, store, failures)


def _draw(run: TaskRun, jobs: int, teller: Progress, folder: Path) -> None:
    """Do the tasks that are missing, and tell what was remarked of each image."""
    try:
        for done in run.complete(jobs, teller, doing=f"drawing {run.missing[0].label}"):
            for remark in () if done.failure else done.value.remarks:
                teller.say(f"gbnbench: {remark}")
    except UnfinishedError as error:
        kept = f"what is drawn is kept in {folder}, and the same command continues from there"
        raise UnfinishedError(f"{error}; {kept}") from error


def _report(files: Mapping[str, Path], store: StippledFolder, failures: Sequence[str]) -> None:
    """Say what was written and what was there, and raise if anything failed."""
    for file in files.values():
        if (said := store.said(file.name)) is not None:
            click.echo(f"{'wrote' if file.name in store.written else 'kept'} {file}: {said}")
    for line in failures[1:]:
        click.echo(f"gbnbench: failed: {line}", err=True)
    if failures:
        raise UnfinishedError(
            f"{len(failures)} of {len(files)} images could not be drawn, and the same command tries only "
            f"them again; the first: {failures[0]}"
        )


def in_words(image: str, why: str) -> str:
    """Say what went wrong with an image, whose name comes first.

    Parameters
    ----------
    image : str
        What it is called.
    why : str
        The fault, with or without the name.

    Returns
    -------
    str
    """
    return why if why.startswith(image) else f"{image}: {why}"


def content_of(image: str) -> bytes | None:
    """Read the bytes of a file; None for an image of scikit-image's by its name.

    Raises
    ------
    FormatError
        If there is neither.
    """
    path = Path(image)
    if not path.exists():
        if image in BUNDLED:
            return None
        known = nearest(image, BUNDLED) or ""
        raise FormatError(path, f"there is no such file{known}")
    try:
        return path.read_bytes()
    except OSError as error:
        raise FormatError(path, reason(error)) from None


def drawn_file(image: str, content: bytes | None, suffix: str, given: StippleOptions) -> StippledFile:
    """Draw one image in a worker, which need not reach its file.

    Parameters
    ----------
    image : str
        What it is called.
    content : bytes or None
        Of its file; None for an image of scikit-image's.
    suffix : str
        Of the file that is written.
    given : StippleOptions
        How.

    Returns
    -------
    StippledFile

    Raises
    ------
    InputError
        If it cannot be drawn.
    """
    with tempfile.TemporaryDirectory(prefix="gbnbench-") as folder:
        place = Path(folder) / Path(image).name
        if content is not None:
            place.write_bytes(content)

        def named(text: str) -> str:
            """Call the file what the user calls it."""
            return text.replace(str(place), image)

        try:
            plan = planned(image if content is None else str(place), given, suffix)
            darkness = {ink: replace(dark, name=named(dark.name)) for ink, dark in plan.darkness.items()}
            made = drawn(replace(plan, darkness=darkness), given)
        except (GbnbenchError, click.ClickException) as error:
            said = error.format_message() if isinstance(error, click.ClickException) else str(error)
            raise InputError(named(said)) from None
    data = encoded(suffix, made.layers, plan.style, dpi=given.dpi, template=given.template)
    said = ", ".join([made.summary(suffix), *made.tours(suffix)])
    return StippledFile(data, said, tuple(map(named, plan.remarks)))
