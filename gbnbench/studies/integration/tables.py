"""Tables of a study of integration: variances with their errors, what spectra predict, slopes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gbnbench.analysis.integration.integrands.protocol import Family
from gbnbench.analysis.integration.variance import crossed_mean, slope_of, variance_of
from gbnbench.core.settings import specification
from gbnbench.core.torus import FloatArray
from gbnbench.runs.sources import Source
from gbnbench.runs.task_folder import Arrays
from gbnbench.studies.integration.blocks import blocks, task_key

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Gathered:
    """All estimates of one source with one family.

    Attributes
    ----------
    errors : (instances, realizations, shifts or 1) float64
        Estimates less integrals.
    predicted : (instances, realizations) float64 or None
        Variances that the spectra predict.
    beyond : float
        What the frequencies left out may add to them.
    """

    errors: FloatArray
    predicted: FloatArray | None
    beyond: float


def gather(results: Mapping[str, Arrays], source: Source, family: Family) -> Gathered:
    """Put together the estimates of all blocks of one source with one family.

    Parameters
    ----------
    results : mapping
        What ``estimate_block`` returned, by the keys of the tasks.
    source : Source
        Whose blocks.
    family : Family
        Of integrands.

    Returns
    -------
    Gathered
    """
    text = specification(family)
    pieces = [results[task_key(source, first)] for first, _ in blocks(source)]
    errors = np.concatenate([piece[f"{text} errors"] for piece in pieces], axis=1)
    if f"{text} foretold" not in pieces[0]:
        return Gathered(errors, None, float("nan"))
    predicted = np.concatenate([piece[f"{text} foretold"] for piece in pieces], axis=1)
    return Gathered(errors, predicted, float(pieces[0][f"{text} beyond"]))


def tables(
    sources: Sequence[Source],
    families: Sequence[Family],
    instances: int,
    shifts: int,
    errors: dict[tuple[str, str], Gathered],
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Lay out the tables of a whole study.

    Parameters
    ----------
    sources, families : sequence
        All of them, in the order asked for.
    instances, shifts : int
        As asked for.
    errors : mapping
        (source key, specification of a family) -> what ``gather`` found; not where the family has no
        integrands in the source's dimension.

    Returns
    -------
    variance, slopes : DataFrame
        As ``gbnbench.studies.integration.study_folder.IntegrationStudy`` has them.
    """
    import pandas as pd

    rows, lines = [], []
    for family in families:
        text = specification(family)
        with_it = [source for source in sources if (source.key, text) in errors]
        for source in with_it:
            gathered = errors[source.key, text]
            rows.append(
                {
                    "source": source.label, "n": source.n, "d": source.d, "integrand": text,
                    "instances": instances, "realizations": source.realizations, "shifts": shifts,
                    **_row(gathered),
                }
            )  # fmt: skip
        for label, d in dict.fromkeys((source.label, source.d) for source in with_it):
            group = sorted((s.n, s.key) for s in with_it if (s.label, s.d) == (label, d))
            if len(group) > 1:
                slope = slope_of([n for n, _ in group], [errors[key, text].errors for _, key in group])
                lines.append(
                    {
                        "source": label, "d": d, "integrand": text, "n_from": group[0][0],
                        "n_to": group[-1][0], "slope": slope.value, "standard_error": slope.standard_error,
                        "scatter": slope.scatter,
                    }
                )  # fmt: skip
    columns = [
        "source", "d", "integrand", "n_from", "n_to", "slope", "standard_error", "scatter"
    ]  # fmt: skip
    return pd.DataFrame(rows), pd.DataFrame(lines, columns=columns)


def _row(gathered: Gathered) -> dict[str, float]:
    found = variance_of(gathered.errors)
    row = {
        "variance": found.value, "standard_error": found.standard_error, "low": found.low, "high": found.high,
        "bias": found.bias, "bias_error": found.bias_error,
    }  # fmt: skip
    nan = float("nan")
    if gathered.predicted is None:
        return {**row, "foretold": nan, "foretold_error": nan, "beyond": nan, "deviation": nan}
    predicted = crossed_mean(gathered.predicted)
    # Integrand by integrand and set by set: what both have in common is no error of their difference.
    difference = crossed_mean((gathered.errors**2).mean(axis=2) - gathered.predicted)
    outside = difference.value - min(max(difference.value, 0.0), gathered.beyond)
    deviation = outside / difference.standard_error if difference.standard_error > 0 else nan
    return {
        **row,
        "foretold": predicted.value,
        "foretold_error": predicted.standard_error,
        "beyond": gathered.beyond,
        "deviation": deviation,
    }
