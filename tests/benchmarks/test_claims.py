"""The paper's claims: the page against its table, the table against what is exact, resuming, verdicts."""

from __future__ import annotations

import csv
import json
import math
import tomllib

import mpmath
import numpy as np
import pytest

from gbnbench.analysis.spatial.delaunay import neighbours
from gbnbench.benchmarks.claims import (
    box,
    complexity,
    convergence,
    discrete_methods,
    half_space,
    high_dimensions,
    integration_errors,
    long_descent,
    periodic_kernel,
    profile,
)
from gbnbench.benchmarks.claims.claim import BESIDE, COLUMNS, VERDICTS, verdict
from gbnbench.benchmarks.claims.page import filled, number, page
from gbnbench.benchmarks.claims.registry import CLAIMS, MEASURES
from gbnbench.benchmarks.claims.run import fill, main, measure, named, read, record_machine
from gbnbench.benchmarks.claims.sets import MissingError, SetCache
from gbnbench.core.errors import GbnbenchError, InputError
from gbnbench.generators.gbn.kernel_profile import theta
from tests.oracles.theta import jacobi
from tests.paths import ROOT

TABLE = ROOT / "benchmarks" / "results" / "claims" / "claims.csv"
# Claims whose numbers need no sets and no clock.
EXACT = (
    "weight", "leak", "nearest-image", "eq-22-23", "profiles", "eq-1", "eq-24", "eq-47", "freedom", "digits",
)  # fmt: skip


def claim(name):
    return next(c for c in CLAIMS if c.name == name)


def test_the_page_is_what_the_table_says():
    assert (ROOT / "docs" / "claims.md").read_text() == page(read(TABLE))


def test_every_claim_is_measured_and_every_row_has_a_verdict():
    table = read(TABLE)
    assert list(table) == [c.name for c in CLAIMS] == list(MEASURES)
    with TABLE.open() as file:
        rows = list(csv.DictReader(file))
    assert tuple(rows[0]) == COLUMNS
    assert {row["holds"] for row in rows} <= {*VERDICTS, BESIDE}
    keys = [(row["claim"], row["row"]) for row in rows]
    assert len(set(keys)) == len(keys)
    assert all(row["place"] == claim(row["claim"]).place for row in rows)
    # What decides has its criterion in words, and a number unless it could not be tried.
    decided = [row for row in rows if row["holds"] in ("yes", "no", "partly")]
    assert all(row["paper"] and math.isfinite(float(row["measured"])) for row in decided)


@pytest.mark.parametrize("name", EXACT)
def test_what_is_exact_comes_out_as_in_the_table(name):
    kept = read(TABLE)[name]
    again = measure(claim(name), SetCache())
    assert [row["row"] for row in again] == [row["row"] for row in kept]
    for now, then in zip(again, kept, strict=True):
        assert now["holds"] == then["holds"]
        # Differences of rounding size are not reproduced, only that they are so small.
        np.testing.assert_allclose(float(now["measured"]), float(then["measured"]), rtol=1e-4, atol=1e-8)


def test_the_weight_of_the_nominal_spacing_by_mpmath():
    rows = {row.row: row.measured for row in profile.weight(SetCache())}
    assert rows["number"] == pytest.approx(float(mpmath.exp(-((2 * mpmath.pi) ** 2))), rel=1e-12)
    assert rows["energy"] == pytest.approx(float(mpmath.exp(-2 * mpmath.pi**2)), rel=1e-6)
    assert rows["formula"] == pytest.approx(float(mpmath.exp(-2 * mpmath.pi**2)), rel=1e-12)


@pytest.mark.parametrize("sigma", [0.2, 0.5])
def test_theta_is_jacobis(sigma):
    for x in (0.0, 0.21, 0.5):
        told = float(jacobi(x, sigma))
        assert float(theta(np.array([x]), 1.0, sigma)[0]) == pytest.approx(told, rel=1e-12)


