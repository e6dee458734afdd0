"""The published figures of some generators or of a family."""

from __future__ import annotations

from collections.abc import Sequence

from gbnbench.core.errors import InputError
from gbnbench.core.settings import nearest, parse
from gbnbench.generators.listing import check_family
from gbnbench.generators.registry import GENERATORS
from gbnbench.verification.published import PUBLISHED
from gbnbench.verification.published_figure import PublishedFigure


def chosen_figures(only: Sequence[str] = (), family: str | None = None) -> tuple[PublishedFigure, ...]:
    """Choose published figures.

    Parameters
    ----------
    only : sequence of str
        Generators, without settings; none for all.
    family : str, optional
        Only those of this family.

    Returns
    -------
    tuple of PublishedFigure
        At least one.

    Raises
    ------
    InputError
        If a generator or the family is unknown, or nothing was published of what is chosen.
    """
    for name in only:
        if name not in GENERATORS:
            raise InputError(f"no generator of gbnbench is named {name!r}{nearest(name, GENERATORS)}")
    if family is not None:
        check_family(family)
    found = []
    for figure in PUBLISHED:
        name, _ = parse(figure.generator)
        if (not only or name in only) and (family is None or GENERATORS[name].family == family):
            found.append(figure)
    if not found:
        names = ", ".join(dict.fromkeys(parse(figure.generator)[0] for figure in PUBLISHED))
        raise InputError(f"no published figure is held here of that; there are figures of {names}")
    return tuple(found)
