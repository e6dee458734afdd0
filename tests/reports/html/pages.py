"""What the tests of the page in a browser share: a hostile name, patience, and how a chart is read."""

from __future__ import annotations

EVIL = "</script><b>%{y}</b>"
LONG = 30_000  # milliseconds; a busy machine is slow


def drawn_chart(page, number):
    chart = page.locator(".chart").nth(number)
    page.locator("figure.charted").nth(number).scroll_into_view_if_needed()
    chart.locator(".main-svg").first.wait_for()
    page.wait_for_function(
        "k => document.querySelectorAll('.chart')[k]._fullLayout?.xaxis?._length > 0", arg=number
    )
    return chart


def ranges(page, number, axis="xaxis"):
    return page.evaluate("([k, a]) => document.querySelectorAll('.chart')[k].layout[a].range", [number, axis])


def shown_curves(page, number):
    script = """k => [...new Set(document.querySelectorAll('.chart')[k].data
        .filter(t => t.visible && t.source >= 0).map(t => t.source))]"""
    return page.evaluate(script, number)
