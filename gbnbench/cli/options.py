"""Options that several commands share, each with one name, and the two sections in which help shows them."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

F = TypeVar("F", bound=Callable[..., Any])
SHARED = {"--seed", "--realizations", "--jobs", "--quick", "--json", "--quiet", "--device", "--help"}


class Command(click.Command):
    """A command whose help shows its own options first, then those that many commands have."""

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the two sections.

        Parameters
        ----------
        ctx : click.Context
            Of the command.
        formatter : click.HelpFormatter
            Takes the text.
        """
        own: list[tuple[str, str]] = []
        shared: list[tuple[str, str]] = []
        for parameter in self.get_params(ctx):
            record = parameter.get_help_record(ctx)
            if isinstance(parameter, click.Option) and record is not None:
                (shared if {*parameter.opts} & SHARED else own).append(record)
        for title, records in (("Options", own), ("Options of many commands", shared)):
            if records:
                with formatter.section(title):
                    formatter.write_dl(records)


class WholeNumbers(click.ParamType[tuple[int, ...]]):
    """Whole numbers separated by commas, such as ``256,1024,4096``."""

    name = "numbers"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[int, ...]:
        """Read the text.

        Parameters
        ----------
        value : str or tuple of int
            What the user typed; click may hand back what is read already.
        param, ctx : click.Parameter and click.Context, optional
            For the message.

        Returns
        -------
        tuple of int
            Each >= 1.

        Raises
        ------
        click.BadParameter
            If the text holds anything else.
        """
        if isinstance(value, tuple):
            return value
        try:
            numbers = tuple(int(word) for word in str(value).split(","))
        except ValueError:
            self.fail(f"must be whole numbers parted by commas; got {value!r}", param, ctx)
        if bad := [number for number in numbers if number < 1]:
            self.fail(f"must be at least 1; got {bad[0]}", param, ctx)
        return numbers


def out_folder(text: str, default: str | None = None) -> Callable[[F], F]:
    """Return ``-o/--out`` of a folder.

    Parameters
    ----------
    text : str
        Help.
    default : str, optional
        Folder that is taken, and shown, when none is given.

    Returns
    -------
    callable
        The decorator of a command.
    """
    return click.option(
        "-o", "--out", metavar="FOLDER", type=click.Path(path_type=Path),
        default=None if default is None else Path(default), show_default=default is not None, help=text,
    )  # fmt: skip


def out_file(text: str, *, required: bool = False) -> Callable[[F], F]:
    """Return ``-o/--out`` of a file.

    Parameters
    ----------
    text : str
        Help.
    required : bool
        Whether the command does nothing without it.

    Returns
    -------
    callable
        The decorator of a command.
    """
    return click.option(
        "-o", "--out", metavar="FILE", type=click.Path(path_type=Path, dir_okay=False), required=required,
        help=text,
    )  # fmt: skip


def quick_or_full(text: str, *, default: str) -> Callable[[F], F]:
    """Return ``--quick/--full``, which a command gets as ``quick``.

    Parameters
    ----------
    text : str
        Help: what each of the two means.
    default : {"quick", "full"}
        What is done without the option.

    Returns
    -------
    callable
        The decorator of a command.
    """
    return click.option(
        "--quick/--full", "quick", default=default == "quick", help=f"{text}  [default: {default}]"
    )


def realizations(default: int) -> Callable[[F], F]:
    """Return ``--realizations``, with this default."""
    return click.option(
        "--realizations", type=click.IntRange(1), default=default, show_default=True,
        help="Sets of each generator.",
    )  # fmt: skip


def seed(command: F) -> F:
    """Add ``--seed``."""
    return click.option(
        "--seed", type=click.IntRange(0), default=0, show_default=True,
        help="Realization k draws from stream k of this seed.",
    )(command)  # fmt: skip


def jobs(command: F) -> F:
    """Add ``--jobs``."""
    return click.option("--jobs", type=click.IntRange(1), help="Worker processes.  [default: one a core]")(
        command
    )


def quiet(command: F) -> F:
    """Add ``--quiet``."""
    return click.option("--quiet", is_flag=True, help="No progress.")(command)


def json(command: F) -> F:
    """Add ``--json``, which a command gets as ``as_json``."""
    return click.option(
        "--json", "as_json", is_flag=True, help="Print JSON on standard output, and nothing else there."
    )(command)


def device(command: F) -> F:
    """Add ``--device``, which holds for this process and its workers."""

    def choose(_: click.Context, __: click.Parameter, value: str | None) -> None:
        if value is not None:
            from gbnbench.opencl import DEVICE_VARIABLE

            os.environ[DEVICE_VARIABLE] = value

    return click.option(
        "--device", metavar="NAME", expose_value=False, callback=choose,
        help="OpenCL device: a number or part of a name from 'gbnbench devices'. [default: $GBNBENCH_DEVICE, "
        "else the best]",
    )(command)  # fmt: skip