def test_the_hessian_by_differences_is_that_of_the_pairs():
    n, side = 36, 6.0
    x = np.random.default_rng(3).random((n, 2))
    u = (x[:, None] - x) * side
    expected = np.zeros((n, 2, n, 2))
    shifts = side * np.arange(-2, 3)
    for i, j in ((i, j) for i in range(n) for j in range(n) if i != j):
        for a in shifts:
            for b in shifts:
                r = u[i, j] + (a, b)
                block = (np.outer(r, r) - np.eye(2)) * math.exp(-(r @ r) / 2)
                expected[i, :, i] += block
                expected[i, :, j] -= block
    found = long_descent.hessian_of(x)
    np.testing.assert_allclose(found, expected.reshape(2 * n, 2 * n), atol=1e-6)
    np.testing.assert_allclose(found.reshape(2 * n, n, 2).sum(axis=1), 0, atol=1e-6)


def test_the_outermost_points_of_a_box():
    u = np.array([[0.5, 0.1], [0.3, 0.9], [1.5, 1.6], [1.8, 1.2]])  # a box of two spacings: two strips a face
    expected = [0.3, 0.2, 1.5, 0.5, 0.1, 1.2, 1.1, 0.4]  # the strips of x's faces, then of y's
    expected[1:4] = [1.5, 1.5, 0.2]
    np.testing.assert_allclose(np.sort(box.outermost(u, 2.0)), np.sort(expected))


def test_the_domains_pull_and_the_points_push_in_closed_form():
    rows = {row.row: row.measured for row in box.balance(SetCache())}
    # Far from the other faces; 0.5 from a face along x, 3 along y, with 4 sigma^2 over 2 sigma^2, sigma = 1.
    along = math.sqrt(2) * (1 + math.erf(3 / 2)) / (1 + math.erf(3 / math.sqrt(2)))
    ratio = 2 * math.exp(0.25 / 2 - 0.25 / 4) * along
    assert rows["printed"] == pytest.approx(ratio - 1, abs=1e-4)
    assert rows["gradient"] == pytest.approx(ratio / 2 - 1, abs=1e-4)
    assert rows["constant"] == pytest.approx(math.exp(0.5), rel=1e-4)


def test_the_images_left_out_are_known_far_below_rounding():
    rows = {row.row: row.measured for row in periodic_kernel.images(SetCache())}
    for side in (12, 18):  # half a side away the next image is the only one that counts
        assert rows[f"side-{side}"] == pytest.approx(math.exp(-((side / 2) ** 2) / 2), rel=1e-9)


def test_further_draws_are_others():
    first = [integration_errors.integrands(integration_errors.STEP, 2, k)[0].point[0] for k in range(3)]
    assert first[0] == integration_errors.integrands(integration_errors.STEP, 2)[0].point[0]
    assert len(set(first)) == 3
    exponents = half_space.redrawn(SetCache(), "jittered", 2, further=2)
    assert len(exponents) == len(set(exponents)) == 2
    np.testing.assert_allclose(exponents, -1.5, atol=0.1)


def test_delaunay_neighbours_in_any_dimension():
    rng = np.random.default_rng(5)
    x = rng.random((150, 3))
    assert high_dimensions.mean_degree(x, 0.6) == pytest.approx(neighbours(x)[0].degree.mean(), rel=1e-12)
    assert high_dimensions.mean_degree(rng.random((30, 2)), 1.0) == 6
    with pytest.raises(GbnbenchError, match="is too narrow"):
        high_dimensions.mean_degree(x, 0.05)


def test_discrete_methods_stop_where_no_swap_gains():
    pattern = "voidcluster[sigma=4,share=0.0625,initial={},shift=false]"
    assert discrete_methods.swap_gain(pattern.format(0.0625), 4, 64) < 1e-11
    assert discrete_methods.swap_gain(pattern.format(0.5), 4, 64) > 1e-3
    assert discrete_methods.exchanges_left(1.0, 64) == 0
    assert discrete_methods.exchanges_left(1.0, 64, iterations=0) > 10


def test_the_better_fit():
    told = {"profile_residual_db": 1.0, "powerlaw_residual_db": 1.3}
    assert profile.family(told) == "exponential"
    assert profile.family(told | {"profile_residual_db": 2.0}) == "power law"
    assert profile.family(told | {"profile_residual_db": 1.5}) == "undecided"


