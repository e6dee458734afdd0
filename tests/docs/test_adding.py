"""The examples of docs/adding.md, run as they stand: files first, then what uses them, then the patches."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pandas as pd
import pytest

from tests.paths import ROOT, copy_packages

PAGE = (ROOT / "docs" / "adding.md").read_text(encoding="utf-8")
NAMED = re.compile(r"# (\w+\.py)\n")


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


def files() -> dict[str, str]:
    return {m.group(1): block for block in blocks("python") if (m := NAMED.match(block))}


@pytest.fixture(autouse=True)
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder of one's own, that modules are imported from and that is the current one."""
    before = set(sys.modules)
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path))
    yield tmp_path
    for name in [n for n in sys.modules if n + ".py" in files() and n not in before]:
        del sys.modules[name]


@pytest.mark.slow
def test_the_python_runs_and_its_assertions_hold(place: Path) -> None:
    for name, text in files().items():
        (place / name).write_text(text, encoding="utf-8")
    names: dict[str, object] = {}
    ran = 0
    for block in blocks("python"):
        if not NAMED.match(block):
            exec(compile(block, f"adding.md, block {ran}", "exec"), names)  # noqa: S102 - our own page
            ran += 1
    assert ran == 7
    run = place / "runs" / "antithetic"
    sources = json.loads((run / "settings.json").read_text())["sources"]
    assert sources[1]["class"] == "antithetic.Antithetic"
    assert sources[1]["settings"] == {"width": 0.5}
    assert (run / "report.html").stat().st_size > 100_000
    table = pd.read_csv(run / "table.csv").set_index("source")
    assert 3 < table.powerlaw_exponent["antithetic"] < 4.5
    assert (place / "antithetic.npz").exists()


def apply(patch: str, root: Path) -> None:
    """Put the + lines after the one line of the file that stands before them, or in place of a - line."""
    path, anchor, replaced = root, "", False
    for line in patch.splitlines():
        if line.startswith("--- "):
            path = root / line[4:]
        elif line.startswith("+"):
            text = path.read_text(encoding="utf-8")
            assert text.count(f"\n{anchor}\n") == 1, f"{path.name} has not one line {anchor!r}"
            new = line[1:] if replaced else f"{anchor}\n{line[1:]}"
            path.write_text(text.replace(f"\n{anchor}\n", f"\n{new}\n"), encoding="utf-8")
            anchor, replaced = new, False
        elif not line.startswith("@@"):
            anchor, replaced = line[1:], line.startswith("-")


@pytest.mark.slow
def test_the_patches_fit_and_the_commands_then_know_both(place: Path) -> None:
    copy_packages(place)
    (place / "generators" / "antithetic.py").write_text(files()["antithetic.py"], encoding="utf-8")
    (place / "analysis" / "axis_gap.py").write_text(files()["axis_gap.py"], encoding="utf-8")
    evaluators = place / "analysis" / "spectrum" / "evaluators"
    (evaluators / "plain_sum.py").write_text(files()["plain_sum.py"], encoding="utf-8")
    for patch in blocks("diff"):
        apply(patch, place)
    program = (
        "from pathlib import Path; from gbnbench.studies.comparison import run_comparison;"
        "from gbnbench.runs.sources import resolve;"
        "found, _ = resolve(['antithetic[width=0.5]', 'latin', 'grid'], [128], [2], 2);"
        "run_comparison(found, Path('run'), jobs=1);"
        "import numpy as np; from gbnbench import generate, periodogram, plan;"
        "x = generate('latin', n=100, seed=1);"
        "plain, usual = periodogram(x, 6, method='plain'), periodogram(x, 6);"
        "assert (plain.method, usual.method) == ('plain', 'product');"
        "off = np.abs(np.sqrt(plain.power) - np.sqrt(usual.power)).max();"
        "assert 0 < off <= plain.error_bound + usual.error_bound, off"
    )
    subprocess.run(
        [sys.executable, "-c", program], cwd=place, check=True, env={**os.environ, "PYTHONPATH": str(place)}
    )
    table = pd.read_csv(place / "run" / "table.csv").set_index("source")
    assert list(table.index) == ["antithetic[width=0.5]", "latin"]
    assert 1 < table.axis_gap["latin"] < 2
    assert table.axis_gap["antithetic[width=0.5]"] > 2
