"""Instruction counts of each evaluation of the energy, for plans and benchmarks.

One instruction is a multiplication, an addition or both in one, of one number; comparisons and conversions
count as one too. Loads and stores do not count. All numbers are of one set.
"""

from __future__ import annotations

import math

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.generators.gbn import kernel
from gbnbench.generators.gbn.energy_cost import EnergyCost
from gbnbench.generators.gbn.frequency_ball import ball_square, ball_volume
from gbnbench.generators.gbn.wave_tables import MOST_ROWS, TILE

# Sigmas beyond which a pair adds less than the precision: 4e-7 and 7e-16 of one pair's largest force.
CUTOFF = {"double": 9.0, "float": 6.0}
LARGEST = 1 << 28  # bytes of buffers beyond which the sets of a call are taken in several launches
MOST_IMAGES = 9  # a dimension
ALL_IMAGES = 12.0  # sigmas a side from which strips sum images in double without losing digits
WIDEST = 18.0  # sigmas a side that a polynomial of theta serves; powers of the cosine cancel beyond 20
MARGIN = 1.0 + 1e-9  # of a box over twice the cut-off
EXP = {"double": 18, "float": 13}  # kernels/exp2.cl
DISPLACEMENT = {"double": 5, "float": 3}  # nearest image, in sigmas
WAVE = 8  # a wave of one point, kernels/gbn_harmonics.cl

# Pairs that strips look at, over those within the cut-off, in 1 to 3 dimensions; counted on random points.
SPARE = {"double": (1.2, 1.4, 1.75), "float": (1.65, 2.05, 3.0)}
STRIP = {"double": (3, 19), "float": (4, 14)}  # a dimension of a pair, and the rest with its exp2.cl


def images_needed(ratio: float, precision: str) -> int:
    """Count the images of a point, a dimension, that lie within the cut-off of another.

    Parameters
    ----------
    ratio : float
        Side of the box, in sigmas.
    precision : {"double", "float"}
        Of the arithmetic.

    Returns
    -------
    int
        At least 1.

    Notes
    -----
    The nearest lies within half a side, the others at least 1/2, 1, 3/2, ... sides away.
    """
    return max(1, math.ceil(2 * CUTOFF[precision] / (ratio * MARGIN)))


def theta(n: int, d: int, sigma: float, precision: str) -> EnergyCost:
    """All pairs by polynomials: 2 degree + 9 instructions a pair and dimension.

    Parameters and returns are those of ``images``, without side.

    Raises
    ------
    RefusalError
        If the box is so wide that the polynomial is not worth its length.
    """
    side = kernel.side_of(n, d)
    if side > WIDEST * sigma:
        raise RefusalError(
            f"the box is {side / sigma:.4g} sigmas wide; method theta goes to {WIDEST:g}: strips or images "
            "serve such boxes"
        )
    degree = kernel.degree(side, sigma, precision)
    # Each pair rounds twice a degree and twice a dimension; n pairs may round alike where points coincide.
    error = kernel.EPS[precision] * (4 + 2 * degree + 2 * d) * n
    return EnergyCost("theta", f"all pairs, degree {degree}", n * n, n * n * d * (2.0 * degree + 9), error)


def images(n: int, d: int, sigma: float, precision: str, side: float | None = None) -> EnergyCost:
    """All pairs by exponentials: one a pair, and one for each image of each dimension beyond the nearest.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    sigma : float
        Kernel width, in spacings.
    precision : {"double", "float"}
        Of the arithmetic.
    side : float, optional
        Of the torus, in spacings, where it is not n^(1/d).

    Returns
    -------
    EnergyCost

    Raises
    ------
    RefusalError
        If too many images are within the cut-off.
    """
    ratio = (side or kernel.side_of(n, d)) / sigma
    count = images_needed(ratio, precision)
    if count > MOST_IMAGES:
        raise RefusalError(
            f"a box of {ratio:.3g} sigmas needs {count} images a dimension; method images sums up to "
            f"{MOST_IMAGES}: theta or harmonics serve such boxes"
        )
    pair = d * (DISPLACEMENT[precision] + 2) + EXP[precision] + 2
    if count > 1:
        pair += d * (9 + (count - 1) * (EXP[precision] + 5))
    # Images may cancel: their forces over what is left of them.
    overlap = math.exp(-0.5) / sigma * theta_at_0(n, d, sigma) ** (d - 1) / kernel.largest_force(n, d, sigma)
    terms = 12 + 4 * count + d + _border(ratio, precision)
    error = kernel.EPS[precision] * terms * max(1.0, overlap) * n
    return EnergyCost("images", f"all pairs, {count} images a dimension", n * n, float(n * n) * pair, error)


