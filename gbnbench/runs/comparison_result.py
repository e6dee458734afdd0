"""A finished comparison in memory: what the store writes and reads, and what reports draw from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from gbnbench.core.results import Measures, RadialPower, Spectrum
from gbnbench.core.torus import FloatArray

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class SourceResult:
    """Everything measured of one source (a generator, file or folder) at one n and d.

    Attributes
    ----------
    key : str
        Unique in the run and safe as a folder name, such as ``gbn-iterations-1000_n1024_d2``.
    label : str
        What the user reads, such as ``gbn[iterations=1000]``.
    n, d, realizations : int
        Points a set, dimension, number of sets.
    points : (realizations, n, d) float64
        The sets themselves.
    spectrum : Spectrum
        Power averaged over the realizations.
    radial : RadialPower
        Exact shells of the spectrum.
    anisotropy : DataFrame
        A row a ring: columns frequency, nu, anisotropy_db.
    rdf : DataFrame or None
        Columns r (in densest spacings), g; None where n is too small.
    valence : DataFrame or None
        Columns degree, share of points; None where d has no Delaunay valence.
    zone_plate : (pixels, pixels) float64 or None
        Picture of the first realization, in [0, 1], row 0 at y = 0; None for d != 2.
    measures : Measures
        The scalars with standard errors and reasons.
    cpu_seconds : float
        Mean CPU seconds a set, nan for sets read from files.
    warnings : tuple of str
        What the user should know before trusting a row, such as a set that is not toroidal.
    """

    key: str
    label: str
    n: int
    d: int
    realizations: int
    points: FloatArray
    spectrum: Spectrum
    radial: RadialPower
    anisotropy: pd.DataFrame
    rdf: pd.DataFrame | None
    valence: pd.DataFrame | None
    zone_plate: FloatArray | None
    measures: Measures
    cpu_seconds: float
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True)
class Run:
    """One comparison.

    Attributes
    ----------
    manifest : mapping
        JSON-ready: command, settings, seed, device, versions, timings, baseline.
    sources : tuple of SourceResult
        In the order asked for.
    verdicts : mapping
        (source key, measure) -> "better" or "worse" than the baseline; empty without one.
    """

    manifest: Mapping[str, Any]
    sources: tuple[SourceResult, ...]
    verdicts: Mapping[tuple[str, str], str] = field(default_factory=dict)
