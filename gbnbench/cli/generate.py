"""``gbnbench generate``: point sets of a generator, written to a file."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gbnbench.cli import options
from gbnbench.cli.executor_option import executor, workers_wanted
from gbnbench.cli.needed_unless import NeededUnless
from gbnbench.core.atomic_write import check_folder, remove_leftovers_of
from gbnbench.core.errors import InputError
from gbnbench.core.readable_text import counted

if TYPE_CHECKING:
    import pandas as pd

    from gbnbench.generators.monitor import Monitor, Trace

PATIENCE = 1.0  # seconds before progress is shown


@click.command(cls=options.Command)
@click.argument("name")
@click.option("-n", "n", type=click.IntRange(1), default=1024, show_default=True, help="Points in a set.")
@click.option("-d", "d", type=click.IntRange(1), default=2, show_default=True, help="Dimension.")
@options.out_file(
    "File to write; one that exists is replaced. Its suffix says the format. --explain needs none.",
    cls=NeededUnless, unless="explain",
)  # fmt: skip
@click.option(
    "--checkpoint", type=click.Path(path_type=Path, dir_okay=False),
    help="File that keeps the state of a long run, from which the same command continues. It is removed at "
    "the end.",
)  # fmt: skip
@click.option(
    "--trace", type=click.Path(path_type=Path, dir_okay=False),
    help="CSV to write energy, excess energy, largest force and step in, a row for each gradient.",
)  # fmt: skip
@click.option(
    "--spectra-at", type=options.WholeNumbers(), default=(), metavar="GRADIENTS",
    help="With --trace: write the radial power after these numbers of gradients, such as 10,100,300, to "
    "TRACE-spectra.csv.",
)  # fmt: skip
@click.option("--explain", is_flag=True, help="Only say how the energy would be computed, and at what cost.")
@options.realizations(1)
@options.seed
@click.option(
    "--jobs", type=click.IntRange(1),
    help="Generate the sets by this many processes of one thread each, piece by piece. If it is stopped, the "
    "same command continues it.  [default: this process moves all sets together]",
)  # fmt: skip
@executor
@options.quiet
@options.device
def generate(
    name: str, n: int, d: int, realizations: int, seed: int, out: Path | None, checkpoint: Path | None,
    trace: Path | None, spectra_at: tuple[int, ...], explain: bool, jobs: int | None, quiet: bool,
) -> None:  # fmt: skip
    """Make point sets and write them to a file.

    NAME is one of "gbnbench generators", such as gbn or 'gbn[iterations=1000]'. With --jobs or
    --executor, workers generate the sets; the sets are the same however many workers there are.
    """
    from gbnbench.cli import generate_by_workers as by_workers
    from gbnbench.generators.gbn.generator import GaussianBlueNoise
    from gbnbench.generators.monitor import Trace
    from gbnbench.generators.registry import find
    from gbnbench.generators.registry import generate as draw
    from gbnbench.generators.spectral_control.ring_means import RingMeans
    from gbnbench.io.points import load, save
    from gbnbench.io.points.writer import encode, write_atomically

    if spectra_at and trace is None:
        raise click.UsageError("--spectra-at goes with --trace FILE")
    if trace is not None and trace.suffix != ".csv":
        raise InputError(f"a trace is a .csv file; got {trace}")
    generator = find(name)
    gbn = generator if isinstance(generator, GaussianBlueNoise) else None
    if gbn is not None and max(spectra_at, default=0) > gbn.steps:
        raise InputError(
            f"--spectra-at must be at most {gbn.steps}, the gradients of {name}; got {max(spectra_at)}"
        )
    if explain or out is None:  # which only --explain may lack
        click.echo(gbn.explain(n, d, realizations) if gbn else f"{generator.name}: {generator.summary}")
        return
    encode(out, [[[0.0] * d]] * min(realizations, 2))  # what cannot be written is refused before the work
    for path in (out, trace, checkpoint):
        check_folder(path)
    if checkpoint is not None and checkpoint.absolute() in (out.absolute(), trace and trace.absolute()):
        raise InputError(f"a checkpoint needs a file of its own; got {checkpoint} for two")
    sets = f"{counted(realizations, 'set')} of {counted(n, 'point')}, d={d}"
    replaced = ", replacing what was there" if out.exists() else ""
    if workers_wanted():
        by_workers.check_alone()
        reused = by_workers.generate_by_workers(generator, n, d, realizations, seed, out, jobs, quiet)
        click.echo(f"wrote {out}: {sets}{replaced}{reused}")
        if isinstance(generator, RingMeans):
            click.echo(generator.fit(load(out)))
        return
    kept = None if trace is None else Trace(keep_at=spectra_at)
    with _monitored(kept, checkpoint, quiet) as monitor:
        x = draw(name, n=n, d=d, seed=seed, realizations=realizations, monitor=monitor)
    save(out, x)
    click.echo(f"wrote {out}: {sets}{replaced}")
    if isinstance(generator, RingMeans):
        click.echo(generator.fit(x))
    if trace is not None and kept is not None:
        write_atomically(trace, kept.to_frame().to_csv(index=False).encode())
        click.echo(f"wrote {trace}: {len(kept.rows)} rows")
        if spectra_at:
            beside = trace.with_name(f"{trace.stem}-spectra.csv")
            write_atomically(beside, _spectra(kept).to_csv(index=False).encode())
            reached = ", ".join(map(str, sorted(kept.kept))) or "none of so many"
            click.echo(f"wrote {beside}: radial power after {reached} gradients")
    if checkpoint is not None:
        checkpoint.unlink(missing_ok=True)
        remove_leftovers_of(checkpoint)


@contextlib.contextmanager
def _monitored(trace: Trace | None, checkpoint: Path | None, quiet: bool) -> Iterator[Monitor]:
    """Progress once a draw has taken a second; on being stopped, say how to go on."""
    from gbnbench.execution import progress
    from gbnbench.generators.monitor import Monitor

    began = time.monotonic()
    with contextlib.ExitStack() as stack:
        shown: progress.Progress | None = None
        counted = most = 0

        def tell(done: int, total: int, doing: str) -> None:
            nonlocal shown, counted, most
            most = total
            if shown is None:
                if time.monotonic() - began < PATIENCE:
                    return
                shown = stack.enter_context(progress.choose(quiet))
                shown.start(total, done, doing)
            else:
                shown.advance(doing, done - counted)
            counted = done

        try:
            yield Monitor(tell, trace, checkpoint)
            if shown is not None:
                shown.advance("done", most - counted)
        except KeyboardInterrupt:
            if checkpoint is not None and checkpoint.exists():
                raise KeyboardInterrupt(f"repeat the command to continue from {checkpoint}") from None
            raise


def _spectra(trace: Trace) -> pd.DataFrame:
    """Columns gradients, frequency, nu, power, filtered, count: shells of the mean spectrum (Figure 7)."""
    import pandas as pd

    from gbnbench.analysis.radial.radial_power import radial
    from gbnbench.analysis.spectrum.limits import default_fmax
    from gbnbench.analysis.spectrum.periodogram import periodogram

    frames = []
    for at in sorted(trace.kept):
        x = trace.points(at)
        sets, n, d = x.shape
        spectrum = periodogram(x, default_fmax(n, d, sets))
        frame = radial(spectrum).to_frame()
        frame.insert(0, "gradients", at)
        frame.insert(4, "filtered", radial(spectrum).filtered(1.0).power)
        frames.append(frame)
    columns = ["gradients", "frequency", "nu", "power", "filtered", "count"]
    return pd.concat(frames) if frames else pd.DataFrame(columns=columns)
