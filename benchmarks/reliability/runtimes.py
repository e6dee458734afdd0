"""OpenCL runtimes of several makers: what `gbnbench doctor` says of each, and a spectrum against numpy.

A runtime is tried where it is installed: in the environment of this process, or by an ICD file in one of the
folders that GBNBENCH_TRIAL_VENDORS names, parted by colons, whose libraries LD_LIBRARY_PATH leads to.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass

from gbnbench.benchmarks.reliability.commands import GBNBENCH, TIMEOUT
from gbnbench.benchmarks.reliability.trial import FAULT, UNTRIED, Trials, shortened

VENDORS = "GBNBENCH_TRIAL_VENDORS"
SPECTRUM = """
import numpy as np
import gbnbench
x = np.random.default_rng(5).random((777, 2))
power = gbnbench.periodogram(x, 20).power
f = np.arange(-20, 21)
a, b = (np.exp(-2j * np.pi * np.outer(f, axis)) for axis in x.T)
expected = np.abs(a @ b.T) ** 2 / len(x)
print(np.max(np.abs(np.sqrt(power) - np.sqrt(expected))))
"""
ERROR = 1e-13  # of sqrt(P), that numpy's own phases at |f| = 20 cost


@dataclass(frozen=True)
class Runtime:
    """A runtime to be looked for.

    Attributes
    ----------
    title : str
        For the page.
    contains, lacks : str
        What its label has and has not.
    install : str
        How it is had.
    """

    title: str
    contains: str
    lacks: str
    install: str


RUNTIMES = {
    "pocl-pypi": Runtime("PoCL of PyPI", "PoCL", "+debian", "pip install pocl-binary-distribution"),
    "pocl-debian": Runtime("PoCL of Debian", "+debian", "no such words", "apt-get install pocl-opencl-icd"),
    "intel-pypi": Runtime("Intel's of PyPI", "Intel(R) OpenCL", "PoCL", "pip install intel-opencl-rt"),
}


def runtime_trials(name: str) -> list[Trials]:
    """Try one runtime.

    Parameters
    ----------
    name : str
        One of ``RUNTIMES``.

    Returns
    -------
    list of Trials
    """
    wanted = RUNTIMES[name]
    for env in _environments():
        listed = subprocess.run(
            [*GBNBENCH, "devices", "--json"],
            env=env,
            capture_output=True,
            text=True,
            timeout=TIMEOUT,
            check=False,
        )
        for device in json.loads(listed.stdout) if listed.returncode == 0 else ():
            if wanted.contains in device["label"] and wanted.lacks not in device["label"]:
                env["GBNBENCH_DEVICE"] = str(device["index"])
                return [_doctor(wanted.title, device["label"], env), _spectrum(wanted.title, env)]
    return [
        Trials(wanted.title, "doctor, spectrum", UNTRIED, UNTRIED, 0, f"not installed here: {wanted.install}")
    ]


def _environments() -> Iterator[dict[str, str]]:
    yield {**os.environ}
    for folder in filter(None, os.environ.get(VENDORS, "").split(os.pathsep)):
        yield {**os.environ, "OCL_ICD_VENDORS": folder}


def _doctor(title: str, label: str, env: dict[str, str]) -> Trials:
    done = subprocess.run(
        [*GBNBENCH, "doctor", "--json"], env=env, capture_output=True, text=True, timeout=TIMEOUT, check=False
    )
    try:
        checks = json.loads(done.stdout)
    except ValueError:
        said = shortened(f"{done.returncode} {done.stderr}")
        return Trials(title, "doctor in full", "no verdict", FAULT, 1, said)
    failed = sorted({f"{check['kernel']} ({check['precision']})" for check in checks if not check["passed"]})
    if failed:
        said = f"refused in words: {', '.join(failed)} departs from numpy"
        return Trials(title, "doctor in full", said, count=len(checks), note=label)
    return Trials(title, "doctor in full", "every check agrees with numpy", count=len(checks), note=label)


def _spectrum(title: str, env: dict[str, str]) -> Trials:
    done = subprocess.run(
        [sys.executable, "-c", SPECTRUM],
        env=env,
        capture_output=True,
        text=True,
        timeout=TIMEOUT,
        check=False,
    )
    if done.returncode:
        return Trials(title, "a spectrum", "no spectrum", FAULT, 1, shortened(done.stderr[-500:]))
    error = float(done.stdout)
    said = f"amplitudes within {ERROR:g} of numpy's"
    if error > ERROR:
        return Trials(title, "a spectrum", f"not {said}", FAULT, 1, f"{error:.1e}")
    return Trials(title, "a spectrum", said, note=f"{error:.1e}")
