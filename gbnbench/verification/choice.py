"""The figures that some generators, or those of a family, are held against."""

from __future__ import annotations

from collections.abc import Sequence

from gbnbench.core.errors import InputError
from gbnbench.core.settings import nearest, parse
from gbnbench.generators.listing import check_family
from gbnbench.generators.registry import GENERATORS
from gbnbench.verification.published import PUBLISHED
from gbnbench.verification.published_figure import PublishedFigure
from gbnbench.verification.without_reference import WITHOUT_REFERENCE


def chosen_figures(only: Sequence[str] = (), family: str | None = None) -> tuple[PublishedFigure, ...]:
    """Choose figures to agree with.

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
        If a generator or the family is unknown, or there is no figure of what is chosen.
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
        raise InputError(_nothing(only, family))
    return tuple(found)


def _nothing(only: Sequence[str], family: str | None) -> str:
    """Say why there is nothing to hold the chosen generators against."""
    inside = [name for name in only if family is None or GENERATORS[name].family == family]
    if only and not inside:
        return f"{' and '.join(only)}: not of the family {family!r}, so that there is nothing to verify"
    reasons = "; ".join(WITHOUT_REFERENCE.get(name, "none was found").replace("`", "") for name in inside)
    chosen = " or ".join(inside) or f"the family {family!r}"
    return f"there is no figure to hold {chosen} against{reasons and ': '}{reasons}"