def test_machines_are_listed_with_their_claims(tmp_path):
    path = tmp_path / "machine.json"
    for name, processor in (("a", "one"), ("b", "one"), ("a", "two")):
        record_machine(path, name, {"processor": processor})
    assert json.loads(path.read_text()) == [
        {"claims": ["b"], "processor": "one"},
        {"claims": ["a"], "processor": "two"},
    ]


def test_every_claim_of_the_table_has_its_machine():
    listed = json.loads(TABLE.with_name("machine.json").read_text())
    assert sorted(name for one in listed for name in one["claims"]) == sorted(read(TABLE))


def test_exponents_of_times():
    slope, error = complexity.exponent([2, 4, 8], [3 * 2**1.5, 3 * 4**1.5, 3 * 8**1.5])
    assert slope == pytest.approx(1.5)
    assert error == pytest.approx(0, abs=1e-7)


@pytest.mark.slow
def test_claims_of_sets_at_a_small_share():
    sets = SetCache(share=0.02)
    rows = {row.row: row for row in long_descent.repeated(sets)}
    assert rows["repeat"].measured == 0
    shaped = {row.row: row for row in convergence.longer(sets)}
    assert shaped["floor-10"].sets == 2
    assert shaped["floor-10000"].measured < 1e-4 * shaped["floor-10"].measured


def test_a_table_is_gone_on_with(tmp_path, capsys):
    path = tmp_path / "claims.csv"
    fill(path, named(["freedom", "digits"]), SetCache())
    first = path.read_text()
    path.write_text(first.replace("square-half", "kept"))
    fill(path, named(["weight", "freedom", "floor-bnot"]), SetCache())
    assert "kept" in path.read_text()
    assert list(read(path)) == ["weight", "freedom", "digits"]
    assert "floor-bnot: left out, no sets of bnot" in capsys.readouterr().out
    fill(path, named(["freedom"]), SetCache(), again=True)
    assert "kept" not in path.read_text()


def test_the_command(tmp_path):
    path = tmp_path / "claims.csv"
    main(["digits", str(path)])
    assert list(read(path)) == ["digits"]
    assert (tmp_path / "machine.json").exists()
    with pytest.raises(InputError, match="no claim is called 'fig-99'"):
        main(["fig-99", str(path)])


def test_sets_by_others(tmp_path):
    for k in range(2):
        np.savetxt(tmp_path / f"{k}.txt", np.random.default_rng(k).random((9, 2)))
    assert SetCache({"bnot": tmp_path}).others("bnot").x.shape == (2, 9, 2)
    np.savetxt(tmp_path / "2.txt", np.random.default_rng(2).random((4, 2)))
    with pytest.raises(InputError, match="sets of one size; found 3 files"):
        SetCache({"bnot": tmp_path}).others("bnot")
    with pytest.raises(MissingError, match="--sets bnot=FOLDER"):
        SetCache().others("bnot")


def test_verdicts():
    assert verdict(["yes", "no", BESIDE]) == "partly"
    assert verdict(["no", VERDICTS[-1]]) == "no"
    assert verdict([BESIDE]) == VERDICTS[-1]


def test_numbers_of_notes_are_the_tables():
    row = dict.fromkeys(COLUMNS, "") | {"row": "a-0.5", "measured": "2.34567e-09"}
    of_note = {"peak": [row], "eq-19": [row | {"row": "b"}]}
    noted = claim("peak").__class__("peak", "", "", "", "{a-0.5} and {eq-19.b}", claim("peak").measure)
    assert filled(noted, of_note) == "2.35e-09 and 2.35e-09"
    with pytest.raises(InputError, match="names 'b'"):
        filled(noted.__class__("peak", "", "", "", "{b}", noted.measure), of_note)
    assert number("nan") == ""


def test_texts_name_what_is_measured():
    texts = tomllib.loads((ROOT / "benchmarks" / "claims" / "texts.toml").read_text())
    assert all(set(words) == {"subject", "place", "says", "note"} for words in texts.values())
    assert all(words["note"].strip() for words in texts.values())
