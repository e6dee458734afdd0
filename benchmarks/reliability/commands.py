"""Small runs of the commands that write results, and what of their results has to be the same bit for bit."""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

GBNBENCH = (sys.executable, "-m", "gbnbench")
TIMEOUT = 300.0  # seconds that a small run never needs
COMMANDS: dict[str, tuple[str, ...]] = {
    "compare": ("compare", "random", "-n", "16", "--realizations", "3", "--out", "run"),
    "integrate": (
        "integrate", "random", "-n", "16,64", "--instances", "5", "--realizations", "2", "--out", "run",
    ),
    "figures": ("figures", "6", "--quick", "--out", "run"),
    "generate": (
        "generate", "gbn[iterations=4000]", "-n", "64", "-o", "x.txt", "--checkpoint", "state.npz",
        "--trace", "t.csv",
    ),
}  # fmt: skip
JOBS = {"compare": ("--jobs", "2"), "integrate": ("--jobs", "2"), "figures": ("--jobs", "2"), "generate": ()}
TIMED = ("manifest.json", "report.html", "settings.json", ".lock")  # tell of times, commands and processes
CLOCKS = {"cpu_seconds"}


@dataclass(frozen=True)
class Undisturbed:
    """What a command leaves when nothing happens.

    Attributes
    ----------
    bits : dict of str
        Digest by file.
    seconds : float
        How long it took.
    size : int
        Bytes that it leaves.
    largest : int
        Bytes of its largest file.
    """

    bits: Mapping[str, str]
    seconds: float
    size: int
    largest: int


def arguments(name: str) -> list[str]:
    """Return the command line of one of ``COMMANDS``."""
    return [*GBNBENCH, *COMMANDS[name], *JOBS[name], "--quiet"]


def environment(**more: str) -> dict[str, str]:
    """Return this process's environment, with a checkpoint at every chance."""
    return {**os.environ, "GBNBENCH_CHECKPOINT_SECONDS": "0.1", **more}


def run(name: str, folder: Path, **options: Any) -> subprocess.CompletedProcess[str]:
    """Run a command in a folder to its end.

    Parameters
    ----------
    name : str
        One of ``COMMANDS``.
    folder : Path
        Where it runs.
    **options
        Those of ``subprocess.run``.

    Returns
    -------
    CompletedProcess
    """
    settings: dict[str, Any] = {
        "env": environment(), "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "timeout": TIMEOUT
    }  # fmt: skip
    return subprocess.run(
        arguments(name), cwd=folder, text=True, errors="replace", check=False, **(settings | options)
    )


@cache
def undisturbed(name: str) -> Undisturbed:
    """Run a command once with nothing happening, which leaves every kernel compiled.

    Raises
    ------
    RuntimeError
        If it fails: then nothing can be tried with it.
    """
    with empty_folder() as folder:
        began = time.monotonic()
        done = run(name, folder)
        seconds = time.monotonic() - began
        if done.returncode:
            raise RuntimeError(f"{name} fails with nothing happening: {done.stderr}")
        sizes = [path.stat().st_size for path in folder.rglob("*") if path.is_file()]
        return Undisturbed(bits(folder), seconds, sum(sizes), max(sizes))


def bits(folder: Path) -> dict[str, str]:
    """Return the digest of every file that a command left, times of day and CPU times apart.

    Parameters
    ----------
    folder : Path
        Where it ran.

    Returns
    -------
    dict of str
        By name; a file that only tells of times has an empty digest, so that it has to be there.
    """
    return {
        path.relative_to(folder).as_posix(): "" if path.name in TIMED else _digest(path)
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def _digest(path: Path) -> str:
    data = path.read_bytes()
    if path.name == "source.json":
        data = json.dumps(
            {k: v for k, v in json.loads(data).items() if k not in CLOCKS}, sort_keys=True
        ).encode()
    if path.name == "table.csv":
        lines = [line.split(",") for line in data.decode().splitlines()]
        kept = [k for k, title in enumerate(lines[0]) if title not in CLOCKS]
        data = "\n".join(",".join(line[k] for k in kept) for line in lines).encode()
    return hashlib.sha256(data).hexdigest()


def difference(name: str, folder: Path) -> str:
    """Say which files differ from those of an undisturbed run; empty where none does.

    Parameters
    ----------
    name : str
        One of ``COMMANDS``.
    folder : Path
        Where it ran.

    Returns
    -------
    str
    """
    expected, found = undisturbed(name).bits, bits(folder)
    differing = sorted(n for n in {**expected, **found} if expected.get(n) != found.get(n))
    return ", ".join(differing)


def in_words(done: subprocess.CompletedProcess[str]) -> bool:
    """Tell whether a command that failed said why: exit code 2, an error of its own and no traceback."""
    return (
        done.returncode == 2
        and any(line.startswith("gbnbench: error: ") for line in done.stderr.splitlines())
        and "Traceback" not in done.stderr
    )


@contextmanager
def empty_folder() -> Iterator[Path]:
    """Make a folder for this block."""
    with tempfile.TemporaryDirectory(prefix="gbnbench-trial-", ignore_cleanup_errors=True) as place:
        yield Path(place)
