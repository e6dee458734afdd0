"""The machine that a benchmark ran on, and CSV files that keep each row as soon as it is known."""

from __future__ import annotations

import csv
import importlib.metadata
import os
import platform
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from gbnbench.opencl import runtime
from gbnbench.opencl.peak_rate import fma_peak

PACKAGES = ("gbnbench", "numpy", "pyopencl", "pocl-binary-distribution", "finufft", "ducc0")
REPEATS = 3
Row = dict[str, Any]  # of a table, by column


def processor() -> str:
    """Model name of the processor, as the system tells it."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        return next(line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def describe() -> dict[str, Any]:
    """JSON-ready record of processor, cores, device and versions."""
    device = runtime().device
    versions: dict[str, str | None] = {}
    for package in PACKAGES:
        try:
            versions[package] = importlib.metadata.version(package)
        except importlib.metadata.PackageNotFoundError:
            versions[package] = None
    return {
        "processor": processor(),
        "cores": os.cpu_count(),
        "system": platform.platform(),
        "python": platform.python_version(),
        "device": device.label,
        "opencl": device.describe() | {"compute_units": device.compute_units},
        "versions": versions,
    }


def peaks() -> dict[str, float]:
    """Floating-point operations a second that one core does at most, by precision, measured now."""
    names = ("double", "float") if runtime().device.has_double else ("float",)
    return {name: max(fma_peak(name) for _ in range(REPEATS)) for name in names}


class Rows:
    """A CSV file that is complete up to its last row, whenever the program is stopped.

    Parameters
    ----------
    path : Path
        Replaced; its folder must exist.
    columns : sequence of str
        The header; rows are mappings that have each of them.
    """

    def __init__(self, path: Path, columns: Sequence[str]) -> None:
        self.path, self.columns, self.kept = path, columns, list[Mapping[str, Any]]()

    def __enter__(self) -> Self:
        self._file = self.path.open("w", newline="", encoding="utf-8")
        self._writer = csv.writer(self._file, lineterminator="\n")
        self._writer.writerow(self.columns)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close the file; the rows are there already."""
        self._file.close()

    def add(self, row: Mapping[str, Any]) -> None:
        """Write one row and keep it."""
        cells = [row[column] for column in self.columns]
        self._writer.writerow([f"{cell:.6g}" if isinstance(cell, float) else cell for cell in cells])
        self._file.flush()
        self.kept.append(row)
