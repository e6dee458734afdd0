"""The report as one page: whole, self-contained and escaped."""

import json
import math
import re
from dataclasses import replace
from html.parser import HTMLParser
from importlib import resources
from pathlib import Path

import pytest

from gbnbench.analysis.measure_definitions import DEFINITIONS
from gbnbench.reports.html.page import page, write_report
from gbnbench.runs.comparison_result import Run
from tests.reports import samples

LIBRARY = resources.files("gbnbench.reports.html").joinpath("plotly/plotly-basic.min.js").read_text("utf-8")
LIBRARY = LIBRARY.strip()
VOID = {"meta", "img", "br", "link", "input", "hr"}
EVIL = '<script>alert("x")</script>&amp;$title'


class Reader(HTMLParser):
    """Collects what a page holds and checks that every element is closed in order."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.words: list[str] = []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if not {"style", "script"} & set(self.open):
            self.words.append(data)

    def all(self, tag: str) -> list[dict[str, str | None]]:
        return [attributes for name, attributes in self.tags if name == tag]


@pytest.fixture(scope="module")
def run() -> Run:
    evil = samples.source(EVIL, samples.random(36, 2, 3), 4, warnings=[f"beware {EVIL}"], key="evil")
    good = samples.source(
        "jittered", samples.jittered(36, 2, 3), 4, measured={"noise_floor": 1.25e-9, "evacuated_energy": 3.5}
    )
    return Run(
        samples.manifest(command=f"gbnbench compare '{EVIL}'", skipped=["hexagonal refuses n=36"]),
        (evil, good),
        {("evil", "peak"): "worse", (good.key, "noise_floor"): "better"},
    )


@pytest.fixture(scope="module")
def text(run: Run) -> str:
    return page(run)


def test_page_is_whole_and_needs_nothing_from_outside(text: str) -> None:
    reader = Reader(text)
    for tag, attributes in reader.tags:
        for name in ("src", "href", "srcset", "data"):
            value = attributes.get(name)
            assert value is None or value.startswith(("data:image/png;base64,", "#")), (tag, name)
    ours = re.sub(r"base64,[^\"]*", "", text.replace(LIBRARY, ""))
    assert not re.search(r"url\(|@import|https?://", ours)
    assert text.count(LIBRARY) == 1
    ids = [attributes["id"] for _, attributes in reader.tags if "id" in attributes]
    assert len(ids) == len(set(ids))
    assert {a["href"] for a in reader.all("a")} <= {f"#{i}" for i in ids}


def test_labels_are_escaped_everywhere(text: str) -> None:
    assert text.count("<script>") == text.count("</script>") - 2 == 2  # the library, ours; data of two charts
    assert EVIL not in text
    reader = Reader(text)
    for chart in re.findall(r'<script type="application/json">(.*?)</script>', text, re.S):
        assert json.loads(chart)["sources"][0]["name"] == EVIL
    assert EVIL in " ".join(reader.words)
    assert any(EVIL in (a["alt"] or "") for a in reader.all("img"))


def test_every_picture_has_words(text: str) -> None:
    pictures = Reader(text).all("img")
    assert len(pictures) >= 2 * 7 + 2
    assert all(a.get("alt") for a in pictures)


def test_words_of_the_page(text: str) -> None:
    words = " ".join(Reader(text).words)
    for definition in DEFINITIONS:
        assert definition.text in words
        assert definition.source in words
    assert "beware" in words
    assert "hexagonal refuses n=36" in words
    assert "not in the made-up run" in words  # the reason of an undefined value
    assert "cpu-haswell" in words
    assert "numpy 2.4.6" in words
    assert "4 pi^2 = 39.5" in words


def test_marks_of_the_table(text: str) -> None:
    rows = re.findall(r"<tr data-order.*?</tr>", text, re.S)
    assert len(rows) == 2
    cells = [re.findall(r"<td.*?</td>", row, re.S) for row in rows]
    assert {len(c) for c in cells} == {len(DEFINITIONS) + 1}
    names = [definition.name for definition in DEFINITIONS]
    floor, peak = names.index("noise_floor"), names.index("peak")
    assert 'class="best"' in cells[1][floor]
    assert "▲ better" in cells[1][floor]
    assert "1.25·10<sup>−9</sup>" in cells[1][floor]
    assert 'class="best"' not in cells[0][floor]
    assert "▼ worse" in cells[0][peak]
    assert 'data-value="1.25e-09"' in cells[1][floor]


@pytest.mark.parametrize(("n", "d", "fmax", "sets"), [(1, 2, 2, 1), (5, 1, 3, 2), (8, 3, 2, 1), (4, 8, 1, 2)])
def test_any_dimension(n: int, d: int, fmax: int, sets: int) -> None:
    run = Run({}, (samples.source("random", samples.random(n, d, sets), fmax, cpu=math.nan),))
    words = " ".join(Reader(page(run)).words)
    said = "Not made for want of data: zone plate (in the plane)"
    assert ("zone plate" in words.replace(said, "")) == (d == 2)
    assert (said in words) == (d != 2)
    assert ("Slice of the first two of" in words) == (d > 2)


@pytest.mark.slow
def test_several_n_have_a_section_each_and_a_sweep() -> None:
    sources = tuple(samples.source("random", samples.random(n, 2, 2), 3) for n in (9, 16))
    reader = Reader(page(Run({}, sources)))
    sections = {a.get("id") for a in reader.all("section")}
    assert {"table-n9-d2", "table-n16-d2", "gallery-n16-d2", "sweep"} <= sections


@pytest.mark.slow
def test_odd_manifest_is_survived(run: Run) -> None:
    odd = {"device": "a string", "versions": None, "settings": {"path": Path("x")}, "timings": {"seconds": 2}}
    assert "a string" in page(replace(run, manifest=odd))
    assert "\udcff" not in page(replace(run, manifest={"command": "caf\udcff"}))


def test_file_is_replaced_whole(tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    path.write_text("old")
    write_report(samples.small_run(), path)
    assert path.read_text(encoding="utf-8").rstrip().endswith("</html>")
    assert list(tmp_path.iterdir()) == [path]
