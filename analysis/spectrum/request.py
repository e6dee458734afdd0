"""A request for a spectrum: its frequencies, and the size of the point sets.

A request can be made, checked and planned before there are any points.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from gbnbench.analysis.spectrum import limits
from gbnbench.analysis.spectrum.digits import Harmonics
from gbnbench.analysis.spectrum.limits import LARGEST_COUNT, check_harmonic, check_positive
from gbnbench.analysis.spectrum.listed_shells import listed_count
from gbnbench.analysis.spectrum.sorted_groups import count_pairs, two_sorted_groups
from gbnbench.core.errors import InputError
from gbnbench.core.memory import memory_limit

Frequencies = Literal["cube", "half cube", "shells", "listed"]
Progress = Callable[[float], None]  # called with the share done
SHELL_BYTES = 96  # for each shell: on the device, twice on the host, and where they are merged
GROUP_BYTES = 64  # for each frequency of a group of axes while it is listed and sorted


@dataclass(frozen=True)
class SpectrumRequest:
    """The frequencies that are wanted, and the number and size of the point sets.

    Attributes
    ----------
    what : {"cube", "half cube", "shells", "listed"}
        Kind of the set of frequencies.
    n, d, fmax, realizations : int
        Points in a set, dimension, largest harmonic on each axis, number of sets.
    frequencies : int
        Number of frequencies wanted, over the whole space.
    low, high : int
        Smallest and largest |f|^2, for shells.
    harmonics : tuple of d ints, or ()
        Largest harmonic on each axis of a box, of which fmax is the largest; empty for a cube.
    """

    what: Frequencies
    n: int
    d: int
    fmax: int
    realizations: int
    frequencies: int
    low: int = 0
    high: int = 0
    harmonics: tuple[int, ...] = ()

    @property
    def largest(self) -> Harmonics:
        """Largest harmonic on each axis: one number for a cube."""
        return self.harmonics or self.fmax

    def __str__(self) -> str:
        sets = "" if self.realizations == 1 else f", {self.realizations} sets"
        noun = "frequency" if self.frequencies == 1 else "frequencies"
        reach = (
            f"|f|^2 from {max(self.low, 1)} to {self.high}"
            if self.what == "shells"
            else f"|f_a| <= {', '.join(map(str, self.harmonics or (self.fmax,)))}"
        )
        what = self.what.replace("cube", "box") if self.harmonics else self.what
        return f"{what}: {self.frequencies:,} {noun}, {reach}, of {self.n:,} points, d={self.d}{sets}"


def box_request(
    n: int, d: int, harmonics: tuple[int, ...], realizations: int, *, half: bool = False
) -> SpectrumRequest:
    """Make the request for a box of frequencies, which is a cube where all axes reach as far.

    Parameters
    ----------
    n, d : int
        Points in a set, and dimension.
    harmonics : tuple of d ints
        Largest harmonic on each axis.
    realizations : int
        Number of sets.
    half : bool
        Only the half with f_0 >= 0.

    Returns
    -------
    SpectrumRequest

    Raises
    ------
    InputError
        If the powers do not fit in memory.
    """
    count = math.prod(2 * f + 1 for f in harmonics)
    room = limits.MEMORY_SHARE * memory_limit() / limits.BYTES
    if count > room:
        raise InputError(
            f"|f_a| <= {', '.join(map(str, harmonics))} means {float(count):.3g} frequencies, of which "
            f"{room:.3g} fit in memory; ask for a smaller fmax"
        )
    largest = max(harmonics)
    equal = min(harmonics) == largest
    return SpectrumRequest(
        "half cube" if half else "cube",
        *(n, d, largest, realizations, count),
        harmonics=() if equal else harmonics,
    )


def shell_request(
    n: int, d: int, fmax: int, realizations: int, band: Sequence[float] | None, corners: bool
) -> SpectrumRequest:
    """Make the request for the shells of a ball, of a band, or of a whole cube.

    Parameters
    ----------
    n, d, fmax, realizations : int
        Points in a set, dimension, largest harmonic on each axis, number of sets.
    band : (float, float) or None
        Smallest and largest |f|, cycles per unit length.
    corners : bool
        Take every frequency of the cube; otherwise those with |f| <= fmax.

    Returns
    -------
    SpectrumRequest
        For shells; for the listed frequencies of one half of them where the cube cannot be counted.

    Raises
    ------
    InputError
        If fmax or band are not what they must be, no frequency lies in the band, or the shells do not fit in
        memory.
    """
    f = check_positive(fmax)
    listed = (2 * f + 1) ** d > LARGEST_COUNT
    if corners or d == 1:
        check_harmonic(f, d)
    low, high = 1, d * f * f if corners else f * f
    if band is not None:
        least, most = check_band(band, math.sqrt(high), f)
        low = max(low, math.ceil(least * least * (1 - 1e-12)))
        high = min(high, math.floor(most * most * (1 + 1e-12)))
    if high >= 1 << 32:
        raise InputError(
            f"|f|^2 up to {high} does not fit in 32 bits; the largest fmax here is "
            f"{math.isqrt(((1 << 32) - 1) // (d if corners else 1))}"
        )
    if low > high:
        raise InputError(f"no integer frequency has |f| in {band!r}")
    if listed:
        count = listed_count(d, low, high)
        if count == 0:
            raise InputError(f"no integer frequency has |f| in {band!r}")
        return SpectrumRequest("listed", n, d, f, realizations, count, low, high)
    check_room(d, f, low, high)
    count = _count(d, f, low, high)
    if count == 0:
        raise InputError(f"no integer frequency has |f| in {band!r}")
    return SpectrumRequest("shells", n, d, f, realizations, count, low, high)


def check_band(band: Sequence[float], largest: float, fmax: int) -> tuple[float, float]:
    """Check a band of |f|.

    Parameters
    ----------
    band : (float, float)
        What the user gave.
    largest : float
        |f| up to which there are shells.
    fmax : int
        Largest harmonic, for the message.

    Returns
    -------
    low, high : float

    Raises
    ------
    InputError
        If they are not 0 <= low <= high <= largest.
    """
    try:
        least, most = (float(edge) for edge in band)
    except (TypeError, ValueError):
        raise InputError(f"band must be two numbers, the least and the largest |f|; got {band!r}") from None
    if not 0 <= least <= most < math.inf:
        raise InputError(f"band must be 0 <= low <= high, cycles per unit length; got {band!r}")
    if most > largest * (1 + 1e-12):
        raise InputError(
            f"band ends at |f| = {most:g}, beyond the whole shells of fmax={fmax}; "
            f"ask for fmax={math.ceil(most)}"
        )
    return least, most


def check_room(d: int, fmax: int, low: int, high: int) -> None:
    """Refuse shells or groups of axes that do not fit in memory, before they are listed.

    Parameters
    ----------
    d, fmax : int
        Dimension and largest harmonic on each axis.
    low, high : int
        Smallest and largest |f|^2.

    Raises
    ------
    InputError
        If they take more than half of this machine's memory.
    """
    axes = d - d // 2
    ball = math.pi ** (axes / 2) / math.gamma(axes / 2 + 1) * (math.sqrt(high) + math.sqrt(axes) / 2) ** axes
    listed = min(ball, float(2 * fmax + 1) ** axes)
    needed = max(SHELL_BYTES * (high - low + 1), GROUP_BYTES * listed)
    room = limits.MEMORY_SHARE * memory_limit()
    if needed > room:
        raise InputError(
            f"shells of |f|^2 from {low} to {high} in d={d} take {needed / 1e9:.3g} GB, more than half "
            "of this machine's memory; ask for a narrower band or a smaller fmax"
        )


def _count(d: int, fmax: int, low: int, high: int) -> int:
    """Count the frequencies with low <= |f|^2 <= high, over the whole space."""
    if d == 1:
        return 2 * (math.isqrt(high) - math.isqrt(low - 1))
    a, b = two_sorted_groups(d, fmax, high)
    # A pair stands for (fa, fb), (fa, -fb) and their mirror images: four, or two if fa or fb is 0.
    alone = sum(int(np.count_nonzero((g.square >= low) & (g.square <= high))) for g in (a, b))
    return 4 * count_pairs(a, b, low, high) - 2 * alone
