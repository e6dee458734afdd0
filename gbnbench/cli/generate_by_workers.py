"""``gbnbench generate`` with ``--jobs`` or ``--executor``: sets drawn piece by piece by workers."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from gbnbench.core.errors import RefusalError
from gbnbench.core.memory import too_large

if TYPE_CHECKING:
    from gbnbench.generators.protocol import Generator

ALONE = {"checkpoint": "--checkpoint", "trace": "--trace"}  # what one process keeps of one optimiser


def check_alone() -> None:
    """Refuse options that are of a single process.

    Raises
    ------
    click.UsageError
        If one stands beside workers.
    """
    given = click.get_current_context().params
    for name, option in ALONE.items():
        if given[name] is not None:
            raise click.UsageError(
                f"{option} is of sets that one process draws together: leave out --jobs and --executor, by "
                "which finished pieces are kept in any case"
            )


def generate_by_workers(
    generator: Generator, n: int, d: int, realizations: int, seed: int, out: Path, jobs: int | None,
    quiet: bool,
) -> str:  # fmt: skip
    """Draw sets by the workers of the executor in force and write them to a file.

    Parameters
    ----------
    generator : Generator
        What draws them.
    n, d, realizations, seed, out, jobs, quiet
        As the command takes them.

    Returns
    -------
    str
        Which pieces an earlier call had drawn, for the last line; empty where none.

    Raises
    ------
    RefusalError
        If the file is of a format that is put together in memory, and the sets are too many for that.
    GbnbenchError
        As ``draw_by_workers`` raises them.
    """
    from gbnbench.execution import progress
    from gbnbench.io.points.files_in_parts import save_parts, takes_parts
    from gbnbench.studies.drawn_sets import DrawnSets, draw_by_workers

    if not takes_parts(out) and (reason := too_large(8.0 * realizations * n * d)):
        raise RefusalError(
            f"{realizations} sets of n={n} points in d={d} {reason}; an .npy is written piece by piece"
        )
    with progress.choose(quiet) as teller:

        def save(drawn: DrawnSets) -> None:
            teller.advance(f"writing {out}", 0)
            save_parts(out, drawn.shape, drawn.parts())

        folder = out.with_name(f"{out.name}.pieces")
        drawn = draw_by_workers(generator, n, d, realizations, seed, folder, save, jobs, teller)
    return f", {drawn.reused} of {drawn.pieces} pieces reused" if drawn.reused else ""
