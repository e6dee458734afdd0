"""External programs as generators: seeds, settings, what they write checked, and every failure in words."""

from __future__ import annotations

import pickle
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import gbnbench
from gbnbench.cli import run
from gbnbench.core.cpu_time import cpu_seconds
from gbnbench.core.errors import GbnbenchError, InputError, RefusalError
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import GENERATORS, find, generator_names
from gbnbench.generators.third_parties.discovery import third_parties
from gbnbench.generators.third_parties.program import SEEDS
from gbnbench.generators.third_parties.program_file import read_programs
from gbnbench.runs.sources import resolve

# Says what it was told on a line each of standard error; writes its points to the file, else prints them.
PROGRAM = """
import os, random, sys
n, d, seed, mode, out = int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]), sys.argv[4], sys.argv[5:]
rng = random.Random(seed)
if mode == "folder":
    assert os.listdir() == [], os.listdir()
if mode == "fails":
    sys.exit("first line\\nno luck with %d" % n)
if mode == "dies":
    os.abort()
rows = [[rng.random() for _ in range(d)] for _ in range(n + (mode == "many"))]
if mode == "outside":
    rows[1][0] = 1.5
if mode == "rounding":
    rows[1][0] = -1e-9
text = "".join(" ".join(map(repr, row)) + "\\n" for row in rows)
if mode == "colour":
    sys.exit("%c[31mred%c" % (27, 0))
if mode == "garbage":
    text = "not a number\\n"
if mode != "silent":
    print(text, end="") if not out else open(out[0], "w").write(text)
"""


@pytest.fixture
def programs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Write the program and a file of programs with this text."""
    (tmp_path / "draw.py").write_text(PROGRAM)

    def write(text: str) -> Path:
        path = tmp_path / "generators.toml"
        path.write_text(text.replace("PYTHON", sys.executable))
        monkeypatch.setenv("GBNBENCH_GENERATORS", str(path))
        return path

    return write


def told(mode: str, output: str = "", more: str = "") -> str:
    return f"[generators.mine]\ncommand = 'PYTHON draw.py {{n}} {{d}} {{seed}} {mode} {output}'\n{more}\n"


@pytest.mark.parametrize("output", ["", "{output}"])
def test_it_draws_from_a_seed_of_the_realizations_stream(programs, output: str) -> None:
    programs(told("folder", output, "dimensions = [1]"))
    x = gbnbench.generate("mine", n=7, d=3, seed=5, realizations=2)
    for k in range(2):
        import random

        rng = random.Random(int(realization_rng(5, k).integers(SEEDS)))  # noqa: S311 - no secret
        assert np.array_equal(x[k].ravel(), [rng.random() for _ in range(21)])


def test_few_points_of_many_dimensions_are_not_taken_for_transposed(programs) -> None:
    programs(told("plain", more="dimensions = [1]"))
    assert gbnbench.generate("mine", n=2, d=20).shape == (2, 20)


def test_settings_stand_in_the_command_and_in_the_run_folder(programs, tmp_path: Path) -> None:
    path = programs(told("{mode}", more='settings.mode = { default = "plain", meaning = "What it does." }'))
    assert gbnbench.generate("mine", n=3).shape == (3, 2)
    with pytest.raises(GbnbenchError, match="no luck with 3"):
        gbnbench.generate("mine[mode=fails]", n=3)
    generator = find("mine[mode=many]")
    again = pickle.loads(pickle.dumps(generator))  # noqa: S301 - our own
    assert (again, type(again)) == (generator, type(generator))
    (source,), _ = resolve(["mine[mode=many]"], [4], [2], 1)
    identity = source.identity()
    assert source.label == "mine[mode=many]"
    assert identity["settings"] == {"mode": "many"}
    assert str(tmp_path / "draw.py") in identity["program"]["sha256"]
    before = identity["program"]["sha256"]
    (tmp_path / "draw.py").write_text(f"{PROGRAM}\n# changed\n")
    assert source.identity()["program"]["sha256"] != before
    table = gbnbench.generator_table().set_index("name")
    assert table.origin["mine"] == str(path)


@pytest.mark.parametrize(
    ("mode", "said"),
    [
        ("fails", r"draw.py 3 2 \d+ fails \S*: its process ended with exit code 1: no luck with 3$"),
        ("dies", "its process was killed by SIGABRT"),
        ("many", r"mine drew no set of n=3, d=2: .*: wrote shape \(4, 2\)"),
        ("outside", r"points.txt, line 2: .*1\.5"),
        ("rounding", "brings it in; those are options for files: a program must write its n=3 points"),
        ("garbage", "points.txt, line 1: "),
        ("colour", r"exit code 1: \\x1b\[31mred\\x00$"),
        ("silent", "wrote no file points.txt"),
    ],
)
def test_a_failure_is_told_in_words(programs, mode: str, said: str) -> None:
    programs(told(mode, "{output}"))
    with pytest.raises(GbnbenchError, match=said) as failure:
        gbnbench.generate("mine", n=3)
    assert "\n" not in str(failure.value)


def test_a_program_that_takes_too_long_is_ended_with_what_it_started(programs) -> None:
    programs("[generators.mine]\ncommand = 'sh -c \"sleep 60; true {n} {seed}\"'\ntimeout = 0.2\n")
    began = time.monotonic()
    with pytest.raises(GbnbenchError, match=r"was ended after .* s; its timeout allows no more"):
        gbnbench.generate("mine", n=3)
    assert time.monotonic() - began < 30


def test_no_shell_reads_the_command(programs, tmp_path: Path) -> None:
    programs("[generators.mine]\ncommand = 'echo {n} {seed} > stolen'\n")
    with pytest.raises(GbnbenchError, match=r"'>' stolen"):
        gbnbench.generate("mine", n=3)
    assert not list(tmp_path.rglob("stolen"))


def test_a_zero_byte_in_a_command_is_told(programs) -> None:
    programs('[generators.mine]\ncommand = "true {n} {seed} a\\u0000b"\n')
    with pytest.raises(GbnbenchError, match=r"cannot be started: embedded null byte"):
        gbnbench.generate("mine", n=3)


def test_a_setting_may_be_called_steps(programs, tmp_path: Path) -> None:
    programs(told("{steps}", more='settings.steps = { default = "plain", meaning = "What it does." }'))
    assert run(["generate", "mine", "-n", "3", "-o", str(tmp_path / "x.txt")]) == 0


def test_a_program_that_is_not_there_is_a_refusal(programs) -> None:
    programs("[generators.mine]\ncommand = './absent {n} {seed}'\n")
    with pytest.raises(RefusalError, match=r"its program .*absent is not there, or may not be run"):
        gbnbench.generate("mine", n=3)
    with pytest.raises(RefusalError, match=r"d must be 2 for mine; got d=3, nearest is 2"):
        gbnbench.generate("mine", n=3, d=3)


def test_cpu_seconds_count_those_of_programs(programs) -> None:
    command = 'PYTHON -c "sum(range(9**6)); print(.5, .5)" {n} {seed}'
    programs(f"[generators.mine]\ncommand = '{command}'\n")
    began, own = cpu_seconds(), time.process_time()
    gbnbench.generate("mine", n=1)
    program = (cpu_seconds() - began) - (time.process_time() - own)
    assert program > 0.002  # Python alone takes ten times as long to start


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[generators.mine]\ncomand = 'x'", r"there is no key 'comand'; did you mean 'command'\?"),
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
