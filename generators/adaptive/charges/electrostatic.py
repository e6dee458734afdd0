"""Electrostatic halftoning: points repel one another, pixels attract them (Schmaltz et al. 2010)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from scipy import ndimage

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.charges.repulsion import Repulsion, charges_refusal
from gbnbench.generators.adaptive.charges.smoothed_field import SmoothedField
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.domain import Mode, interpolation_mode, pixels_of, to_ink, within
from gbnbench.generators.adaptive.method import AdaptiveMethod, too_fine
from gbnbench.generators.adaptive.protocol import Told
from gbnbench.generators.adaptive.rejection import Rejection
from gbnbench.generators.kernel_based.electrostatic import EVERY, STRONGEST, shaking_length
from gbnbench.generators.protocol import MOST_ITERATIONS
from gbnbench.generators.ranges import check_above, check_range

PIXEL = 0.8  # width of the Gaussian over which a pixel's charge is spread, in pixels
FINEST = 2.0  # pixels that the least spacing has, at least
MARGIN = 6  # pixels beyond the borders of a bounded image in which its pull is known: splines end there
MOST_PIXELS = 1 << 24  # whose field is had by one transform
LIGHTEST = 0.1  # density over its mean below which steps grow no more


@dataclass(frozen=True)
class ElectrostaticHalftoning(AdaptiveMethod):
    """Equal charges that repel one another and are attracted by an image, shaken ever less.

    Parameters
    ----------
    iterations : int
        Steps of all points, >= 0.
    tau : float
        Step length over force, in squared local spacings, above 0 and at most 0.3, beyond which steps
        overshoot.
    shaking : float
        Factor of the published shaking, 0 to 1000; 0 leaves it out.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    A point moves by tau times the sum of forces 1/r: away from each other point, and towards each pixel with
    the charge of its share of points. Every tenth step i each point is shaken in a random direction by
    max(0, log2(iterations) - 6) exp(-i / 1000) / 10 spacings of the darkest pixel, which are pixels where
    that one is black and has a point of its own; ten steps follow the last shaking. Points start independent
    in proportion to the density. Points that would leave a bounded image go half of the way to its border.

    What differs from the publication: tau counts squared spacings of the local density, or of a tenth of the
    mean where it is less, in place of those of the darkest pixel for all (light regions come to rest as fast
    as dark ones; 24.0 dB in place of 23.9 on ``camera``), and a step is at most one spacing. A pixel's charge
    is a Gaussian of 0.8 pixels, and pixels are cut until the least spacing has two of them; its pull is
    interpolated by cubic splines. Points repel on a mesh and in pairs (``repulsion``), to 1e-4 of a near
    one's force, in place of all pairs. On the torus all images act, with an even background.

    Cost: 15 CPU s for 10,000 points on 512 x 512 pixels.

    References
    ----------
    Schmaltz, Gwosdek, Bruhn & Weickert, "Electrostatic halftoning", Computer Graphics Forum 29(8), 2010.

    Examples
    --------
    >>> from gbnbench.generators.adaptive.density import as_density
    >>> ramp = as_density(np.linspace(0, 1, 32)[:, None] * np.ones(32))
    >>> ElectrostaticHalftoning(iterations=5)(ramp, 50, np.random.default_rng(0)).shape
    (50, 2)
    """

    name: ClassVar[str] = "electrostatic"
    summary: ClassVar[str] = "electrostatic halftoning (Schmaltz et al. 2010)"
    reference: ClassVar[str] = "Schmaltz, Gwosdek, Bruhn & Weickert, Electrostatic halftoning, 2010"
    iterations: int = 250
    tau: float = 0.1
    shaking: float = 1.0

    def __post_init__(self) -> None:
        check_range("iterations", self.iterations, 0, MOST_ITERATIONS)
        check_above("tau", self.tau, 0, 0.3, "squared spacings")
        check_range("shaking", self.shaking, 0, STRONGEST)

    def refusal(self, density: Density, n: int) -> str | None:
        """Say why charges are not moved, as ``AdaptiveMethod.refusal`` does."""
        if density.d != 2:
            return f"forces 1/r are those of charges in the plane; got {density.d} axes, not 2"
        parts = self._parts(density, n)
        if reason := too_fine(density, n, density.values.size * parts**2, most=MOST_PIXELS):
            return reason
        return charges_refusal(density.finer(parts), n)

    def _parts(self, density: Density, n: int) -> int:
        """Parts of a pixel's side that make the least spacing two of them."""
        return max(1, math.ceil(FINEST * math.sqrt(float(density.of_points(n).max()))))

    def one_set(self, density: Density, n: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one set, as ``AdaptiveMethod.one_set`` describes it."""
        parts = self._parts(density, n)
        fine = density.finer(parts)
        repulsion, attraction = Repulsion(fine, n), Attraction(fine, n)
        x = Rejection()(density, n, rng) * parts
        for i in range(1, self.iterations + 1):
            spacing = attraction.spacings(x)[:, None]
            step = self.tau * spacing**2 * (repulsion(x) + attraction(x))
            step /= np.maximum(np.linalg.norm(step, axis=1, keepdims=True) / spacing, 1.0)
            if i % EVERY == 0 and i + EVERY <= self.iterations and self.shaking:
                direction = rng.standard_normal((n, 2))
                direction /= np.linalg.norm(direction, axis=1, keepdims=True)
                step += (
                    self.shaking * shaking_length(i, self.iterations) * attraction.least_spacing * direction
                )
            x = moved_within(fine, x, step)
            told(i, self.iterations, "steps of electrostatic")
        return within(density, to_ink(fine, x) / parts)


def moved_within(density: Density, x: FloatArray, step: FloatArray) -> FloatArray:
    """Move points; those that would leave a box go half of the way to its border, where none meet.

    Parameters
    ----------
    density : Density
        The density.
    x, step : (n, 2) float64
        Points and their steps, in pixels.

    Returns
    -------
    (n, 2) float64
    """
    moved = x + step
    inside = within(density, moved)
    return inside if density.toroidal else np.where(inside == moved, moved, (x + inside) / 2)


class Attraction:
    """The pull of a density's pixels, and the spacing that it wants.

    Parameters
    ----------
    density : Density
        Of an image.
    n : int
        Points, whose charges add up to that of the pixels.

    Attributes
    ----------
    least_spacing : float
        Of points where the density is largest, in pixels.
    """

    def __init__(self, density: Density, n: int) -> None:
        rho = density.of_points(n)
        self._density = density
        self._mode: Mode = interpolation_mode(toroidal=density.toroidal)
        self._margin = 0 if density.toroidal else MARGIN
        charges = np.pad(rho, self._margin)
        push = SmoothedField(charges.shape, np.ones(2), PIXEL**2, toroidal=density.toroidal)(charges)
        self._pull = [ndimage.spline_filter(-along, order=3, mode=self._mode) for along in push]
        smooth = ndimage.gaussian_filter(rho, PIXEL, mode=self._mode)
        self.least_spacing = 1 / math.sqrt(float(rho.max()))
        self._spacings: FloatArray = 1 / np.sqrt(np.maximum(smooth, LIGHTEST * rho.mean()))

    def spacings(self, x: FloatArray) -> FloatArray:
        """Wanted spacing at places, in pixels: density ** (-1/2).

        Parameters
        ----------
        x : (m, 2) float64
            Within the density.

        Returns
        -------
        (m,) float64
        """
        found: FloatArray = self._spacings[pixels_of(self._density, x)]
        return found

    def __call__(self, x: FloatArray) -> FloatArray:
        """Force of the pixels on unit charges.

        Parameters
        ----------
        x : (m, 2) float64
            Within the density, in pixels.

        Returns
        -------
        (m, 2) float64
        """
        at = x.T - 0.5 + self._margin
        force = [
            ndimage.map_coordinates(along, at, order=3, mode=self._mode, prefilter=False)
            for along in self._pull
        ]
        return np.stack(force, axis=1)
