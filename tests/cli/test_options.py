"""Options of the commands: one name for one thing in all, none hidden, and help by task."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator

import click
import numpy as np
import pytest
from click.testing import CliRunner

from gbnbench.cli import TASKS, gbnbench, run
from gbnbench.cli.json_text import json_text
from gbnbench.io.points import save


def every_command(group: click.Group = gbnbench, prefix: str = "") -> Iterator[tuple[str, click.Command]]:
    for name, command in group.commands.items():
        if isinstance(command, click.Group):
            yield from every_command(command, f"{prefix}{name} ")
        else:
            yield f"{prefix}{name}", command


COMMANDS = dict(every_command())
# Which command has which of the options that several have; report waits for little.
BENCHES = "bench periodogram, bench gbn"
SHARED = {
    "--out": "compare spectrum analyze generate library generators stipple reconstruct convert export "
    f"integrate figures report, {BENCHES}",
    "--json": "compare spectrum analyze generators reconstruct export integrate check devices doctor, "
    f"{BENCHES}",
    "--quiet": "compare spectrum analyze generate library generators stipple reconstruct export integrate "
    f"figures check doctor, {BENCHES}",
    "--quick": f"figures check doctor, {BENCHES}",
    "--full": f"figures check doctor, {BENCHES}",
    "--seed": "compare generate library generators stipple export integrate figures",
    "--jobs": "compare generate library generators stipple integrate figures check, bench gbn",
    "--executor": "compare generate library stipple integrate figures, bench gbn",
    "--executor-config": "compare generate library stipple integrate figures, bench gbn",
    "--family": "compare generators integrate",
    "--preset": "compare integrate",
    "--realizations": "compare spectrum generate library generators export integrate",
    "--device": "compare spectrum analyze generate library generators stipple reconstruct export integrate "
    f"figures check devices doctor, {BENCHES}",
}


def options_of(command: click.Command) -> dict[str, click.Option]:
    return {
        spelling: parameter
        for parameter in command.params
        if isinstance(parameter, click.Option)
        for spelling in (*parameter.opts, *parameter.secondary_opts)
    }


@pytest.mark.parametrize("option", SHARED)
def test_the_same_option_has_the_same_name_in_every_command(option):
    alone, *pairs = SHARED[option].split(", ")
    expected = {*alone.split(), *pairs}
    assert {name for name, command in COMMANDS.items() if option in options_of(command)} == expected


@pytest.mark.parametrize("name", COMMANDS)
def test_an_option_is_short_and_long_in_the_same_way_and_never_hidden(name):
    options = options_of(COMMANDS[name])
    assert not [option.name for option in options.values() if option.hidden]
    assert ("-o" in options) == ("--out" in options)
    assert ("--quick" in options) == ("--full" in options)
    if "--out" in options:
        assert options["-o"] is options["--out"]


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_says_what_it_does(name):
    for spelling, option in options_of(COMMANDS[name]).items():
        assert option.help or isinstance(option.type, click.Choice), spelling


def test_the_first_screen_has_every_command_by_task_in_24_lines_of_80_columns(monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    said = CliRunner().invoke(gbnbench, ["--help"], terminal_width=80).output.splitlines()
    assert len(said) <= 24
    assert max(map(len, said)) <= 80
    assert not [line for line in said if line.endswith("...")][1:]  # nothing is cut short after the usage
    listed = [m.group(1) for line in said if (m := re.match(r"  (\w+)  +\S", line))]
    assert listed == [command.name for commands in TASKS.values() for command in commands]
    assert set(listed) == set(gbnbench.commands)
    assert listed[:4] == ["compare", "spectrum", "analyze", "generate"]


def test_json_has_null_for_what_is_not_a_number_and_keeps_every_bit():
    content = {"a": np.array([1 / 3, np.nan, np.inf]), "b": (np.int64(2), None, "x", True)}
    assert json.loads(json_text(content)) == {"a": [1 / 3, None, None], "b": [2, None, "x", True]}


def test_json_of_a_spectrum_holds_its_shells(tmp_path):
    x = np.random.default_rng(1).random((50, 2))
    save(tmp_path / "x.npy", x)
    done = CliRunner().invoke(gbnbench, ["spectrum", str(tmp_path / "x.npy"), "--fmax", "3", "--json"])
    assert done.exit_code == 0, done.output
    (spectrum,) = json.loads(done.stdout)
    assert (spectrum["n"], spectrum["d"], spectrum["fmax"]) == (50, 2, 3)
    first = spectrum["rows"][0]
    power = (np.abs(np.exp(-2j * np.pi * x).sum(axis=0)) ** 2 / 50).mean()
    assert first["frequency"] == 1
    assert first["count"] == 4
    assert first["power"] == pytest.approx(power, rel=1e-12)


def test_json_does_not_go_with_a_file(tmp_path):
    save(tmp_path / "x.npy", [[0.5, 0.5]])
    arguments = ["spectrum", str(tmp_path / "x.npy"), "--json", "-o", str(tmp_path / "y.csv")]
    done = CliRunner().invoke(gbnbench, arguments)
    assert done.exit_code == 2
    assert "--json and --out do not go together" in done.output


def test_devices_as_json_mark_the_one_in_use():
    rows = json.loads(CliRunner().invoke(gbnbench, ["devices", "--json"]).stdout)
    assert sum(row["used"] for row in rows) == 1


def test_a_file_whose_name_begins_with_a_dash_is_told_from_an_option(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "-x.txt").write_text("0.5 0.25\n")
    assert run(["analyze", "-x.txt"]) == 2
    said = capsys.readouterr().err
    assert "No such option" in said
    assert "-x'. Of the file" in said or "-x. Of the file" in said  # click quotes it since 8.4
    assert said.endswith("Of the file of this name, write ./-x.txt.\n")
    assert run(["analyze", "-y.txt"]) == 2
    assert "Of the file" not in capsys.readouterr().err


def test_a_folder_is_not_written_as_a_file(tmp_path, capsys):
    assert run(["generate", "random", "-n", "4", "-o", f"{tmp_path}/dots.txt/"]) == 2
    assert "dots.txt/' ends as a folder does: name a file" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["x.txt"], "No such command 'x.txt'. A file stands behind a command: gbnbench analyze x.txt."),
        (["analyze", "-"], "standard input is not read: name a file"),
        (
            ["convert", "x.txt", "--period", "640", "480", "-o", "y.txt"],
            "480: cannot be read: no such file or directory; numbers of one option are parted by commas",
        ),
        (
            ["analyze", "x.txt", "--window", "512,512"],
            "--window must have low < high on each axis; axis 0 has 512, 512; 'file' takes the box that",
        ),
    ],
)
def test_a_word_in_a_wrong_place_is_told(tmp_path, monkeypatch, capsys, words, said):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "x.txt").write_text("0.5 0.25\n0.125 0.75\n")
    assert run(words) == 2
    assert said in capsys.readouterr().err
