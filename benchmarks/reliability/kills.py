"""Kills at random moments: what is finished stays whole, and the same command continues to the same bits."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import signal
import subprocess
import time
import zipfile
from pathlib import Path

import numpy as np

from gbnbench.benchmarks.reliability.commands import (
    COMMANDS,
    arguments,
    difference,
    empty_folder,
    environment,
    in_words,
    run,
    undisturbed,
)
from gbnbench.benchmarks.reliability.trial import FAULT, Trials, shortened, summed

COLD = 5  # every so many chains one begins without compiled kernels
WELL = "went on to the same bits"


def kill_chain(name: str, chain: int, kills: int) -> list[Trials]:
    """Kill a command several times on its way, then let it end.

    Parameters
    ----------
    name : str
        One of ``COMMANDS``.
    chain : int
        Names the stream of random moments.
    kills : int
        How many.

    Returns
    -------
    list of Trials
        The kills of this chain.
    """
    rng = np.random.default_rng(np.random.SeedSequence(34, spawn_key=([*COMMANDS].index(name), chain)))
    cold = chain % COLD == COLD - 1
    tried = "SIGKILL, kernels not compiled" if cold else "SIGKILL"
    seconds = undisturbed(name).seconds
    struck, faults = 0, list[Trials]()
    with empty_folder() as folder, empty_folder() as caches:
        env = environment(**_caches(caches)) if cold else environment()
        while struck < kills:
            whole_group = bool(rng.integers(2))
            if not _killed(name, folder, env, rng.uniform(0, seconds), whole_group):
                faults += _end(name, folder, env, tried)  # it was faster than the kill
                _empty(folder)
                continue
            struck += 1
            if broken := _broken(folder):
                note = shortened(f"after kill {struck}: {', '.join(broken)}")
                faults.append(Trials(name, tried, "a file that is not whole", FAULT, 1, note))
        faults += _end(name, folder, env, tried)
    return summed([Trials(name, tried, WELL, count=kills - len(faults)), *faults])


def _killed(name: str, folder: Path, env: dict[str, str], moment: float, whole_group: bool) -> bool:
    """Start a command and kill it at a moment; whether it was still running then."""
    with subprocess.Popen(
        arguments(name), cwd=folder, env=env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        start_new_session=True,
    ) as busy:  # fmt: skip
        with contextlib.suppress(subprocess.TimeoutExpired):
            busy.wait(moment)
            return False
        if whole_group:
            os.killpg(busy.pid, signal.SIGKILL)
        else:
            busy.kill()  # its workers have to end by themselves
        busy.wait()
    return True


def _end(name: str, folder: Path, env: dict[str, str], tried: str) -> list[Trials]:
    """Let the command end, and compare what it left."""
    done = run(name, folder, env=env)
    for _ in range(20):  # a worker of the killed one may take a moment to notice
        if not (in_words(done) and "another gbnbench" in done.stderr):
            break
        time.sleep(0.1)
        done = run(name, folder, env=env)
    if done.returncode:
        return [Trials(name, tried, "could not go on", FAULT, 1, shortened(done.stderr))]
    differing = difference(name, folder)
    return [Trials(name, tried, "other bits", FAULT, 1, shortened(differing))] if differing else []


def _broken(folder: Path) -> list[str]:
    """Files that stand finished and are not whole."""
    return [
        path.relative_to(folder).as_posix()
        for path in folder.rglob("*")
        if path.is_file() and not any(part.endswith(".tmp") for part in path.parts) and not _is_whole(path)
    ]


def _is_whole(path: Path) -> bool:
    data = path.read_bytes()
    match path.suffix:
        case ".json":
            try:
                return json.loads(data) is not None
            except ValueError:
                return False
        case ".npz":
            try:
                with zipfile.ZipFile(path) as archive:
                    return archive.testzip() is None
            except zipfile.BadZipFile:
                return False
        case ".png":
            return data.endswith(b"IEND\xaeB`\x82")
        case ".pdf":
            return data.rstrip().endswith(b"%%EOF")
        case ".html":
            return data.rstrip().endswith(b"</html>")
        case ".csv" | ".txt" | ".md":
            return data.endswith(b"\n")
        case _:
            return True


def _caches(folder: Path) -> dict[str, str]:
    names = ("GBNBENCH_CACHE", "POCL_CACHE_DIR", "XDG_CACHE_HOME")
    return {name: str(folder / name.lower()) for name in names}


def _empty(folder: Path) -> None:
    for path in folder.iterdir():
        if path.is_dir():
            shutil.rmtree(path)
        else:
            path.unlink()
