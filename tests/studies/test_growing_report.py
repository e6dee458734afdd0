"""The report of a long run grows as sources are measured, at little cost, and stands still in the end."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import ClassVar

import pytest

from gbnbench.api.comparison import draw, draw_unfinished
from gbnbench.core.errors import RefusalError, UnfinishedError
from gbnbench.runs.sources import resolve
from gbnbench.studies import growing_report
from gbnbench.studies.comparison import run_comparison
from gbnbench.studies.growing_report import END, START, stop_reloading

NAMES = ["random", "jittered", "grid"]


@pytest.fixture
def sources():
    return resolve(NAMES, (16,), (2,), 1)[0]


@pytest.fixture
def at_once(monkeypatch):
    """Every chance is taken to write the report."""
    monkeypatch.setattr(growing_report, "FIRST", 0.0)
    monkeypatch.setattr(growing_report, "SHARE", 1e9)


@pytest.mark.slow
def test_the_page_says_what_is_measured_and_the_last_one_is_whole(sources, at_once, tmp_path):
    pages = []

    def grow(run, folder, unfinished):
        draw_unfinished(run, folder, unfinished)
        pages.append((len(run.sources), (folder / "report.html").read_text(encoding="utf-8")))

    outcome = run_comparison(sources, tmp_path / "run", jobs=1, draw=draw, grow=grow)
    assert outcome.undrawn == ""
    assert [count for count, _ in pages] == [1, 2]
    for count, text in pages:
        assert f"{count} of 3 sources measured" in text
        assert 'http-equiv="refresh"' in text
        assert text.count('<tr data-order="') == count
        waiting = re.search(r"still to come: (.*?)\.</span>", text)[1].split(", ")
        assert len(waiting) == 3 - count
        assert set(waiting) < set(NAMES)
    last = (tmp_path / "run" / "report.html").read_text(encoding="utf-8")
    assert "sources measured" not in last
    assert "refresh" not in last.replace("refreshTooltip", "")
    assert START not in last


@dataclass(frozen=True)
class Never:
    """A generator that makes nothing."""

    name: ClassVar[str] = "never"

    def __call__(self, n, d, rng):
        raise RefusalError("not today")


@pytest.mark.slow
def test_a_run_that_ends_early_leaves_a_page_that_stands_still(sources, at_once, tmp_path):
    sources = [*sources[:2], replace(sources[2], generator=Never())]
    with pytest.raises(UnfinishedError):
        run_comparison(sources, tmp_path / "run", jobs=1, draw=draw, grow=draw_unfinished)
    text = (tmp_path / "run" / "report.html").read_text(encoding="utf-8")
    assert "2 of 3 sources measured" in text
    assert START not in text
    assert "refresh" not in text.replace("refreshTooltip", "")


def test_a_short_run_writes_no_page_in_between(sources, tmp_path):
    def grow(run, folder, unfinished):
        pytest.fail("a run of seconds wrote a report in between")

    assert run_comparison(sources, tmp_path / "run", jobs=1, grow=grow).undrawn == ""


def test_pages_take_a_small_share_of_the_time(sources, tmp_path, monkeypatch):
    """A page that takes 10 s is written again after 200 s at the earliest."""
    now = [0.0]
    monkeypatch.setattr(growing_report.time, "monotonic", lambda: now[0])
    written = []

    def slow(run, folder, unfinished):
        written.append(now[0])
        now[0] += 10.0

    class Folder:
        path = tmp_path

        def write(self, key, result):
            pass

        def read_source(self, key):
            return "there" if key == "a" else None

    monkeypatch.setattr(growing_report, "SourceResult", str)
    report = growing_report.GrowingReport(Folder(), {"a": "a", "b": "b"}, {}, slow)
    for _ in range(1000):
        report.write("a", "source")
        now[0] += 1.0
    assert written[0] == growing_report.FIRST
    assert all(late - early >= 200 for early, late in pairwise(written))
    assert len(written) == 5


def test_a_page_that_cannot_be_drawn_stops_nothing(sources, at_once, tmp_path):
    def grow(run, folder, unfinished):
        raise RuntimeError("no ink")

    assert len(run_comparison(sources, tmp_path / "run", jobs=1, grow=grow).run.sources) == 3


def test_stopping_takes_only_what_reloads(tmp_path):
    page = tmp_path / "report.html"
    page.write_text(f"<p>kept{START}reload{END} é{START}\nmore\n{END}</p>", encoding="utf-8")
    stop_reloading(page)
    assert page.read_text(encoding="utf-8") == "<p>kept é</p>"
    stop_reloading(tmp_path / "none.html")
    assert not (tmp_path / "none.html").exists()
