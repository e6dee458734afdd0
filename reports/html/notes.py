"""Notes of the page: values that are undefined and why, and the provenance of the run."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from gbnbench.reports.comparison import table
from gbnbench.runs.comparison_result import Run
from gbnbench.runs.joined_runs import JoinedRuns


@dataclass(frozen=True)
class UndefinedValue:
    """A measure without a value.

    Attributes
    ----------
    measure : str
        Title of its column in the table.
    reason : str
        Sentence that says why there is no value.
    sources : list of str
        Labels of the sources that share the reason.
    """

    measure: str
    reason: str
    sources: list[str]


def undefined_values(run: Run) -> list[UndefinedValue]:
    """List every undefined value with its reason, once for all sources that share it."""
    found: dict[tuple[str, str], list[str]] = {}
    for row in table.rows(run):
        for column in table.COLUMNS:
            cell = row.cells[column.name]
            if math.isnan(cell.value):
                label = table.row_label(row.source, run)
                found.setdefault((column.title, cell.reason or "no reason was recorded"), []).append(label)
    return [UndefinedValue(measure, reason, labels) for (measure, reason), labels in found.items()]


def joined_provenance(joined: JoinedRuns) -> dict[str, str]:
    """Return what made joined runs, each name followed by that of its run."""
    return {
        f"{name}, {title}": text
        for title, run in zip(joined.names, joined.runs, strict=True)
        for name, text in provenance(run.manifest).items()
    }


def provenance(manifest: Mapping[str, Any]) -> dict[str, str]:
    """Return what made the run, by name: command, seed, device, versions and time, as far as recorded."""
    simple = ("command", "version", "seed", "realizations", "baseline")
    found = {key: str(manifest[key]) for key in simple if manifest.get(key) not in (None, "")}
    device = manifest.get("device")
    if device:
        parts = device.values() if isinstance(device, Mapping) else [device]
        found["device"] = " · ".join(str(part) for part in parts if part not in (None, ""))
    versions = manifest.get("versions")
    if isinstance(versions, Mapping):
        found["versions"] = ", ".join(f"{name} {version}" for name, version in versions.items())
    started = manifest.get("started") or manifest.get("created")
    if started:
        found["when"] = str(started)
    timings = manifest.get("timings")
    seconds = manifest.get("wall_seconds") or (
        timings.get("seconds") if isinstance(timings, Mapping) else None
    )
    if isinstance(seconds, int | float):
        found["wall time"] = f"{seconds:.1f} s"
    return found
