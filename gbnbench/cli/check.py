"""``gbnbench check``: regression cases of floors, order and energy, held against their stored values."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gbnbench.cli import options
from gbnbench.core.text_table import aligned

if TYPE_CHECKING:
    from gbnbench.execution.progress import Progress
    from gbnbench.regression.cases import Case
    from gbnbench.regression.runner import ExpectationChange
    from gbnbench.regression.verdict import Verdict

MARKS = {"ok": "ok", "better": "▲ better", "worse": "▼ worse", "skipped": "skipped"}
HEAD = ("", "case", "measure", "found", "expected", "allowed")
SEEDS = 24
WIDE = 10.0  # a factor that is allowed, above which a measure guards little


@click.command(cls=options.Command)
@click.option("--only", multiple=True, metavar="NAME", help="Only this case; may be given several times.")
@click.option(
    "--cases", "path", type=click.Path(path_type=Path), help="File of cases.  [default: gbnbench's own]"
)
@click.option("--update", is_flag=True, help="Measure the expected values anew, and rewrite the file.")
@click.option(
    "--spread", type=click.IntRange(3), metavar="SEEDS",
    help=f"With --update: seeds over which values and tolerances are measured.  [default: {SEEDS}]",
)  # fmt: skip
@options.quick_or_full("--full is every case: larger sets, longer runs, more generators.", default="quick")
@options.json
@click.option(
    "--jobs", type=click.IntRange(1),
    help="Worker processes; 1 does all the work in this process.  [default: one per core]",
)  # fmt: skip
@click.option("--quiet", is_flag=True, help="No progress, and only the lines of the table that are not ok.")
@options.device
def check(
    quick: bool,
    only: tuple[str, ...],
    path: Path | None,
    update: bool,
    spread: int | None,
    as_json: bool,
    jobs: int | None,
    quiet: bool,
) -> None:
    """Check that noise floors are what they were.

    The cases are seeded sets of several generators, whose floor, peak and order are compared with their
    spread over seeds, and exact values: the energy's field at fixed points and the spectra of lattices,
    in double and float. Whatever is worse than expected is named, and the exit code is then 1.
    """
    from gbnbench.execution import progress
    from gbnbench.regression.case_file import default_path, read_cases
    from gbnbench.regression.cases import select

    if spread is not None and not update:
        raise click.UsageError("--spread goes with --update")
    file = path or default_path()
    every = read_cases(file)
    chosen = select(every, only, not quick)
    workers = jobs or os.cpu_count() or 1
    with progress.choose(quiet or as_json) as teller:
        if update:
            bad = _update(file, every, chosen, spread or SEEDS, workers, as_json, teller)
        else:
            bad = _check(chosen, workers, as_json, quiet, teller)
    if bad:
        click.get_current_context().exit(1)


def _check(chosen: Sequence[Case], jobs: int, as_json: bool, quiet: bool, teller: Progress) -> bool:
    """Measure, print the table and the sentences; whether anything is worse."""
    from gbnbench.regression.runner import check as measure

    verdicts = measure(chosen, jobs=jobs, progress=teller)
    if as_json:
        click.echo(json.dumps([_entry(verdict) for verdict in verdicts], indent=2, allow_nan=False))
    else:
        for line in _table(verdicts, quiet):
            click.echo(line)
    return _tell(verdicts)


def _update(
    file: Path,
    every: Sequence[Case],
    chosen: Sequence[Case],
    seeds: int,
    jobs: int,
    as_json: bool,
    teller: Progress,
) -> bool:
    """Rewrite the file, unless what is known exactly comes out wrong; whether it did."""
    from gbnbench.regression.case_file import write_cases
    from gbnbench.regression.runner import check as measure
    from gbnbench.regression.runner import update as renew

    known = [case for case in every if case.exact and not case.full]
    verdicts = measure(known, jobs=jobs, progress=teller)
    if _tell(verdicts):
        click.echo(f"gbnbench: {file} was left as it is: mend that first", err=True)
        return True
    renewed, changes = renew(chosen, seeds, jobs=jobs, progress=teller)
    by_name = {case.name: case for case in renewed}
    if changes:
        write_cases(file, [by_name.get(case.name, case) for case in every])
    if as_json:
        click.echo(json.dumps([_change_entry(change) for change in changes], indent=2, allow_nan=False))
        return False
    for line in _changes(changes):
        click.echo(line)
    for change in changes:
        if change.after.scale == "ratio" and change.after.tolerance > WIDE:
            click.echo(
                f"gbnbench: {change.case}: {change.measure} varies so much that {change.after.tolerance:g} "
                "times is allowed, which guards little: take more realizations, or another measure",
                err=True,
            )
    click.echo(f"{file}: {len(changes)} values measured over {seeds} seeds")
    return False


def _tell(verdicts: Sequence[Verdict]) -> bool:
    """Say in words what is worse or better; whether anything is worse."""
    worse = {verdict.case.name for verdict in verdicts if verdict.word == "worse"}
    for verdict in verdicts:
        if verdict.text:
            better = verdict.word == "better" and verdict.case.name not in worse
            advice = "; better: run gbnbench check --update to keep it" if better else ""
            click.echo(f"gbnbench: {verdict.text}{advice}", err=True)
    return bool(worse)


def _table(verdicts: Sequence[Verdict], quiet: bool) -> Iterator[str]:
    from gbnbench.regression.verdict import allowed, shown, title

    rows = [
        (
            MARKS[verdict.word], verdict.case.name, title(verdict.measure), shown(verdict.found),
            shown(verdict.expectation.expected), allowed(verdict.expectation),
        )
        for verdict in verdicts
        if verdict.word != "ok" or not quiet
    ]  # fmt: skip
    if rows:
        yield from aligned(HEAD, rows)
    words = [verdict.word for verdict in verdicts]
    cases = len({verdict.case.name for verdict in verdicts})
    counts = ", ".join(f"{words.count(word)} {word}" for word in MARKS if word in words)
    yield f"{len(verdicts)} values of {cases} cases: {counts}"


def _changes(changes: Sequence[ExpectationChange]) -> Iterator[str]:
    """Lay out old -> new of every value."""
    from gbnbench.regression.verdict import allowed, shown, title

    yield from aligned(
        ("case", "measure", "expected", "was", "change", "allowed", "was"),
        [
            (
                change.case, title(change.measure), shown(change.after.expected),
                shown(change.before.expected), _moved(change),
                allowed(change.after), allowed(change.before) if change.before.expected else "–",
            )
            for change in changes
        ],
    )  # fmt: skip


def _moved(change: ExpectationChange) -> str:
    from gbnbench.core.number_text import number

    if not change.before.expected:
        return "new"
    before, after = change.before.expected[0], change.after.expected[0]
    if before == after:
        return "–"
    return f"×{number(after / before)}" if change.after.scale == "ratio" else f"{after - before:+.3g}"


def _entry(verdict: Verdict) -> dict[str, Any]:
    case, expectation = verdict.case, verdict.expectation
    return {
        "case": case.name,
        "kind": case.kind,
        "n": case.n,
        "d": case.d,
        "measure": verdict.measure,
        "verdict": verdict.word,
        "found": [_or_null(value) for value in verdict.found],
        "expected": list(expectation.expected),
        "scale": expectation.scale,
        "better": expectation.better,
        "departure": _or_null(verdict.departure),
        "tolerance": expectation.tolerance,
        "text": verdict.text,
    }


def _change_entry(change: ExpectationChange) -> dict[str, Any]:
    sides = {"before": change.before, "after": change.after}
    return {
        "case": change.case,
        "measure": change.measure,
        **{
            side: {"expected": list(expectation.expected), "tolerance": expectation.tolerance}
            for side, expectation in sides.items()
        },
    }


def _or_null(value: float) -> float | None:
    return value if math.isfinite(value) else None
