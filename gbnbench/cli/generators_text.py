"""The lines of ``gbnbench generators``: the list, one described, published figures beside ours."""

from __future__ import annotations

import dataclasses
import itertools
import re
import textwrap
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from gbnbench.core.number_text import number
from gbnbench.core.readable_text import display_width, left
from gbnbench.core.text_table import aligned
from gbnbench.generators.listing import OWN, GeneratorEntry, cost_machine, record

if TYPE_CHECKING:
    from gbnbench.generators.description import Description, ServedSizes, Setting
    from gbnbench.verification.verify import Verified

WIDTH = 100  # columns of folded text
NOTHING = "–"


def list_lines(entries: Sequence[GeneratorEntry]) -> Iterator[str]:
    """Lay out the list of generators.

    Parameters
    ----------
    entries : sequence of GeneratorEntry
        In order.

    Yields
    ------
    str
        A line each, then how costs were measured.
    """
    yield from aligned(
        ("name", "family", "d", "domain", "CPU s", "reference"),
        [
            (
                one.name, one.family or NOTHING, one.dimensions_text, one.domain or NOTHING, cost_text(one),
                one.reference or (NOTHING if one.origin == OWN else one.origin),
            )
            for one in entries
        ],
    )  # fmt: skip
    yield f"CPU s: of a set of 1,024 points in 2D ({cost_machine()}); 'gbnbench generators NAME' says more"


def cost_text(one: GeneratorEntry) -> str:
    """Write the cost of a generator, with n where it is not 1,024."""
    size = "" if one.cost.n == 1024 else f" (n={one.cost.n})"
    return f"{number(one.cost.cpu_seconds)}{size}"


def description_lines(one: GeneratorEntry, description: Description) -> Iterator[str]:
    """Lay out the description of a generator.

    Parameters
    ----------
    one : GeneratorEntry
        Its row of the list.
    description : Description
        What its docstring says and what it serves.

    Yields
    ------
    str
    """
    yield f"{one.name}: {one.summary}"
    yield ""
    if description.opening.rstrip(".") != one.summary.rstrip("."):
        yield from _paragraphs(description.opening)
        yield ""
    facts = {
        "family": one.family,
        "dimensions": one.dimensions_text,
        "domain": one.domain,
        "cost": f"{cost_text(one)} CPU s a set of 1,024 points in 2D ({cost_machine()})"
        if one.cost.cpu_seconds == one.cost.cpu_seconds
        else "not measured",
        "reference": one.reference,
        "from": "" if one.origin == OWN else one.origin,
    }
    for title, fact in facts.items():
        if fact:
            yield f"{title:<12}{fact}"
    yield ""
    yield "Settings:" if description.settings else "It has no settings."
    for setting in description.settings:
        yield f"  {setting.name} = {_value(setting.value)}  ({_note(setting)})"
        yield from textwrap.wrap(
            _plain(setting.meaning), WIDTH, initial_indent="    ", subsequent_indent="    "
        )
    yield ""
    sizes = sorted({n for one in description.serves for n in (*one.n, *one.refused)})
    yield f"Takes, of n = {_listed(sizes)} points:"
    for line in _served(description.serves):
        yield from textwrap.wrap(line, WIDTH, initial_indent="  ", subsequent_indent="         ")
    for title, text in (("Notes", description.notes), ("References", description.references)):
        if text:
            yield ""
            yield f"{title}:"
            yield from (f"  {line}" if line else "" for line in _paragraphs(text))


def description_record(one: GeneratorEntry, description: Description) -> dict[str, Any]:
    """Return a description as plain values for JSON.

    Parameters
    ----------
    one : GeneratorEntry
        Its row of the list.
    description : Description
        What its docstring says and what it serves.

    Returns
    -------
    dict
    """
    return {**record(one), **dataclasses.asdict(description)}


def verified_lines(found: Sequence[Verified]) -> Iterator[str]:
    """Lay out published figures beside ours.

    Parameters
    ----------
    found : sequence of Verified
        In order.

    Yields
    ------
    str
        A line each, ours agreeing if it lies between "from" and "to"; then how many agree, then the reasons
        of failures.
    """
    lines = list(
        aligned(
            ("", "generator", "measure", "published", "ours", "from", "to"),
            [
                (
                    "ok" if one.agrees else "▼ no", one.figure.generator, one.figure.measure_name,
                    one.figure.published, number(one.ours), number(one.figure.low), number(one.figure.high),
                )
                for one in found
            ],
        )
    )  # fmt: skip
    width = max(map(display_width, lines))
    for line, reason in zip(lines, ("why so far", *(one.figure.reason for one in found)), strict=True):
        yield f"{left(line, width)}  {reason}"
    agreeing = sum(one.agrees for one in found)
    yield f"{agreeing} of {len(found)} published figures agree"
    yield from dict.fromkeys(f"{one.figure.generator}: {one.failure}" for one in found if one.failure)


def verified_record(one: Verified) -> dict[str, Any]:
    """Return a published figure beside ours as plain values for JSON."""
    figure = dataclasses.asdict(one.figure) | {"measure": one.figure.measure_name}
    return {**figure, "ours": one.ours, "agrees": one.agrees, "failure": one.failure}


def _note(setting: Setting) -> str:
    changed = "" if setting.value == setting.default else f"; default {_value(setting.default)}"
    return f"{setting.type}{changed}"


def _value(value: object) -> str:
    return str(value).lower() if value is None or isinstance(value, bool) else str(value)


def _served(serves: Sequence[ServedSizes]) -> Iterator[str]:
    """Lay out what is served, with those dimensions in one line of which all, or none, is."""

    def kind(one: ServedSizes) -> tuple[bool, bool, int]:
        return bool(one.n), bool(one.refused), one.d if one.n and one.refused else 0

    for _, group in itertools.groupby(serves, kind):
        same = list(group)
        first, head = same[0], f"d = {_listed([one.d for one in same])}  "
        if not first.refused:
            yield f"{head}all"
            continue
        n, reason = max(first.refused.items(), key=lambda item: (item[0] == 1000, item[0]))
        if first.n:
            yield f"{head}n = {_listed(first.n)}; not {_listed(list(first.refused))} (for {n}: {reason})"
        else:
            yield f"{head}none: {reason}"


def _listed(numbers: Sequence[int]) -> str:
    return ", ".join(map(str, numbers))


def _paragraphs(text: str) -> Iterator[str]:
    """Fold running text; what is indented, such as a formula, stays."""
    for k, paragraph in enumerate(text.split("\n\n")):
        if k:
            yield ""
        lines = paragraph.splitlines()
        if any(line.startswith((" ", "- ", "..")) for line in lines):
            yield from map(_plain, lines)
        else:
            yield from textwrap.wrap(_plain(" ".join(lines)), WIDTH - 2)


def _plain(text: str) -> str:
    """Drop the marks of code."""
    return re.sub(r"``?([^`]+)``?", r"\1", text)
