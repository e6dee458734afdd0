"""Several commands on one folder at once: one works, the others say who holds it, the results are right."""

from __future__ import annotations

import subprocess

from gbnbench.benchmarks.reliability.commands import (
    arguments,
    difference,
    empty_folder,
    environment,
    in_words,
)
from gbnbench.benchmarks.reliability.trial import FAULT, Trials, shortened

NUMBERS = {2: "two at once", 4: "four at once"}


def crowd(name: str, size: int) -> list[Trials]:
    """Start a command several times at once in one folder.

    Parameters
    ----------
    name : str
        One of ``COMMANDS``.
    size : int
        How many at once: 2 or 4.

    Returns
    -------
    list of Trials
        The one.
    """
    with empty_folder() as folder:
        busy = [
            subprocess.Popen(
                arguments(name), cwd=folder, env=environment(), text=True, errors="replace",
                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
            )
            for _ in range(size)
        ]  # fmt: skip
        ended = [
            subprocess.CompletedProcess(one.args, one.returncode, "", said)
            for one in busy
            for _, said in [one.communicate()]
        ]
        return [_judged(name, NUMBERS[size], ended, difference(name, folder))]


def _judged(name: str, tried: str, ended: list[subprocess.CompletedProcess[str]], differing: str) -> Trials:
    worked = [one for one in ended if one.returncode == 0]
    for one in ended:
        if one.returncode and not (in_words(one) and "another gbnbench" in one.stderr):
            return Trials(
                name, tried, "not said in words", FAULT, 1, shortened(f"{one.returncode} {one.stderr}")
            )
    if not worked:
        return Trials(name, tried, "none worked", FAULT, 1, shortened(ended[0].stderr))
    if differing:
        return Trials(name, tried, "other bits", FAULT, 1, shortened(differing))
    return Trials(name, tried, "the same bits; who did not work said who did")
