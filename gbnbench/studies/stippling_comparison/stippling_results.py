"""Results of a comparison of stipplings: of each source, and of all; and the tables that hold them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.reconstruction.image_quality import WINDOW
from gbnbench.analysis.standard_errors import mean_over_sets
from gbnbench.core.results.measures import Measures
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.torus import FloatArray
from gbnbench.studies.stippling_comparison.flat_patch import FlatPatch
from gbnbench.studies.stippling_comparison.measured_set import MEASURES
from gbnbench.studies.timed_draw import mean_cost

NO_PATCH = "no square of the image holds 64 points"
# Why a measure is undefined, where it can be.
REASONS = {
    "relative_variance": "kernels are too narrow for so large an image",
    "ssim": f"the image has a side of fewer than {WINDOW} pixels",
    "patch_floor": NO_PATCH,
}


@dataclass(frozen=True)
class StipplingResult:
    """What was measured of one source.

    Attributes
    ----------
    key, label : str
        Of the source.
    n, realizations : int
        Points a set, sets.
    points : (realizations, n, 2) float64
        In pixels, rows first.
    cpu_seconds : float
        Of the drawing of one set; nan where nothing drew them.
    measures : Measures
        Means over the sets by the names of ``MEASURES``, with standard errors.
    difference : RadialPower
        Power of the sets less the density in annuli, mean over sets; 1 for independent points. ``nu`` is in
        one over the mean spacing.
    patch : RadialPower or None
        The same in the flattest square, seen through a taper; ``nu`` is in one over the spacing there.
    reconstruction : (rows, columns) float32
        Points a pixel, found back from the first set by Algorithm 2.
    blurred : (rows, columns) float32
        The first set less the density, blurred by 16 pixels, over the mean density.
    patch_map : (2 f + 1, 2 f + 1) float32 or None
        Power of the first set in the flattest square, 0 in the middle.
    patch_reach : float
        Half its side, in nu.
    """

    key: str
    label: str
    n: int
    realizations: int
    points: FloatArray
    cpu_seconds: float
    measures: Measures
    difference: RadialPower
    patch: RadialPower | None
    reconstruction: NDArray[np.float32]
    blurred: NDArray[np.float32]
    patch_map: NDArray[np.float32] | None
    patch_reach: float


@dataclass(frozen=True)
class StipplingRun:
    """A comparison of stipplings.

    Attributes
    ----------
    manifest : dict
        JSON-ready: command, settings, seed, device, versions.
    density : (rows, columns) float64
        1 at most.
    patch : FlatPatch or None
        The flattest square.
    sources : tuple of StipplingResult
        In the order given, without those that failed.
    failures : tuple of str
        What went wrong, for each of these.
    """

    manifest: Mapping[str, Any]
    density: FloatArray
    patch: FlatPatch | None
    sources: tuple[StipplingResult, ...]
    failures: tuple[str, ...] = ()


def gathered(key: str, label: str, sets: Sequence[Mapping[str, NDArray[Any]]]) -> StipplingResult:
    """Put the sets of a source together.

    Parameters
    ----------
    key, label : str
        Of the source.
    sets : sequence of mapping
        What ``measured_set`` and the drawing made of each; the first has pictures.

    Returns
    -------
    StipplingResult
    """
    values, errors, reasons = {}, {}, {}
    for measure in MEASURES:
        each = np.array([float(one[measure.name]) for one in sets])
        values[measure.name], errors[measure.name] = mean_over_sets(each)
        if math.isnan(values[measure.name]):
            reasons[measure.name] = REASONS[measure.name]
    first = sets[0]
    drawn = [one for one in sets if "cpu_seconds" in one]
    return StipplingResult(
        key=key,
        label=label,
        n=first["points"].shape[0],
        realizations=len(sets),
        points=np.stack([one["points"] for one in sets]),
        cpu_seconds=mean_cost(
            [float(one["cpu_seconds"]) for one in drawn], [bool(one["first"]) for one in drawn]
        ),
        measures=Measures(values, errors, reasons),
        difference=_mean(sets, "difference"),
        patch=_mean(sets, "patch") if "patch_nu" in first else None,
        reconstruction=first["reconstruction"],
        blurred=first["blurred"],
        patch_map=first.get("patch_map"),
        patch_reach=float(first.get("patch_reach", np.asarray(math.nan))),
    )


def _mean(sets: Sequence[Mapping[str, NDArray[Any]]], name: str) -> RadialPower:
    nu, count = sets[0][f"{name}_nu"], sets[0][f"{name}_count"]
    power = np.mean([one[f"{name}_power"] for one in sets], axis=0)
    return RadialPower(np.arange(1.0, len(nu) + 1), nu, power, count)


def wide_table(run: StipplingRun) -> list[dict[str, object]]:
    """One row a source: source, n, realizations, a column and one of its standard error a measure, cost."""
    return [
        {
            "source": source.label,
            "n": source.n,
            "realizations": source.realizations,
            **{
                column: value
                for measure in MEASURES
                for column, value in (
                    (measure.name, source.measures[measure.name]),
                    (f"{measure.name}_error", source.measures.standard_error[measure.name]),
                )
            },
            "cpu_seconds": source.cpu_seconds,
        }
        for source in run.sources
    ]


def spectra_table(run: StipplingRun) -> list[dict[str, object]]:
    """One row a source, spectrum (difference, patch) and annulus: nu, power, count."""
    return [
        {"source": source.label, "spectrum": name, "nu": nu, "power": power, "count": count}
        for source in run.sources
        for name, radial in (("difference", source.difference), ("patch", source.patch))
        if radial is not None
        for nu, power, count in zip(radial.nu, radial.power, radial.count, strict=True)
    ]
