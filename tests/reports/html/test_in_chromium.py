"""The report in a real browser: used by clicks and keys, printed, without scripts, dark and light."""

from __future__ import annotations

import csv
import io
import re

import numpy as np
import pytest
from PIL import Image

from gbnbench.reports.comparison import table
from gbnbench.reports.html.page import write_report
from gbnbench.runs import joined_runs
from gbnbench.runs.comparison_result import Run
from gbnbench.studies import growing_report
from gbnbench.studies.growing_report import Unfinished
from tests.reports import samples

pytestmark = pytest.mark.slow

EVIL = "</script><b>%{y}</b>"
LONG = 30_000  # milliseconds; a busy machine is slow


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


def first_column(page):
    return page.locator("table.measures tbody tr:visible > th").all_inner_texts()


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
