"""Adaptive Gaussian Blue Noise as a generator (Ahmed, Ren & Wonka 2022, Sections 4.10 and 5.3)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.gbn.descent import descend
from gbnbench.generators.adaptive.gbn.energy import (
    BLOCK_AVERAGE,
    BLOCK_RESOLUTION,
    RESOLUTION,
    AdaptiveEnergy,
)
from gbnbench.generators.adaptive.gbn.ink_box import within_ink
from gbnbench.generators.adaptive.gbn.joint_energy import JointEnergy, Part, union_density
from gbnbench.generators.adaptive.gbn.pixel_blocks import block_side
from gbnbench.generators.adaptive.hilbert_start import hilbert_start
from gbnbench.generators.adaptive.method import AdaptiveMethod, too_fine
from gbnbench.generators.adaptive.protocol import Seen, Told
from gbnbench.generators.ranges import check_least, check_range, raise_refusal
from gbnbench.opencl import runtime


@dataclass(frozen=True)
class AdaptiveGaussianBlueNoise(AdaptiveMethod):
    """Gaussian blue noise whose kernels are as wide as the density wants them.

    Parameters
    ----------
    sigma : float
        Kernel width in local spacings, 0.5 to 1.5. Below 1 pictures are sharper and their grain rougher.
    smoothing : float
        c: the density is averaged over c times the kernels' width to give them their width, 0.1 to 2.
    spread : float
        t: pixels attract as if spread over t times the kernels' width there, 0 to 1. At 1 the set has the
        density and the uniform method's spectrum; below, edges are sharpened, and at 0 points gather in
        clumps.
    gradients : int
        How many, at least 0.
    union : float
        Weight of the energy of all points where several classes, such as inks, are drawn together, 0 to 100;
        at 0 each is drawn by itself.
    precision : {"float", "double"}
        Of the sums over neighbours and pixels.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    What differs from the publication: kernel widths are a field of the density in place of shaping factors
    that each step makes anew (``kernel_widths``), pixels are squares, spread by a part of the kernels' width
    (``attraction``), points start along a Hilbert curve, and Nesterov's method takes the place of 300 to
    1,000 steps of descent. The energy is the paper's variance, Eq. 29 and 47.

    References
    ----------
    Ahmed, Ren & Wonka, "Gaussian blue noise", ACM Trans. Graph. 41(6), 2022.

    Examples
    --------
    >>> from gbnbench.generators.adaptive.density import as_density
    >>> ramp = as_density(np.linspace(0, 1, 32)[:, None] * np.ones(32))
    >>> AdaptiveGaussianBlueNoise(gradients=5)(ramp, 50, np.random.default_rng(0)).shape
    (50, 2)
    """

    name: ClassVar[str] = "gbn"
    summary: ClassVar[str] = "adaptive Gaussian blue noise (Ahmed, Ren & Wonka 2022)"
    reference: ClassVar[str] = "Ahmed, Ren & Wonka, Gaussian blue noise, 2022"
    sigma: float = 0.78
    smoothing: float = 0.5
    spread: float = 0.3
    gradients: int = 100
    union: float = 0.1
    precision: Literal["float", "double"] = "float"

    def __post_init__(self) -> None:
        for name, least, most in (
            ("sigma", 0.5, 1.5),
            ("smoothing", 0.1, 2),
            ("spread", 0, 1),
            ("union", 0, 100),
        ):
            check_range(name, getattr(self, name), least, most)
        check_least("gradients", self.gradients, 0)

    def refusal(self, density: Density, n: int) -> str | None:
        """Say why pixels cannot be cut finely enough, as ``AdaptiveMethod.refusal`` does."""
        cut = self._parts(density, n) ** density.d
        if too_fine(density, n, density.values.size * cut) is None:
            return None
        inner, _, _ = self._within_ink(density, [density], [n])
        return too_fine(density, n, inner.values.size * cut)

    def _narrowest(self, density: Density, n: int) -> float:
        """Width of the narrowest kernel, in pixels."""
        densest = float(density.values.max()) * (n / float(density.values.sum()))
        return float(self.sigma / math.sqrt(2) / densest ** (1 / density.d))

    def _parts(self, density: Density, n: int) -> int:
        """Parts of a pixel's side that make pixels finer than the narrowest kernel."""
        parts: int = math.ceil(RESOLUTION[self.precision] / self._narrowest(density, n))
        return parts

    def blocks(self, density: Density, n: int) -> int:
        """Choose the blocks in which pixels are summed first.

        Parameters
        ----------
        density : Density
            The density.
        n : int
            Points.

        Returns
        -------
        int
            Pixels along a side of those that resolve the narrowest kernel; 1 in double precision.
        """
        least = max(BLOCK_RESOLUTION, BLOCK_AVERAGE / self.smoothing)
        return 1 if self.precision == "double" else block_side(density, self._narrowest(density, n), least)

    def one_set(self, density: Density, n: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one set, as ``AdaptiveMethod.one_set`` describes it."""
        return self.classes([density], [n], [rng], told)[0]

    def classes(
        self,
        densities: Sequence[Density],
        counts: Sequence[int],
        rngs: Sequence[np.random.Generator],
        told: Told | None = None,
        seen: Seen | None = None,
    ) -> list[FloatArray]:
        """Draw sets of several classes, each of them blue noise and so their union.

        Parameters
        ----------
        densities : sequence of Density
            One a class, on one grid of pixels.
        counts : sequence of int
            Points of each class.
        rngs : sequence of numpy.random.Generator
            The streams that their starts are drawn from.
        told : callable, optional
            Called after each gradient.
        seen : callable, optional
            Called with the points at the start and after each gradient.

        Returns
        -------
        list of (n, d) float64
            In pixels, one set a class.

        Raises
        ------
        RefusalError
            If there are too many points for the pixels.

        Notes
        -----
        The energy is the sum over classes of (n / n_c)^2 E_c and ``union`` times the energy E of all n points
        for the sum of the densities. So in flat tones, where a class has the density n_c / n of all, a point
        is held as stiffly by its own class as by all points at ``union`` = 1.
        """
        whole, n = union_density(densities, counts), sum(counts)
        raise_refusal(self.refusal(whole, n))
        if told is not None:
            told(0, max(1, self.gradients), "preparing gbn")
        parts = self._parts(whole, n)
        ends = np.cumsum(counts)[:-1].tolist()
        starts = zip(densities, counts, rngs, strict=True)
        x = np.concatenate([hilbert_start(one, count, rng) * parts for one, count, rng in starts])
        if seen is not None:
            seen(np.split(x / parts, ends))
        if self.gradients:
            whole, densities, corner = self._within_ink(whole, densities, counts)
            fine = [one.finer(parts) for one in densities]
            energy = self._joint_energy(whole.finer(parts), fine, counts)

            def tell(done: int, _: float, now: FloatArray) -> None:
                if told is not None:
                    told(done, self.gradients, "gradients of gbn")
                if seen is not None:
                    seen(np.split(now / parts + corner, ends))

            x = descend(energy, x - corner * parts, self.gradients, tell) + corner * parts
        return np.split(x / parts, ends)

    def pull(self, density: Density, n: int, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Look up what a density of n points does at any number of places.

        Parameters
        ----------
        density : Density
            The density.
        n : int
            Points that it is scaled to.
        x : (m, d) float64
            Places, in pixels.

        Returns
        -------
        widths : (m,) float64
            Of the kernels of n points there, in pixels.
        pulls : (m,) float64
            The density with its spread, smoothed by these, points a squared pixel (or cubed).
        """
        parts = self._parts(density, n)
        density, _, corner = self._within_ink(density, [density], [n])
        widths, pulls = self._energy(density.finer(parts), n).pull((x - corner) * parts)
        return widths / parts, pulls * parts**density.d

    def _within_ink(
        self, whole: Density, densities: Sequence[Density], counts: Sequence[int]
    ) -> tuple[Density, Sequence[Density], FloatArray]:
        """Leave out white that no kernel sees, if pixels are to be cut; with the corner of what is left."""
        if self._parts(whole, sum(counts)) == 1:
            return whole, densities, np.zeros(whole.d)
        return within_ink(whole, densities, counts, self.sigma, self.smoothing)

    def _energy(self, density: Density, n: int) -> AdaptiveEnergy:
        return AdaptiveEnergy(
            runtime(), density, n, sigma=self.sigma, smoothing=self.smoothing, spread=self.spread,
            precision=self.precision, blocks=self.blocks(density, n),
        )  # fmt: skip

    def _joint_energy(
        self, whole: Density, densities: Sequence[Density], counts: Sequence[int]
    ) -> AdaptiveEnergy | JointEnergy:
        """Energy of all points, class after class."""
        n = sum(counts)
        if len(counts) == 1:
            return self._energy(whole, n)
        parts = [Part(slice(0, n), self._energy(whole, n), self.union)] if self.union else []
        first = 0
        for density, count in zip(densities, counts, strict=True):
            parts.append(Part(slice(first, first + count), self._energy(density, count), (n / count) ** 2))
            first += count
        return JointEnergy(whole, parts)
