"""Options that several commands share, each with one name, and the sections in which help shows them."""

from __future__ import annotations

import functools
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

F = TypeVar("F", bound=Callable[..., Any])
SHARED = {"--seed", "--realizations", "--jobs", "--quick", "--json", "--quiet", "--device", "--help"}
READING = {"--period", "--bounds", "--wrap", "--columns", "--raw", "--array"}


class Command(click.Command):
    """A command whose help shows its own options first, then those of reading and those of many commands."""

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the sections.

        Parameters
        ----------
        ctx : click.Context
            Of the command.
        formatter : click.HelpFormatter
            Takes the text.
        """
        sections: dict[str, list[tuple[str, str]]] = {
            "Options": [], "Reading options": [], "Options of many commands": []
        }  # fmt: skip
        for parameter in self.get_params(ctx):
            record = parameter.get_help_record(ctx)
            if isinstance(parameter, click.Option) and record is not None:
                title = "Options of many commands" if {*parameter.opts} & SHARED else "Options"
                sections["Reading options" if {*parameter.opts} & READING else title].append(record)
        for title, records in sections.items():
            if records:
                with formatter.section(title):
                    formatter.write_dl(records)


class WholeNumbers(click.ParamType):  # type: ignore[type-arg]  # takes no argument before click 8.4
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
        if not re.fullmatch(r"(\s*[+-]?(0|[1-9](_?\d)*)\s*,)+", f"{value},"):  # 1,024 is no list
            self.fail(f"must be whole numbers parted by commas; got {value!r}", param, ctx)
        numbers = tuple(map(int, str(value).split(",")))
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


class _NewFile(click.Path):
    """A path of a file, which does not end as that of a folder does: ``Path`` would drop the end."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if isinstance(value, str) and value.endswith(("/", os.sep)):
            self.fail(f"{value!r} ends as a folder does: name a file", param, ctx)
        return super().convert(value, param, ctx)


def out_file(text: str, **settings: Any) -> Callable[[F], F]:
    """Return ``-o/--out`` of a file.

    Parameters
    ----------
    text : str
        Help.
    **settings
        More that ``click.option`` takes, such as ``required``.

    Returns
    -------
    callable
        The decorator of a command.
    """
    return click.option(
        "-o", "--out", metavar="FILE", type=_NewFile(path_type=Path, dir_okay=False), help=text, **settings
    )


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
    return click.option("--jobs", type=click.IntRange(1), help="Worker processes.  [default: one per core]")(
        command
    )


def groups(command: F) -> F:
    """Add ``--family`` and ``--preset``, generators by groups, which a command gets as ``groups``."""

    @functools.wraps(command)
    def with_groups(*args: Any, family: tuple[str, ...], preset: tuple[str, ...], **kwargs: Any) -> Any:
        named = [*(f"family:{name}" for name in family), *(f"preset:{name}" for name in preset)]
        return command(*args, groups=tuple(named), **kwargs)

    decorated = click.option(
        "--preset", metavar="NAME", multiple=True,
        help="Also the generators of this preset. There is one, paper: the methods of the paper's figures "
        "1 and 8.",
    )(with_groups)  # fmt: skip
    return click.option(
        "--family",
        metavar="NAME",
        multiple=True,
        help="Also every generator of this family that serves n and d; may be given several times.",
    )(decorated)  # type: ignore[return-value]


def quiet(command: F) -> F:
    """Add ``--quiet``."""
    return click.option("--quiet", is_flag=True, help="Show no progress.")(command)


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


def reading(command: F) -> F:
    """Add the options that say how files of points are read, which a command gets as ``reading``."""

    @functools.wraps(command)
    def with_reading(*args: Any, **kwargs: Any) -> Any:
        from gbnbench.io.points.options import reading_options

        given = [kwargs.pop(name.removeprefix("--")) for name in (*_TEXTS, "--wrap")]
        return command(*args, reading=reading_options(*given), **kwargs)

    decorated = click.option(
        "--wrap", is_flag=True, help="Move points outside the box into it, by whole sides."
    )(with_reading)
    for name, (metavar, text) in reversed(_TEXTS.items()):
        decorated = click.option(name, metavar=metavar, help=text)(decorated)
    return decorated  # type: ignore[return-value]


# in the order of the arguments of reading_options
_TEXTS = {
    "--columns": ("X,Y", "Columns of the coordinates, by name; without names by number, from 1."),
    "--raw": ("TYPE,D", "Binary without a header: float32,3 means three a point; >float32,3 big-endian."),
    "--array": ("NAME", "Array of an .npz, or key of a JSON file, that holds the points."),
    "--period": ("SIDES", "Sides of the torus in the files' unit, such as 512,512 for pixels."),
    "--bounds": ("ENDS", "Ends of each axis, such as 0,512,0,256."),
}
