"""The file of cases: written and read, its faults named, its cases chosen."""

from __future__ import annotations

import pytest

from gbnbench.cli import run
from gbnbench.core.errors import FormatError, InputError
from gbnbench.regression.case_file import default_path, read_cases, write_cases
from gbnbench.regression.cases import select
from tests.regression.own_cases import OWN


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
        ('"better": "lower"', '"bettr": "lower"', "has an unknown key 'bettr' (did you mean 'better'"),
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
    with pytest.raises(InputError, match=r"no case is named 'gbn-2d-63' \(did you mean 'gbn-2d-64'"):
        select(cases, ["gbn-2d-63"], False)
