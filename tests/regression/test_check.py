"""``gbnbench check``: exact values against other arithmetic, the command, updates."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy import stats

from gbnbench.cli import run
from gbnbench.core.errors import GbnbenchError
from gbnbench.regression.case_file import read_cases, write_cases
from gbnbench.regression.cases import Case, Expectation, Spread
from gbnbench.regression.measurement import fixed_points, observe
from gbnbench.regression.runner import check, update
from gbnbench.regression.verdict import judge
from tests.oracles.energy import image_field, theta_field
from tests.regression import exact_energy
from tests.regression.own_cases import JITTERED, OWN

FIELDS = [name for name in OWN if name.startswith("field") and name.endswith("double")]


def test_fixed_points_are_those_of_plain_integers():
    for n, d, seed in ((1, 1, 0), (64, 2, 1), (5, 8, 2**33)):
        expected = exact_energy.points(n, d, seed)
        assert (fixed_points(n, d, seed) == expected).all()


@pytest.mark.skipif(np.finfo(np.longdouble).eps > 1e-18, reason="long double is no longer than double here")
@pytest.mark.parametrize("name", FIELDS)
def test_expected_fields_are_those_of_image_sums_in_long_double(name):
    case = OWN[name]
    values = exact_energy.values(*image_field(exact_energy.points(case.n, case.d, case.seed), case.sigma))
    for measure, expectation in case.measures.items():
        allowed = 1e-15 * max(map(abs, values[measure]))
        assert expectation.expected == pytest.approx(values[measure], abs=allowed)
        assert OWN[name.replace("double", "float")].measures[measure].expected == expectation.expected


@pytest.mark.parametrize("name", ["field-2d-2-double", "field-2d-64-double"])
def test_expected_fields_are_those_of_the_theta_function(name):
    case = OWN[name]
    values = exact_energy.values(*theta_field(exact_energy.points(case.n, case.d, case.seed), case.sigma))
    for measure, expectation in case.measures.items():
        assert expectation.expected == pytest.approx(values[measure], rel=1e-15)


def test_every_tolerance_has_its_reason_and_its_source():
    for case in OWN.values():
        for expectation in case.measures.values():
            assert expectation.expected
            assert len(expectation.reason) > 5
            assert (expectation.spread is None) == bool(expectation.reference)


def test_float_cannot_pass_for_double():
    """Every double field and lattice allows less than float's error, measured now."""
    for name in OWN:
        if name.endswith("-double") and OWN[name].n <= 256:
            case = OWN[name]
            found = observe(replace(case, precision="float"), case.seed)
            assert "worse" in {judge(case, measure, found[measure]).word for measure in case.measures}, name


def test_a_case_written_by_hand_is_completed_and_then_holds(file, capsys):
    arguments = ["check", "--cases", str(file), "--jobs", "1", "--quiet"]
    assert run(arguments) == 2
    assert (
        "jittered expects nothing of noise_floor yet: gbnbench check --update --only"
        in capsys.readouterr().err
    )
    assert run([*arguments, "--update", "--spread", "5"]) == 0
    assert "new" in capsys.readouterr().out
    lattice, jittered = read_cases(file)
    assert lattice == OWN["lattice-3d-64-double"]
    floor = jittered.measures["noise_floor"]
    single = [observe(jittered, seed)["noise_floor"][0] for seed in range(5)]
    assert floor.expected[0] == pytest.approx(stats.gmean(single), rel=1e-5)
    assert (floor.reason, floor.spread.seeds) == ("seeds", 5)
    assert run(arguments) == 0
    assert capsys.readouterr().out == "3 values of 2 cases: 3 ok\n"


def test_what_is_worse_is_said_and_is_exit_code_1(file, capsys):
    floor = Expectation("lower", "ratio", "seeds", (1e-5,), 1.6, Spread(20, 0.1))
    psi6 = Expectation("lower", "difference", "seeds", (0.9,), 0.05, Spread(20, 0.01))
    write_cases(file, [replace(JITTERED, measures={"noise_floor": floor, "psi6": psi6})])
    arguments = ["check", "--cases", str(file), "--jobs", "1"]
    assert run(arguments) == 1
    said = capsys.readouterr()
    assert "gbnbench: jittered: noise floor 0." in said.err
    assert "times the expected 1.00e-5 (at most 1.60 times)" in said.err
    assert "jittered: psi6 0." in said.err
    assert "--update" not in said.err  # better in one measure and worse in another is nothing to keep
    assert "▼ worse   jittered  noise floor" in said.out
    assert "▲ better  jittered  psi6" in said.out
    assert said.out.endswith("2 values of 1 cases: 1 better, 1 worse\n")
    assert run([*arguments, "--json"]) == 1
    entries = json.loads(capsys.readouterr().out)
    assert [entry["verdict"] for entry in entries] == ["worse", "better"]
    assert entries[0]["departure"] == pytest.approx(entries[0]["found"][0] / 1e-5)


