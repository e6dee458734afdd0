"""Every executor by its name, and how a text and a file of settings become one."""

from __future__ import annotations

import dataclasses
import tomllib
from pathlib import Path
from typing import Any

from gbnbench.core.errors import FormatError, InputError
from gbnbench.execution.executors.dask_scheduler import DaskScheduler
from gbnbench.execution.executors.local_processes import LocalProcesses
from gbnbench.execution.executors.mpi_ranks import MpiRanks
from gbnbench.execution.executors.slurm_jobs import SlurmJobs
from gbnbench.execution.protocol import Executor

EXECUTORS: dict[str, type[Any]] = {
    kind.name: kind for kind in (LocalProcesses, DaskScheduler, MpiRanks, SlurmJobs)
}


def find(text: str | None, config: str | Path | None = None) -> Executor:
    """Make an executor of ``NAME`` or ``NAME:ADDRESS``, and a file of settings.

    Parameters
    ----------
    text : str or None
        Such as ``dask:tcp://head:8786``; None for the ``executor`` of the file, or ``local``.
    config : path, optional
        A TOML file: ``executor = "..."``, and a table of settings for each name, such as ``[slurm]``.

    Returns
    -------
    Executor

    Raises
    ------
    InputError
        If there is no such executor, or a setting is unknown or of another kind.
    FormatError
        If the file cannot be read.
    """
    tables = {} if config is None else _tables(Path(config))
    if not isinstance(text or "", str):
        raise InputError(f"executor must be a text such as 'dask:local'; got {text!r}")
    name, _, address = str(text or tables.get("executor", "local")).partition(":")
    if name not in EXECUTORS:
        raise InputError(f"no executor is named {name!r}; there are {', '.join(EXECUTORS)}")
    settings = dict(tables.get(name, {}))
    if address:
        settings["address"] = address
    known = {field.name: field.default for field in dataclasses.fields(EXECUTORS[name])}
    for key, value in settings.items():
        if key not in known:
            raise InputError(f"{config}: {name} has no setting {key!r}; it has {', '.join(known)}")
        wanted = type(known[key])
        if isinstance(value, bool) or not isinstance(value, (int, float) if wanted is float else wanted):
            raise InputError(f"{config}: {key} of {name} must be a {_WORDS[wanted]}; got {value!r}")
        if isinstance(value, (int, float)) and value < (0 if key == "gpus" else 1):
            raise InputError(f"{config}: {key} of {name} must be at least 1; got {value!r}")
    executor: Executor = EXECUTORS[name](**settings)
    return executor


_WORDS = {str: "text", int: "whole number", float: "number"}


def _tables(path: Path) -> dict[str, Any]:
    try:
        found = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise FormatError(path, f"cannot be read: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise FormatError(path, f"is no TOML: {error}") from None
    for name, table in found.items():
        if name == "executor" and isinstance(table, str):
            continue
        if name not in EXECUTORS or not isinstance(table, dict):
            raise FormatError(
                path, f'{name!r} is neither executor = "..." nor a table of {", ".join(EXECUTORS)}'
            )
    return found
