"""Capacity-constrained point distributions by swapping samples (Balzer, Schlömer & Deussen 2009)."""

from __future__ import annotations

import functools
import warnings
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.ccvt.assignment import sample_lattice, share_out, short_basis, split
from gbnbench.generators.ccvt.swaps import Swaps, placed
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import check_least, outside_plane
from gbnbench.generators.set_by_set import SetBySet, Told

SPLITS = 2  # times that each sample is split into four
MOST = 2**25  # samples in all: some 2 GB while they are swapped


@dataclass(frozen=True)
class CapacityConstrained(SetBySet):
    """Sites at the centroids of equally many samples each, which no swap of two samples can bring nearer.

    Parameters
    ----------
    samples : int
        Samples of the torus a point, its capacity, >= 1.
    passes : int
        Most passes over all pairs with one sampling, >= 1.

    Raises
    ------
    InputError
        If a setting is out of range.
    DeviceError
        If the device lacks double precision or memory, when called.

    Warns
    -----
    RuntimeWarning
        If swaps still lower the energy after the last pass.

    Notes
    -----
    n * samples samples, a lattice at a random shift, are shared out among uniform random sites, each to the
    nearest that has room. Then two sites swap samples, those first that gain the most, while that lowers the
    sum of squared distances of samples from their sites, and both move to their centroids; pairs are looked
    at whose bounding circles overlap and of which one has changed, until no swap is left. Every site keeps
    its capacity, so the variance of capacities is 0 exactly. The samples are a lattice and not the square
    grid of the authors, which needs n * samples to be a square; pairs that share no site are treated
    together, in random order. Sites settle first with a sixteenth of the samples, each of which is then split
    into four, twice, where four divide them. Of a few points, whose cells meet on both sides of the torus,
    swaps are sought on one side at a time.

    Where the swaps end depends on the capacity, for a coarse sampling holds boundaries fast. The authors'
    program has 1,024 samples a point, but the set whose figures were published cannot have come of that:
    their algorithm to the letter, written anew, gives a mean distance of .861 and a spread over sets of .001,
    as this module does, where the set has .872; 4,096 samples give .881. With 2,048 it is .872, and the
    other four figures of the set follow: minimum distance .73 (.748), bond order .44 (.450), effective
    Nyquist frequency .858 (.860), oscillations 2.01 (2.01). That number is thus inferred from one figure, and
    is the default.

    Four times the points take some five times as long: more sites need more passes, but the last of them are
    over a few pairs.

    References
    ----------
    Balzer, Schlömer & Deussen, "Capacity-constrained point distributions: a variant of Lloyd's method",
    ACM Trans. Graphics 28(3), 2009.

    Examples
    --------
    >>> CapacityConstrained(samples=64)(16, 2, np.random.default_rng(0)).shape
    (16, 2)
    """

    name: ClassVar[str] = "ccvt"
    summary: ClassVar[str] = (
        "capacity-constrained point distribution by swapping samples (Balzer et al. 2009)"
    )
    family: ClassVar[Family] = "cellular"
    dimensions: ClassVar[tuple[int, int | None]] = (2, 2)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Balzer, Schlömer & Deussen, 2009"
    samples: int = 2048
    passes: int = 10000

    def __post_init__(self) -> None:
        for name in ("samples", "passes"):
            check_least(name, getattr(self, name), 1)

    def refusal(self, n: int, d: int) -> str | None:
        """Say why not: d is other than 2, or there would be too many samples.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason; None where the set can be made.
        """
        if reason := outside_plane(d, "ccvt shares out samples of the plane"):
            return reason
        if n * self.samples > MOST:
            return (
                f"ccvt swaps at most {MOST:,} samples; got n={n} of {self.samples} each, "
                f"nearest is {max(1, MOST // self.samples)}"
            )
        return None

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        sites, capacity = rng.random((n, d)), self.samples
        for _ in range(SPLITS):
            capacity //= 4 if capacity % 4 == 0 else 1
        samples, basis = sample_lattice(n * capacity, rng), short_basis(n * capacity)
        swaps = Swaps(sites, placed(sites, samples[share_out(sites, samples, rng)]))
        self._settle(swaps, rng, functools.partial(_between, told, 0.0, capacity / self.samples))
        while capacity < self.samples:
            swaps = Swaps(swaps.sites, split(swaps.offsets, basis))
            before, capacity, basis = capacity / self.samples, 4 * capacity, basis / 2
            after = capacity / self.samples
            self._settle(swaps, rng, functools.partial(_between, told, before, after))
        if swaps.settled:
            return swaps.sites
        warnings.warn(
            f"ccvt: passes={self.passes} left swaps that lower the energy of n={n} points; raise passes",
            RuntimeWarning,
            stacklevel=2,
        )
        return swaps.sites

    def _settle(self, swaps: Swaps, rng: np.random.Generator, told: Told) -> None:
        """Swap until no swap is left, or for so many passes; tell the share of sites that are at rest."""
        for _ in range(self.passes):
            if swaps.settled:
                return
            swaps.sweep(rng)
            told(swaps.at_rest)


def _between(told: Told, before: float, after: float, share: float) -> None:
    told(before + (after - before) * share)