def test_what_is_only_better_is_no_failure(file, capsys):
    floor = Expectation("lower", "ratio", "seeds", (10.0,), 1.6, Spread(20, 0.1))
    write_cases(file, [replace(JITTERED, measures={"noise_floor": floor})])
    assert run(["check", "--cases", str(file), "--jobs", "1", "--quiet"]) == 0
    assert "better: run gbnbench check --update to keep it" in capsys.readouterr().err


def test_an_update_keeps_other_cases_and_shows_what_moved(file, capsys):
    floor = Expectation("lower", "ratio", "why", (1e-5,), 1.6, Spread(20, 0.1))
    other = replace(JITTERED, name="other", measures={"noise_floor": floor})
    write_cases(file, [replace(JITTERED, measures={"noise_floor": floor}), other])
    command = [
        "check",
        "--cases",
        str(file),
        "--update",
        "--spread",
        "3",
        "--jobs",
        "1",
        "--only",
        "jittered",
    ]
    assert run([*command, "--json"]) == 0
    (change,) = json.loads(capsys.readouterr().out)
    assert change["before"] == {"expected": [1e-5], "tolerance": 1.6}
    first, second = read_cases(file)
    assert change["after"]["expected"] == list(first.measures["noise_floor"].expected)
    assert second == other
    assert list(file.parent.iterdir()) == [file]  # nothing temporary is left


def test_an_update_is_refused_while_an_exact_value_is_wrong(file, capsys):
    lattice = OWN["lattice-3d-64-double"]
    wrong = replace(lattice.measures["on_harmonics"], expected=(63.0,))
    write_cases(file, [replace(lattice, measures={"on_harmonics": wrong}), JITTERED])
    before = file.read_bytes()
    assert run(["check", "--cases", str(file), "--update", "--jobs", "1", "--quiet"]) == 1
    assert "lattice-3d-64-double: on harmonics departs" in (said := capsys.readouterr().err)
    assert "was left as it is" in said
    assert file.read_bytes() == before


def test_what_cannot_be_measured_is_worse_and_does_not_stop_the_rest(monkeypatch):
    floor = Expectation("lower", "ratio", "seeds", (0.05,), 3.0, Spread(20, 0.1))
    cases = [replace(JITTERED, name=name, measures={"noise_floor": floor}) for name in ("first", "second")]

    def broken(case: Case, seed: int) -> dict[str, tuple[float, ...]]:
        if case.name == "first":
            raise GbnbenchError("cannot build gbn.cl")
        return observe(case, seed)

    monkeypatch.setattr("gbnbench.regression.runner.observe", broken)
    first, second = check(cases)
    assert (first.word, second.word) == ("worse", "ok")
    assert first.text == "first: could not be measured: cannot build gbn.cl"
    with pytest.raises(GbnbenchError, match="first, seed 0, could not be measured"):
        update(cases, 3)


def test_double_is_skipped_with_words_where_there_is_none(monkeypatch):
    from gbnbench.regression import runner as running

    device = running.choose()
    monkeypatch.setattr(running, "choose", lambda: replace(device, has_double=False))
    verdicts = check([OWN["lattice-3d-64-double"]])
    assert {verdict.word for verdict in verdicts} == {"skipped"}
    assert "does not compute in double" in verdicts[0].text


@pytest.mark.slow
def test_workers_measure_what_this_process_does(file):
    cases = [OWN["lattice-3d-64-double"], OWN["lattice-2d-256-float"]]
    alone, shared = check(cases, jobs=1), check(cases, jobs=2)
    assert [verdict.word for verdict in alone] == [verdict.word for verdict in shared] == ["ok"] * 4
    assert [verdict.case.name for verdict in shared] == [verdict.case.name for verdict in alone]


def test_spread_belongs_to_update(file, capsys):
    assert run(["check", "--cases", str(file), "--spread", "5"]) == 2
    assert "--spread goes with --update" in capsys.readouterr().err
    assert run(["check", "--cases", str(Path(file).parent)]) == 2
    assert "is a folder" in capsys.readouterr().err
