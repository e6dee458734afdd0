"""Notes of the page: values that are undefined and why, definitions of the measures, and provenance."""

from __future__ import annotations

import html
import json
import math
from collections.abc import Mapping
from typing import Any

from gbnbench.analysis.measure_definitions import Definition
from gbnbench.reports.comparison import table
from gbnbench.runs.comparison_result import Run


def escaped(value: object) -> str:
    """Escape for HTML, lone surrogates of odd file names replaced."""
    return html.escape(str(value).encode("utf-8", "replace").decode("utf-8"))


def undefined(run: Run) -> str:
    """List every undefined value with its reason, once for all sources that share it."""
    found: dict[tuple[str, str], list[str]] = {}
    for row in table.rows(run):
        for column in table.COLUMNS:
            cell = row.cells[column.name]
            if math.isnan(cell.value):
                label = table.row_label(row.source, run)
                found.setdefault((column.title, cell.reason or "no reason was recorded"), []).append(label)
    if not found:
        return "<p>Nothing: every measure of every source has a value.</p>"
    items = [
        f"<dt>{escaped(title)}</dt><dd>{escaped(reason)}<br><small>{escaped(', '.join(labels))}</small></dd>"
        for (title, reason), labels in found.items()
    ]
    return f'<dl class="definitions">{"".join(items)}</dl>'


def definitions() -> str:
    """Return the definition of every column of the table and its source in the literature."""
    opening = (
        "<p>A set has n points x in [0, 1)<sup>d</sup> on the unit torus. Its power at an integer "
        "frequency f is P(f) = |Σ exp(−2πi f·x)|² / n, 1 in expectation for white "
        "noise; nu = |f| n<sup>−1/d</sup>. A standard error is that of the mean over realizations.</p>"
    )
    return opening + f'<dl class="definitions">{"".join(map(_definition, table.COLUMNS))}</dl>'


def _definition(column: Definition) -> str:
    unit = f" Unit: {column.unit}." if column.unit else ""
    return (
        f"<dt>{escaped(column.title)}</dt><dd>{escaped(column.text)} "
        f"<small>{escaped(column.better.capitalize())} is better.{escaped(unit)} {escaped(column.source)}. "
        f"<code>{escaped(column.name)}</code></small></dd>"
    )


def made(manifest: Mapping[str, Any]) -> str:
    """Describe the provenance of the run: command, seed, device, versions, time and all saved settings."""
    rows = []
    if manifest.get("command"):
        rows.append(("command", f"<code>{escaped(manifest['command'])}</code>"))
    simple = ("version", "seed", "realizations", "baseline")
    rows += [(key, escaped(manifest[key])) for key in simple if manifest.get(key) is not None]
    device = manifest.get("device")
    if device:
        said = device.values() if isinstance(device, Mapping) else [device]
        rows.append(("device", escaped(" · ".join(str(v) for v in said if v not in (None, "")))))
    versions = manifest.get("versions")
    if isinstance(versions, Mapping):
        rows.append(("versions", escaped(", ".join(f"{k} {v}" for k, v in versions.items()))))
    started = manifest.get("started") or manifest.get("created")
    if started:
        rows.append(("when", escaped(started)))
    timings = manifest.get("timings")
    seconds = manifest.get("wall_seconds") or (
        timings.get("seconds") if isinstance(timings, Mapping) else None
    )
    if isinstance(seconds, int | float):
        rows.append(("wall time", f"{seconds:.1f} s"))
    listed = "".join(f'<tr><th scope="row">{key}</th><td>{said}</td></tr>' for key, said in rows)
    whole = escaped(json.dumps(manifest, indent=2, ensure_ascii=False, default=str))
    return (
        f'<table class="made"><tbody>{listed}</tbody></table>'
        f"<details><summary>All settings, as saved</summary><pre>{whole}</pre></details>"
    )
