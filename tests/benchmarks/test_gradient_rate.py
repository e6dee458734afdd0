"""The benchmark of gradients chooses one evaluation in each precision, and none outruns the device."""

from __future__ import annotations

from gbnbench.benchmarks.experiments import gradient_rate


def test_rows_hang_together(monkeypatch):
    monkeypatch.setattr(gradient_rate, "SECONDS", 0.05)
    rows = gradient_rate.measure(gradient_rate.GradientCase(64, 2, sets=2))
    assert {row["precision"] for row in rows} == {"double", "float"}
    for row in rows:
        assert 0 < row["share"] < 1
    assert sum(row["chosen"] for row in rows) == 2
    assert [row["double_over_float"] > 0 for row in rows].count(True) == 1
