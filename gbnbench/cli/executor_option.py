"""The options ``--executor`` and ``--executor-config``: who does the work of a command."""

from __future__ import annotations

import functools
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

F = TypeVar("F", bound=Callable[..., Any])


def executor(command: F) -> F:
    """Add ``--executor`` and ``--executor-config``, which hold for all work of the command."""

    @functools.wraps(command)
    def with_executor(*args: Any, executor: str | None, executor_config: Path | None, **kwargs: Any) -> Any:
        if executor is None and executor_config is None:
            return command(*args, **kwargs)
        from gbnbench.execution.executor_choice import use_executor

        tell = None if kwargs.get("quiet") else functools.partial(click.echo, err=True)
        with use_executor(executor, executor_config, tell):
            return command(*args, **kwargs)

    decorated = click.option(
        "--executor-config", type=click.Path(path_type=Path), metavar="FILE.toml",
        help="Settings of the executor.",
    )(with_executor)  # fmt: skip
    return click.option(  # type: ignore[return-value]
        "--executor", metavar="NAME",
        help="Who does the work: local, dask:tcp://HOST:PORT, dask:local, mpi or slurm.  [default: local]",
    )(decorated)  # fmt: skip


def workers_wanted() -> bool:
    """Whether the command line asks for workers, by ``--jobs``, ``--executor`` or ``--executor-config``."""
    given = click.get_current_context().params
    return any(given[name] is not None for name in ("jobs", "executor", "executor_config"))
