"""The file of programs: what is wrong with a table is told with its name, and costs only itself."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

import gbnbench
from gbnbench.core.errors import InputError
from gbnbench.generators.registry import GENERATORS, find, generator_names
from gbnbench.generators.third_parties.discovery import third_parties
from gbnbench.generators.third_parties.program_file import read_programs


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[generators.mine]\ncomand = 'x'", r"there is no key 'comand' \(did you mean 'command'\?\)"),
        ("[generators.mine]\nsummary = 'x'", "it needs a command"),
        ("[generators.mine]\ncommand = 3", "command must be text; got 3"),
        ("[generators.mine]\ncommand = 'x {n}'", "command must hold {seed}; got 'x {n}'"),
        ("[generators.mine]\ncommand = 'x {n} {seed}'\ndimensions = [1, 3]", "command must hold {d}"),
        ("[generators.mine]\ncommand = 'x {n} {seed}'\ndimensions = [3, 1]", "dimensions must be d"),
        ("[generators.mine]\ncommand = 'x {n} {seed}'\ndimensions = true", "dimensions must be"),
        ("[generators.mine]\ncommand = 'x {n} {seed}'\nn = 'm**3'", "n must be one of any, m**d, 2**m"),
        ("[generators.mine]\ncommand = 'x {n} {seed}'\nn = [0]", "or a list of numbers >= 1; got [0]"),
        ("[generators.mine]\ncommand = 'x {n} {seed}'\ntimeout = 0", "timeout must be above 0 seconds"),
        ("[generators.mine]\ncommand = 'x {n} {seed}'\nfamily = 'blue'", "family must be one of direct, "),
        ("[generators.mine]\ncommand = 'x {n} {seed}'\nformat = 'a/b'", "format must be the suffix"),
        ("[generators.mine]\ncommand = '\"x {n} {seed}'", "command cannot be read: No closing quotation"),
        ("[generators.mine]\ncommand = 'x {n} {seed}'\nsettings.a = 3", "setting a must read { default ="),
        (
            "[generators.mine]\ncommand = 'x {n} {seed}'\nsettings.a = { default = 3, meaning = 'b' }",
            "command must hold {a}",
        ),
        (
            "[generators.mine]\ncommand = 'x {n} {seed}'\nsettings.seed = { default = 3, meaning = 'b' }",
            "a setting of a generator must not be named as a keyword of generate",
        ),
        (
            "[generators.mine]\ncommand = 'x {n} {seed} {class}'\n"
            "settings.class = { default = 3, meaning = 'b' }",
            "a setting must be named as a variable is",
        ),
        (
            "[generators.mine]\ncommand = 'x {n} {seed} {family}'\n"
            "settings.family = { default = 'a', meaning = 'b' }",
            "a setting of a generator must not be named as a member of generators",
        ),
        (
            "[generators.mine]\ncommand = 'x {n} {seed} {a}'\nsettings.a = { default = nan, meaning = 'b' }",
            "the default of setting a must be finite; got nan",
        ),
        (
            "[generators.mine]\ncommand = 'x {n} {seed}'\nsummary = \"two\\nlines\"",
            "must be one line of text; got 'two",
        ),
        ("[generators]\nmine = 3", "it must be a table"),
        ("[generators.'mi ne']\ncommand = 'x {n} {seed}'", "a name must be free of blanks"),
    ],
)  # fmt: skip
def test_a_wrong_table_is_told_and_costs_only_itself(programs, text: str, said: str) -> None:
    path = programs(f"{text}\n[generators.sound]\ncommand = 'x {{n}} {{seed}}'\n")
    kinds, faults = read_programs(path)
    assert list(kinds) == ["sound"]
    ((name, fault),) = faults.items()
    assert fault.startswith(f"{path}: generator {name!r} cannot be used: ")
    assert said.replace("\\", "").rstrip("?") in fault
    assert generator_names()[-2:] in ([name, "sound"], ["sound", name])
    if name == "mine":
        with pytest.raises(InputError, match=r"generators.toml: generator 'mine' cannot be used"):
            find("mine")


@pytest.mark.parametrize(
    ("text", "said"),
    [("[generators.mine", "is no TOML: "), ("generator = 3", r"must hold tables \[generators.NAME\] alone")],
)
def test_a_file_that_cannot_be_read_is_told_where_it_matters(programs, text: str, said: str) -> None:
    programs(text)
    assert gbnbench.generate("random", n=3).shape == (3, 2)
    with pytest.raises(InputError, match=f"no generator is named 'mine', and the file of programs .*{said}"):
        find("mine")
    with pytest.warns(UserWarning, match=said):
        gbnbench.generator_table()


def test_a_file_that_is_not_there_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("GBNBENCH_GENERATORS", str(tmp_path / "absent.toml"))
    assert third_parties(GENERATORS)[1] == (f"{tmp_path / 'absent.toml'}: No such file or directory",)


def test_gbnbenchs_own_name_stays_its_own(programs) -> None:
    path = programs("[generators.gbn]\ncommand = 'x {n} {seed}'\n")
    found, faults = third_parties(GENERATORS)
    assert not found
    assert faults == (f"{path}: generator 'gbn' cannot be used: gbnbench has one of that name; rename it",)
    assert type(find("gbn")) is GENERATORS["gbn"]


def test_the_users_own_file_is_read_without_the_variable(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("GBNBENCH_GENERATORS", raising=False)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    monkeypatch.setenv("HOME", str(tmp_path))
    assert generator_names() == list(GENERATORS)
    (tmp_path / "gbnbench").mkdir()
    (tmp_path / "gbnbench" / "generators.toml").write_text("[generators.mine]\ncommand = 'x {n} {seed}'\n")
    if sys.platform == "linux":
        assert generator_names() == [*GENERATORS, "mine"]
