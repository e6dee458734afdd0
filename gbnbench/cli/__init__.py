"""The gbnbench command: its subcommands by task, its exit codes, and its errors in one line."""

from __future__ import annotations

import os
import shlex
import sys
import warnings
from collections.abc import Sequence
from pathlib import Path

import click

from gbnbench import __version__
from gbnbench.cli.analyze import analyze
from gbnbench.cli.bench import bench
from gbnbench.cli.check import check
from gbnbench.cli.compare import compare
from gbnbench.cli.convert import convert
from gbnbench.cli.devices import devices, doctor
from gbnbench.cli.export import export
from gbnbench.cli.figures import figures
from gbnbench.cli.generate import generate
from gbnbench.cli.generators import generators
from gbnbench.cli.integrate import integrate
from gbnbench.cli.make_library import library
from gbnbench.cli.reconstruct import reconstruct
from gbnbench.cli.report import report
from gbnbench.cli.spectrum import spectrum
from gbnbench.cli.standard_streams import in_words, lasting_streams
from gbnbench.cli.stipple import stipple
from gbnbench.core.errors import GbnbenchError
from gbnbench.core.garbage import collect_rarely
from gbnbench.core.interruption import forget_interruption, is_interruption
from gbnbench.core.memory import memory_limit, too_little

BAD, STOPPED, PIPE = 2, 130, 141  # exit codes; 0 is done, 1 is worse than a baseline or a failed check

TASKS: dict[str, tuple[click.Command, ...]] = {
    "Start here": (
        compare,
        spectrum,
        analyze,
        generate,
        library,
        generators,
        stipple,
        reconstruct,
        convert,
        export,
    ),
    "Studies, and this machine": (integrate, figures, report, check, bench, devices, doctor),
}


class CommandsByTask(click.Group):
    """A group whose help shows its commands by what they are for."""

    def format_help_text(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """Write what it is right below its usage, as a screen has 24 lines.

        Parameters
        ----------
        ctx : click.Context
            Of the command.
        formatter : click.HelpFormatter
            Takes the text.
        """
        with formatter.indentation():
            formatter.write_text(str(self.help))

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """Write a section for each task.

        Parameters
        ----------
        ctx : click.Context
            Of the command.
        formatter : click.HelpFormatter
            Takes the text.
        """
        width = max(len(str(command.name)) for commands in TASKS.values() for command in commands)
        for task, commands in TASKS.items():
            with formatter.section(task):
                limit = formatter.width - width - 4
                formatter.write_dl(
                    [(str(c.name).ljust(width), c.get_short_help_str(limit)) for c in commands]
                )

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write only the commands: the epilog names the two options.

        Parameters
        ----------
        ctx : click.Context
            Of the command.
        formatter : click.HelpFormatter
            Takes the text.
        """
        self.format_commands(ctx, formatter)

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """Write the epilog right below the commands, as a screen has 24 lines.

        Parameters
        ----------
        ctx : click.Context
            Of the command.
        formatter : click.HelpFormatter
            Takes the text.
        """
        with formatter.indentation():
            formatter.write_text(str(self.epilog))


def _version(context: click.Context, _: click.Parameter, asked: bool) -> None:
    if asked:
        click.echo(f"gbnbench {__version__}")
        context.exit()


@click.group(
    cls=CommandsByTask,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    epilog="'gbnbench COMMAND --help' shows its options; 'gbnbench --version'.",
)
@click.option(
    "--version", is_flag=True, expose_value=False, is_eager=True, callback=_version, help="Show the version."
)
def gbnbench() -> None:
    """Exact spectra of point sets, generators side by side, Gaussian blue noise."""


for _commands in TASKS.values():
    for _command in _commands:
        gbnbench.add_command(_command)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command and exit: 0 done, 1 worse or failed check, 2 bad input or use, 130 stopped."""
    collect_rarely()
    with lasting_streams() as output:
        fault = too_little()
        code = _fail(fault, BAD) if fault else run(sys.argv[1:] if arguments is None else arguments)
        if output is not None and output.fault is not None:
            code = max(_fail(in_words(output.fault), BAD), code)
    sys.exit(code)


def run(arguments: Sequence[str]) -> int:
    """Run the command and return its exit code."""
    try:
        with gbnbench.make_context("gbnbench", list(arguments)) as context, warnings.catch_warnings():
            warnings.showwarning = _warn
            gbnbench.invoke(context)
            _tell_of_fonts()
        sys.stdout.flush()
    except click.exceptions.Exit as done:
        return done.exit_code
    except click.exceptions.NoArgsIsHelpError as error:
        click.echo(error.format_message())
        return BAD
    except click.ClickException as error:
        return _fail(_sentence(error.format_message()) + _mistaken_file(error, arguments), error.exit_code)
    except (KeyboardInterrupt, click.Abort) as error:
        return _stopped(str(error))
    except GbnbenchError as error:
        return _fail(str(error), BAD)
    except BrokenPipeError:  # such as ``| head``
        # Python's own flush at the end would complain again.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return PIPE
    except MemoryError:
        return _fail(f"not enough memory: {memory_limit() / 1e9:.3g} GB are allowed; take fewer points", BAD)
    except ImportError as error:
        if is_interruption(error):
            return _stopped("")
        return _fail(f"a library cannot be loaded: {error}", BAD)
    except OSError as error:
        return _fail(f"{error.filename}: {error.strerror}" if error.filename else str(error), BAD)
    return 0


def _stopped(what_is_kept: str) -> int:
    forget_interruption()
    return _fail(f"stopped; {what_is_kept}" if what_is_kept else "stopped", STOPPED)


def _warn(message: Warning | str, *_: object, **__: object) -> None:
    """Say a warning in one line, without the place in the code that gave it."""
    click.echo(f"gbnbench: warning: {message}", err=True)


def _sentence(message: str) -> str:
    """End a message of click's, which older versions of it leave open."""
    return message if message.endswith((".", "?", ")")) else f"{message}."


def _mistaken_file(error: click.ClickException, arguments: Sequence[str]) -> str:
    """Tell how to name a file that was taken for an option or a command."""
    if error.message.startswith("No such command") and Path(arguments[0]).exists():
        return f" A file stands behind a command: gbnbench analyze {shlex.quote(arguments[0])}."
    if not isinstance(error, click.NoSuchOption):
        return ""
    file = next((word for word in arguments if word.startswith("-") and Path(word).is_file()), None)
    return "" if file is None else f" Of the file of this name, write {shlex.quote(f'./{file}')}."


def _tell_of_fonts() -> None:
    """Say once which signs the pictures could not show, if any were drawn."""
    fonts = sys.modules.get("gbnbench.reports.fonts")
    if fonts is not None and (shortage := fonts.shortage()):
        click.echo(f"gbnbench: warning: {shortage}", err=True)


def _fail(text: str, code: int) -> int:
    click.echo(f"gbnbench: {text}" if code == STOPPED else f"gbnbench: error: {text}", err=True)
    return code
