"""Prose of Markdown pages in lines that an editor shows whole."""

from __future__ import annotations

import re
import textwrap

WIDTH = 110  # of prose on pages that code writes
MARKS = re.compile(r" (?=(?:[-+*=#>|:]+|\d+[.)])(?: |$))")  # what a line must not begin with


def paragraph(text: str, before: str = "", further: str | None = None) -> str:
    """Return prose in lines of at most ``WIDTH``, none of which begins as an item of a list does.

    Parameters
    ----------
    text : str
        Words with single spaces between them.
    before : str
        What the first line begins with.
    further : str, optional
        What all others begin with; the same if not given.

    Returns
    -------
    str

    Examples
    --------
    >>> print(paragraph("Power falls as the wave number does. " * 4, "> "))
    > Power falls as the wave number does. Power falls as the wave number does. Power falls as the wave number
    > does. Power falls as the wave number does.
    """
    lines = textwrap.wrap(
        MARKS.sub("\0", text),
        WIDTH,
        initial_indent=before,
        subsequent_indent=before if further is None else further,
        break_long_words=False,
        break_on_hyphens=False,
    )
    return "\n".join(lines).replace("\0", " ")
