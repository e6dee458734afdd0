"""Python code and the command gbnbench in processes of their own."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

COMMAND = [sys.executable, "-m", "gbnbench"]
NO_DEVICE = {"OCL_ICD_VENDORS": "/nonexistent"}  # an environment in which OpenCL finds no device


def python(code: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run code in a fresh interpreter whose environment has these variables too."""
    return subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


def command(*arguments: object, cwd: Path, **options: Any) -> subprocess.CompletedProcess[str]:
    """Run gbnbench in a folder; options are those of subprocess.run."""
    return subprocess.run(
        [*COMMAND, *map(str, arguments)], cwd=cwd, capture_output=True, text=True, check=False, **options
    )


NOBODY = 54321  # a user id that has no name
# Python may stand where only its owner can go: reading is allowed to the nameless user too, writing is not.
AS_NOBODY = [
    "setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups",
    "--inh-caps=+dac_read_search", "--ambient-caps=+dac_read_search",
]  # fmt: skip


def as_nobody(arguments: list[str], *, cwd: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a program as a user without a name, in an environment of just these variables and PATH."""
    if sys.platform != "linux" or os.getuid() != 0 or shutil.which("setpriv") is None:
        pytest.skip("only root on Linux, with setpriv, can become a user without a name")
    paths = {name: os.environ[name] for name in ("PATH", "PYTHONPATH") if name in os.environ}
    return subprocess.run(
        [*AS_NOBODY, *arguments],
        cwd=cwd,
        env={**paths, "PYTHONDONTWRITEBYTECODE": "1", **environment},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
