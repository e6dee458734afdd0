"""The picture of one generator: sets are drawn and analysed here, without a folder."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from gbnbench import __version__
from gbnbench.analysis.measures import analyse_to_arrays
from gbnbench.generators.protocol import Generator
from gbnbench.generators.registry import generate
from gbnbench.opencl import choose
from gbnbench.reports.comparison import single_source
from gbnbench.runs.comparison_folder import Realization
from gbnbench.runs.comparison_result import Run
from gbnbench.runs.sources import resolve
from gbnbench.studies.comparison_tasks import source_result


def portrait(
    generator: Generator, *, n: int = 1024, d: int = 2, realizations: int = 1, seed: int = 0
) -> Figure:
    """Draw a set of a generator, the spectrum, the radial power and, in 2D, the zone plate.

    Parameters
    ----------
    generator : Generator
        With its settings.
    n, d : int
        Points a set and dimension.
    realizations : int
        Sets over which spectra are averaged.
    seed : int
        Realization k draws from ``SeedSequence(seed, spawn_key=(k,))``.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    RefusalError
        If the generator cannot make such sets.
    """
    (source,), _ = resolve([generator], [n], [d], realizations)
    x = np.reshape(generate(generator, n, d, seed, realizations), (realizations, n, d))
    drawn = [Realization(one, math.nan, True) for one in x]
    result = source_result(source, analyse_to_arrays(x), drawn)
    manifest = {"seed": seed, "device": choose().describe(), "version": __version__}
    return single_source.figure(Run(manifest, (result,)))
