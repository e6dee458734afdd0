"""Runs side by side: paired by source, judged against the first, refused in words where they do not fit."""

from __future__ import annotations

import math
import re

import pytest

from gbnbench.core.errors import InputError
from gbnbench.reports import style
from gbnbench.reports.comparison.run_columns import measure_rows
from gbnbench.reports.html.page import page
from gbnbench.runs.comparison_folder import ComparisonFolder
from gbnbench.runs.joined_runs import join_runs
from tests.reports import samples


def saved(path, *sources, **more):
    """A run folder of made-up sources."""
    settings = {"sources": [{"key": source.key} for source in sources]}
    folder = ComparisonFolder(path, settings)
    with folder.lock():
        folder.begin()
        for source in sources:
            folder.write_source(source)
        folder.finish({**samples.manifest(**more), "settings": settings, "verdicts": []})
    return path


def made(label, floor, seed=0, n=36, **more):
    return samples.source(label, samples.random(n, 2, 9, seed), 4, measured={"noise_floor": floor}, **more)


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    folder = tmp_path_factory.mktemp("runs")
    before = saved(folder / "before", made("a", 1.0), made("b", 1.0))
    after = saved(folder / "after", made("b", 1.5), made("a", 0.5, cpu=math.nan), made("c", 2.0), seed=1)
    return before, after


def test_sources_of_one_label_stand_together_and_are_judged_against_the_first_run(folders):
    joined = join_runs(folders)
    labels = ["a · before", "a · after", "b · before", "b · after", "c · after"]
    assert [source.label for source in joined.run.sources] == labels
    floors = {key: word for (key, measure), word in joined.run.verdicts.items() if measure == "noise_floor"}
    named = {joined.run.series[key]: word for key, word in floors.items()}
    assert named == {("a", 1): "better", ("b", 1): "worse"}  # by 0.5 with errors of .02 each
    assert "after: c (n=36, d=2): not in before" in joined.notes
    assert joined.run.manifest["version"] == "0.1.0"
    assert "seed" not in joined.run.manifest  # they differ
    assert joined.run.manifest["runs"]["after"]["seed"] == 1
    strokes = style.strokes(joined.run)
    assert len({strokes[source.key] for source in joined.run.sources}) == 5
    a, again, b, *_ = (strokes[source.key] for source in joined.run.sources)
    assert a.colour == again.colour != b.colour
    assert a.dash == b.dash != again.dash


def test_a_row_is_a_measure_and_a_column_a_run(folders):
    joined = join_runs(folders)
    rows = {(row.label, row.measure.name): row.cells for row in measure_rows(joined, (36, 2))}
    before, after = rows["a", "noise_floor"]
    assert (before.value, after.value) == (1.0, 0.5)
    assert (before.verdict, after.verdict) == ("", "better")
    assert rows["c", "noise_floor"][0] is None
    assert math.isnan(rows["a", "cpu_seconds"][1].value)
    text = page(joined.run, joined=joined)
    table = re.search(r'<table class="measures runs">.*?</table>', text, re.S)[0]
    heads = re.findall(r'class="sort">(.*?)</button>', table)
    assert heads == ["source", "measure", "before", "after"]
    assert table.count("▲ better") == sum(word == "better" for word in joined.run.verdicts.values())
    assert table.count("▼ worse") == sum(word == "worse" for word in joined.run.verdicts.values())
    assert table.count('<tr data-order="') == len(rows)
    assert "not in before" in text
    assert "seed, after" in text


def test_names_are_the_shortest_that_tell_runs_apart(tmp_path):
    one = saved(tmp_path / "x" / "run", made("a", 1.0))
    two = saved(tmp_path / "y" / "run", made("a", 1.0))
    assert join_runs([one, two]).names == ("x/run", "y/run")


def test_what_changes_numbers_is_told(folders, tmp_path):
    wide = samples.source("a", samples.random(36, 2, 9), 6)
    other = saved(tmp_path / "other", wide, version="0.2.0")
    notes = "\n".join(join_runs([folders[0], other]).notes)
    assert "differ in their version (before: of gbnbench 0.1.0; other: of gbnbench 0.2.0)" in notes
    assert "a (n=36, d=2): spectra up to F = 4, 6" in notes


def test_what_does_not_fit_is_refused_in_words(folders, tmp_path):
    before, after = folders
    with pytest.raises(InputError, match="before is given twice"):
        join_runs([before, after, before.parent / "after" / ".." / "before"])
    with pytest.raises(InputError, match="got 1"):
        join_runs([before])
    small = saved(tmp_path / "small", made("a", 1.0, n=16))
    with pytest.raises(InputError, match=r"same n and d; .*before has n=36 d=2, .*small has n=16 d=2"):
        join_runs([before, small])
    with pytest.raises(InputError, match="is not a run of gbnbench"):
        join_runs([before, tmp_path])
