"""Footnotes below a table: why values are missing, each reason once with the columns that it holds for."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable


def footnotes(missing: Iterable[tuple[str, str]], width: int = 100) -> list[str]:
    """Gather the reasons of missing values.

    Parameters
    ----------
    missing : iterable of (str, str)
        The title of a column and the reason why a value in it is missing, as often as there are such values.
    width : int
        Characters in a line.

    Returns
    -------
    list of str
        Lines such as ``- Q6; psi6: psi6 is defined in the plane, got d=3``, in the order of the reasons.

    Examples
    --------
    >>> footnotes([("Q6", "of the plane"), ("psi6", "of the plane"), ("Q6", "of the plane")])
    ['- Q6; psi6: of the plane']
    """
    columns: dict[str, dict[str, None]] = {}
    for title, reason in missing:
        if reason:
            columns.setdefault(reason, {})[title] = None
    return [
        line
        for reason, titles in columns.items()
        for line in textwrap.wrap(f"- {'; '.join(titles)}: {reason}", max(width, 40), subsequent_indent="  ")
    ]
