"""The tables of the report in a real browser: sorted, chosen, filtered and copied."""

from __future__ import annotations

import csv
import io

import numpy as np
import pytest

from gbnbench.reports.comparison import table
from gbnbench.reports.html.page import write_report
from gbnbench.runs import joined_runs
from gbnbench.runs.comparison_result import Run
from tests.reports import samples
from tests.reports.html.pages import EVIL, LONG, drawn_chart, shown_curves

pytestmark = pytest.mark.slow


def first_column(page):
    return page.locator("table.measures tbody tr:visible > th").all_inner_texts()


def test_a_head_sorts_by_click_and_by_key(opened):
    head = opened.locator("th[data-name=noise_floor]")
    head.get_by_role("button", name="noise floor", exact=True).click()
    assert head.get_attribute("aria-sort") == "ascending"
    assert first_column(opened) == ["jittered", "grid", EVIL]
    head.locator("button.sort").focus()
    opened.keyboard.press("Enter")
    assert head.get_attribute("aria-sort") == "descending"
    assert first_column(opened) == [EVIL, "grid", "jittered"]
    assert opened.locator("th[aria-sort]").count() == 1
    for _ in range(2):  # what is undefined comes last in both directions
        opened.locator("th[data-name=evacuated_energy] button.sort").click()
        assert first_column(opened)[0] == "jittered"


def test_the_tab_key_reaches_the_heads_and_shows_where_it_is(opened):
    for _ in range(80):
        opened.keyboard.press("Tab")
        if opened.evaluate("document.activeElement.textContent") == "noise floor":
            break
    else:
        pytest.fail("the Tab key does not reach the head of the noise floor")
    assert opened.evaluate("getComputedStyle(document.activeElement).outlineStyle") == "solid"
    opened.keyboard.press("Enter")
    assert first_column(opened)[0] == "jittered"


def test_columns_are_chosen(opened):
    opened.locator("details.chooser summary").click()
    chooser = opened.locator(".chooser .columns")
    chooser.get_by_role("button", name="none").click()
    chooser.get_by_label("noise floor", exact=True).click()
    heads = opened.locator("table.measures thead th:visible button.sort").all_inner_texts()
    assert heads == ["source", "noise floor"]
    assert opened.locator("table.measures tbody tr").first.locator(":scope > :visible").count() == 2


def test_rows_are_filtered_by_words_and_by_values(opened):
    field = opened.get_by_label("Rows with")
    field.fill("jit")
    assert first_column(opened) == ["jittered"]
    assert opened.locator("output.said").inner_text() == "1 of 3 rows"
    field.fill("noise floor < 1")
    assert first_column(opened) == ["jittered", "grid"]
    field.fill("noise_floor > 1e-3 gr")
    assert first_column(opened) == ["grid"]
    field.fill("")
    assert len(first_column(opened)) == 3


def copied(page, kind):
    page.get_by_role("button", name=kind, exact=True).click()
    page.wait_for_function("k => document.querySelector('output.said').value.endsWith(k)", arg=kind)
    return page.evaluate("navigator.clipboard.readText()")


def test_what_is_shown_is_copied(opened, run):
    everything = list(csv.DictReader(io.StringIO(copied(opened, "CSV"))))
    assert [row["source"] for row in everything] == [EVIL, "jittered", "grid"]
    for row, measured in zip(everything, table.rows(run), strict=True):
        for column in table.COLUMNS:
            value = measured.cells[column.name].value
            text = row[column.name]
            assert (text == "" and np.isnan(value)) or float(text) == value  # to the last digit
    assert (
        float(everything[1]["noise_floor_standard_error"])
        == run.sources[1].measures.standard_error["noise_floor"]
    )
    opened.locator("details.chooser summary").click()
    opened.locator(".chooser").get_by_role("button", name="none").click()
    opened.locator(".chooser").get_by_label("noise floor", exact=True).click()
    opened.locator("details.chooser summary").click()
    opened.get_by_label("Rows with").fill("t")
    assert copied(opened, "Markdown").splitlines() == [
        "| source | noise floor |",
        "| :-- | --: |",
        r"| \</script\>\<b\>%{y}\</b\> | 1.50 ± 0.03 |",
        "| jittered | **(1.25 ± 0.03)e-9** |",
    ]
    assert copied(opened, "LaTeX").splitlines() == [
        r"\begin{tabular}{lr}  % needs booktabs",
        r"\toprule",
        r"source & noise floor \\",
        r"\midrule",
        r"\textless{}/script\textgreater{}\textless{}b\textgreater{}\%\{y\}\textless{}/b\textgreater{} & "
        r"$1.50 \pm 0.03$ \\",
        r"jittered & $\mathbf{(1.25 \pm 0.03) \cdot 10^{-9}}$ \\",
        r"\bottomrule",
        r"\end{tabular}",
    ]


