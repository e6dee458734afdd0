"""The regression's cases, their file, verdicts and updates; exact values against other arithmetic."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy import stats

from gbnbench.cli import run
from gbnbench.core.errors import FormatError, GbnbenchError, InputError
from gbnbench.regression.case_file import default_path, read_cases, write_cases
from gbnbench.regression.cases import Case, Expectation, Spread, select
from gbnbench.regression.measurement import fixed_points, observe
from gbnbench.regression.runner import check, expect, update
from gbnbench.regression.verdict import judge
from tests.oracles.energy import image_field, theta_field
from tests.regression import exact_energy

OWN = {case.name: case for case in read_cases(default_path())}
FIELDS = [name for name in OWN if name.startswith("field") and name.endswith("double")]
FLOOR = Expectation("lower", "ratio", "seeds", (7.5e-10,), 1.6, Spread(20, 0.1))
JITTERED = Case(
    "jittered", "sets", 64, 2, {"noise_floor": Expectation("lower", "ratio", "seeds")}, generator="jittered"
)


def sets(**measures: Expectation) -> Case:
    return Case("gbn-2d-1024", "sets", 1024, 2, measures, generator="gbn")


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "cases.json"
    write_cases(path, [OWN["lattice-3d-64-double"], JITTERED])
    return path


# ---- what is exact


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


# ---- verdicts


@pytest.mark.parametrize(
    ("found", "word", "words"),
    [
        (7.5e-10, "ok", ""),
        (1.19e-9, "ok", ""),
        (3.2e-9, "worse", "noise floor 3.20e-9 is 4.27 times the expected 7.50e-10 (at most 1.60 times)"),
        (1e-10, "better", "noise floor 1.00e-10 is 0.133 times the expected 7.50e-10 (at least 0.625 times)"),
        (0.0, "better", "noise floor 0 is 0 times"),
        (math.nan, "worse", "noise floor is undefined"),
        (math.inf, "worse", "noise floor is undefined"),
    ],
)
def test_a_ratio_is_judged_by_its_factor(found, word, words):
    verdict = judge(sets(noise_floor=FLOOR), "noise_floor", (found,))
    assert verdict.word == word
    if words:
        assert verdict.text.startswith("gbn-2d-1024: ")
        assert words in verdict.text
    else:
        assert verdict.text == ""


@pytest.mark.parametrize(
    ("better", "found", "word"),
    [
        ("lower", 0.66, "worse"), ("lower", 0.55, "better"), ("lower", 0.64, "ok"),
        ("higher", 0.66, "better"), ("higher", 0.55, "worse"),
        ("neither", 0.66, "worse"), ("neither", 0.55, "worse"),
    ],
)  # fmt: skip
def test_a_difference_is_judged_by_its_side(better, found, word):
    case = sets(valence6=Expectation(better, "difference", "seeds", (0.61,), 0.04, Spread(20, 0.01)))
    verdict = judge(case, "valence6", (found,))
    assert verdict.word == word
    assert word == "ok" or ("above" in verdict.text) == (found > 0.61)


def test_several_values_are_judged_by_the_largest_departure():
    expectation = Expectation("neither", "relative", "rounding", (1.0, -4.0), 1e-3, reference="closed form")
    case = Case("field", "field", 2, 1, {"gradient": expectation})
    assert judge(case, "gradient", (1.003, -4.0)).word == "ok"
    verdict = judge(case, "gradient", (1.0, -4.1))
    assert verdict.word == "worse"
    assert verdict.text == (
        "field: gradient departs from the 2 exact values by 0.0250 of the largest (at most 0.00100)"
    )
    assert judge(case, "gradient", (1.0,)).word == "worse"


# ---- tolerances


@pytest.mark.parametrize(("better", "chance"), [("lower", 1e-4), ("neither", 0.5e-4)])
def test_a_tolerance_is_a_prediction_by_students_t(better, chance):
    values = [2.0, 4.0, 8.0]
    found = expect("x", Expectation(better, "ratio", "r"), [(v,) for v in values])
    assert found.expected == (4.0,)
    assert found.spread == Spread(3, pytest.approx(math.log(2), rel=1e-3))
    departure = math.log(found.tolerance) / (math.log(2) * math.sqrt(4 / 3))
    assert stats.t(2).sf(departure) == pytest.approx(chance, rel=0.02)
    plain = expect("x", Expectation(better, "difference", "r"), [(v,) for v in values])
    assert plain.expected == (pytest.approx(14 / 3, rel=1e-5),)
    assert plain.spread.deviation == pytest.approx(np.std(values, ddof=1), rel=1e-2)


def test_a_tolerance_holds_as_often_as_it_says():
    """At a chance of 1e-4, hardly any of 2,000 new seeds departs."""
    rng = np.random.default_rng(1)
    alarms = 0
    for _ in range(2000):
        floor = expect("x", Expectation("lower", "ratio", "r"), np.exp(0.2 * rng.standard_normal((12, 1))))
        alarms += (
            judge(sets(noise_floor=floor), "noise_floor", (math.exp(0.2 * rng.standard_normal()),)).word
            == "worse"
        )
    assert alarms <= 3  # 0.2 expected; four or more has a chance of 6e-5


@pytest.mark.parametrize(
    ("scale", "values", "words"),
    [
        ("ratio", [(1.0,), (0.0,), (1.0,)], "not above 0"),
        ("difference", [(1.0,), (math.nan,), (1.0,)], "undefined for some seeds"),
        ("difference", [(1.0, 2.0)] * 3, "need a reference"),
    ],
)
def test_what_has_no_spread_is_refused(scale, values, words):
    with pytest.raises(InputError, match=words):
        expect("x", Expectation("lower", scale, "r"), values)


# ---- the file


def test_a_file_written_is_the_file_read(tmp_path):
    write_cases(tmp_path / "again.json", OWN.values())
    assert read_cases(tmp_path / "again.json") == tuple(OWN.values())
    assert (tmp_path / "again.json").read_bytes() == default_path().read_bytes()


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"format": 1', '"format": 7', "has format 7; this version reads 1"),
        ('"kind": "sets"', '"kind": "set"', "case 'jittered': kind must be one of sets, field, lattice; got"),
        ('"n": 64', '"n": "64"', "n must be a whole number >= 1; got '64'"),
        ('"generator": "jittered"', '"generator": "jitered"', "did you mean 'jittered'"),
        ('"noise_floor"', '"noise_flor"', "did you mean 'noise_floor'"),
        ('"better": "lower"', '"better": "down"', "better must be one of lower, higher, neither; got 'down'"),
        ('"better": "lower"', '"bettr": "lower"', "has an unknown key 'bettr'; did you mean 'better'"),
        ('"scale": "ratio"', '"scale": "ratio", "expected": -1', "a ratio needs an expected value above 0"),
        ('"scale": "ratio"', '"scale": "ratio", "expected": 1', "tolerance must be a number above 0"),
        ('"scale": "ratio"', '"scale": "ratio", "expected": 1, "tolerance": 1', "tolerance must be above 1"),
        ('"scale": "ratio"', '"scale": "ratio", "expected": 1, "tolerance": 2', "must have a spread"),
        ('"scale": "ratio"', '"scale": "ratio", "expected": NaN', "expected must be a finite number"),
        ('"reason": "seeds"', '"reason": ""', "reason must say why"),
        ('"n": 64,\n      "d": 2', '"n": 65,\n      "d": 2', "nearest is 64"),
        ('"n": 64,\n      "d": 3', '"n": 27,\n      "d": 3', "a dyadic lattice has"),
        ('"name": "jittered"', '"name": "lattice-3d-64-double"', "has a name that another case has"),
    ],
)  # fmt: skip
def test_a_fault_is_named_by_case_and_key(file, old, new, words, capsys):
    text = file.read_text()
    assert old in text
    head, _, tail = text.rpartition(old)
    file.write_text(head + new + tail)
    assert run(["check", "--cases", str(file)]) == 2
    assert words in (said := capsys.readouterr().err)
    assert str(file) in said


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b'{"format": 1,\n "cases": [}', ", line 2: is not JSON"),
        (b"[]", "is not a file of cases"),
        (b'{"points": 3}', "is not a file of cases"),
        (b"\xff\xfe", "is not UTF-8"),
        (b'{"format": 1, "cases": [3]}', "case 1: must be an object"),
        (None, "does not exist"),
    ],
)
def test_a_foreign_file_is_refused(tmp_path, content, words):
    path = tmp_path / "mine.json"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(FormatError, match=words):
        read_cases(path)


def test_cases_are_chosen_by_name_or_by_length():
    cases = tuple(OWN.values())
    assert [case.name for case in select(cases, ["gbn-2d-64"], False)] == ["gbn-2d-64"]
    assert len(select(cases, [], False)) < len(select(cases, [], True)) == len(cases)
    with pytest.raises(InputError, match="no case is named 'gbn-2d-63'; did you mean 'gbn-2d-64'"):
        select(cases, ["gbn-2d-63"], False)


# ---- the command


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
