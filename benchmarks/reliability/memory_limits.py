"""Limits of memory: a command ends as without one, or says in words that it has too little."""

from __future__ import annotations

import resource

from gbnbench.benchmarks.reliability.commands import difference, empty_folder, in_words, run
from gbnbench.benchmarks.reliability.trial import FAULT, Trials, shortened

# bytes of address space, on both sides of what the libraries need to start
LIMITS = (
    2_000_000_000,
    300_000_000,
    900_000_000,
    64_000_000,
    1_000_000_000,
    860_000_000,
    800_000_000,
    1_200_000_000,
)
BEFORE_OURS = "Fatal Python error: _PyRuntimeState_Init"  # said before the first line of any program


def memory_limit(name: str, limit: int) -> list[Trials]:
    """Run a command in a small address space.

    Parameters
    ----------
    name : str
        One of ``COMMANDS``.
    limit : int
        Bytes.

    Returns
    -------
    list of Trials
        The one.
    """
    tried = f"{limit / 1e6:.0f} MB"

    def restrict() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))

    with empty_folder() as folder:
        done = run(name, folder, preexec_fn=restrict)
        differing = "" if done.returncode else difference(name, folder)
    if in_words(done):
        return [Trials(name, tried, "refused in words", note=shortened(done.stderr))]
    if BEFORE_OURS in done.stderr:
        return [Trials(name, tried, "Python itself does not start", note=shortened(done.stderr))]
    if done.returncode:
        note = shortened(f"{done.returncode} {done.stderr[-1000:]}")
        return [Trials(name, tried, "not said in words", FAULT, 1, note)]
    if differing:
        return [Trials(name, tried, "other bits", FAULT, 1, shortened(differing))]
    return [Trials(name, tried, "ended with the same bits")]
