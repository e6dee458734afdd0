"""Methods of others in the paper's figures: by the sets given, by a generator, or left out in words."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from gbnbench.cli import gbnbench
from gbnbench.generators.listing import MeasuredCost
from gbnbench.generators.registry import GENERATORS
from gbnbench.reports.paper import gallery_requests, wording
from gbnbench.reports.paper.data import ComparisonRequest
from gbnbench.reports.paper.figure import FigureOptions
from gbnbench.reports.paper.method_styles import GENERATOR_NAMES, GIVEN, NAMES
from gbnbench.reports.paper.registry import find
from gbnbench.runs.named_groups import PAPER
from tests.smallest_sizes import smallest_sizes

METHODS = ("bnot", "kdm", "vnc")


@pytest.fixture
def stand_ins(monkeypatch: pytest.MonkeyPatch) -> None:
    """Jittered sets stand for BNOT's; hexagonal ones, which 100 points refuse, for VnC's; KDM has none."""
    names = {"bnot": "jittered", "vnc": "hexagonal", **{name: "none" for name in GIVEN[1:] if name != "vnc"}}
    monkeypatch.setattr(gallery_requests, "GENERATOR_NAMES", names)


def test_sets_come_before_a_generator_and_what_has_neither_is_told(stand_ins: None) -> None:
    plain, given = FigureOptions("tiny"), FigureOptions("tiny", {"bnot": "theirs", "house": "mine"})
    assert GENERATORS["hexagonal"]().refusal(100, 2) is not None
    assert gallery_requests.methods_shown(plain, METHODS) == ("bnot",)
    assert gallery_requests.methods_shown(given, METHODS) == ("bnot", "house")
    generated = ComparisonRequest(("jittered",), (100,), (2,), 2)
    assert gallery_requests.method_requests(plain, METHODS) == {"bnot": generated}
    assert gallery_requests.method_requests(given, (*METHODS, "house")) == {
        "bnot": ComparisonRequest(("theirs",)), "house": ComparisonRequest(("mine",)),
    }  # fmt: skip
    note = "KDM and VnC of the paper are left out: no generator here makes them and no sets were given"
    assert wording.missing_sets_note(plain, METHODS).startswith(note)
    assert wording.missing_sets_note(plain, ("bnot",)) == ""


def test_a_method_that_takes_long_is_shown_by_fewer_sets(
    stand_ins: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    costs = {"jittered": MeasuredCost(60.0)}
    monkeypatch.setattr(gallery_requests, "measured_costs", lambda: costs)
    for scale, count in (("tiny", 2), ("quick", 2), ("full", 100)):
        requests = gallery_requests.method_requests(FigureOptions(scale), ("bnot",))
        assert requests["bnot"].realizations == count


def test_every_figure_knows_a_method_by_one_generator() -> None:
    assert set(GENERATOR_NAMES) <= set(GIVEN) <= set(NAMES)
    assert gallery_requests.generator_of(FigureOptions("tiny"), "step") == "step[method=correlation]"
    methods = {GENERATOR_NAMES.get(name, name) for name in NAMES}
    assert {one.generator for one in PAPER} <= methods


@pytest.mark.slow
def test_a_generator_s_sets_are_a_column_of_its_method(stand_ins: None, tmp_path: Path) -> None:
    arguments = ["figures", "1", "8", "14", "--quick", "--quiet", "--jobs", "1", "--out", str(tmp_path)]
    with smallest_sizes():
        result = CliRunner().invoke(gbnbench, arguments)
    assert result.exit_code == 0, result.output
    captions = json.loads((tmp_path / "captions.json").read_bytes())
    first, eighth, last = (captions[f"figure-{name}"]["caption"] for name in ("01", "08", "14"))
    assert "Shaded: what GBN gains over BNOT." in first
    assert "KDM, VnC and BlueNets of the paper are left out" in first
    assert "(BNOT)" in eighth
    assert "(BNOT)" in last
    assert "takes its place" not in last
    (figure,) = find(["1"])
    assert figure.needs(FigureOptions("tiny"))["bnot"] == ComparisonRequest(("jittered",), (100,), (2,), 2)
