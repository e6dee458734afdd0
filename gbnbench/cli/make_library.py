"""``gbnbench library``: ready point sets made by one command, listed, checked and unpacked."""

from __future__ import annotations

from pathlib import Path

import click

from gbnbench.cli import options
from gbnbench.cli.executor_option import executor
from gbnbench.cli.size_ranges import NumberRanges

EPILOG = """\b
Examples:
  gbnbench library --dry-run                    what the whole library holds, and what it would cost
  gbnbench library -o sets -d 2,3 -n 16-4096    a part of it; other parts can be added to the same folder
  gbnbench library gbn -d 2 -n 1024 -o gbn.zip  an archive: .zip, .tar.gz or .tar
  gbnbench library --list bundled               the sets that are installed with gbnbench
  gbnbench library --unpack bundled -o sets     these as files
  gbnbench library --check sets                 exit code 1 where a file is damaged, which is named
"""


@click.command(cls=options.Command, epilog=EPILOG)
@click.argument("generators", nargs=-1)
@click.option(
    "-n", "n", type=NumberRanges(doubling=True), default="16-65536", show_default=True,
    help="Points in a set; a range means the powers of two in it.",
)  # fmt: skip
@click.option("-d", "d", type=NumberRanges(), default="1-8", show_default=True, help="Dimensions.")
@options.out_folder("Folder, or archive if its suffix says so; what it holds already is kept and added to.")
@click.option(
    "--dry-run", is_flag=True, help="Only say what would be made, what would be refused, and at what cost."
)
@click.option("--list", "listed", metavar="LIBRARY", help="List the files of a library, with measures.")
@click.option("--check", "checked", metavar="LIBRARY", help="Check every file against its SHA-256.")
@click.option("--unpack", "unpacked", metavar="LIBRARY", help="Write the files of a library to a new folder.")
@options.realizations(8)
@options.seed
@options.jobs
@executor
@options.quiet
@options.device
def library(
    generators: tuple[str, ...], n: tuple[int, ...], d: tuple[int, ...], realizations: int, seed: int,
    out: Path | None, dry_run: bool, listed: str | None, checked: str | None, unpacked: str | None,
    jobs: int | None, quiet: bool,
) -> None:  # fmt: skip
    """Ready point sets in files, with measures and checksums.

    GENERATORS are those of "gbnbench generators", by default gbn, deep, stealthy and bnot. However a run
    is stopped, the same command continues it and writes the same bits. A LIBRARY is a folder, an archive,
    or "bundled", the choice of sets that is installed.
    """
    reading = [text for text in (listed, checked, unpacked) if text is not None]
    if len(reading) > 1 or (reading and (generators or dry_run)):
        raise click.UsageError("--list, --check, --unpack and making are done one at a time")
    if listed is not None:
        _list(listed)
    elif checked is not None:
        _check(checked)
    elif unpacked is not None:
        _unpack(unpacked, out)
    else:
        _make(generators, n, d, realizations, seed, out, dry_run, jobs, quiet)


def _make(
    generators: tuple[str, ...], n: tuple[int, ...], d: tuple[int, ...], realizations: int, seed: int,
    out: Path | None, dry_run: bool, jobs: int | None, quiet: bool,
) -> None:  # fmt: skip
    from gbnbench.cli.set_library_text import count, plan_lines
    from gbnbench.execution import progress
    from gbnbench.studies.set_library.making import check_place, finished_files, make_library
    from gbnbench.studies.set_library.request import DEFAULT_GENERATORS, library_request

    if out is None and not dry_run:
        raise click.UsageError("give -o FOLDER or -o FILE.zip, or --dry-run to see what would be made")
    request = library_request(generators or DEFAULT_GENERATORS, n, d, realizations)
    if out is not None:
        check_place(out)
    there = [] if out is None else finished_files(request, out)
    if dry_run or not quiet:
        for line in plan_lines(request, there):
            click.echo(line)
    if dry_run or out is None:
        return
    with progress.choose(quiet) as shown:
        made = make_library(request, out, seed=seed, jobs=jobs, progress=shown)
    for entry in made.manifest.files:
        for k, reason in entry.refused.items():
            click.echo(f"gbnbench: {entry.file} lacks realization {k}: {reason}", err=True)
    for refused in made.manifest.refused:
        if refused.tried:
            where = f"{refused.generator}, n={refused.n}, d={refused.d}"
            click.echo(f"gbnbench: {where}: none of {refused.tried} sets: {refused.reason}", err=True)
    held = count(len(made.manifest.files), "file")
    click.echo(f"library: {made.place}, {held} ({made.made} made, {made.found} found; {made.seconds:.1f} s)")


def _list(where: str) -> None:
    from gbnbench.cli.set_library_text import list_lines
    from gbnbench.io.set_library.places import manifest_of, open_place

    with open_place(where) as place:
        manifest = manifest_of(place)
    for line in list_lines(manifest):
        click.echo(line)


def _check(where: str) -> None:
    from gbnbench.cli.set_library_text import count
    from gbnbench.io.set_library.places import manifest_of, open_place
    from gbnbench.io.set_library.set_file import faults

    with open_place(where) as place:
        manifest = manifest_of(place)
        found = faults(place, manifest)
        path = place.path
    for file, fault in found.items():
        click.echo(f"gbnbench: {path / file} {fault}", err=True)
    files = len(manifest.files)
    way_out = "; the command that made the library makes the rest again" if found else ""
    click.echo(f"{path}: {files - len(found)} of {count(files, 'file')} whole{way_out}")
    if found:
        click.get_current_context().exit(1)


def _unpack(where: str, out: Path | None) -> None:
    from gbnbench.cli.set_library_text import count
    from gbnbench.io.set_library.archive import unpack
    from gbnbench.io.set_library.places import open_place
    from gbnbench.runs.resumable_folder import SETTINGS

    if out is None:
        raise click.UsageError("--unpack goes with -o FOLDER")
    with open_place(where) as place:
        files = unpack(place, out, [SETTINGS])  # with which it can be added to, and a damaged file made again
    click.echo(f"wrote {out}: {count(files, 'file')} of point sets")
