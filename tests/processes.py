"""Python code and the command gbnbench in processes of their own."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

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
