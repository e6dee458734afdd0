"""The jobs that one driver has in Slurm's queue, all of one name, and the folder of their files."""

from __future__ import annotations

import contextlib
import secrets
import shutil
import socket
import subprocess
import sys
from pathlib import Path
from typing import IO

if sys.platform != "win32":
    import fcntl

ANSWER_SECONDS = 60.0  # for a command of Slurm
LOCK = "driver.lock"

# Why Slurm holds a job that waiting alone does not start (squeue(1), "JOB REASON CODES").
HELD = frozenset({
    "AccountNotAllowed", "AssocMaxWallDurationPerJobLimit", "BadConstraints", "DependencyNeverSatisfied",
    "InvalidAccount", "InvalidQOS", "JobHeldAdmin", "JobHeldUser", "PartitionDown", "PartitionInactive",
    "PartitionNodeLimit", "PartitionTimeLimit", "QOSMaxWallDurationPerJobLimit", "QOSNotAllowed",
})  # fmt: skip


class DriverFolder:
    """A folder for the files of one driver's jobs: job numbers of another cluster may be the same.

    Parameters
    ----------
    folder : path
        In which it is made.

    Attributes
    ----------
    name : str
        Of the folder and of every job, such as ``gbnbench-head-1f2e3d4c``.
    path : Path
        Of the folder.
    """

    def __init__(self, folder: str | Path) -> None:
        self._place = Path(folder).expanduser().absolute()
        self.name = f"{_stem()}{secrets.token_hex(4)}"
        self.path = self._place / self.name
        self.path.mkdir(parents=True)
        self._lock = (self.path / LOCK).open("xb")  # held as long as this process lives
        with contextlib.suppress(OSError):  # a file system without locks
            _hold(self._lock)

    def end_dead_drivers(self) -> None:
        """Take jobs out of the queue whose driver, on this machine and in this place, was killed."""
        for path in self._place.glob(f"{_stem()}*/{LOCK}"):
            if path.parent == self.path:
                continue
            with contextlib.suppress(OSError), path.open("r+b") as lock:  # it lives, or was ended by another
                _hold(lock)
                if cancel(path.parent.name):
                    shutil.rmtree(path.parent, ignore_errors=True)

    def finished(self) -> set[str]:
        """Give the names of the files that are there.

        Returns
        -------
        set of str
        """
        with contextlib.suppress(OSError):  # a network file system then looks anew
            self.path.chmod(self.path.stat().st_mode)
        return {path.name for path in self.path.iterdir()}

    def forget(self, job: str) -> None:
        """Delete the files of a job that was of use."""
        for path in self.path.glob(f"{job}_*"):
            path.unlink(missing_ok=True)

    def close(self, *, keep: bool, dead: bool = True) -> None:
        """Delete the folder, or keep it.

        Parameters
        ----------
        keep : bool
            For what failed jobs have written.
        dead : bool
            False where its jobs could not be taken out of the queue; the next driver will try it again.
        """
        if dead:
            (self.path / LOCK).unlink(missing_ok=True)
        self._lock.close()
        if dead and not keep:
            shutil.rmtree(self.path, ignore_errors=True)
            with contextlib.suppress(OSError):  # others are there
                self._place.rmdir()


def waiting_jobs(name: str) -> dict[str, tuple[str, str]] | None:
    """Ask Slurm for the jobs of a name that are queued or run.

    Parameters
    ----------
    name : str
        Of all of them.

    Returns
    -------
    dict or None
        The state of each and the reason for it, by job number; None if Slurm does not answer.
    """
    told = _answer("squeue", "--noheader", "--name", name, "--format", "%A|%T|%r")
    if told is None:
        return None
    fields = [line.strip().split("|") for line in told.splitlines()]
    return {job: (state, reason) for job, state, reason in fields}


def cancel(name: str) -> bool:
    """Take the jobs of a name out of the queue.

    Parameters
    ----------
    name : str
        Of all of them.

    Returns
    -------
    bool
        Whether Slurm did it.
    """
    return _answer("scancel", "--name", name) is not None


def _answer(*command: str) -> str | None:
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, timeout=ANSWER_SECONDS, check=True,
            start_new_session=True,  # Ctrl-C is for the driver alone
        )  # fmt: skip
    except (OSError, subprocess.SubprocessError):
        return None
    return done.stdout


def _stem() -> str:
    return f"gbnbench-{socket.gethostname().partition('.')[0]}-"


def _hold(file: IO[bytes]) -> None:
    if sys.platform != "win32":
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