def theta_at_0(n: int, d: int, sigma: float) -> float:
    """Value of theta where two points coincide.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    sigma : float
        Kernel width, in spacings.

    Returns
    -------
    float
    """
    ratio = kernel.side_of(n, d) / sigma
    reach = math.ceil(9 / ratio)
    return 1 + 2 * sum(math.exp(-0.5 * (j * ratio) ** 2) for j in range(1, reach + 1))


def harmonics(n: int, d: int, sigma: float, precision: str, edge: float | None = None) -> EnergyCost:
    """Frequencies of a ball: three products a point and frequency, over tables of waves.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    sigma : float
        Kernel width, in spacings.
    precision : {"double", "float"}
        Of the arithmetic.
    edge : float or None
        Highest nu that is summed.

    Returns
    -------
    EnergyCost

    Raises
    ------
    RefusalError
        If the tables would be too long.
    InputError
        If edge leaves no frequency.
    """
    square = ball_square(n, d, sigma, precision, edge)
    lead = (d + 1) // 2
    rows = [ball_volume(axes, square) for axes in (lead, d - lead)]
    if max(rows) > MOST_ROWS:
        raise RefusalError(
            f"frequencies up to |f| = {math.sqrt(square):.4g} are {max(rows):.3g} waves of {lead} axes; "
            f"method harmonics takes {MOST_ROWS}: a larger sigma or a smaller edge needs fewer, and theta or "
            "strips none"
        )
    padded = [-(-count // tile) * tile for count, tile in zip(rows, TILE, strict=True)]
    numbers = n * (sum(padded) + d * (2 * math.isqrt(square) + 4)) + 2 * math.prod(padded)
    nbytes = numbers * (8 if precision == "double" else 4)
    if nbytes > LARGEST:
        raise RefusalError(
            f"the waves of {n} points up to |f| = {math.sqrt(square):.4g} take {nbytes:.3g} bytes; method "
            f"harmonics takes {LARGEST:.3g}: strips or theta serve such sets, or a smaller edge"
        )
    # Tiles straddle the ball's surface: about half a tile more along each side.
    products = ball_volume(d, square) * 1.1 + sum(padded)
    waves = sum(count * axes for count, axes in zip(rows, (lead, d - lead), strict=True))
    instructions = n * (3.0 * products + waves * 4 + WAVE * d * (2 * math.isqrt(square) + 1))
    error = kernel.EPS[precision] * (12 + 4 * d) * 1.4 * n
    return EnergyCost(
        "harmonics", f"{ball_volume(d, square):.4g} frequencies", n * products, instructions, error
    )


def strips(
    n: int, d: int, sigma: float, precision: str, cutoff: float | None = None, side: float | None = None
) -> EnergyCost:
    """Pairs within the cut-off only: in double every image of them, in float the nearest.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    sigma : float
        Kernel width, in spacings.
    precision : {"double", "float"}
        Of the arithmetic.
    cutoff : float, optional
        Where the kernel itself ends, in sigmas.
    side : float, optional
        Of the torus, in spacings, where it is not n^(1/d).

    Returns
    -------
    EnergyCost

    Raises
    ------
    InputError
        If cutoff is not positive.
    RefusalError
        In more than 3 dimensions, or where the box is too narrow: than twice the cut-off in float or with a
        cutoff of the kernel's own, than 12 sigmas in double, whose forces images cancel in narrower ones.
    """
    if cutoff is not None and not (math.isfinite(cutoff) and cutoff > 0):
        raise InputError(f"cutoff must be positive, in sigmas; got {cutoff}")
    reach = CUTOFF[precision] if cutoff is None else cutoff
    ratio = (side or kernel.side_of(n, d)) / sigma
    if d > 3:
        raise RefusalError(f"method strips sorts points in 1 to 3 dimensions; got d={d}: theta serves any")
    narrowest = ALL_IMAGES if cutoff is None and precision == "double" else 2 * reach
    if ratio < narrowest * MARGIN:
        least = math.ceil((narrowest * sigma * MARGIN) ** d)
        raise RefusalError(
            f"the box is {ratio:.4g} sigmas wide; strips within {reach:g} sigmas serve boxes from "
            f"{narrowest:g} sigmas, n={least} at this d and sigma"
        )
    ball = math.pi ** (d / 2) / math.gamma(d / 2 + 1) * (reach * sigma) ** d
    dimension, rest = STRIP[precision]
    looked_at = n * ball * SPARE[precision][d - 1]
    error = kernel.EPS[precision] * (16 + d + _border(ratio, precision)) * n
    work = looked_at * (dimension * d + rest)
    return EnergyCost("strips", f"pairs within {reach:g} sigmas", looked_at, work, error)


def _border(ratio: float, precision: str) -> float:
    """Bound what a difference across the border rounds: 2^-54 sides in double, 2^-33 a turn in float."""
    return ratio * (0.85 if precision == "double" else 2.0**-7)
