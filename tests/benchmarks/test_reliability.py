"""Trials of what must not fail, a few of each; the judges themselves; the page against its table."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

from gbnbench.benchmarks.reliability import kills, registry, run
from gbnbench.benchmarks.reliability.commands import COMMANDS, GBNBENCH
from gbnbench.benchmarks.reliability.damage import DAMAGES, bomb
from gbnbench.benchmarks.reliability.files import READ, REFUSED, damaged_files
from gbnbench.benchmarks.reliability.full_disk import full_disk, quota
from gbnbench.benchmarks.reliability.memory_limits import memory_limit
from gbnbench.benchmarks.reliability.page import page
from gbnbench.benchmarks.reliability.planted_kernels import PLANTS, planted_kernel
from gbnbench.benchmarks.reliability.registry import PARTS
from gbnbench.benchmarks.reliability.seed_files import FORMATS, seed_files
from gbnbench.benchmarks.reliability.strict_packed import PACKERS
from gbnbench.benchmarks.reliability.table import PieceResult, TrialTable, read
from gbnbench.benchmarks.reliability.together import crowd
from gbnbench.benchmarks.reliability.trial import FAULT, UNTRIED, WELL, Trials, summed
from gbnbench.benchmarks.reliability.watched_reading import LIMIT, watched_reading
from gbnbench.core import memory
from gbnbench.core.errors import FormatError
from gbnbench.io.points import ReadingOptions, read_sets
from gbnbench.io.points.formats.registry import FORMATS as KNOWN
from tests.paths import ROOT

TABLE = ROOT / "benchmarks" / "results" / "reliability" / "trials.csv"


def faults(trials: list[Trials]) -> list[Trials]:
    return [one for one in trials if one.verdict == FAULT]


def test_the_page_is_what_the_table_says() -> None:
    assert (ROOT / "docs" / "reliability.md").read_text() == page(read(TABLE))


def test_every_trial_of_the_table_is_one_of_a_piece_and_none_is_a_fault() -> None:
    keys = {piece.key for part in PARTS for piece in part.pieces(False)}
    table = read(TABLE)
    assert {*table} <= keys
    assert not [one for result in table.values() for one in faults(list(result.trials))]


def test_there_are_seeds_of_every_format_and_strict_readings_read_them(tmp_path: Path) -> None:
    suffixes = {seed.suffix for name in FORMATS for seed in seed_files(name)}
    assert all(suffixes & {*format_.suffixes} for format_ in KNOWN)
    for name in FORMATS:
        for seed in seed_files(name):
            path = tmp_path / f"seed{seed.suffix}"
            path.write_bytes(seed.data)
            found = [[tuple(row) for row in x.tolist()] for x in read_sets(path).sets]
            assert found == seed.strict(seed.data), (name, seed.data[:80])


def test_every_damage_changes_files_and_none_fails_on_little() -> None:
    rng = np.random.default_rng(1)
    for name, damage in DAMAGES.items():
        changed = [damage(b"3\n0.1 0.2\n0.3 0.4\n0.5 0.6\n", rng) for _ in range(30)]
        assert len({*changed}) > (1 if name != "file twice" else 0), name
        for little in (b"", b"1", b"\n"):
            damage(little, rng)


@pytest.mark.parametrize("name", FORMATS)
def test_damaged_files_of_a_format(name: str) -> None:
    trials = damaged_files(name, piece=1_000_000, count=40)
    assert not faults(trials)
    assert sum(one.count for one in trials) == 40


@pytest.mark.slow
@pytest.mark.parametrize("name", FORMATS)
def test_more_damaged_files_of_a_format(name: str) -> None:
    trials = damaged_files(name, piece=1_000_001, count=1000)
    assert not faults(trials)
    judged = {one.outcome for one in trials}
    assert {READ, REFUSED} <= judged  # the strict reading decided both ways


def test_a_reader_that_is_wrong_is_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    from gbnbench.benchmarks.reliability import watched_reading as watched

    def shifted(path: Path, options: ReadingOptions, max_bytes: int) -> object:
        found = read_sets(path, options, max_bytes=max_bytes)
        found.sets[0][0, 0] = (found.sets[0][0, 0] + 1e-9) % 1
        return found

    monkeypatch.setattr(watched, "read_sets", shifted)
    outcomes = {one.outcome for one in faults(damaged_files("json", 1, 40))}
    assert outcomes == {"read, but other points than the strict reading finds"}
    monkeypatch.setattr(watched, "read_sets", lambda *_, **__: 1 / 0)
    assert {one.outcome for one in damaged_files("json", 1, 5)} == {"no refusal but a crash"}
    monkeypatch.setattr(watched, "SECONDS", 0.05)

    def endless(*_: object, **__: object) -> None:
        while True:
            pass

    monkeypatch.setattr(watched, "read_sets", endless)
    (found,) = damaged_files("json", 1, 1)
    assert found.note.startswith("more than 0.05 s")


@pytest.mark.parametrize("packing", sorted(PACKERS))
def test_a_bomb_is_refused_within_the_limit_of_memory(tmp_path: Path, packing: str) -> None:
    path = tmp_path / f"bomb.txt{packing}"
    path.write_bytes(bomb(packing))
    reading = watched_reading(path, ReadingOptions())
    assert "unpacked, it holds" in reading.refusal
    assert reading.megabytes < 3 * LIMIT / 1e6


def test_names_within_a_file_cannot_break_the_line_or_command_the_terminal(tmp_path: Path) -> None:
    path = tmp_path / "x.npz"
    np.savez(path, **{"a\n\x1b[2J": np.full((2, 2), 0.5), "b": np.full((2, 2), 0.5)})
    with pytest.raises(FormatError) as caught:
        read_sets(path)
    assert str(caught.value).isprintable()
    assert r"a\n\x1b[2J" in str(caught.value)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["integrate", "generate"])
def test_killed_twice_a_command_goes_on_to_the_same_bits(name: str) -> None:
    (found,) = kills.kill_chain(name, 1000, 2)
    assert (found.outcome, found.count) == (kills.WELL, 2), found


@pytest.mark.slow
@pytest.mark.parametrize("function", [full_disk, quota])
def test_no_room_is_said_in_words_and_nothing_is_lost(function) -> None:
    (found,) = function("generate", 1000)
    assert found.verdict != FAULT, found
    assert (found.count == 1) != (found.verdict == UNTRIED)


@pytest.mark.slow
def test_two_at_once_leave_the_bits_of_one() -> None:
    assert not faults(crowd("integrate", 2))


@pytest.mark.slow
def test_little_memory_is_said_in_words() -> None:
    for limit, outcome in ((64_000_000, "refused in words"), (2_000_000_000, "ended with the same bits")):
        (found,) = memory_limit("generate", limit)
        assert (found.outcome, found.verdict) == (outcome, WELL), found


@pytest.mark.slow
@pytest.mark.parametrize("name", ["a window's odd part", "an integrand's phase"])
def test_a_planted_kernel_is_named(name: str) -> None:
    (found,) = planted_kernel(name)
    assert found.verdict != FAULT, found
    assert PLANTS[name].kernel in found.note


def test_every_plant_stands_in_the_kernel_that_it_names() -> None:
    kernels = {path.name: path.read_text() for path in ROOT.glob("*/kernels/*.cl")}
    kernels |= {f"/{path.name}": path.read_text() for path in ROOT.glob("gbnbench/opencl/kernels/*.cl")}
    for name, plant in PLANTS.items():
        assert plant.right in kernels[plant.file], name
        assert plant.right != plant.wrong


def test_limits_of_memory_are_minded(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    memory.memory_limit.cache_clear()
    monkeypatch.setattr(memory, "_limits", lambda: iter((5_000_000, 900_000_000)))
    assert memory.memory_limit() == 5_000_000
    assert "limited to 5 MB (ulimit -v or -d)" in str(memory.too_little())
    monkeypatch.setattr(memory, "_limits", lambda: iter(()))
    monkeypatch.setattr(memory, "_CGROUPS", tmp_path)
    (tmp_path / "memory.max").write_text("7000000\n")
    memory.memory_limit.cache_clear()
    assert memory.memory_limit() == 7_000_000
    assert memory.too_little() is None
    (tmp_path / "memory.max").write_text("max\n")
    memory.memory_limit.cache_clear()
    assert memory.memory_limit() > 100_000_000
    memory.memory_limit.cache_clear()


def test_a_command_without_memory_ends_in_words(monkeypatch: pytest.MonkeyPatch, capsys) -> None:
    from gbnbench import cli

    def none_left(*_: object) -> None:
        raise MemoryError

    monkeypatch.setattr(cli.gbnbench, "invoke", none_left)
    assert cli.run(["devices"]) == 2
    assert "gbnbench: error: not enough memory" in capsys.readouterr().err


def test_the_table_keeps_pieces_and_sums_what_is_alike(tmp_path: Path) -> None:
    one, two = (
        Trials("npz", "damaged", "read", count=3, slowest=0.5),
        Trials("npz", "damaged", "read", count=4),
    )
    assert summed([one, two]) == [Trials("npz", "damaged", "read", count=7, slowest=0.5)]
    bad = Trials("npz", "damaged", "a crash", FAULT, 1, "said, with a comma")
    table = TrialTable(tmp_path / "t.csv")
    table.write("files/npz/0", PieceResult((one, bad), 2.5))
    again = TrialTable(tmp_path / "t.csv")
    assert again.read("files/npz/0") == PieceResult((one, bad), 2.5)
    assert again.read("files/npz/1") is None
    written = page(again.table)
    assert "**4 trials, 1 fault. Not finished: 202 of 202 pieces are still to be tried.**" in written
    assert "| npz | 4 | 3 | 1 | 0.5 | 0 |" in written
    assert "Not tried yet." in written


def test_parts_are_tried_by_name_and_a_second_time_nothing_is_left(
    monkeypatch, tmp_path: Path, capsys
) -> None:
    monkeypatch.setattr(registry, "QUICK_FILES", 3)
    monkeypatch.setattr(run, "JOBS", None)
    arguments = ["files", "--quick", "--table", str(tmp_path / "t.csv"), "-o", str(tmp_path / "page.md")]
    for _ in range(2):
        with pytest.raises(SystemExit) as ended:
            run.main(arguments)
        assert ended.value.code == 0
        assert f"{3 * len(FORMATS)} trials, 0 faults" in capsys.readouterr().out
    assert (tmp_path / "page.md").read_text() == page(read(tmp_path / "t.csv"))
    assert json.loads((tmp_path / "machine.json").read_text())["device"]
    with pytest.raises(ValueError, match="no part is called 'fires'; there are files, kills"):
        run.main(["fires"])


def test_kills_see_files_that_are_not_whole(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text('{"a": 1')
    (tmp_path / "b.csv").write_text("a,b\n1,2")
    (tmp_path / "c.npz").write_bytes(b"PK")
    (tmp_path / "d.json").write_text("{}")
    (tmp_path / ".gbnbench-1.tmp").write_text("half")
    assert sorted(kills._broken(tmp_path)) == ["a.json", "b.csv", "c.npz"]


def test_commands_that_are_tried_exist() -> None:
    for words in COMMANDS.values():
        assert re.fullmatch("compare|integrate|figures|generate", words[0])
    done = subprocess.run([*GBNBENCH, "--version"], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("gbnbench ")
