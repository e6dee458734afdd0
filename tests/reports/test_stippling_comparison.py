"""The report of stipplings: every picture drawn, the page whole and escaped, the command's exit codes."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from gbnbench.api.stipplings import compare_stipplings
from gbnbench.cli import run
from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.registry import adaptive_points
from gbnbench.reports.stippling_comparison import figure_files, gallery, table
from gbnbench.reports.stippling_comparison.page import page
from gbnbench.runs.resumable import TaskRun
from gbnbench.studies.stippling_comparison.flat_patch import flattest_patch
from gbnbench.studies.stippling_comparison.measured_set import measured_set
from gbnbench.studies.stippling_comparison.stippling_folder import assembled
from gbnbench.studies.stippling_comparison.stippling_results import StipplingRun

DENSITY = as_density(np.linspace(0.2, 1, 48)[:, None] * np.ones(40))


def sample(n: int = 100, labels: tuple[str, ...] = ("rejection", "<b>&")) -> StipplingRun:
    """A comparison of independent points, as if two sources had drawn them."""
    patch = flattest_patch(DENSITY.values, n)
    found = {}
    for k, label in enumerate(labels):
        x = adaptive_points("rejection", DENSITY, n, seed=k)
        cost = {"cpu_seconds": np.asarray(0.5 + k), "first": np.asarray(False)}
        found[label] = [{"points": x, **measured_set(x, DENSITY, patch, pictures=True), **cost}]
    settings = {
        "density": {"name": "ramp", "shape": [48, 40]},
        "patch": None if patch is None else vars(patch),
        "sources": [{"key": label, "label": label} for label in labels],
    }
    manifest = {"settings": settings, "seed": 0, "version": "0", "device": {"name": "none"}}
    return assembled(manifest, DENSITY.values, found, ("third: it failed",))


@pytest.mark.slow
@pytest.mark.parametrize("n", [100, 40])  # with and without a square that holds enough points
def test_every_figure_and_the_page_are_made(tmp_path, n):
    made = sample(n)
    assert (made.patch is None) == (n == 40)
    drawn: dict[str, bytes] = {}
    written = figure_files.write_figures(made, tmp_path, drawn)
    assert sorted(path.name for path in written) == sorted(
        f"{name}.{ending}" for name in figure_files.FIGURES for ending in ("png", "pdf")
    )
    text = page(made, drawn)
    assert "<b>&" not in text
    assert "&lt;b&gt;&amp;" in text
    assert "failed: third: it failed" in text
    assert ("Spectrum there" in text) == (n == 100)


def test_the_best_of_a_column_is_marked_and_gaps_have_reasons():
    rows = table.rows(sample(40))
    assert [row.cells["cpu_seconds"].best for row in rows] == [True, False]
    assert sum(row.cells["psnr"].best for row in rows) == 1
    assert rows[0].cells["patch_floor"].reason == "no square of the image holds 64 points"
    text = table.terminal_text(sample(40), 100)
    assert "- patch floor: no square of the image holds 64 points" in text


@pytest.mark.slow
def test_the_command_compares_files_and_generators(here: Path, capsys):
    np.save(here / "ramp.npy", np.linspace(0.1, 0.9, 48)[:, None] * np.ones(40))
    np.savetxt(here / "theirs.txt", np.random.default_rng(1).random((90, 2)) * [40, 48])
    command = ["compare", "--density", "ramp.npy", "rejection", "theirs.txt", "-n", "90", "--jobs", "1"]
    assert run([*command, "--out", "run", "--json", "--quiet"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert [row["source"] for row in rows] == ["rejection", "theirs"]
    assert rows[1]["cpu_seconds"] is None
    assert rows[1]["reasons"]["cpu_seconds"] == "no generator made these sets"
    names = {path.relative_to(here / "run").as_posix() for path in (here / "run").rglob("*.*")}
    assert names >= {"report.html", "table.csv", "spectra.csv", "manifest.json", "figures/gallery.png"}
    assert run([*command, "--out", "run", "--quiet"]) == 0
    assert "2 of 2 sets reused" in capsys.readouterr().out
    (here / "run" / "report.html").unlink()
    assert run(["report", "run"]) == 0
    assert (here / "run" / "report.html").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--density", "none.png"], "none.png: there is no such file"),
        (["--density", "camera", "gbnn"], "did you mean 'gbn'"),
        (["--density", "camera", "gbn", "-d", "3"], "-d is not for stipplings"),
        (["--density", "camera", "gbn", "-n", "10,20"], "-n takes one number with --density"),
        (["--density", "camera", "--family", "cellular"], "--family and --preset are not for stipplings"),
        (["gbn", "--invert"], "--invert goes with --density IMAGE"),
    ],
)
def test_bad_use_is_exit_code_2(here: Path, capsys, arguments, message):
    assert run(["compare", *arguments, "--quiet"]) == 2
    assert message in capsys.readouterr().err
    assert list(here.iterdir()) == []


@pytest.mark.slow
def test_a_source_that_fails_is_exit_code_2_with_the_report_of_the_others(here: Path, capsys, monkeypatch):
    np.save(here / "ramp.npy", np.linspace(0.1, 0.9, 48)[:, None] * np.ones(40))
    command = ["compare", "--density", "ramp.npy", "rejection", "floydsteinberg", "-n", "90", "--quiet"]
    complete = TaskRun.complete

    def one_fails(self, *arguments, **options):
        for done in complete(self, *arguments, **options):
            if str(done.key).startswith("floyd"):
                self.failures[done.key] = "the worker was killed"
            yield done

    with monkeypatch.context() as patch:
        patch.setattr(TaskRun, "complete", one_fails)
        assert run([*command, "--jobs", "1", "--out", "run"]) == 2
    said = capsys.readouterr()
    assert "1 of 2 sources failed" in said.err
    assert "the first: floydsteinberg: the worker was killed" in said.err
    assert said.out.splitlines()[1].startswith("rejection")
    assert "failed: floydsteinberg" in (here / "run" / "report.html").read_text()
    assert run([*command, "--jobs", "1", "--out", "run"]) == 0
    assert "floydsteinberg" in capsys.readouterr().out
    assert "failed: floydsteinberg" not in (here / "run" / "report.html").read_text()


def test_the_worst_source_does_not_set_the_scale_of_differences():
    made = sample(60, ("a", "b", "c"))
    flat = np.ones(DENSITY.shape, np.float32)
    sources = [
        replace(one, blurred=flat * size) for one, size in zip(made.sources, (3, 0.02, 0.5), strict=True)
    ]
    run = replace(made, sources=tuple(sources))
    scale = gallery.difference_scale(run)
    assert (scale.linthresh, scale.vmin, scale.vmax) == pytest.approx((0.02, -6, 6), rel=1e-6)
    assert scale(0.02) - scale(0) > 0.1  # the colours of the best are told apart
    assert scale(3) < 1  # and those of the worst do not end
    five = replace(run, sources=(*sources, replace(sources[0], blurred=flat * 0.03), sources[0]))
    assert gallery.difference_scale(five).linthresh == pytest.approx(0.03, rel=1e-6)
    text = gallery.figure(run).texts
    assert any("proportion up to 0.02," in " ".join(one.get_text().split()) for one in text)


@pytest.mark.parametrize("shape", [(1, 600), (60, 1)])
def test_an_image_of_one_row_or_column_has_its_report(shape, tmp_path):
    ramp = np.linspace(0.1, 0.9, max(shape)).reshape(shape)
    made = compare_stipplings(as_density(ramp), "rejection", n=30, out=tmp_path / "run", jobs=1, quiet=True)
    assert made.failures == ()
    assert made.report().read_text(encoding="utf-8").count("a side of fewer than 7 pixels") == 1
