"""Full disks, quotas and full outputs: said in words, nothing lost, the same bits once there is room."""

from __future__ import annotations

import contextlib
import resource
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from gbnbench.benchmarks.reliability.commands import (
    COMMANDS,
    TIMEOUT,
    arguments,
    difference,
    empty_folder,
    environment,
    in_words,
    run,
    undisturbed,
)
from gbnbench.benchmarks.reliability.trial import FAULT, UNTRIED, Trials, shortened

PAGE = 4096
ROOM = "64m"  # of the file system once there is room again
SAID = "said in words, then the same bits"
FITTED = "fitted, the same bits"


def full_disk(name: str, number: int) -> list[Trials]:
    """Run a command on a small file system that runs full, then on the same with room.

    Parameters
    ----------
    name : str
        One of ``COMMANDS``.
    number : int
        Names the stream of the random size, which goes up to what the command leaves.

    Returns
    -------
    list of Trials
        The one.
    """
    tried = "a full disk"
    pages = int(_random(name, 0, number).integers(1, undisturbed(name).size // PAGE + 8))
    with empty_folder() as folder:
        try:
            _mount(folder, f"{pages * PAGE}", "")
        except (OSError, subprocess.CalledProcessError) as error:
            why = f"no file system could be mounted, which takes root on Linux: {error}"
            return [Trials(name, tried, UNTRIED, UNTRIED, 0, shortened(why))]
        try:
            return [_judged(name, tried, folder, run(name, folder), lambda: _mount(folder, ROOM, "remount,"))]
        finally:
            subprocess.run(["umount", "--lazy", folder], check=True)


def quota(name: str, number: int) -> list[Trials]:
    """Run a command whose files get a largest size at a random moment after the first one, then without one.

    Before the first, nothing would be tried but the refusal of kernels, which need a megabyte.

    Parameters
    ----------
    name : str
        One of ``COMMANDS``.
    number : int
        Names the stream of the random moment and limit, up to a quarter of its largest file.

    Returns
    -------
    list of Trials
        The one.
    """
    usual, random = undisturbed(name), _random(name, 1, number)
    limit, moment = int(random.integers(1, usual.largest // 4)), random.uniform(0, usual.seconds)
    with empty_folder() as folder:
        return [_judged(name, "a quota", folder, _run_limited(name, folder, limit, moment), lambda: None)]


def _run_limited(name: str, folder: Path, limit: int, moment: float) -> subprocess.CompletedProcess[str]:
    """Run a command whose files, a moment after the first one, may not grow beyond a limit.

    Parameters
    ----------
    name : str
        One of ``COMMANDS``.
    folder : Path
        Where it runs.
    limit : int
        In bytes.
    moment : float
        Seconds after its first file.

    Returns
    -------
    CompletedProcess
    """
    with subprocess.Popen(
        arguments(name), cwd=folder, env=environment(), text=True, errors="replace",
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    ) as started:  # fmt: skip
        try:
            latest = time.monotonic() + TIMEOUT
            while not any(folder.iterdir()) and started.poll() is None and time.monotonic() < latest:
                time.sleep(0.005)
            output, complaints = started.communicate(timeout=moment)
        except subprocess.TimeoutExpired:
            with contextlib.suppress(ProcessLookupError):  # it may have ended
                resource.prlimit(started.pid, resource.RLIMIT_FSIZE, (limit, resource.RLIM_INFINITY))
            output, complaints = started.communicate(timeout=TIMEOUT)
    return subprocess.CompletedProcess(started.args, started.returncode, output, complaints)


def full_output(name: str) -> list[Trials]:
    """Run a command whose standard output is full: it says so, and its files are there."""
    tried = "/dev/full as standard output"
    with empty_folder() as folder, Path("/dev/full").open("w") as full:
        done = run(name, folder, stdout=full)
        if not in_words(done):
            said = shortened(f"{done.returncode} {done.stderr}")
            return [Trials(name, tried, "not said in words", FAULT, 1, said)]
        differing = difference(name, folder)
    if differing:
        return [Trials(name, tried, "other bits", FAULT, 1, shortened(differing))]
    return [Trials(name, tried, "said in words, files whole")]


def _random(name: str, kind: int, number: int) -> np.random.Generator:
    return np.random.default_rng(
        np.random.SeedSequence(56, spawn_key=([*COMMANDS].index(name), kind, number))
    )


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
