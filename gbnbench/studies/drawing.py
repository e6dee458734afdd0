"""The last step of a study, its pictures: where it fails, what was measured is kept and shown."""

from __future__ import annotations

from collections.abc import Callable


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
        draw()
    except Exception as error:
        text = str(error).strip().partition("\n")[0]
        notes = "".join(f"{note}: " for note in getattr(error, "__notes__", ()))
        return f"{notes}{text or type(error).__name__}"
    return ""
