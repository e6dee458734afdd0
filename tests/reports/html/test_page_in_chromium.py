"""The page of the report in a real browser: without scripts, printed, dark and light, narrow, and growing."""

from __future__ import annotations

import io
import os
import time

import numpy as np
import pytest
from PIL import Image

from gbnbench.reports.html.page import write_report
from gbnbench.runs.comparison_result import Run
from gbnbench.studies import growing_report
from gbnbench.studies.growing_report import Unfinished
from tests.reports.html.pages import LONG, drawn_chart

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("case", ["no scripts", "print"])
def test_every_picture_is_there_without_scripts_and_in_print(browser, address, case):
    context = browser.new_context(java_script_enabled=case == "print", color_scheme="dark")
    page = context.new_page()
    page.goto(address)
    if case == "print":
        for number in (0, 1):
            drawn_chart(page, number)
            assert not page.locator("figure.charted img").nth(number).is_visible()
        page.emulate_media(media="print")
    pictures = page.locator("img")
    assert pictures.count() >= 3 * 7 + 3
    assert all(picture.is_visible() and picture.get_attribute("alt") for picture in pictures.all())
    assert not any(tool.is_visible() for tool in page.locator(".chart, .tools, .sources, .about").all())
    assert page.locator("table.measures tbody tr:visible").count() == 3
    assert page.locator("#definitions").is_visible()
    if case == "print":
        assert page.pdf().startswith(b"%PDF")
        assert (
            page.evaluate("getComputedStyle(document.body).color") == "rgb(29, 36, 48)"
        )  # also of a dark page
        assert page.evaluate("getComputedStyle(document.querySelector('img')).filter") == "none"
    context.close()


def contrast(page, text, ground):
    """WCAG's ratio of two custom colours of the page."""
    values = page.evaluate(
        """names => names.map(name => { const c = document.createElement("canvas").getContext("2d");
        const style = getComputedStyle(document.documentElement);
        c.fillStyle = name.startsWith("--") ? style.getPropertyValue(name).trim() : name;
        c.fillRect(0, 0, 1, 1); return [...c.getImageData(0, 0, 1, 1).data].slice(0, 3); })""",
        [text, ground],
    )
    light = [
        sum(
            w * (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4)
            for w, c in zip((0.2126, 0.7152, 0.0722), np.array(v) / 255, strict=True)
        )
        for v in values
    ]
    return (max(light) + 0.05) / (min(light) + 0.05)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_dark_and_light_are_readable(browser, address, scheme):
    context = browser.new_context(color_scheme=scheme, viewport={"width": 1200, "height": 900})
    page = context.new_page()
    page.goto(address)
    for ground in ("--page", "--card"):
        for text in ("--ink", "--soft", "--link", "--good", "--bad"):
            assert contrast(page, text, ground) >= 4.5, (text, ground)
    assert contrast(page, "--best-ink", "--best") >= 4.5
    drawn_chart(page, 0)
    inks = page.evaluate(
        "document.querySelector('.chart').data.filter(t => t.source >= 0).map(t => t.marker.color)"
    )
    least = 3 if scheme == "dark" else 2  # on white they are those of the pictures
    assert min(contrast(page, ink, "--card") for ink in inks) >= least
    ground = page.evaluate("document.querySelector('.chart')._fullLayout.plot_bgcolor")
    other = "light" if scheme == "dark" else "dark"
    page.emulate_media(color_scheme=other)
    page.wait_for_function("g => document.querySelector('.chart')._fullLayout.plot_bgcolor !== g", arg=ground)
    page.emulate_media(color_scheme=scheme)
    page.evaluate("scrollTo(0, 0)")
    shot = np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("L"), float)
    assert (np.median(shot) < 60) == (scheme == "dark")
    context.close()


def test_on_a_narrow_screen_nothing_is_wider_than_it(browser, address):
    context = browser.new_context(viewport={"width": 390, "height": 800})
    page = context.new_page()
    page.goto(address)
    drawn_chart(page, 0)
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    context.close()


def test_a_growing_page_reads_itself_again_until_it_is_whole(browser, run, tmp_path, monkeypatch):
    monkeypatch.setattr(growing_report, "RELOAD", 1)
    path = tmp_path / "report.html"
    first = Run(run.manifest, run.sources[:1])
    write_report(first, path, unfinished=Unfinished(1, 3, ("jittered", "grid"), "12:00:00"))
    context = browser.new_context()
    page = context.new_page()
    page.set_default_timeout(LONG)
    loads = []
    page.on("load", lambda: loads.append(page.url))
    page.goto(path.as_uri())
    status = page.get_by_role("status").filter(has_text="sources measured")
    assert status.inner_text().startswith(
        "1 of 3 sources measured at 12:00:00; still to come: jittered, grid."
    )
    page.wait_for_event("load")  # by itself
    stop = page.get_by_role("button", name="stop reloading")
    stop.click()
    assert stop.get_attribute("aria-pressed") == "true"
    before = len(loads)
    page.wait_for_timeout(3000)
    assert len(loads) == before
    write_report(run, path)
    stop.click()
    page.wait_for_function("() => document.querySelectorAll('.measures tbody tr').length === 3")
    assert status.count() == 0
    before = len(loads)
    page.wait_for_timeout(2500)
    assert len(loads) == before
    context.close()


def test_a_growing_page_that_got_nothing_new_for_an_hour_stands_still(browser, run, tmp_path, monkeypatch):
    monkeypatch.setattr(growing_report, "RELOAD", 1)
    path = tmp_path / "report.html"
    write_report(
        Run(run.manifest, run.sources[:1]),
        path,
        unfinished=Unfinished(1, 3, ("jittered", "grid"), "12:00:00"),
    )
    long_ago = time.time() - 4000
    os.utime(path, (long_ago, long_ago))
    context = browser.new_context()
    page = context.new_page()
    loads = []
    page.on("load", lambda: loads.append(page.url))
    page.goto(path.as_uri())
    assert "nothing was added for an hour" in page.locator("p.growing").inner_text()
    page.wait_for_timeout(2500)
    assert len(loads) == 1
    context.close()
