"""A finished comparison in memory: what a run folder holds and what reports draw from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from gbnbench.analysis.measures import Analysis
from gbnbench.core.sides import Sides
from gbnbench.core.torus import FloatArray


@dataclass(frozen=True, kw_only=True)
class SourceResult(Analysis):
    """The sets of one source (a generator, file or folder) at one n and d, with everything measured of them.

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
    cpu_seconds : float
        Mean CPU seconds a set, nan for sets read from files.

    Notes
    -----
    The spectrum and all that is made of it are the fields of ``Analysis``.
    """

    key: str
    label: str
    n: int
    d: int
    realizations: int
    points: FloatArray
    cpu_seconds: float

    @property
    def sides(self) -> Sides | None:
        """Sides of the torus, of volume 1; None for a cube."""
        return self.spectrum.sides


@dataclass(frozen=True)
class Run:
    """One comparison.

    Attributes
    ----------
    manifest : mapping
        JSON-ready: command, settings, seed, device, versions, timings, baseline.
    sources : tuple of SourceResult
        In the order of the request.
    verdicts : mapping
        (source key, measure) -> "better" or "worse" than the baseline; empty without one.
    series : mapping
        source key -> (its label in its own run, number of that run) where runs are joined; else empty.
    """

    manifest: Mapping[str, Any]
    sources: tuple[SourceResult, ...]
    verdicts: Mapping[tuple[str, str], str] = field(default_factory=dict)
    series: Mapping[str, tuple[str, int]] = field(default_factory=dict)
