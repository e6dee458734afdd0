"""The field's benchmark: its rows hang together, and the share is of counted instructions."""

from __future__ import annotations

import pytest

from gbnbench.benchmarks.experiments import gradient_rate
from gbnbench.generators.gbn import operation_counts


def test_rows_hang_together(monkeypatch):
    monkeypatch.setattr(gradient_rate, "SECONDS", 0.05)
    rows = gradient_rate.measure(gradient_rate.Case(64, 2, sets=2))
    assert {row["precision"] for row in rows} == {"double", "float"}
    for row in rows:
        assert set(row) == set(gradient_rate.COLUMNS)
        assert 0 < row["share"] < 1
        assert row["share"] == pytest.approx(row["instructions"] / (1e-3 * row["cpu_ms"]) / row["peak"])
    theta = next(row for row in rows if row["method"] == "theta" and row["precision"] == "double")
    assert theta["instructions"] == 2 * operation_counts.theta(64, 2, 1.0, "double").instructions
    assert sum(row["chosen"] for row in rows) == 2
    assert [row["double_over_float"] > 0 for row in rows].count(True) == 1
