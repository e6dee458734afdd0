"""A comparison as tables: a row a source and measure, or a row a source."""

from __future__ import annotations

from gbnbench.analysis.measure_definitions import BY_NAME, DEFINITIONS
from gbnbench.runs.comparison_result import Run


def long_table(run: Run) -> list[dict[str, object]]:
    """One row a source and measure, with its standard error, direction and reason."""
    return [
        {
            "source": source.label,
            "n": source.n,
            "d": source.d,
            "realizations": source.realizations,
            "measure": name,
            "value": value,
            "standard_error": source.measures.standard_error.get(name, float("nan")),
            "better": BY_NAME[name].better,
            "unit": BY_NAME[name].unit,
            "verdict": run.verdicts.get((source.key, name), ""),
            "reason": source.measures.reasons.get(name, ""),
        }
        for source in run.sources
        for name, value in source.measures.items()
    ]


def wide_table(run: Run) -> list[dict[str, object]]:
    """One row a source, a column a measure."""
    return [
        {
            "source": source.label,
            "n": source.n,
            "d": source.d,
            "realizations": source.realizations,
            **{definition.name: source.measures[definition.name] for definition in DEFINITIONS},
            "cpu_seconds": source.cpu_seconds,
        }
        for source in run.sources
    ]
