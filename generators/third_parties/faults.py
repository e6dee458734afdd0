"""Faults of generators from elsewhere in words: errors that they raise, reasons that are no text."""

from __future__ import annotations

import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from gbnbench.core.errors import GbnbenchError, InputError
from gbnbench.generators.protocol import Generator
from gbnbench.generators.third_parties.installed import error_text, package_of


@contextmanager
def faults_in_words(kind: type[Generator], deed: str) -> Iterator[None]:
    """Turn errors of a generator from elsewhere into a ``GbnbenchError`` that names it and its package.

    Parameters
    ----------
    kind : type
        The class of the generator. Errors of gbnbench's own pass as they are, which are faults of gbnbench.
    deed : str
        What it is doing, such as ``"drawing n=4, d=2"``.

    Returns
    -------
    context manager

    Raises
    ------
    GbnbenchError
        If what is done inside raises anything but a ``GbnbenchError``, which passes, or want of memory. The
        text has the error, with the line of the generator's own module where it is known.
    """
    try:
        yield
    except (GbnbenchError, MemoryError):
        raise
    except (Exception, SystemExit) as error:
        if kind.__module__.partition(".")[0] == "gbnbench":
            raise
        frames = [f for f in traceback.extract_tb(error.__traceback__)[1:] if f.filename != __file__]
        where = f" ({Path(frames[-1].filename).name}, line {frames[-1].lineno})" if frames else ""
        raise GbnbenchError(f"{_named(kind)}: {deed} failed: {error_text(error)}{where}") from error


def refusal_of(generator: Generator, n: int, d: int) -> str | None:
    """Ask any generator why n points in d dimensions cannot be made.

    Parameters
    ----------
    generator : Generator
        Of gbnbench or from elsewhere.
    n, d : int
        Points and dimension, >= 1.

    Returns
    -------
    str or None
        The reason, in one line; None where the set can be made.

    Raises
    ------
    GbnbenchError
        If one from elsewhere fails.
    InputError
        If its answer is neither text nor None.
    """
    kind = type(generator)
    with faults_in_words(kind, f"refusal(n={n}, d={d})"):
        reason = generator.refusal(n, d)
    if reason is None:
        return None
    if isinstance(reason, str):
        return " ".join(reason.split())
    raise InputError(f"{_named(kind)}: refusal(n, d) must return a reason or None; got {reason!r}")


def _named(kind: type[Generator]) -> str:
    package = package_of(kind)
    origin = f"package {package}" if package else f"module {kind.__module__}"
    return f"generator {kind.name!r} of the {origin}"
