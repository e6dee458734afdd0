"""Studies of integration: right against closed forms, the same however split, resumed, kind to mistakes."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest

from gbnbench import generate, save
from gbnbench.analysis.integration.integrands.registry import find
from gbnbench.analysis.integration.variance import variance_of
from gbnbench.cli import run as command
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.studies.integration.blocks import instances_of
from gbnbench.studies.integration.set_variance import variance
from gbnbench.studies.integration.study import run_integration_study
from gbnbench.studies.integration.study_folder import read_integration


def study(folder, sources=("random", "jittered"), **changes):
    asked = {
        "n": (4, 16, 64), "d": (2,), "realizations": 6, "integrands": ("korobov", "half-space"),
        "instances": 5, "seed": 7, "jobs": 2,
    }  # fmt: skip
    return run_integration_study(sources, folder, **{**asked, **changes})


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    return study(tmp_path_factory.mktemp("studies") / "one")


def test_the_table_is_what_a_plain_loop_gives(done):
    for name in ("random", "jittered"):
        for text in ("korobov", "half-space"):
            family = find(text)
            drawn = instances_of(family, 2, 7, 5)
            for n in (4, 16, 64):
                x = generate(name, n=n, d=2, seed=7, realizations=6)
                errors = np.array([[g(points).mean() - g.integral for points in x] for g in drawn])
                table = done.study.variance
                (row,) = table[
                    (table.source == name) & (table.n == n) & table.integrand.str.startswith(text)
                ].itertuples()
                expected = variance_of(errors)
                assert row.variance == pytest.approx(expected.value, rel=1e-10)
                assert row.standard_error == pytest.approx(expected.standard_error, rel=1e-9)
                assert (row.low, row.high) == pytest.approx((expected.low, expected.high), rel=1e-8)


@pytest.mark.slow
def test_random_sets_have_the_variance_of_monte_carlo(tmp_path):
    """Korobov of smoothness 4 in 2D: variance of one value is (1 + 2 zeta(8))^2 - 1, by Parseval."""
    found = study(
        tmp_path / "r", ("random",), n=(16, 128), realizations=60, integrands=("korobov",), instances=40
    )
    one = (1 + 2 * 1.0040773561979443) ** 2 - 1
    for row in found.study.variance.itertuples():
        assert abs(row.variance - one / row.n) < 3.5 * row.standard_error
        assert abs(row.bias) < 3.5 * row.bias_error
        assert abs(row.deviation) < 3.5
    (slope,) = found.study.slopes.itertuples()
    assert abs(slope.slope + 1) < 3.5 * slope.standard_error
    assert slope.standard_error < 0.1


def test_a_prediction_is_for_periodic_families_alone(done):
    table = done.study.variance
    periodic = table.integrand.str.startswith("korobov")
    assert table[periodic].foretold.notna().all()
    assert table[~periodic][["foretold", "beyond", "deviation"]].isna().all().all()


@pytest.mark.slow
def test_one_worker_and_another_order_give_the_same_numbers(done, tmp_path):
    again = study(tmp_path / "again", ("jittered", "random"), jobs=1)
    keys = ["source", "n", "integrand"]
    first, second = (
        t.sort_values(keys).reset_index(drop=True) for t in (done.study.variance, again.study.variance)
    )
    pd.testing.assert_frame_equal(first, second, check_exact=True)


@pytest.mark.slow
def test_more_instances_and_sets_begin_with_the_same(tmp_path):
    few, more = (
        study(tmp_path / "few", ("random",)),
        study(tmp_path / "more", ("random",), instances=8, realizations=9),
    )
    name = "korobov errors"
    for piece in (few.folder / "pieces").rglob("*.npz"):
        other = more.folder / piece.relative_to(few.folder)
        with np.load(piece) as a, np.load(other) as b:
            key = next(k for k in a.files if k.startswith("korobov") and k.endswith("errors"))
            assert np.array_equal(b[key][:5, :6], a[key]), name


@pytest.mark.slow
def test_a_stopped_study_goes_on_and_a_finished_one_is_read(done, tmp_path):
    folder = tmp_path / "stopped"
    whole = study(folder)
    table = whole.study.variance
    (folder / "manifest.json").unlink()
    pieces = sorted((folder / "pieces").rglob("*.npz"))
    for piece in pieces[::2]:
        piece.unlink()
    again = study(folder)
    assert again.reused == len(pieces) - len(pieces[::2])
    pd.testing.assert_frame_equal(again.study.variance, table, check_exact=True)
    read = study(folder)
    assert read.reused == read.pieces == len(pieces)
    pd.testing.assert_frame_equal(read.study.variance, table, check_exact=True)
    pd.testing.assert_frame_equal(read.study.slopes, whole.study.slopes, check_exact=True)


def test_files_are_sources_and_shifts_are_averaged(tmp_path):
    for k in range(3):
        save(tmp_path / f"set{k}.txt", generate("jittered", n=16, d=2, seed=k))
    (tmp_path / "sets").mkdir()
    for k in range(3):
        (tmp_path / f"set{k}.txt").rename(tmp_path / "sets" / f"set{k}.txt")
    found = study(tmp_path / "s", (str(tmp_path / "sets"),), shifts=400, integrands=("korobov",))
    (row,) = found.study.variance.itertuples()
    assert (row.source, row.n, row.realizations, row.shifts) == ("sets", 16, 3, 400)
    # Given the sets and instances, only the shifts are random: 400 x 3 x 5 leave some 5%.
    assert row.variance == pytest.approx(row.foretold, rel=0.2)


def test_variance_of_points_at_hand(tmp_path):
    x = generate("jittered", n=16, d=2, seed=7, realizations=6)
    table = study(tmp_path / "v", ("jittered",), n=(16,), integrands=("korobov",)).study.variance
    found = variance(x, "korobov", instances=5, seed=7)
    assert found.value == pytest.approx(table.variance[0], rel=1e-12)
    assert found.standard_error == pytest.approx(table.standard_error[0], rel=1e-10)
    assert variance(x[0], "korobov", instances=5, seed=7).value > 0


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"instances": 0}, "instances must be at least 1; got 0"),
        ({"shifts": -1}, "shifts must be at least 0"),
        ({"seed": -1}, "seed must be at least 0"),
        ({"jobs": -2}, "jobs must be at least 1"),
        ({"integrands": ("korobow",)}, "korobow"),
        ({"integrands": ()}, "no integrand"),
        ({"n": (0,)}, "n must be at least 1"),
        ({"sources": ("nonesuch",)}, "neither a generator"),
        ({"sources": ("jittered",), "n": (5,)}, "m"),
    ],
)
def test_mistakes_are_refused_in_words(tmp_path, changes, message):
    with pytest.raises(InputError, match=message):
        study(tmp_path / "wrong", **changes)
    assert not (tmp_path / "wrong").exists()


def test_a_family_that_has_none_in_a_dimension_is_refused_before_any_work(tmp_path):
    with pytest.raises(RefusalError):
        study(tmp_path / "wrong", ("random",), d=(500,), n=(4,), integrands=("half-space",))
    with pytest.raises(RefusalError):
        variance(np.zeros((4, 500)), "half-space")


@pytest.mark.slow
def test_a_dimension_without_integrands_of_a_family_is_skipped_and_said(tmp_path):
    made = study(
        tmp_path / "run", ("random",), d=(2, 50), n=(4, 8), integrands=("gaussians", "half-space"),
        instances=1, realizations=1,
    ).study  # fmt: skip
    assert list(made.slopes.integrand) == ["gaussians", "half-space"]
    assert list(made.variance.d.unique()) == [2]
    assert made.manifest["skipped"] == [
        "gaussians: sums of Gaussians are for d = 1 to 20; got d=50",
        "half-space: half spaces are for d = 1 to 20; got d=50",
    ]


def test_reading_what_is_no_study_is_refused(tmp_path, done):
    with pytest.raises(InputError, match="no study"):
        read_integration(tmp_path)
    run = tmp_path / "run"
    run.mkdir()
    (run / "manifest.json").write_text(json.dumps({"format": 1, "settings": {}}))
    with pytest.raises(InputError, match="not of a study"):
        read_integration(run)


@pytest.mark.slow
def test_the_command_prints_keeps_and_draws(tmp_path, capsys):
    folder = tmp_path / "out"
    arguments = ["integrate", "random", "jittered", "-n", "4,16", "--realizations", "3", "--instances", "4",
                 "--integrand", "korobov", "--out", str(folder), "--quiet"]  # fmt: skip
    assert command(arguments) == 0
    printed = capsys.readouterr().out
    assert "n=16" in printed
    assert "slope" in printed
    assert {"variance.csv", "slopes.csv", "integration.png", "integration.pdf", "manifest.json"} <= {
        p.name for p in folder.iterdir()
    }
    table = pd.read_csv(folder / "variance.csv")
    assert len(table) == 4
    assert command(arguments) == 0
    assert "reused" in capsys.readouterr().out
    assert command([*arguments, "--seed", "3"]) == 2
    assert "seed is 0 there, 3 here" in capsys.readouterr().err


@pytest.mark.slow
def test_the_command_lists_families_and_says_what_is_skipped(tmp_path, capsys):
    assert command(["integrate", "--list"]) == 0
    listed = capsys.readouterr().out
    for name in ("gaussians", "half-space", "korobov"):
        assert name in listed
    assert command(["integrate", "jittered", "random", "-n", "5", "--realizations", "1", "--instances", "2",
                    "--integrand", "korobov", "--out", str(tmp_path / "o")]) == 0  # fmt: skip
    assert "skipped: jittered at n=5" in capsys.readouterr().err
    assert command(["integrate", "nonesuch"]) == 2
    assert command(["integrate", "random", "--integrand", "x[y=1]"]) == 2
