"""External programs as generators: seeds, settings, what they write checked, and every failure in words."""

from __future__ import annotations

import pickle
import time
from pathlib import Path

import numpy as np
import pytest

import gbnbench
from gbnbench.cli import run
from gbnbench.core.cpu_time import cpu_seconds
from gbnbench.core.errors import GbnbenchError, RefusalError
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import find
from gbnbench.generators.third_parties import program_run
from gbnbench.generators.third_parties.program import SEEDS
from gbnbench.runs.sources import resolve


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
    with (tmp_path / "draw.py").open("a") as program:
        program.write("# changed\n")
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


@pytest.mark.parametrize("mode", ["points", "file", "messages"])
def test_a_program_that_writes_without_end_is_ended(
    programs, monkeypatch: pytest.MonkeyPatch, mode: str
) -> None:
    monkeypatch.setattr(program_run, "ROOM", 2_000_000)
    into = {"points": "", "file": "> {output}", "messages": ">&2"}[mode]
    programs(f"[generators.mine]\ncommand = 'sh -c \"yes 0.5 {into}; true {{n}} {{seed}}\"'\n")
    with pytest.raises(GbnbenchError, match=r"was ended at 2 MB of output; its points need far less$"):
        gbnbench.generate("mine", n=3)


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
    with pytest.raises(RefusalError, match=r"mine: its program .*absent is not there, or may not be run"):
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
