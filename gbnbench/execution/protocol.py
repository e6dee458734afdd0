"""The protocol of executors: settings that start workers, or find those that are there, and take calls.

What is started takes calls as ``concurrent.futures`` has it. Everything that spreads work does so through it.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from typing import Any, ClassVar, Protocol


class Workers(Protocol):
    """Workers that take calls: a ``concurrent.futures.Executor`` that knows when it is in trouble."""

    @property
    def count(self) -> int:
        """How many calls are carried out at once, as far as is known."""
        ...

    @property
    def backlog(self) -> int:
        """How many calls are given out at a time, so that no worker waits; each is held in memory."""
        ...

    def submit(self, fn: Callable[..., Any], /, *args: Any) -> Future[Any]:
        """Queue a call of a function of a module; an exception of the future means a lost worker.

        Parameters
        ----------
        fn : callable
            A function of a module.
        *args
            They can be pickled.

        Returns
        -------
        Future
        """
        ...

    def shutdown(self) -> None:
        """Give up what is not finished, and end the workers that were started."""

    def trouble(self) -> str:
        """Say why no call can finish any more; empty while all is well."""
        ...

    def avoid(self, worker: str) -> bool:
        """Send no more calls to an unfit worker, where that can be chosen; False if none is left.

        Parameters
        ----------
        worker : str
            As its answers name it.

        Returns
        -------
        bool
            False if no other is left.
        """
        ...


class Executor(Protocol):
    """A way to have calls carried out: a frozen dataclass of its settings.

    Attributes
    ----------
    name : str
        The word for it in ``--executor``.
    summary : str
        What it is, in a line.
    address : str
        What follows the colon in ``--executor name:address``.
    tries : int
        How often a call is tried, each time by another worker where there is a choice.
    remote : bool
        Whether the workers may be on other machines, which are asked for their device and version.
    """

    name: ClassVar[str]
    summary: ClassVar[str]
    remote: ClassVar[bool]

    @property
    def address(self) -> str:
        """What follows the colon."""
        ...

    @property
    def tries(self) -> int:
        """How often a call is tried."""
        ...

    def start(self, jobs: int) -> Workers:
        """Start or find the workers.

        Parameters
        ----------
        jobs : int
            How many to start, where their number is chosen here.

        Returns
        -------
        Workers

        Raises
        ------
        InputError
            If the settings mean nothing, or something is not installed.
        UnfinishedError
            If the workers cannot be reached.
        """
        ...
