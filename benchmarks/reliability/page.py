"""docs/reliability.md, from the table of trials: every number on it is one of the table's."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import resources

from gbnbench.benchmarks.reliability.registry import PARTS, Part
from gbnbench.benchmarks.reliability.table import Table
from gbnbench.benchmarks.reliability.trial import FAULT, UNTRIED, Trials, summed
from gbnbench.core.prose_lines import paragraph

HEAD, PACKAGE = "head.md", "gbnbench.benchmarks.reliability"


def trials_of(part: Part, table: Table) -> list[Trials]:
    """Return all trials of a part, summed over its pieces.

    Parameters
    ----------
    part : Part
        Which.
    table : Table
        Results by piece.

    Returns
    -------
    list of Trials
    """
    order = {piece.key: k for k, piece in enumerate(part.pieces(False))}
    keys = sorted(
        (key for key in table if key.split("/")[0] == part.name), key=lambda k: (order.get(k, 0), k)
    )
    return summed(one for key in keys for one in table[key].trials)


def page(table: Table) -> str:
    """Return the whole page."""
    every = [one for result in table.values() for one in result.trials]
    faults = sum(one.count for one in every if one.verdict == FAULT)
    counts = f"{sum(one.count for one in every):,} trials, {faults or 'no'} fault{'s' * (faults != 1)}."
    pieces = [piece.key for part in PARTS for piece in part.pieces(False)]
    missing = sum(key not in table for key in pieces)
    if missing:
        counts += f" Not finished: {missing} of {len(pieces)} pieces are still to be tried."
    minutes = sum(result.seconds for result in table.values()) / 60
    time = f"; its pieces took\n{minutes:.0f} minutes one after the other, and two ran at a time"
    head = resources.files(PACKAGE).joinpath(HEAD).read_text(encoding="utf-8")
    lines = [head.replace("{counts}", counts).replace("{time}", time)]
    lines += ["| part | pieces carried out | trials | faults | not available here |", "|---|--:|--:|--:|--:|"]
    lines += [_part_row(part, table) for part in PARTS]
    for part in PARTS:
        lines += ["", f"## {part.title}", "", paragraph(part.says), ""]
        trials = trials_of(part, table)
        lines += _file_table(trials) if part.name == "files" else _plain_table(trials)
    return "\n".join(lines) + "\n"


def _part_row(part: Part, table: Table) -> str:
    trials, pieces = trials_of(part, table), part.pieces(False)
    done = sum(piece.key in table for piece in pieces)
    faults = sum(one.count for one in trials if one.verdict == FAULT)
    untried = sum(one.verdict == UNTRIED for one in trials)
    total = sum(one.count for one in trials)
    title = f"[{part.title}](#{_anchor(part.title)})"
    return f"| {title} | {done} of {len(pieces)} | {total:,} | {faults:,} | {untried or ''} |"


def _plain_table(trials: list[Trials]) -> Iterator[str]:
    if not trials:
        yield "Not tried yet."
        return
    yield "| | tried | outcome | trials |"
    yield "|---|---|---|--:|"
    for one in trials:
        bold = "**" if one.verdict == FAULT else ""
        said = f"{bold}{one.outcome}{bold}" + (f": {_cell(one.note)}" if one.note else "")
        yield f"| {one.subject} | {_cell(one.tried)} | {said} | {one.count:,} |"


def _file_table(trials: list[Trials]) -> Iterator[str]:
    """Yield formats by outcomes, with the slowest file and the most memory."""
    if not trials:
        yield "Not tried yet."
        return
    outcomes = list(dict.fromkeys(one.outcome for one in sorted(trials, key=lambda t: t.verdict == FAULT)))
    yield "| format | files | " + " | ".join(outcomes) + " | slowest, s | most memory, MB |"
    yield "|---|" + "--:|" * (len(outcomes) + 3)
    for name in dict.fromkeys(one.subject for one in trials):
        yield _file_row(name, [one for one in trials if one.subject == name], outcomes)
    yield _file_row("all", trials, outcomes)
    yield ""
    yield "By what was done to the file:"
    yield ""
    yield "| damage | files | read | refused | faults |"
    yield "|---|--:|--:|--:|--:|"
    for done in dict.fromkeys(one.tried for one in trials):
        of = [one for one in trials if one.tried == done]
        read = sum(one.count for one in of if one.outcome.startswith("read") and one.verdict != FAULT)
        faults = sum(one.count for one in of if one.verdict == FAULT)
        total = sum(one.count for one in of)
        yield f"| {done} | {total:,} | {read:,} | {total - read - faults:,} | {faults:,} |"


def _file_row(name: str, trials: list[Trials], outcomes: list[str]) -> str:
    counts = [sum(one.count for one in trials if one.outcome == outcome) for outcome in outcomes]
    slowest, memory = max(one.slowest for one in trials), max(one.memory for one in trials)
    cells = [name, *(f"{count:,}" for count in (sum(counts), *counts)), f"{slowest:.2g}", f"{memory:.0f}"]
    return f"| {' | '.join(cells)} |"


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("<", "\\<")


def _anchor(title: str) -> str:
    return title.lower().replace(",", "").replace(" ", "-")
