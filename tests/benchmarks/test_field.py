"""The field's benchmark: its rows hang together, and the share is of counted instructions."""

from __future__ import annotations

import pytest

from gbnbench.benchmarks import field
from gbnbench.generators.gbn import cost


def test_rows_hang_together(monkeypatch):
    monkeypatch.setattr(field, "SECONDS", 0.05)
    rows = field.measure(field.Case(64, 2, sets=2))
    assert {row["precision"] for row in rows} == {"double", "float"}
    for row in rows:
        assert set(row) == set(field.COLUMNS)
        assert 0 < row["share"] < 1
        assert row["share"] == pytest.approx(row["instructions"] / (1e-3 * row["cpu_ms"]) / row["peak"])
    theta = next(row for row in rows if row["method"] == "theta" and row["precision"] == "double")
    assert theta["instructions"] == 2 * cost.theta(64, 2, 1.0, "double").instructions
    assert sum(row["chosen"] for row in rows) == 2
    assert [row["double_over_float"] > 0 for row in rows].count(True) == 1
