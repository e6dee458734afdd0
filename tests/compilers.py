"""The compilers of C and C++ of this machine, for tests that build what gbnbench exported."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

STRICT = ("-Wall", "-Wextra", "-Werror", "-pedantic", "-O1")
NAMES = {"c99": ("cc", "gcc", "clang"), "c++11": ("c++", "g++", "clang++")}


def built(source: Path, standard: str, folder: Path) -> Path:
    """Compile a file without a warning, with the headers of a folder; a machine without a compiler skips."""
    program = next(filter(None, map(shutil.which, NAMES[standard])), None)
    if program is None:
        pytest.skip(f"there is no compiler of {standard}")
    out = folder / f"{source.stem}-{standard.replace('+', 'p')}.exe"
    command = [program, f"-std={standard}", *STRICT, "-I", str(folder), str(source), "-o", str(out), "-lm"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stderr
    return out


def said(program: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run a program that succeeds."""
    return subprocess.run(
        [str(program), *words], capture_output=True, text=True, check=True, timeout=120, cwd=program.parent
    )
