"""Measures of one set for a density: its error, the picture found back from it, and local spectra."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.measure_definitions import Definition
from gbnbench.analysis.reconstruction.blurred_difference import blurred_difference_map
from gbnbench.analysis.reconstruction.density_estimates import reconstructed_density
from gbnbench.analysis.reconstruction.difference_spectrum import annular_power, difference_power
from gbnbench.analysis.reconstruction.image_quality import ImageQuality, image_quality
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.studies.stippling_comparison.flat_patch import FlatPatch
from gbnbench.studies.stippling_comparison.relative_variance import relative_variance

BLUR = 16.0  # pixels
ITERATIONS = 15  # of Algorithm 2, as in its authors' program
FLOOR = 0.25  # nu
PATCH_NU = 2.0

MEASURES: tuple[Definition, ...] = (
    Definition(
        "relative_variance",
        "variance",
        "",
        "lower",
        "Mean over the density of ((A - T) / T)^2: A sums Gaussians whose widths follow the density, T is "
        "the density blurred by as much.",
        "Ahmed, Ren & Wonka 2022, Eq. 29 and 47, relative",
    ),
    Definition(
        "blurred_difference",
        "F16",
        "",
        "lower",
        "Root mean square of the set less the density, both blurred by a Gaussian of 16 pixels, over the "
        "mean density.",
        "gbnbench",
    ),
    Definition(
        "psnr",
        "PSNR",
        "dB",
        "higher",
        "Peak signal to noise of the picture that Algorithm 2 finds back from the points alone (sigma 0.5, "
        "15 iterations, mean normalised, points mirrored at the borders), at its best gain.",
        "Ahmed, Ren & Wonka 2022, Sec. 4.10",
    ),
    Definition(
        "ssim",
        "SSIM",
        "",
        "higher",
        "Structural similarity of the same picture, windows of 7 pixels.",
        "Wang, Bovik, Sheikh & Simoncelli 2004",
    ),
    Definition(
        "patch_floor",
        "patch floor",
        "power",
        "lower",
        "Mean power of the points less the density in the flattest square of the image, over 0 < nu <= 0.25 "
        "of its own spacing, seen through the taper of Blackman and Harris, which mixes frequencies within "
        "4 cycles.",
        "gbnbench",
    ),
)


def reconstruction_quality(
    points: FloatArray, density: FloatArray, *, reflected: bool = True
) -> tuple[FloatArray, ImageQuality]:
    """Find the picture back by Algorithm 2 as its authors' program does, and hold it against the density.

    Parameters
    ----------
    points : (n, 2) float64
        In pixels, rows first.
    density : (rows, columns) float64
        At least 0; its scale is free.
    reflected : bool
        Mirror the points at the borders, which the authors' program does not.

    Returns
    -------
    reconstruction : (rows, columns) float64
        Points a pixel.
    quality : ImageQuality
    """
    found = reconstructed_density(
        points, density.shape, average="mean", iterations=ITERATIONS, reflected=reflected
    )
    return found, image_quality(found, density)


def measured_set(
    points: FloatArray, density: Density, patch: FlatPatch | None, *, pictures: bool
) -> dict[str, NDArray[np.generic]]:
    """Measure one set.

    Parameters
    ----------
    points : (n, 2) float64
        In pixels, rows first.
    density : Density
        What they are for.
    patch : FlatPatch, optional
        Where the local spectrum is taken.
    pictures : bool
        Return what pictures show, too.

    Returns
    -------
    dict of arrays
        A number for each of ``MEASURES``, nan where undefined; ``difference_nu``, ``difference_power`` and
        ``difference_count``, the spectrum of the set less the density in annuli of one cycle of the shorter
        side; ``patch_nu``, ``patch_power``, ``patch_count``, the same in the patch. With pictures float32
        ``reconstruction`` and ``blurred`` of the density's shape and ``patch_map``, its half side being
        ``patch_reach`` in nu.
    """
    wanted = density.of_points(len(points))
    reconstruction, quality = reconstruction_quality(points, density.values)
    blurred = blurred_difference_map(points, density.values, BLUR, toroidal=density.toroidal)
    values = {
        "relative_variance": relative_variance(points, density),
        "blurred_difference": float(np.sqrt((blurred**2).mean())),
        "psnr": quality.psnr,
        "ssim": quality.ssim,
        "patch_floor": math.nan,
    }
    spacing = math.sqrt(wanted.size / len(points))
    nu, power = difference_power(points, wanted)
    arrays = _annuli("difference", nu, power, spacing / min(density.shape))
    if pictures:
        arrays |= {"reconstruction": reconstruction.astype(np.float32), "blurred": blurred.astype(np.float32)}
    if patch is not None:
        local = patch.of(wanted)
        nu, power = difference_power(patch.points(points), local, tapered=True, nu_max=PATCH_NU)
        step = 1 / math.sqrt(float(local.sum()))
        arrays |= _annuli("patch", nu, power, step)
        low = (nu > 0) & (nu <= max(FLOOR, step))
        values["patch_floor"] = float(power[low].mean())
        if pictures:
            arrays |= {
                "patch_map": power.astype(np.float32),
                "patch_reach": np.asarray((len(power) // 2) * step),
            }
    return {**{name: np.asarray(value) for name, value in values.items()}, **arrays}


def _annuli(name: str, nu: FloatArray, power: FloatArray, step: float) -> dict[str, NDArray[np.generic]]:
    radial = annular_power(nu, power, step)
    return {f"{name}_nu": radial.nu, f"{name}_power": radial.power, f"{name}_count": radial.count}
