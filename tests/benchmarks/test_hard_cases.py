"""Every hard case by every evaluation: errors are within the stated bound, and the bound is not idle."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from gbnbench.analysis.spectrum.error_model import RESOLVED
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.benchmarks.spectra.hard_cases import FAR, GRID, MOST, hard_cases
from gbnbench.benchmarks.spectra.hard_lattices import SHALLOW
from gbnbench.benchmarks.spectra.hard_table import SLACK, TYPICAL, evaluate, judged, markdown, resolvable
from gbnbench.benchmarks.spectra.reference import reference_roots

pytestmark = pytest.mark.slow

CASES = {f"{c.name}, n={c.n} d={c.d} F={c.reach}": c for c in hard_cases()}


def case(name):
    return next(c for c in CASES.values() if c.name == name)


@pytest.fixture(scope="module")
def table() -> pd.DataFrame:
    """Rows of all cases, in double and float."""
    rows = [row | {"key": key} for key, c in CASES.items() for row in evaluate(c)]
    return judged(rows)


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize("key", CASES)
def test_errors_are_within_the_stated_bound(table, key, precision):
    rows = table[(table.key == key) & (table.precision == precision)]
    assert len(rows) >= 2
    assert np.isfinite(rows.error_bound).all()
    assert (rows.largest <= rows.error_bound).all()
    assert rows.held.all()


def test_no_bound_is_idle(table):
    loose = table[table.slack > SLACK]
    assert loose[["case", "n", "method", "precision", "error_bound", "slack"]].to_dict("records") == []


def test_the_stated_typical_error_is_typical(table):
    rows = table[table.scattered]
    assert rows.error_rms.between(rows.rms / TYPICAL, rows.rms * TYPICAL).all()


@pytest.mark.parametrize("method", ["product", "gridded"])
def test_a_power_of_1e_25_is_known_to_a_percent(method):
    shallow = case(f"true power {SHALLOW:g}")
    f = np.array([[1, 0], [-1, 3], [1, -5]])
    truth = shallow.truth(shallow.build(), f) ** 2
    assert truth.astype(float) == pytest.approx(SHALLOW, rel=1e-6)
    chosen = periodogram(shallow.build(), 13, "double", method=method)  # a grid needs some frequencies
    assert chosen.power[tuple((f + 13).T)] == pytest.approx(truth.astype(float), rel=RESOLVED)
    assert periodogram(shallow.build(), frequencies=f).power == pytest.approx(
        truth.astype(float), rel=RESOLVED
    )


@pytest.mark.parametrize(
    "name", ["dyadic lattice 16^2", "true power 1e-25", "heavy cancellation", "one point"]
)
def test_closed_forms_are_what_the_reference_says(name):
    c = case(name)
    x, f = c.build(), c.frequencies()[:60]
    away = np.abs(c.truth(x, f) - reference_roots(x, f))
    assert away.max() <= (1e-17 if np.finfo(np.longdouble).nmant >= 63 else 1e-14)


def test_coincident_and_parted_points_are_what_the_reference_says():
    for c in CASES.values():
        if "coincident" in c.name and c.n <= 256:
            x, f = c.build(), c.frequencies()[:5]
            assert c.truth(x, f).astype(float) == pytest.approx(
                reference_roots(x, f).astype(float), abs=1e-15
            )


@pytest.mark.parametrize("name", ["rounded lattice 225^1", "rounded lattice 15^2"])
def test_a_rounded_lattice_is_truly_below_its_ceiling(name):
    c = case(name)
    x, f = c.build(), c.frequencies()
    ceiling = c.ceiling(f)
    off = np.isfinite(ceiling)
    assert 50 < off.sum() < len(f)
    assert (reference_roots(x, f)[off] <= ceiling[off]).all()


def test_cases_are_what_they_say():
    for c in CASES.values():
        x, f = c.build(), c.frequencies()
        assert x.shape == (c.n, c.d)
        assert x.min() >= 0
        assert x.max() < 1
        assert np.array_equal(x, c.build())
        assert f.shape[1] == c.d
        assert np.abs(f).max() <= c.reach
    assert {c.d for c in CASES.values()} >= {1, 12}
    assert {c.n for c in CASES.values()} >= {1, MOST}
    assert max(c.reach for c in CASES.values()) == FAR
    shifted, permuted = case("shifted on the torus").build(), case("permuted").build()
    step = (shifted - case("random, d = 2").build()) % 1.0 * GRID
    assert len(np.unique(step, axis=0)) == 1  # exact, and one shift for all
    assert not np.array_equal(permuted, case("random, d = 2").build())
    assert np.array_equal(np.sort(permuted, axis=0), np.sort(case("random, d = 2").build(), axis=0))
    stored = case("float32 file").build()
    assert np.array_equal(stored, stored.astype(np.float32))
    tiny = case("denormal coordinates").build()
    assert ((tiny > 0) & (tiny < np.finfo(float).tiny)).any()


def test_the_page_has_every_row(table):
    page = markdown(table)
    assert page.count("| ok |") + page.count("**loose**") == len(table)
    assert "fails" not in page.split("## ", 1)[1]
    least = resolvable(table)
    deep = least[(least.precision == "double") & (least.method == "two-group product")]
    assert (deep.power < SHALLOW).all()
    assert (least[least.precision == "float"].power > 1e-13).all()
