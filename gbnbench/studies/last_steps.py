"""The last steps of a study, tables and pictures: where one fails, what was measured is kept and shown."""

from __future__ import annotations

from collections.abc import Callable


def failure_of(last_steps: Callable[[], None]) -> str:
    """Carry out the last steps, and say what went wrong.

    Parameters
    ----------
    last_steps : callable
        Writes the tables, the pictures and the report of a study whose pieces are kept already.

    Returns
    -------
    str
        The fault in a line; empty where there was none.
    """
    try:
        last_steps()
    except Exception as error:
        text = str(error).strip().partition("\n")[0]
        if isinstance(error, OSError) and error.filename:
            text = f"{error.filename}: {error.strerror}"
        notes = "".join(f"{note}: " for note in getattr(error, "__notes__", ()))
        return f"{notes}{text or type(error).__name__}"
    return ""
