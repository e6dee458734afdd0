"""The product's share of the peak: what a row says hangs together, and nothing outruns the device."""

from __future__ import annotations

from gbnbench.benchmarks.experiments import product_share


def test_a_row_hangs_together(monkeypatch):
    monkeypatch.setattr(product_share, "ROUNDS", 2)
    monkeypatch.setattr(product_share, "SECONDS", 0.001)
    request, groups, *numbers = product_share.row(4, 1, 400).strip("| ").split(" | ")
    assert request == "d = 4, F = 1, n = 400"
    a, b = map(int, groups.split(" and "))
    assert (2 * a - 1) * (2 * b - 1) == 3**4
    double_ms, double, float_ms, single, ratio, *blas = map(float, numbers)
    assert len(numbers) == len(product_share.HEAD) - 2 + len(product_share.PRECISIONS)
    assert min(double_ms, float_ms, ratio) > 0
    assert all(0 <= share < 1 for share in (double, single, *blas))


def test_work_of_known_rate_has_its_share_of_the_peak(monkeypatch):
    monkeypatch.setattr(product_share, "fma_peak", lambda precision: 4e9)
    monkeypatch.setattr(product_share, "_cpu_seconds", lambda call: 0.01)
    assert product_share.share_of_peak(lambda: None, 1e7, "double") == (10.0, 0.25)
