"""The last step of a study, its pictures: where it fails, what was measured is kept and shown."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from gbnbench.core.errors import GbnbenchError


class UndrawnError(GbnbenchError):
    """Some pictures could not be made; all others were.

    Attributes
    ----------
    names : tuple of str
        The pictures that could not.
    why : str
        The fault of the first.
    """

    def __init__(self, names: tuple[str, ...], why: str) -> None:
        self.names, self.why = names, why
        super().__init__(f"{', '.join(names)}: {why}")


def make_each(steps: Iterable[tuple[str, Callable[[], object]]]) -> None:
    """Make every picture that can be made, and then say which could not.

    Parameters
    ----------
    steps : iterable of (str, callable)
        Name of a picture, and what makes it.

    Raises
    ------
    UndrawnError
        If any could not be made.
    """
    names: list[str] = []
    why = ""
    for name, make in steps:
        try:
            make()
        except UndrawnError as error:
            names += error.names
            why = why or error.why
        except Exception as error:
            names.append(name)
            why = why or str(error).strip().partition("\n")[0] or type(error).__name__
    if names:
        raise UndrawnError(tuple(names), why)


def failure_of(draw: Callable[[], None]) -> str:
    """Draw, and say what went wrong.

    Parameters
    ----------
    draw : callable
        Makes the pictures and the report of a study whose results are written already.

    Returns
    -------
    str
        The fault in a line; empty where all was drawn.
    """
    try:
        make_each([("pictures", draw)])
    except UndrawnError as error:
        return error.why if error.names == ("pictures",) else str(error)
    return ""
