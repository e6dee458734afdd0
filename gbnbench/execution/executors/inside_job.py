"""Calls in a job of Slurm: one after another, as long as it has time."""

from __future__ import annotations

import signal
import threading
from collections.abc import Sequence
from typing import Any

from gbnbench.execution.one_thread import one_thread


def carried_out_in_time(calls: Sequence[tuple[Any, ...]]) -> list[Any]:
    """Carry out calls with one thread, and end between two of them when Slurm says that time runs out.

    Parameters
    ----------
    calls : sequence of tuple
        A function and its arguments each.

    Returns
    -------
    list
        What the first of them returned; at least one was carried out.

    Notes
    -----
    submitit has Slurm send SIGUSR2 a minute and a half before the end. It also lets a job go on after
    SIGTERM, so that a cancelled one would compute for nobody until it is killed: this one ends at once.
    """
    one_thread()
    late = threading.Event()
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        if hasattr(signal, "SIGUSR2"):
            signal.signal(signal.SIGUSR2, lambda *_: late.set())
    done: list[Any] = []
    for function, *arguments in calls:
        if done and late.is_set():
            break
        done.append(function(*arguments))
    return done
