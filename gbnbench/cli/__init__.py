"""The gbnbench command: what it is called, what it exits with, and how it says what went wrong."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

import click

from gbnbench import __version__
from gbnbench.cli.analyze import analyze
from gbnbench.cli.bench import bench
from gbnbench.cli.check import check
from gbnbench.cli.compare import compare
from gbnbench.cli.devices import devices, doctor
from gbnbench.cli.figures import figures
from gbnbench.cli.generate import generate
from gbnbench.cli.integrate import integrate
from gbnbench.cli.report import report
from gbnbench.cli.spectrum import spectrum
from gbnbench.core.errors import GbnbenchError

BAD, STOPPED, PIPE = 2, 130, 141  # exit codes; 0 is done, 1 is worse than a baseline or a failed check


def _version(context: click.Context, _: click.Parameter, asked: bool) -> None:
    if asked:
        click.echo(f"gbnbench {__version__}")
        context.exit()


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.option("--version", is_flag=True, expose_value=False, is_eager=True, callback=_version, help="Say it.")
def gbnbench() -> None:
    """Measure point sets' spectra exactly, compare generators side by side, make Gaussian blue noise.

    Start with: gbnbench compare
    """


for _command in (
    compare,
    generate,
    analyze,
    spectrum,
    integrate,
    figures,
    report,
    check,
    bench,
    devices,
    doctor,
):
    gbnbench.add_command(_command)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command and exit: 0 done, 1 worse or failed check, 2 bad input or use, 130 stopped."""
    sys.exit(run(sys.argv[1:] if arguments is None else arguments))


def run(arguments: Sequence[str]) -> int:
    """Run the command and return its exit code."""
    try:
        with gbnbench.make_context("gbnbench", list(arguments)) as context:
            gbnbench.invoke(context)
        sys.stdout.flush()
    except click.exceptions.Exit as done:
        return done.exit_code
    except click.exceptions.NoArgsIsHelpError as error:
        click.echo(error.format_message())
        return BAD
    except click.ClickException as error:
        return _fail(error.format_message(), error.exit_code)
    except (KeyboardInterrupt, click.Abort) as error:
        return _fail(f"stopped; {error}" if str(error) else "stopped", STOPPED)
    except GbnbenchError as error:
        return _fail(str(error), BAD)
    except BrokenPipeError:  # such as ``| head``
        # Python's own flush at the end would complain again.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return PIPE
    except OSError as error:
        return _fail(f"{error.filename}: {error.strerror}" if error.filename else str(error), BAD)
    return 0


def _fail(text: str, code: int) -> int:
    click.echo(f"gbnbench: {text}" if code == STOPPED else f"gbnbench: error: {text}", err=True)
    return code
