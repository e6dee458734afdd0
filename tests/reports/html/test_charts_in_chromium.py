"""The charts of the report in a real browser, used by clicks and keys."""

from __future__ import annotations

import re

import numpy as np
import pytest

from tests.reports.html.pages import EVIL, drawn_chart, ranges, shown_curves

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("number", [0, 1])
def test_dragging_zooms_and_a_double_click_shows_all(opened, number):
    chart = drawn_chart(opened, number)
    before = ranges(opened, number)
    chart.scroll_into_view_if_needed()
    box = chart.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + 150
    opened.mouse.move(x, y)
    opened.mouse.down()
    opened.mouse.move(x + 200, y + 100, steps=5)
    opened.mouse.up()
    opened.wait_for_function(
        "([k, b]) => document.querySelectorAll('.chart')[k].layout.xaxis.range[0] > b",
        arg=[number, before[0]],
    )
    after = ranges(opened, number)
    assert before[0] < after[0] < after[1] < before[1]
    for _ in range(5):  # two clicks far apart, on a busy machine, are no double click
        opened.mouse.dblclick(x, y)
        opened.wait_for_timeout(1000)
        if ranges(opened, number) == pytest.approx(before):
            break
    assert ranges(opened, number) == pytest.approx(before)


MARKS = """axis => [...document.querySelectorAll('.chart')[0].querySelectorAll(`.${axis}tick text`)]
    .map(text => text.textContent)"""


def test_marks_are_numbers_in_full_however_far_one_zooms(opened):
    """A bare digit says nothing where no power of ten is in view, nor does an axis without marks."""
    drawn_chart(opened, 0)
    zoom = "r => Plotly.relayout(document.querySelectorAll('.chart')[0], r)"
    for low, high in ((0.15, 4.0), (0.3, 0.8), (0.52, 0.58), (1.02, 1.04)):
        within = np.log10([low, high]).tolist()
        opened.evaluate(zoom, {"xaxis.range": within, "yaxis.range": within})
        opened.wait_for_timeout(200)
        marks = [float(text) for text in opened.evaluate(MARKS, "x")]
        assert len(marks) >= 2
        assert all(low <= mark <= high for mark in marks)
        assert len(opened.evaluate(MARKS, "y")) >= 2


def test_the_pointer_shows_the_values_of_all_sources(opened, run):
    chart = drawn_chart(opened, 0)
    chart.scroll_into_view_if_needed()
    nu = run.sources[0].radial.nu
    script = """nu => { const c = document.querySelectorAll('.chart')[0], a = c._fullLayout.xaxis;
        return a._offset + a.l2p(Math.log10(nu)); }"""
    box = chart.bounding_box()
    k = 4
    opened.mouse.move(box["x"] + opened.evaluate(script, nu[k]), box["y"] + 200)
    label = opened.locator(".hoverlayer .legend")
    label.wait_for()
    head = label.locator(".legendtitletext").text_content()
    assert float(head.removeprefix("nu ")) == pytest.approx(nu[k], rel=1e-3)
    lines = [line.rpartition(" : ") for line in label.locator(".legendtext").all_text_contents()]
    names = [name.replace("\N{ZERO WIDTH SPACE}", "") for name, _, _ in lines]
    assert names == [EVIL, "jittered", "grid"]
    powers = [source.radial.power[k] for source in run.sources[:2]]
    assert [float(value) for _, _, value in lines[:2]] == pytest.approx(powers, rel=1e-3)
    assert lines[2][2] == "zero to rounding"


def test_sources_are_switched_off_and_on(opened):
    drawn_chart(opened, 0)
    boxes = opened.locator("fieldset.sources").first
    assert shown_curves(opened, 0) == [0, 1, 2]
    boxes.get_by_label("jittered").click()
    assert shown_curves(opened, 0) == [0, 2]
    boxes.get_by_role("button", name="none").click()
    assert shown_curves(opened, 0) == []
    boxes.get_by_label(EVIL).focus()
    opened.keyboard.press("Space")
    assert shown_curves(opened, 0) == [0]
    boxes.get_by_role("button", name="all").click()
    assert shown_curves(opened, 0) == [0, 1, 2]


def test_a_chart_is_read_and_zoomed_with_the_keys(opened, run):
    chart = drawn_chart(opened, 0)
    before = ranges(opened, 0)
    chart.focus()
    reading = opened.locator("output.reading").first
    for _ in range(3):
        opened.keyboard.press("ArrowRight")
    radial = run.sources[0].radial
    said = reading.inner_text()
    assert said.startswith(f"{EVIL}: nu ")
    numbers = [float(number) for number in re.findall(r"(?:nu|power) ([\d.e-]+)", said)]
    assert numbers == pytest.approx([radial.nu[2], radial.power[2]], rel=1e-4)
    opened.keyboard.press("ArrowDown")
    assert reading.inner_text().startswith("jittered: ")
    opened.keyboard.press("ArrowDown")
    opened.keyboard.press("ArrowLeft")
    assert reading.inner_text().endswith("radial power zero to rounding")  # of the grid
    opened.keyboard.press("+")
    opened.wait_for_function("b => document.querySelector('.chart').layout.xaxis.range[0] > b", arg=before[0])
    assert np.diff(ranges(opened, 0)) == pytest.approx(np.diff(before) / 2)
    opened.keyboard.press("0")
    opened.wait_for_function(
        "b => Math.abs(document.querySelector('.chart').layout.xaxis.range[0] - b) < 1e-9", arg=before[0]
    )
