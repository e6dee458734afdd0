"""Exact spectra of point sets in any dimension, generators compared side by side, and Gaussian Blue Noise.

The names below load their modules when first used, so that importing gbnbench costs nearly nothing:

- ``compare(sources, n=, d=, realizations=, out=)``: generators, files and arrays side by side, as a
  ``Comparison`` with its table, figures and report;
- ``integrate(sources, ...)``: variance of integrals estimated by their points, as an ``Integration``;
- ``generate(name, n=, d=, seed=, realizations=, **settings)``: point sets from a generator;
- ``generator_table()``: every generator with its family, dimensions, cost and reference;
- ``stipple(image, n)``: points whose density follows an image, a volume or a function, as a ``Stippling``;
- ``reconstruct(points, shape=)``: the picture that points draw, from them alone;
- ``compare_stipplings(image, sources)``: stipplers and stipplings by anybody side by side, as a
  ``StipplingComparison``;
- ``load(path)``, ``save(path, x)``: point-set files;
- ``export_sets(path, source)``, ``export_mask(path, shape)``, ``dither_mask(shape)``: files for renderers;
- ``wrap(x)``, ``scale(x, low, high)``: points brought onto the unit torus [0, 1)^d;
- ``periodogram(x, fmax)``: exact power at every integer frequency; ``radial(spectrum)``: its radial mean;
- ``shells(x, fmax)``: radial power and anisotropy without the cube, in any dimension;
- ``plan(n, d, fmax)``: which evaluation a spectrum gets, why, and what it costs;
- ``measures(x)``: every scalar measure with its standard error;
- ``in_window(points, low, high)``: spectrum, pair correlation and hyperuniformity of points seen in a window
  that is no torus.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gbnbench.analysis.measures import measures
    from gbnbench.analysis.radial.radial_power import radial
    from gbnbench.analysis.spectrum.periodogram import periodogram
    from gbnbench.analysis.spectrum.plan import plan
    from gbnbench.analysis.spectrum.shell_spectrum import shells
    from gbnbench.analysis.spectrum.spectrum_plan import SpectrumPlan
    from gbnbench.analysis.window.estimates import WindowEstimates, in_window
    from gbnbench.api.compare import compare
    from gbnbench.api.comparison import Comparison
    from gbnbench.api.exports import ExportedMask, ExportedSets
    from gbnbench.api.integration import Integration, integrate
    from gbnbench.api.mask_export import export_mask
    from gbnbench.api.reconstruct import reconstruct
    from gbnbench.api.set_export import export_sets
    from gbnbench.api.stipple import stipple
    from gbnbench.api.stippling import Stippling
    from gbnbench.api.stippling_comparison import StipplingComparison
    from gbnbench.api.stipplings import compare_stipplings
    from gbnbench.core.errors import GbnbenchError
    from gbnbench.core.results.radial import ShellSpectrum
    from gbnbench.core.results.spectrum import Spectrum
    from gbnbench.core.torus import scale, wrap
    from gbnbench.generators.kernel_based.dither_mask import dither_mask
    from gbnbench.generators.listing import generator_table
    from gbnbench.generators.registry import generate
    from gbnbench.io.points import load, save

__version__ = "0.1.0"

__all__ = [
    "Comparison",
    "ExportedMask",
    "ExportedSets",
    "GbnbenchError",
    "Integration",
    "ShellSpectrum",
    "Spectrum",
    "SpectrumPlan",
    "Stippling",
    "StipplingComparison",
    "WindowEstimates",
    "compare",
    "compare_stipplings",
    "dither_mask",
    "export_mask",
    "export_sets",
    "generate",
    "generator_table",
    "in_window",
    "integrate",
    "load",
    "measures",
    "periodogram",
    "plan",
    "radial",
    "reconstruct",
    "save",
    "scale",
    "shells",
    "stipple",
    "wrap",
]

_MODULES = {
    "Comparison": "gbnbench.api.comparison",
    "ExportedMask": "gbnbench.api.exports",
    "ExportedSets": "gbnbench.api.exports",
    "GbnbenchError": "gbnbench.core.errors",
    "Integration": "gbnbench.api.integration",
    "ShellSpectrum": "gbnbench.core.results.radial",
    "Spectrum": "gbnbench.core.results.spectrum",
    "SpectrumPlan": "gbnbench.analysis.spectrum.spectrum_plan",
    "Stippling": "gbnbench.api.stippling",
    "StipplingComparison": "gbnbench.api.stippling_comparison",
    "WindowEstimates": "gbnbench.analysis.window.estimates",
    "compare": "gbnbench.api.compare",
    "compare_stipplings": "gbnbench.api.stipplings",
    "dither_mask": "gbnbench.generators.kernel_based.dither_mask",
    "export_mask": "gbnbench.api.mask_export",
    "export_sets": "gbnbench.api.set_export",
    "generate": "gbnbench.generators.registry",
    "generator_table": "gbnbench.generators.listing",
    "in_window": "gbnbench.analysis.window.estimates",
    "integrate": "gbnbench.api.integration",
    "load": "gbnbench.io.points",
    "measures": "gbnbench.analysis.measures",
    "periodogram": "gbnbench.analysis.spectrum.periodogram",
    "plan": "gbnbench.analysis.spectrum.plan",
    "radial": "gbnbench.analysis.radial.radial_power",
    "reconstruct": "gbnbench.api.reconstruct",
    "save": "gbnbench.io.points",
    "scale": "gbnbench.core.torus",
    "shells": "gbnbench.analysis.spectrum.shell_spectrum",
    "stipple": "gbnbench.api.stipple",
    "wrap": "gbnbench.core.torus",
}


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module 'gbnbench' has no attribute {name!r}")
    value = getattr(importlib.import_module(_MODULES[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
