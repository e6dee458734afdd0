"""A browser for the tests of the pages, driven by real clicks and keys; without one they are skipped."""

from __future__ import annotations

import shutil
from collections.abc import Iterator

import pytest

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
