"""The real command in real processes: what it prints, where, its exit codes."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from gbnbench.analysis.measure_definitions import BY_NAME
from gbnbench.cli import run
from gbnbench.io.points import load, save
from gbnbench.runs.comparison_folder import read_run
from gbnbench.runs.sources import resolve
from gbnbench.studies.comparison import run_comparison
from tests.processes import COMMAND, command


@dataclass(frozen=True)
class Whole:
    folder: Path  # where the command ran
    arguments: tuple[str, ...]
    done: subprocess.CompletedProcess[str]

    @property
    def out(self) -> Path:
        (out,) = (self.folder / "runs").iterdir()
        return out


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Whole:
    """A small run of two generators and a file, whose sets are clumped since its baseline."""
    folder = tmp_path_factory.mktemp("whole")
    before = np.random.default_rng(3).random((3, 64, 2))
    save(folder / "mine.npy", before)
    sources, _ = resolve([str(folder / "mine.npy")], (64,), (2,), 3)
    run_comparison(sources, folder / "before", jobs=1)
    save(folder / "mine.npy", 0.5 + before / 1000)
    line = "compare random jittered mine.npy -n 64 --realizations 3 --baseline before"
    arguments = tuple(line.split())
    return Whole(folder, arguments, command(*arguments, cwd=folder))


@pytest.mark.slow
def test_compare_prints_a_table_and_leaves_a_whole_run(whole: Whole) -> None:
    folder, out, done = whole.folder, whole.out, whole.done
    assert all(label in done.stdout for label in ("random", "jittered", "mine", "report: runs")), done.stderr
    names = {path.relative_to(out).as_posix() for path in out.rglob("*") if path.is_file()}
    assert {
        "manifest.json", "settings.json", "measures.csv", "table.csv", "report.html", "figures/gallery.png",
        "sources/random_n64_d2/points.npz", "sources/random_n64_d2/spectrum.npz",
        "sources/mine_n64_d2/radial.csv",
    } <= names  # fmt: skip
    assert not any("parts" in name or name.endswith((".tmp", ".pdf")) for name in names)
    result = read_run(out)
    assert [(s.label, s.n, s.realizations) for s in result.sources] == [
        ("random", 64, 3), ("jittered", 64, 3), ("mine", 64, 3)
    ]  # fmt: skip
    for k in range(3):  # the documented stream, drawn here without gbnbench
        rng = np.random.default_rng(np.random.SeedSequence(0, spawn_key=(k,)))
        np.testing.assert_array_equal(result.sources[0].points[k], rng.random((64, 2)))
    np.testing.assert_array_equal(result.sources[2].points, load(folder / "mine.npy"))
    assert result.sources[0].cpu_seconds > 0
    assert np.isnan(result.sources[2].cpu_seconds)
    assert result.manifest["command"].startswith("gbnbench compare random jittered mine.npy -n 64")


@pytest.mark.slow
def test_pdf_files_come_when_they_are_asked_for(tmp_path: Path) -> None:
    line = ("compare", "random", "-n", "64", "--realizations", "2", "--jobs", "1", "--out", "run")
    figures = tmp_path / "run" / "figures"
    assert command(*line, cwd=tmp_path).returncode == 0
    assert not list(figures.glob("*.pdf"))
    assert command(*line, "--pdf", cwd=tmp_path).returncode == 0  # of the finished run
    stems = {path.stem for path in figures.glob("*.png")}
    assert {path.stem for path in figures.glob("*.pdf")} == stems
    for path in figures.glob("*.pdf"):
        path.unlink()
    assert command("report", "run", "--pdf", cwd=tmp_path).returncode == 0
    assert {path.stem for path in figures.glob("*.pdf")} == stems


@pytest.mark.slow
def test_the_same_command_again_reuses_everything(whole: Whole) -> None:
    before = {path: path.stat().st_mtime_ns for path in whole.out.rglob("*") if path.name != ".lock"}
    again = command(*whole.arguments, cwd=whole.folder)
    assert "9 of 9 pieces reused" in again.stdout
    assert again.stdout.splitlines()[:-1] == whole.done.stdout.splitlines()[:-1]
    assert {p: p.stat().st_mtime_ns for p in whole.out.rglob("*") if p.name != ".lock"} == before


@pytest.mark.slow
def test_what_is_worse_than_the_baseline_exits_with_1(whole: Whole) -> None:
    assert whole.done.returncode == 1
    assert "worse: mine (n=64, d=2) power_at_1" in whole.done.stdout
    assert "baseline: random (n=64, d=2): not in the baseline" in whole.done.stderr
    assert read_run(whole.out).verdicts["mine_n64_d2", "power_at_1"] == "worse"


@pytest.mark.slow
def test_bad_use_is_one_line_and_exit_2(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "thesis").mkdir()
    (here / "thesis" / "thesis.tex").write_text("x")
    done = command("compare", "randm", cwd=here)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("gbnbench: error: ")
    assert done.stderr.count("\n") == 1
    assert "did you mean random or" in done.stderr
    for arguments, words in (
        (["compare", "jittered", "-n", "50"], "nearest is 49"),
        (["compare", "random", "-n", "64,x"], "whole numbers parted by commas"),
        (["compare", "random", "-n", "1,024"], "whole numbers parted by commas; got '1,024'"),
        (["compare", ""], "a source is an empty text"),
        (["compare", "random", "--out", "thesis"], "not empty and is not a run"),
        (["compare", "random", "--baseline", "thesis"], "not a run of gbnbench"),
        (["generate", "random", "-o", "x.docx"], "x.docx"),
        (["report", "nowhere"], "not a run of gbnbench"),
        (["report", "here", "there"], "give -o FILE"),
        (["report", "nowhere", "nowhere", "-o", "page.html"], "nowhere is given twice"),
    ):
        assert run(arguments) == 2, arguments
        said = capsys.readouterr()
        assert said.out == ""
        assert said.err.startswith("gbnbench: error: ")
        assert said.err.count("\n") == 1
        assert words in said.err
    assert sorted(p.name for p in here.rglob("*")) == ["thesis", "thesis.tex"]


@pytest.mark.slow
def test_generate_writes_what_the_seed_says(tmp_path: Path) -> None:
    done = command(
        "generate", "random", "-n", 32, "-d", 3, "--realizations", 2, "--seed", 5, "-o", "x.csv", cwd=tmp_path
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout == "wrote x.csv: 2 sets of 32 points, d=3\n"
    expected = [
        np.random.default_rng(np.random.SeedSequence(5, spawn_key=(k,))).random((32, 3)) for k in (0, 1)
    ]
    np.testing.assert_array_equal(load(tmp_path / "x.csv"), np.stack(expected))
    assert "replacing" in command("generate", "random", "-o", "x.csv", cwd=tmp_path).stdout


def test_analyze_prints_json_alone_and_goes_on_past_a_bad_file(tmp_path: Path) -> None:
    sets = np.random.default_rng(3).random((2, 40, 3))
    save(tmp_path / "good.npy", sets)
    (tmp_path / "bad.txt").write_text("0.5 nan\n")
    done = command("analyze", "bad.txt", "absent.txt", "good.npy", "--json", cwd=tmp_path)
    assert done.returncode == 2
    rows = json.loads(done.stdout, parse_constant=pytest.fail)
    assert [(r["path"], r["set"], r["n"], r["d"]) for r in rows] == [
        ("good.npy", 0, 40, 3), ("good.npy", 1, 40, 3)
    ]  # fmt: skip
    assert all(set(r["measures"]) == set(BY_NAME) for r in rows)
    assert all(r["measures"]["psi6"] is None for r in rows)  # the plane's measure
    assert all(r["reasons"]["psi6"] == "psi6 is defined in the plane; got d=3" for r in rows)
    for row, x in zip(rows, sets, strict=True):  # |f| = 1 summed here, without gbnbench
        power = np.abs(np.exp(-2j * np.pi * x).sum(axis=0)) ** 2 / 40
        assert row["measures"]["power_at_1"] == pytest.approx(power.mean(), rel=1e-12)
    assert len(done.stderr.splitlines()) == 2
    assert "bad.txt, line 1" in done.stderr
    table = command("analyze", "good.npy", cwd=tmp_path)
    assert table.returncode == 0
    assert [line.split()[:4] for line in table.stdout.splitlines()[1:] if line.startswith("good")] == [
        ["good.npy", "0", "40", "3"], ["good.npy", "1", "40", "3"]
    ]  # fmt: skip


@pytest.mark.slow
def test_report_remakes_the_pictures(whole: Whole) -> None:
    made = [whole.out / "report.html", whole.out / "figures" / "gallery.png"]
    before = [path.read_bytes() for path in made]
    for path in made:
        path.unlink()
    done = command("report", whole.out, cwd=whole.folder)
    assert done.returncode == 0, done.stderr
    assert [path.read_bytes() for path in made] == before


@pytest.mark.slow
def test_report_sets_runs_side_by_side(whole: Whole) -> None:
    done = command("report", whole.out, "before", "-o", "both.html", cwd=whole.folder)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "report: both.html\n"
    assert f"gbnbench: before: random (n=64, d=2): only in {whole.out.name}" in done.stderr
    page = (whole.folder / "both.html").read_text(encoding="utf-8")
    assert f"mine · {whole.out.name}" in page
    assert "mine · before" in page
    assert "▲ better" in page  # the clumped sets are worse, and the page's first run has them


@pytest.mark.slow
def test_the_page_of_the_default_sources_is_small(tmp_path: Path) -> None:
    """Sets add next to nothing to a page: spectra of a single one are the noisiest and pack worst."""
    done = command("compare", "--realizations", 1, "--quiet", "-o", "run", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "run" / "report.html").stat().st_size <= 4e6


def test_version_and_a_closed_pipe(tmp_path: Path) -> None:
    assert command("--version", cwd=tmp_path).stdout.startswith("gbnbench ")
    piped = subprocess.Popen(
        [*COMMAND, "compare", "--help"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert piped.stdout is not None
    piped.stdout.close()
    assert piped.stderr is not None
    with piped.stderr as said:
        assert said.read() == ""
    piped.wait()


def test_the_command_starts_without_heavy_libraries(tmp_path: Path) -> None:
    script = (
        "import sys\n"
        "from gbnbench.cli import run\n"
        "run(['compare', '--help'])\n"
        "heavy = {'numpy', 'scipy', 'pandas', 'matplotlib', 'pyopencl', 'skimage', 'rich'}\n"
        "sys.exit(' '.join(heavy & set(sys.modules)) or 0)\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
