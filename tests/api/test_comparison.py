"""gbnbench.compare from Python: every kind of source, resuming, figures, the report, and wrong use."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

import gbnbench
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.generators.direct.jittered import Jittered
from gbnbench.runs.sources import resolve

RANDOM = np.random.default_rng(4)
MINE = RANDOM.random((2, 64, 2))


def compare(sources: object, out: Path, **more: object) -> gbnbench.Comparison:
    settings = {"n": 64, "realizations": 2, "jobs": 1, "quiet": True, **more}
    return gbnbench.compare(sources, out=out, **settings)


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> gbnbench.Comparison:
    """One of each kind of source."""
    folder = tmp_path_factory.mktemp("compared")
    gbnbench.save(folder / "mine.npy", MINE)
    sources = ["random", str(folder / "mine.npy"), folder / "mine.npy", MINE[0], Jittered()]
    return compare(sources, folder / "out")


def test_every_kind_of_source_is_a_row(made):
    table = made.table
    assert table.source.tolist() == ["random", "mine", "mine (2)", "array", "jittered"]
    assert table.realizations.tolist() == [2, 2, 2, 1, 2]
    np.testing.assert_array_equal(made.sources[1].points, MINE)
    np.testing.assert_array_equal(made.sources[3].points, MINE[:1])
    np.testing.assert_array_equal(made.sources[4].points, gbnbench.generate("jittered", n=64, realizations=2))
    assert dict(made.sources[1].measures) == pytest.approx(dict(gbnbench.measures(MINE)), nan_ok=True)
    assert table.noise_floor[3] == gbnbench.measures(MINE[0])["noise_floor"]


def test_the_long_table_has_standard_errors(made):
    row = made.measures.query("source == 'mine' and measure == 'noise_floor'").iloc[0]
    assert row.standard_error == gbnbench.measures(MINE).standard_error["noise_floor"] > 0


def test_the_folder_is_read_as_what_was_made(made):
    again = gbnbench.Comparison.read(made.folder)
    assert again.table.equals(made.table)
    assert str(again) == str(made)
    assert "noise floor" in str(made).replace("\n", " ") or "noise" in str(made)


def test_figures_are_drawn_by_name_and_a_wrong_name_lists_them(made):
    assert made.figures == (
        "gallery", "points", "spectrum", "radial", "loglog", "zone-plate", "valence", "rdf"
    )  # fmt: skip
    assert isinstance(made.figure("gallery"), Figure)
    with pytest.raises(InputError, match=r"no figure 'galery'; it has gallery, points, .*, rdf$"):
        made.figure("galery")


def test_the_table_in_markdown_has_the_columns_asked_for(made):
    lines = made.to_markdown(["noise_floor", "cpu_seconds"]).splitlines()
    assert len(lines) == 2 + len(made.sources)
    assert lines[2].startswith("| random | ")
    with pytest.raises(InputError, match="no column 'floor'; it has noise_floor"):
        made.to_markdown(["floor"])


@pytest.mark.slow
def test_the_report_is_made_when_it_is_missing(made):
    path = made.folder / "report.html"
    assert not path.exists()
    assert made.report() == path
    assert "jittered" in path.read_text(encoding="utf-8")
    assert (made.folder / "figures" / "gallery.png").is_file()
    path.write_text("kept")
    assert made.report().read_text() == "kept"


def test_a_notebook_shows_the_table_and_pictures(made):
    shown = made._repr_html_()
    assert shown.count("<tr>") == 1 + len(made.sources)
    assert shown.count('src="data:image/png;base64,') == 2
    assert "<b>" in shown


@pytest.mark.slow
def test_the_same_call_finds_it_and_another_array_is_refused(tmp_path):
    first = compare({"a": MINE}, tmp_path / "out")
    again = compare({"a": MINE.copy()}, tmp_path / "out")
    assert (first.reused, again.reused, again.pieces) == (0, 1, 1)
    assert again.table.equals(first.table)
    with pytest.raises(InputError, match="holds"):
        compare({"a": MINE[:, ::-1]}, tmp_path / "out")
    (source,) = json.loads((tmp_path / "out" / "settings.json").read_text())["sources"]
    assert source["kind"] == "array"
    assert re.fullmatch(r"[0-9a-f]{64}", source["sha256"])


@pytest.mark.slow
def test_a_mapping_gives_labels_and_several_sizes_suffix_the_figures(tmp_path):
    made = compare({"white": "random", "mine": MINE}, tmp_path / "out", n=[16, 64])
    assert list(zip(made.table.source, made.table.n, strict=True)) == [
        ("white", 16), ("white", 64), ("mine", 64)
    ]  # fmt: skip
    assert "gallery_n16_d2" in made.figures
    assert made.figures[-1] == "sweep"


def test_one_source_needs_no_list_and_what_is_refused_is_said(tmp_path):
    made = compare(["random", "jittered"], tmp_path / "out", n=50)
    assert made.table.source.tolist() == ["random"]
    assert len(made.skipped) == 1
    assert "nearest is 49" in made.skipped[0]
    with pytest.raises(RefusalError, match="nearest is 49"):
        compare("jittered", tmp_path / "none", n=50)


@pytest.mark.slow
def test_a_baseline_is_judged(tmp_path):
    compare({"mine": MINE}, tmp_path / "before")
    after = compare({"mine": 0.5 + MINE / 1000}, tmp_path / "after", baseline=tmp_path / "before")
    assert after.worse
    assert "power_at_1" in {change.measure for change in after.changes}


@pytest.mark.slow
def test_a_source_object_passes(tmp_path):
    sources, _ = resolve(["random"], (64,), (2,), 2)
    assert compare(list(sources), tmp_path / "out").table.source.tolist() == ["random"]


@pytest.mark.parametrize(
    ("sources", "words"),
    [
        ("randm", "did you mean random"),
        (Path("nowhere.txt"), "nowhere.txt is neither a file nor a folder"),
        (1 + MINE, r"points must lie in \[0, 1\)"),
        ([object()], "a generator must be text"),
        ({"": MINE}, "a source needs a name"),
    ],
    ids=["name", "path", "array", "object", "empty label"],
)
def test_what_is_no_source_is_named(sources, words, tmp_path):
    with pytest.raises(InputError, match=words):
        compare(sources, tmp_path / "out")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("n", [1.5, "64", [], None])
def test_n_must_be_whole_numbers(n, tmp_path):
    with pytest.raises(InputError, match="n must be a whole number or several"):
        compare("random", tmp_path, n=n)


def test_a_device_that_is_not_there_is_named(tmp_path):
    with pytest.raises(gbnbench.GbnbenchError, match="'no such device' fits no device"):
        compare("random", tmp_path, device="no such device")


@pytest.mark.slow
def test_arrays_of_a_rectangle_are_measured_saved_drawn_and_told_apart(tmp_path: Path) -> None:
    made = compare({"mine": MINE, "other": "random"}, tmp_path / "out", sides=(200, 100), pictures=True)
    mine, other = made.sources
    assert mine.sides == pytest.approx((2**0.5, 0.5**0.5))
    assert other.sides is None
    expected = gbnbench.measures(MINE, sides=(2, 1))
    assert dict(mine.measures) == pytest.approx(dict(expected), nan_ok=True)
    again = gbnbench.Comparison.read(tmp_path / "out").sources[0]
    assert again.sides == mine.sides
    np.testing.assert_array_equal(again.spectrum.power, mine.spectrum.power)
    assert "mine sides 2:1" in str(made)
    assert "mine sides 2:1" in made.to_markdown()
    assert "mine sides 2:1" in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    settings = json.loads((tmp_path / "out" / "settings.json").read_text())
    assert "[200.0, 100.0]" in json.dumps(settings)
    for name in ("points", "valence"):
        axes = made.figure(name).axes[0]
        assert axes.get_xlim()[1] / axes.get_ylim()[1] == pytest.approx(2)
        assert axes.get_aspect() in ("equal", 1.0)
    with pytest.raises(InputError, match="sides of mine is 200,100 there, not given here"):
        compare({"mine": MINE, "other": "random"}, tmp_path / "out", sides=(100, 100))
    with pytest.raises(InputError, match="sides must be 2 lengths"):
        compare(MINE, tmp_path / "wrong", sides=(1, 2, 3))


@pytest.mark.slow
def test_a_baseline_of_other_sides_gives_no_verdict(tmp_path: Path) -> None:
    square = compare({"mine": MINE}, tmp_path / "square")
    told = compare({"mine": MINE}, tmp_path / "told", sides=(2, 1), baseline=square.folder)
    assert told.changes == ()
    assert any("other sides" in note for note in told.notes)
