"""A call that is carried out in another process, and the answer that comes back from there."""

from __future__ import annotations

import os
import pickle
import socket
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import gbnbench
from gbnbench.core.errors import DeviceError, GbnbenchError


@dataclass(frozen=True)
class Answer:
    """What became of a call in a worker.

    Attributes
    ----------
    value : object
        What the function returned, None after a failure.
    failure : str
        Empty when it succeeded, else one line, or a traceback where the cause is a bug.
    again : bool
        Whether another worker may succeed: memory was short, a device was missing, or something unforeseen.
    unfit : bool
        Whether this worker cannot serve at all, and why stands in ``failure``.
    worker : str
        Which worker, as its executor knows it; empty where that does not matter.
    """

    value: Any = None
    failure: str = ""
    again: bool = False
    unfit: bool = False
    worker: str = ""


def packed(function: Callable[..., Any], *arguments: object) -> bytes:
    """Pickle a call of a function of a module.

    Parameters
    ----------
    function : callable
        It is found by its module and name.
    *arguments
        They can be pickled.

    Returns
    -------
    bytes
    """
    return pickle.dumps((function, arguments), protocol=5)


def answered(version: str, check: bytes, call: bytes) -> Answer:
    """Carry out a call in a worker, whatever becomes of it.

    Parameters
    ----------
    version : str
        Of the gbnbench that asks: another one may draw other points.
    check : bytes
        A packed call that returns why this worker cannot serve, or an empty text; it is asked once in each
        process. Empty for none.
    call : bytes
        The packed call.

    Returns
    -------
    Answer
    """
    if version != gbnbench.__version__:
        told = f"{here()} has gbnbench {gbnbench.__version__}, and this run is made by {version}"
        return Answer(failure=f"{told}; install the same version there", again=True, unfit=True)
    try:
        if check and (refusal := _checked(check)):
            return Answer(failure=refusal, again=True, unfit=True)
        function, arguments = pickle.loads(call)  # noqa: S301 - from our own driver
        return Answer(function(*arguments))
    except DeviceError as error:
        return Answer(failure=str(error), again=True)
    except GbnbenchError as error:
        return Answer(failure=str(error))
    except MemoryError:
        return Answer(failure="not enough memory", again=True)
    except Exception:
        return Answer(failure="unexpected error\n" + traceback.format_exc(), again=True)


def here() -> str:
    """Name this process for messages."""
    return f"process {os.getpid()} on {socket.gethostname()}"


@lru_cache(maxsize=8)
def _checked(check: bytes) -> str:
    function, arguments = pickle.loads(check)  # noqa: S301 - from our own driver
    return str(function(*arguments))