def test_runs_side_by_side_are_filtered_and_copied_with_their_verdicts(browser, tmp_path):
    def made(floor):
        return samples.source("white", samples.random(16, 2, 9), 3, measured={"noise_floor": floor})

    runs = (Run(samples.manifest(), (made(1.0),)), Run(samples.manifest(), (made(2.0),)))
    joined = joined_runs.joined(("before", "after"), runs)
    write_report(joined.run, tmp_path / "both.html", joined=joined)
    context = browser.new_context()
    context.grant_permissions(["clipboard-read", "clipboard-write"])
    page = context.new_page()
    page.set_default_timeout(LONG)
    page.goto((tmp_path / "both.html").as_uri())
    page.get_by_label("Rows with").first.fill("noise floor")
    page.get_by_role("button", name="CSV").first.click()
    page.wait_for_function("() => document.querySelector('output.said').value.endsWith('CSV')")
    (row,) = csv.DictReader(io.StringIO(page.evaluate("navigator.clipboard.readText()")))
    assert (row["source"], row["measure"]) == ("white", "noise floor")
    assert (row["before"], row["after"], row["after_verdict"]) == ("1.0", "2.0", "worse")
    page.get_by_role("button", name="Markdown").first.click()
    page.wait_for_function("() => document.querySelector('output.said').value.endsWith('Markdown')")
    copied = page.evaluate("navigator.clipboard.readText()")
    assert copied.splitlines()[-1] == "| white | noise floor | 1.00 ± 0.02 | 2.00 ± 0.04 (worse) |"
    drawn_chart(page, 0)
    boxes = page.locator("fieldset.sources").first
    boxes.get_by_label("white · before").click()
    assert shown_curves(page, 0) == [1]
    context.close()


def test_a_phone_shows_a_value_beside_every_measure_of_runs(browser, tmp_path):
    """Of what lies to the right of the window nobody knows that it is there."""
    source = samples.source("gbn[gradients=20]", samples.random(16, 2, 9), 3, measured={"noise_floor": 1.0})
    run = Run(samples.manifest(), (source,))
    joined = joined_runs.joined(("before", "after"), (run, run))
    write_report(joined.run, tmp_path / "both.html", joined=joined)
    context = browser.new_context(viewport={"width": 390, "height": 844})
    page = context.new_page()
    page.set_default_timeout(LONG)
    page.goto((tmp_path / "both.html").as_uri())
    first_run = page.locator("table.runs tbody tr td:nth-child(3)").all()
    card = page.locator(".scroll").first.bounding_box()
    ends = [box["x"] + box["width"] for box in (cell.bounding_box() for cell in first_run)]
    assert 0 < max(ends) <= card["x"] + card["width"] <= 390
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    context.close()


def test_a_definition_opens_beside_its_name(opened):
    note = opened.locator("#about-noise_floor")
    assert not note.is_visible()
    ask = opened.get_by_role("button", name="Definition of noise floor")
    ask.click()
    assert note.is_visible()
    assert "Mean power over 0 < nu <= 0.25" in note.inner_text()
    assert abs(note.bounding_box()["x"] - ask.bounding_box()["x"]) < 40
    opened.keyboard.press("Escape")
    assert not note.is_visible()
