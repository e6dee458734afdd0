"""The examples of the pages: Python runs, commands are understood, and those marked to run do.

Blocks of Python, of ``>>>`` with what comes out too, run in the order of their page, in a folder of its own.
Those too heavy stand under ``<!-- skip: next "the reason" -->``, commands to be run under ``<!-- run -->``.
"""

from __future__ import annotations

import re
from pathlib import Path
from unittest import SkipTest

import click
import pytest
from sybil import Example
from sybil.document import Document
from sybil.parsers.markdown import CodeBlockParser, PythonCodeBlockParser, SkipParser

from gbnbench.cli import run
from gbnbench.core.errors import InputError
from tests.docs.commands import check, commands
from tests.paths import ROOT

OWN = {"adding.md"}  # whose files are written out and run by a test of their own
PAGES = sorted(p for p in [*ROOT.glob("*.md"), *(ROOT / "docs").glob("*.md")] if p.name not in OWN)
SHELLS = ("sh", "bash", "console")
NAMES = [str(page.relative_to(ROOT)) for page in PAGES]


def run_commands(example: Example) -> None:
    if example.document.text[: example.region.start].rstrip().endswith("<!-- run -->"):
        for arguments in commands(example.parsed):
            assert run(arguments) == 0, arguments


def document(page: Path) -> Document:
    shells = [CodeBlockParser(shell, run_commands) for shell in SHELLS]
    return Document.parse(str(page), PythonCodeBlockParser(), SkipParser(), *shells)


HEAVY = (
    "README.md",
    "adaptive.md",
    "scaling.md",
    "integration.md",
    "domains.md",
    "formats.md",
    "stippling.md",
    "choosing.md",
)  # seconds each


@pytest.mark.parametrize(
    "page",
    [pytest.param(page, marks=pytest.mark.slow) if page.name in HEAVY else page for page in PAGES],
    ids=NAMES,
)
def test_the_python_of_a_page_runs(page, tmp_path, monkeypatch, subtests):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    for example in document(page).examples():
        with subtests.test(f"line {example.line}"):
            try:
                example.evaluate()
            except SkipTest as reason:
                pytest.skip(str(reason))


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_the_commands_of_a_page_are_understood(page, subtests):
    text = page.read_text()
    fences = re.compile(rf"^```(?:{'|'.join(SHELLS)})\n(.*?)^```", re.MULTILINE | re.DOTALL)
    spans = re.compile(r"`(gbnbench [^`]+)`")
    for pattern in (fences, spans):
        for found in pattern.finditer(text):
            for arguments in commands(found[1]):
                with subtests.test(" ".join(arguments)):
                    check(arguments, whole=pattern is fences)


def test_no_page_hides_code_from_these_tests():
    for page in PAGES:
        inside = None
        for number, line in enumerate(page.read_text().splitlines(), 1):
            where = f"{page.relative_to(ROOT)}, line {number}"
            if line.lstrip().startswith("```"):
                inside = None if inside is not None else line.strip("` ")
                assert inside != "", f"{where}: a fence must name its language"
            if re.match(r"\s*>>> ", line):
                assert inside == "python", f"{where}: >>> stands in a fence of python"
            if inside in (None, "text"):
                assert not re.match(r"\s*(\$ )?gbnbench [a-z]", line), f"{where}: a command in a fence of sh"


@pytest.mark.parametrize(
    "line",
    [
        "gbnbench comparison",
        "gbnbench compare --sets 3",
        "gbnbench compare -n many",
        "gbnbench compare 'gbn[sigma=9]'",
        "gbnbench generate gbn -n 16",
        "gbnbench generate nbg -n 16 -o x.txt",
        "gbnbench report",
        "ls && GBNBENCH_DEVICE=0 gbnbench devices --all | head",
    ],
)
def test_a_command_that_is_wrong_is_found(line):
    (arguments,) = commands(line)
    with pytest.raises((click.UsageError, InputError)):
        check(arguments)


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("gbnbench compare 'gbn[sigma=0.8]' -n 256  # both", [["compare", "gbn[sigma=0.8]", "-n", "256"]]),
        ("gbnbench generate NAME -n ... -o FILE && gbnbench analyze FILE --json > x.json",
         [["generate", "NAME", "-n", "...", "-o", "FILE"], ["analyze", "FILE", "--json"]]),
        ("make docs; pip install gbnbench", []),
    ],
)  # fmt: skip
def test_commands_are_found_among_others(line, expected):
    assert list(commands(line)) == expected
    for arguments in expected:
        if "NAME" not in arguments:
            check(arguments)
