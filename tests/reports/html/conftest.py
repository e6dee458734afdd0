"""A browser, driven by real clicks and keys, and a page for it; without a browser its tests are skipped."""

from __future__ import annotations

import shutil
from collections.abc import Iterator

import pytest

from gbnbench.reports.html.page import write_report
from gbnbench.runs.comparison_result import Run
from tests.reports import samples
from tests.reports.html.pages import EVIL, LONG

NAMES = ("chromium", "chromium-browser", "google-chrome")


@pytest.fixture(scope="module")
def browser() -> Iterator[object]:
    """Chromium without a window, as playwright drives it."""
    chromium = next(filter(None, map(shutil.which, NAMES)), None)
    if chromium is None:
        pytest.skip("no chromium on PATH to open the page with")
    driver = pytest.importorskip("playwright.sync_api", reason="playwright, which clicks, is not installed")
    with driver.sync_playwright() as driven:
        opened = driven.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        yield opened
        opened.close()


@pytest.fixture(scope="module")
def run() -> Run:
    """Three sources, of which one has a name that tries to break out and one shells that are zero."""
    sources = (
        samples.source(EVIL, samples.random(64, 2, 3), key="evil", measured={"noise_floor": 1.5}),
        samples.source(
            "jittered", samples.jittered(64, 2, 3), measured={"noise_floor": 1.25e-9, "evacuated_energy": 3.5}
        ),
        samples.source("grid", samples.grid(64, 2), measured={"noise_floor": 0.25}),
    )
    return Run(samples.manifest(), sources, {("evil", "peak"): "worse"})


@pytest.fixture(scope="module")
def address(run, tmp_path_factory) -> str:
    path = tmp_path_factory.mktemp("page") / "report.html"
    write_report(run, path)
    return path.as_uri()


@pytest.fixture
def opened(browser, address):
    """A page with what it said and asked for."""
    context = browser.new_context(viewport={"width": 1200, "height": 900})
    context.grant_permissions(["clipboard-read", "clipboard-write"])
    page = context.new_page()
    page.set_default_timeout(LONG)
    page.said, page.fetched = [], []
    page.on("pageerror", lambda error: page.said.append(str(error)))
    page.on("console", lambda message: page.said.append(message.text))
    page.on("request", lambda request: page.fetched.append(request.url))
    page.goto(address)
    yield page
    assert page.said == []
    assert [url for url in page.fetched if not url.startswith("data:")] == [address]  # nothing from outside
    context.close()
