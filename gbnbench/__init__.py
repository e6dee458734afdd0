"""Exact spectra of point sets in any dimension, generators compared side by side, and Gaussian Blue Noise.

The names below load their modules when first used, so that importing gbnbench costs nearly nothing:

- ``generate(name, n=, d=, seed=, realizations=, **settings)``: point sets from a generator;
- ``load(path)``, ``save(path, x)``: point-set files;
- ``periodogram(x, fmax)``: exact power at every integer frequency; ``radial(spectrum)``: its radial mean;
- ``shells(x, fmax)``: radial power and anisotropy without the cube, in any dimension;
- ``plan(n, d, fmax)``: which evaluation a spectrum gets, why, and what it costs;
- ``measures(x)``: every scalar measure with its standard error.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gbnbench.analysis.measures import measures
    from gbnbench.analysis.radial.radial_power import radial
    from gbnbench.analysis.spectrum.periodogram import periodogram
    from gbnbench.analysis.spectrum.plan import SpectrumPlan, plan
    from gbnbench.analysis.spectrum.shell_spectrum import shells
    from gbnbench.core.errors import GbnbenchError
    from gbnbench.core.results import ShellSpectrum, Spectrum
    from gbnbench.generators.registry import generate
    from gbnbench.io.points import load, save

__version__ = "0.1.0"

_HOMES = {
    "GbnbenchError": "gbnbench.core.errors",
    "generate": "gbnbench.generators.registry",
    "SpectrumPlan": "gbnbench.analysis.spectrum.plan",
    "ShellSpectrum": "gbnbench.core.results",
    "Spectrum": "gbnbench.core.results",
    "load": "gbnbench.io.points",
    "measures": "gbnbench.analysis.measures",
    "periodogram": "gbnbench.analysis.spectrum.periodogram",
    "plan": "gbnbench.analysis.spectrum.plan",
    "radial": "gbnbench.analysis.radial.radial_power",
    "save": "gbnbench.io.points",
    "shells": "gbnbench.analysis.spectrum.shell_spectrum",
}

__all__ = [
    "GbnbenchError",
    "ShellSpectrum",
    "Spectrum",
    "SpectrumPlan",
    "generate",
    "load",
    "measures",
    "periodogram",
    "plan",
    "radial",
    "save",
    "shells",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'gbnbench' has no attribute {name!r}")
    value = getattr(importlib.import_module(_HOMES[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *_HOMES])
