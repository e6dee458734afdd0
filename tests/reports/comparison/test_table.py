"""The table of a comparison: the best of each column, and reasons for what is missing."""

import io
import math
from dataclasses import replace

import pytest
from rich.console import Console

from gbnbench.analysis.measure_definitions import DEFINITIONS
from gbnbench.core.number_text import NOTHING, error_number, number
from gbnbench.reports.comparison import markdown, table, terminal
from gbnbench.runs.comparison_result import Run
from tests.reports import samples


@pytest.fixture(scope="module")
def run() -> Run:
    """Three sources with hand-made measures: a clear best, a tie as read, an undefined value."""
    x = samples.random(16, 2, 3)
    values = (
        {"noise_floor": 1.2e-4, "peak": 3.211, "psi6": math.nan, "min_distance": 0.5, "anisotropy_db": -9.0},
        {"noise_floor": 3.4e-10, "peak": 3.212, "psi6": 0.55, "min_distance": 0.75, "anisotropy_db": -9.0},
        {"noise_floor": 0.98, "peak": 9.0, "psi6": 0.41, "min_distance": 0.01, "anisotropy_db": -9.0},
    )
    sources = [
        samples.source(label, x, 3, measured=measured, cpu=cpu)
        for label, measured, cpu in zip("abc", values, (0.5, 2.0, math.nan), strict=True)
    ]
    return Run(
        {}, tuple(sources), {(sources[0].key, "peak"): "worse", (sources[1].key, "noise_floor"): "better"}
    )


def best(run: Run, name: str) -> str:
    return "".join(row.source.label for row in table.rows(run) if row.cells[name].best)


@pytest.mark.parametrize(
    ("name", "labels"),
    [
        ("noise_floor", "b"),  # lower
        ("min_distance", "b"),  # higher
        ("peak", "ab"),  # 3.211 and 3.212 both read 3.21
        ("psi6", "c"),  # nan is never best
        ("anisotropy_db", ""),  # all tie
        ("cpu_seconds", "a"),
        ("evacuated_energy", ""),  # nobody has it
    ],
)
def test_best_of_a_column(run: Run, name: str, labels: str) -> None:
    assert best(run, name) == labels


def test_best_is_among_equal_n_and_d(run: Run) -> None:
    other = samples.source("a", samples.random(25, 2, 3), 3, measured={"noise_floor": 1e-20})
    assert best(replace(run, sources=(*run.sources, other)), "noise_floor") == "b"  # alone at its n: no mark


def test_every_measure_is_a_column_and_keeps_its_reason(run: Run) -> None:
    for row in table.rows(run):
        assert list(row.cells) == [*(definition.name for definition in DEFINITIONS), "cpu_seconds"]
        for name, cell in row.cells.items():
            assert math.isnan(cell.value) == (cell.text == NOTHING) == bool(cell.reason), name


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.001, "0.00100"),
        (0.0123456, "0.0123"),
        (99949.0, "99949"),
        (99999.4, "1.00e5"),
        (100000.0, "1.00e5"),
        (9.9996, "10.0"),
        (-0.5, "-0.500"),
        (4e-30, "4.00e-30"),
        (math.inf, "∞"),
        (-math.inf, "-∞"),
    ],
)
def test_number(value: float, text: str) -> None:
    assert number(value) == text


def test_shown_number_is_within_half_a_unit_of_its_third_digit() -> None:
    for exponent in range(-32, 9):
        for mantissa in (1.0, 1.2345, 9.994, 9.996):
            value = mantissa * 10.0**exponent
            assert float(number(value)) == pytest.approx(value, rel=0.0051)


@pytest.mark.parametrize(
    ("value", "error", "full"),
    [
        (0.995, 0.0123, "0.995 ± 0.012"),
        (1.234e-4, 5e-6, "(1.23 ± 0.05)e-4"),
        (1.234e-4, 5e-3, "(1.23 ± 50.00)e-4"),
        (3.21, 0.0004, "3.21 ± 0.0004"),
        (3.21, 0.0, "3.21 ± 0"),
        (3.23e-5, 1.97e-19, "(3.23 ± 0)e-5"),  # rounding
        (0.00181, 6e-16, "0.00181 ± 0"),
        (0.005, 6e-13, "0.00500 ± 6e-13"),
        (3.21, math.nan, "3.21"),
        (math.nan, math.nan, "–"),
        (-12.34, 0.56, "-12.3 ± 0.6"),
    ],
)
def test_standard_error_in_the_digits_of_its_value(value: float, error: float, full: str) -> None:
    assert table.Cell(value, error, number(value), error_number(value, error)).full == full


@pytest.mark.parametrize("width", [40, 60, 80, 120, 200, 400])
def test_terminal_table_fits_and_is_not_cut(run: Run, width: int) -> None:
    text = terminal.terminal_text(run, width)
    lines = text.split("\n")
    assert max(map(len, lines)) <= width
    rows = [line for line in lines if line[:2] in ("a ", "b ", "c ")]
    assert len(rows) == 3
    assert "3.40e-10" in rows[1] or "(3.40 ± 0.07)e-10*" in rows[1]
    assert "…" not in text
    if width == 400:
        assert "±" in text
        assert "▲" in rows[1]
        assert "▼" in rows[0]
        assert "left out" not in text
    if width == 40:
        assert "more measures" in " ".join(lines)


def test_terminal_table_is_a_rich_table_that_takes_labels_literally(run: Run) -> None:
    odd = samples.source("gbn[iterations=10][/red]\n\x1b[31m" + "x" * 90, samples.random(16, 2, 3), 3)
    console = Console(width=100, record=True, file=io.StringIO())
    console.print(terminal.terminal_table(replace(run, sources=(odd,)), 100))
    text = console.export_text()
    assert "gbn[iterations=10]" in text
    assert "\x1b" not in text


def test_markdown_has_equal_cells_and_escapes(run: Run) -> None:
    odd = samples.source("a|b <script> *x*", samples.random(16, 2, 3), 3)
    text = markdown.markdown_table(replace(run, sources=(*run.sources, odd)), ["noise_floor", "cpu_seconds"])
    lines = text.strip().split("\n")
    assert {line.replace("\\|", "").count("|") for line in lines} == {4}
    assert "a\\|b \\<script\\> \\*x\\*" in lines[-1]
    assert lines[3] == "| b | **3.40e-10** ▲ | 2.00 |"


def test_single_realization_has_no_errors() -> None:
    run = Run({}, (samples.source("random", samples.random(16, 2, 1), 3),))
    assert all(cell.error_text == "" for cell in table.rows(run)[0].cells.values())
