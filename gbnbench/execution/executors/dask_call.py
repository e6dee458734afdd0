"""Calls as a Dask worker carries them out: one at a time in its process, and answered with its address."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from gbnbench.execution.remote_call import Answer


def at_worker(function: Callable[..., Any], *arguments: Any) -> Any:
    """Carry out a call in a Dask worker; one with several threads, which came late, says it cannot serve.

    Parameters
    ----------
    function : callable
        A function of a module.
    *arguments
        Its arguments.

    Returns
    -------
    object
        What it returned.
    """
    from distributed import get_worker

    worker = get_worker()
    if worker.state.nthreads != 1:
        told = several_threads(worker.address, worker.state.nthreads)
        return Answer(failure=told, again=True, unfit=True, worker=worker.address)
    answer = function(*arguments)
    return replace(answer, worker=worker.address) if isinstance(answer, Answer) else answer


def several_threads(address: str, threads: int) -> str:
    """Say why a worker with several threads cannot serve.

    Parameters
    ----------
    address : str
        Of the worker.
    threads : int
        How many it has.

    Returns
    -------
    str
    """
    told = f"the Dask worker {address} carries out {threads} calls at once in one process"
    return f"{told}; gbnbench needs one: dask worker ADDRESS --nthreads 1 --nworkers N"
