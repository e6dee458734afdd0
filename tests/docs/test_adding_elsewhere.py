"""The generators of docs/adding.md that stand outside gbnbench: a package's, a script's, a C program's."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import numpy as np
import pytest

import gbnbench
from gbnbench.cli import run
from gbnbench.generators.registry import find
from tests.docs.test_adding import blocks, files

PROGRAMS = {"awk": "shaken.awk", "c": "roberts.c"}


def block(language: str, name: str) -> str:
    """The block of a language whose first line is a comment with this name."""
    (found,) = [text for text in blocks(language) if re.match(rf"(#|//) {re.escape(name)}\n", text)]
    return found


@pytest.fixture
def programs(here: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder with both programs and their file, the working folder being another."""
    folder = here / "programs"
    folder.mkdir()
    for language, name in PROGRAMS.items():
        (folder / name).write_text(block(language, name))
    (folder / "generators.toml").write_text(block("toml", "generators.toml"))
    monkeypatch.setenv("GBNBENCH_GENERATORS", str(folder / "generators.toml"))
    return folder


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The package of the page as an installer leaves it: its module, and a dist-info."""
    place = tmp_path / "site"
    project = tomllib.loads(block("toml", "pyproject.toml"))["project"]
    info = place / f"{project['name'].replace('-', '_')}-{project['version']}.dist-info"
    info.mkdir(parents=True)
    (place / "antithetic.py").write_text(files()["antithetic.py"])
    (info / "METADATA").write_text(
        f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {project['version']}\n"
    )
    ((group, entries),) = project["entry-points"].items()
    lines = [f"{name} = {value}" for name, value in entries.items()]
    (info / "entry_points.txt").write_text("\n".join([f"[{group}]", *lines, ""]))
    monkeypatch.syspath_prepend(str(place))
    return place


def test_a_package_brings_its_generator(
    here: Path, package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["generators", "antithetic", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["origin"] == "antithetic-points 1.0"
    assert told["settings"][0]["meaning"] == "Share of a cell's side in which its points lie, 0 < width <= 1."
    assert run(["generate", "antithetic[width=0.5]", "-n", "32", "-o", "x.npy"]) == 0
    drawn = gbnbench.generate(find("antithetic[width=0.5]"), n=32)
    assert np.array_equal(np.load("x.npy"), drawn)
    table = gbnbench.generator_table().set_index("name")
    assert table.origin["antithetic"] == "antithetic-points 1.0"


@pytest.mark.slow
def test_workers_and_the_run_folder_know_the_package(here: Path, package: Path) -> None:
    line = "compare antithetic grid -n 32,64 --realizations 2 --jobs 2 --quiet -o run"
    assert run(line.split()) == 0
    sources = json.loads(Path("run/settings.json").read_text())["sources"]
    assert sources[0]["class"] == "antithetic.Antithetic"
    assert sources[0]["package"] == "antithetic-points 1.0"
    line = "integrate antithetic -n 32 --instances 3 --realizations 2 --jobs 2 --quiet -o study"
    assert run(line.split()) == 0


def test_a_script_draws_what_it_is_told(
    here: Path, programs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    x = gbnbench.generate("shaken", n=16, seed=3, realizations=2, width=0.5)
    cell = np.floor(4 * x).astype(int)
    assert np.array_equal(cell[0], np.indices((4, 4)).reshape(2, -1).T)
    assert np.all(4 * x - cell < 0.5)
    assert not np.array_equal(x[0], x[1])
    assert np.array_equal(x[1], gbnbench.generate("shaken[width=0.5]", n=16, seed=3, realizations=2)[1])
    assert run(["generate", "shaken[width=2]", "-n", "16", "-o", "x.txt"]) == 2
    said = capsys.readouterr().err
    assert "awk -v n=16 -v seed=" in said
    assert said.endswith("its process ended with exit code 1: width must be at most 1; got 2.0\n")
    assert run(["generate", "shaken", "-n", "15", "-o", "x.txt"]) == 2
    assert "n must be m**2 for shaken; got n=15, nearest is 16" in capsys.readouterr().err
    assert run(["generate", "shaken", "-n", "16", "-d", "3", "-o", "x.txt"]) == 2
    assert "d must be 2 for shaken; got d=3, nearest is 2" in capsys.readouterr().err


@pytest.mark.slow
def test_a_program_in_c_takes_part_in_everything(
    here: Path, programs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    if shutil.which("cc") is None:
        pytest.skip("there is no C compiler named cc")
    (line,) = [text for text in blocks("sh") if text.startswith("cc ")]
    subprocess.run(line.split(), cwd=programs, check=True)
    phi = 1.32471795724474602596  # the plastic number: phi**3 = phi + 1
    x = gbnbench.generate("roberts", n=50, d=2, seed=1)
    steps = np.diff(x, axis=0) % 1
    assert np.allclose(steps, [1 / phi, 1 / phi**2], rtol=0, atol=1e-12)
    assert gbnbench.generate("roberts", n=20, d=5).shape == (20, 5)
    line = (
        "compare shaken shaken[width=0.5] roberts jittered -n 64,60 --realizations 2 --jobs 2 --quiet -o run"
    )
    assert run(line.split()) == 0
    table, told = capsys.readouterr()
    assert "skipped: shaken at n=60, d=2: n must be m**2 for shaken; got n=60, nearest is 64" in told
    assert all(name in table for name in ("shaken[width=0.5]", "roberts", "jittered"))
    sources = json.loads(Path("run/settings.json").read_text())["sources"]
    assert [one["settings"] for one in sources if "width" in one["label"]] == [{"width": 0.5}]
    (program,) = [source["program"] for source in sources if source["key"] == "roberts_n64_d2"]
    assert program["command"] == [str(programs / "roberts"), "{n}", "{d}", "{seed}", "{output}"]
    assert list(program["sha256"]) == [str(programs / "roberts")]
