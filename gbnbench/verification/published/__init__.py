"""All published figures that generators are held against, family by family."""

from __future__ import annotations

from gbnbench.verification.published.cellular import CELLULAR
from gbnbench.verification.published.direct import DIRECT
from gbnbench.verification.published.kernel_based import KERNEL_BASED
from gbnbench.verification.published.low_discrepancy import LOW_DISCREPANCY
from gbnbench.verification.published.spectral import SPECTRAL
from gbnbench.verification.published_figure import PublishedFigure

PUBLISHED: tuple[PublishedFigure, ...] = (*DIRECT, *LOW_DISCREPANCY, *CELLULAR, *KERNEL_BASED, *SPECTRAL)
