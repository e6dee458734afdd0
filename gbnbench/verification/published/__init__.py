"""All figures that generators are held against, family by family."""

from __future__ import annotations

from gbnbench.core.settings import parse
from gbnbench.generators.registry import GENERATORS
from gbnbench.verification.published.by_definition import BY_DEFINITION
from gbnbench.verification.published.cellular import CELLULAR
from gbnbench.verification.published.direct import DIRECT
from gbnbench.verification.published.kernel_based import KERNEL_BASED
from gbnbench.verification.published.low_discrepancy import LOW_DISCREPANCY
from gbnbench.verification.published.spectral import SPECTRAL
from gbnbench.verification.published.spectral_shape import SPECTRAL_SHAPE
from gbnbench.verification.published_figure import PublishedFigure


def _by_family(figures: tuple[PublishedFigure, ...]) -> tuple[PublishedFigure, ...]:
    """Bring figures of one family together, and within it those of the same sets, which are drawn once."""
    families = list(dict.fromkeys(GENERATORS[parse(one.generator)[0]].family for one in figures))
    sets = list(dict.fromkeys(one.same_sets for one in figures))
    return tuple(
        sorted(
            figures,
            key=lambda one: (
                families.index(GENERATORS[parse(one.generator)[0]].family),
                sets.index(one.same_sets),
            ),
        )
    )


PUBLISHED = _by_family(
    (*DIRECT, *LOW_DISCREPANCY, *CELLULAR, *KERNEL_BASED, *SPECTRAL, *SPECTRAL_SHAPE, *BY_DEFINITION)
)
