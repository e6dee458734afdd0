"""Requirements of an integration study: the dimensions of its families."""

from __future__ import annotations

from collections.abc import Sequence

from gbnbench.analysis.integration.integrands.protocol import Family
from gbnbench.core.errors import RefusalError
from gbnbench.core.settings import specification


def served(families: Sequence[Family], d: int) -> tuple[tuple[Family, ...], list[str]]:
    """Part families that have integrands in a dimension from those that have none there.

    Parameters
    ----------
    families : sequence of Family
        Those asked for.
    d : int
        Dimension.

    Returns
    -------
    served : tuple of Family
        Those that have integrands in d dimensions.
    refused : list of str
        A sentence for each of the others.
    """
    why = {family: family.refusal(d) for family in families}
    refused = [f"{specification(family)}: {reason}" for family, reason in why.items() if reason]
    return tuple(family for family, reason in why.items() if not reason), refused


def refuse(family: Family, d: int) -> None:
    """Refuse a family of integrands in a dimension that it does not have.

    Parameters
    ----------
    family : Family
        The integrands.
    d : int
        Dimension.

    Raises
    ------
    RefusalError
        If it has none in d dimensions.
    """
    if why := family.refusal(d):
        raise RefusalError(f"{specification(family)}: {why}")
