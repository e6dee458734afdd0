"""Scalar measures by name, with their standard errors and the reasons of those that are undefined."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Measures(Mapping[str, float]):
    """Scalar measures by name; nan where undefined, and then ``reasons`` says why.

    Attributes
    ----------
    measured : dict
        Name -> value, for every name of ``gbnbench.analysis.measure_definitions``.
    standard_error : dict
        Standard error over realizations; nan for a single one or where the measure is undefined.
    reasons : dict
        Name -> sentence, only for measures that are undefined here.
    """

    measured: Mapping[str, float]
    standard_error: Mapping[str, float] = field(default_factory=dict)
    reasons: Mapping[str, str] = field(default_factory=dict)

    def __getitem__(self, name: str) -> float:
        return self.measured[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.measured)

    def __len__(self) -> int:
        return len(self.measured)

    def to_frame(self) -> pd.DataFrame:
        """One row a measure: columns measure, value, standard_error, reason."""
        import pandas as pd

        return pd.DataFrame(
            {
                "measure": list(self),
                "value": [self[m] for m in self],
                "standard_error": [self.standard_error.get(m, math.nan) for m in self],
                "reason": [self.reasons.get(m, "") for m in self],
            }
        )
