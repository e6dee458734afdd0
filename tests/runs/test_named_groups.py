"""Groups of generators as sources: a family, and the methods of the paper's figures."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import gbnbench
from gbnbench.api.source_arguments import as_sources
from gbnbench.cli import run
from gbnbench.core.errors import InputError
from gbnbench.generators.registry import GENERATORS
from gbnbench.runs.named_groups import PAPER, expanded
from gbnbench.runs.sources import resolve

CELLULAR = [name for name, kind in GENERATORS.items() if kind.family == "cellular"]


def test_a_family_stands_for_its_generators() -> None:
    assert expanded(["family:cellular"]) == (CELLULAR, ())
    sources, skipped = resolve(["gbn", "family:cellular"], [16], [3], 1)
    serving = [name for name in CELLULAR if GENERATORS[name]().refusal(16, 3) is None]
    assert [source.label for source in sources] == ["gbn", *serving]
    refused = [name for name in CELLULAR if name not in serving]
    assert [line.partition(" ")[0] for line in skipped] == refused
    assert "fpo" in refused


def test_a_generator_that_is_named_too_comes_once() -> None:
    names, _ = expanded(["fpo", "family:cellular", "family:cellular", "fpo[sweeps=9]"])
    assert names == ["fpo", *(name for name in CELLULAR if name != "fpo"), "fpo[sweeps=9]"]


def test_the_papers_methods_are_taken_and_those_missing_are_told() -> None:
    names, told = expanded(["preset:paper"])
    assert names == [one.generator for one in PAPER if one.generator in GENERATORS]
    assert {"jittered", "lloyd", "fpo", "gbn"} <= set(names)
    missing = [one for one in PAPER if one.generator not in GENERATORS]
    assert len(told) == len(missing)
    for line, one in zip(told, missing, strict=True):
        assert line.startswith(f"{one.title} of the paper's Fig. ")


def test_what_is_no_group_is_told() -> None:
    with pytest.raises(InputError, match="did you mean 'cellular'"):
        resolve(["family:celular"], [16], [2], 1)
    with pytest.raises(InputError, match=r"no preset is named 'peper' \(did you mean 'paper'"):
        resolve(["preset:peper"], [16], [2], 1)
    with pytest.raises(InputError, match="family:lattice is several generators"):
        as_sources({"mine": "family:lattice"}, 16, 2, 1)


@pytest.mark.slow
def test_a_run_folder_keeps_which_generators_were_chosen(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    line = "compare --family lattice --preset paper -n 36 --realizations 2 --jobs 2 --quiet -o run"
    assert run(line.split()) == 0
    first = capsys.readouterr()
    sources = json.loads((here / "run" / "settings.json").read_text())["sources"]
    labels = [source["label"] for source in sources]
    assert {"grid", "jittered", "lloyd", "gbn"} <= set(labels)
    assert len(labels) == len(set(labels))
    assert "gbnbench: skipped: hexagonal at n=36, d=2: " in first.err
    assert run(line.split()) == 0
    again = capsys.readouterr()
    assert "pieces reused" in again.out
    assert [line for line in again.err.splitlines() if "skipped" in line] == [
        line for line in first.err.splitlines() if "skipped" in line
    ]
    same = gbnbench.compare(
        ["family:lattice", "preset:paper"], n=36, realizations=2, jobs=2, quiet=True, out="run"
    )
    assert same.reused == same.pieces
