"""Full disks, quotas and full outputs: said in words, nothing lost, the same bits once there is room."""

from __future__ import annotations

import resource
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np

from gbnbench.benchmarks.reliability.commands import (
    COMMANDS,
    difference,
    empty_folder,
    in_words,
    run,
    undisturbed,
)
from gbnbench.benchmarks.reliability.trial import FAULT, UNTRIED, Trials, shortened, summed

PAGE = 4096
ROOM = "64m"  # of the file system once there is room again
SAID = "said in words, then the same bits"
FITTED = "fitted, the same bits"


def full_disks(name: str, count: int) -> list[Trials]:
    """Run a command on small file systems that run full, then on the same with room.

    Parameters
    ----------
    name : str
        One of ``COMMANDS``.
    count : int
        File systems, of random sizes up to what the command leaves.

    Returns
    -------
    list of Trials
    """
    rng = np.random.default_rng(np.random.SeedSequence(56, spawn_key=([*COMMANDS].index(name), 0)))
    tried = "a full disk"
    found = []
    for size in rng.integers(1, undisturbed(name).size // PAGE + 8, count).tolist():
        with empty_folder() as folder:
            try:
                _mount(folder, f"{size * PAGE}", "")
            except (OSError, subprocess.CalledProcessError) as error:
                why = f"no file system could be mounted, which takes root on Linux: {error}"
                return [Trials(name, tried, UNTRIED, UNTRIED, 0, shortened(why))]
            try:
                found.append(
                    _judged(name, tried, folder, run(name, folder), lambda: _mount(folder, ROOM, "remount,"))
                )
            finally:
                subprocess.run(["umount", "--lazy", folder], check=True)
    return summed(found)


def quotas(name: str, count: int) -> list[Trials]:
    """Run a command with a largest size of files, then without.

    Parameters
    ----------
    name : str
        One of ``COMMANDS``.
    count : int
        Limits, random up to the largest file that the command leaves.

    Returns
    -------
    list of Trials
    """
    rng = np.random.default_rng(np.random.SeedSequence(56, spawn_key=([*COMMANDS].index(name), 1)))
    found = []
    for limit in rng.integers(1, undisturbed(name).largest, count).tolist():
        with empty_folder() as folder:

            def restrict(most: int = limit) -> None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (most, resource.RLIM_INFINITY))

            done = run(name, folder, preexec_fn=restrict)
            found.append(_judged(name, "a quota", folder, done, lambda: None))
    return summed(found)


def full_outputs(name: str, _: int) -> list[Trials]:
    """Run a command whose standard output is full; the files are there and it fails in words.

    Parameters
    ----------
    name : str
        One of ``COMMANDS``.
    _ : int
        Not used: there is one such output.

    Returns
    -------
    list of Trials
    """
    tried = "/dev/full as standard output"
    with empty_folder() as folder, Path("/dev/full").open("w") as full:
        done = run(name, folder, stdout=full)
        if not in_words(done):
            return [
                Trials(
                    name, tried, "not said in words", FAULT, 1, shortened(f"{done.returncode} {done.stderr}")
                )
            ]
        differing = difference(name, folder)
    verdict = (FAULT, 1, shortened(differing)) if differing else ()
    return [Trials(name, tried, "other bits" if differing else "said in words, files whole", *verdict)]


def _judged(
    name: str, tried: str, folder: Path, done: subprocess.CompletedProcess[str], make_room: Callable[[], None]
) -> Trials:
    """Judge a run that ended for want of room, and the one that goes on from it."""
    if done.returncode and not in_words(done):
        return Trials(
            name, tried, "not said in words", FAULT, 1, shortened(f"{done.returncode} {done.stderr}")
        )
    make_room()
    if done.returncode:
        again = run(name, folder)
        if again.returncode:
            return Trials(name, tried, "could not go on", FAULT, 1, shortened(again.stderr))
    differing = difference(name, folder)
    if differing:
        return Trials(name, tried, "other bits", FAULT, 1, shortened(differing))
    return Trials(name, tried, SAID if done.returncode else FITTED)


def _mount(folder: Path, size: str, how: str) -> None:
    options = f"{how}size={size}"
    subprocess.run(
        ["mount", "-t", "tmpfs", "-o", options, "tmpfs", folder], check=True, capture_output=True, timeout=30
    )
