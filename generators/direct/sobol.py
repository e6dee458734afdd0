"""Sobol points under Owen's nested uniform scrambling (Sobol 1967; Joe & Kuo 2008; Owen 1995)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import as_file, files
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import raise_refusal, too_many, too_many_axes

MOST_DIMENSIONS = 21201  # of Joe & Kuo's direction numbers in scipy
MOST_BITS = 30  # digits of the unscrambled points
NUMBERS = "stats/_sobol_direction_numbers.npz"  # of scipy, whose statistics take half a second to load
DIGITS = 53  # of a scrambled coordinate


def owen_permutation(bits: int, rng: np.random.Generator) -> NDArray[np.int64]:
    """Nested uniform scrambling of all binary fractions of some length.

    Parameters
    ----------
    bits : int
        Digits m.
    rng : Generator
        Gives the 2**m - 1 independent flips, one for each node of the binary tree.

    Returns
    -------
    (2**m,) int64
        Where k / 2**m goes, times 2**m. Digit j is flipped or kept by a fair coin that belongs to the j - 1
        digits before it.

    Notes
    -----
    Owen 1995, Sec. 3, in base 2, where a permutation of a digit is a flip.
    """
    permutation = np.zeros(1, dtype=np.int64)
    for level in range(bits):
        flip = rng.integers(0, 2, size=2**level)
        permutation = (2 * permutation[:, None] + np.stack([flip, 1 - flip], axis=1)).reshape(-1)
    return permutation


@cache
def directions(d: int) -> NDArray[np.int64]:
    """Direction numbers of Joe & Kuo, from the table within scipy.

    Parameters
    ----------
    d : int
        Dimension, at most 21,201.

    Returns
    -------
    (d, 30) int64
        Number j of each axis, times 2**30: its leading digit has the weight 2**-(j+1).

    Notes
    -----
    Joe & Kuo 2008, Eq. (2). Of a primitive polynomial of degree s with the digits a_0 = 1, a_1 ... a_s, the
    first s numbers m are tabulated, and m_j = 2 a_1 m_{j-1} ^ 4 a_2 m_{j-2} ^ ... ^ 2**s a_s m_{j-s} ^
    m_{j-s}; number j is m_j / 2**(j+1).
    """
    with as_file(files("scipy") / NUMBERS) as path, np.load(path) as table:
        polynomials, tabulated = table["poly"][:d].tolist(), table["vinit"][:d]
    m = np.ones((d, MOST_BITS), dtype=np.int64)  # the first axis has no polynomial: van der Corput's
    for axis in range(1, d):
        degree = polynomials[axis].bit_length() - 1
        m[axis, :degree] = tabulated[axis, :degree]
        for j in range(degree, MOST_BITS):
            number = m[axis, j - degree]
            for k in range(1, degree + 1):
                if polynomials[axis] >> (degree - k) & 1:
                    number ^= m[axis, j - k] << k
            m[axis, j] = number
    return m << np.arange(MOST_BITS - 1, -1, -1)


def unscrambled(bits: int, d: int) -> NDArray[np.int64]:
    """Sobol's points in the order of the Gray code.

    Parameters
    ----------
    bits : int
        There are 2**bits of them, <= 2**30.
    d : int
        Dimension, at most 21,201.

    Returns
    -------
    (2**bits, d) int64
        Coordinates times 2**bits.
    """
    try:
        numbers = directions(d)[:, :bits] >> (MOST_BITS - bits)
    except (OSError, KeyError):  # the table is scipy's own affair, and may move
        from scipy.stats import qmc

        plain = qmc.Sobol(d, scramble=False, bits=MOST_BITS).random_base2(bits)
        return np.asarray(np.floor(plain * 2**bits), np.int64)
    points = np.zeros((1, d), dtype=np.int64)
    for number in numbers.T:  # the second half of a Gray code is the first in reverse, with one digit more
        points = np.concatenate([points, points[::-1] ^ number])
    return points


@dataclass(frozen=True)
class Sobol:
    """First n points of the Sobol sequence under Owen scrambling; not toroidal by design.

    Any n is served, but the balance (each base-2 elementary interval of volume 2**t / n holding 2**t points)
    holds at powers of two.

    Notes
    -----
    scipy's ``Sobol(scramble=True)`` is a random linear matrix scramble and a digital shift, under which the
    points of a stratum depend on one another. Here its unscrambled digits pass through true nested uniform
    permutations: digit j of a coordinate is flipped by a coin of its own for every prefix of j - 1 digits.
    Beyond the first ceil(log2 n) digits all prefixes differ, so that the remaining ones are independent
    uniform bits. Hence for n = 2**m each coordinate has one uniform point in each of n strata, independent
    of the others, and E[P(f)] = 1 - sinc(f_a / n)**2 on the axes.

    References
    ----------
    Joe & Kuo, "Constructing Sobol sequences with better two-dimensional projections", SIAM J. Sci. Comput.
    30(5), 2008. Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", LNS 106, 1995.

    Examples
    --------
    >>> x = Sobol()(8, 2, np.random.default_rng(0))
    >>> np.sort(np.floor(8 * x[:, 1])).tolist()
    [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]
    """

    name: ClassVar[str] = "sobol"
    summary: ClassVar[str] = (
        "Sobol sequence, Owen-scrambled (Joe & Kuo 2008; Owen 1995); balanced at n = 2**m"
    )
    family: ClassVar[Family] = "low-discrepancy"
    dimensions: ClassVar[tuple[int, int | None]] = (1, 21201)
    toroidal: ClassVar[bool] = False
    reference: ClassVar[str] = "Sobol, 1967; Joe & Kuo, 2008; Owen, 1995"

    def refusal(self, n: int, d: int) -> str | None:
        """Say why n or d is beyond the direction numbers at hand, with the largest that is not.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason, with the nearest numbers that can; None where they can.
        """
        what = "for Sobol points"
        return too_many_axes(d, MOST_DIMENSIONS, what) or too_many(n, 2**MOST_BITS, what)

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization, (n, d) float64; RefusalError where ``refusal`` has a reason."""
        raise_refusal(self.refusal(n, d))
        bits = (n - 1).bit_length()
        prefix = unscrambled(bits, d)[:n]
        x = np.empty((n, d))
        for axis in range(d):
            scrambled = owen_permutation(bits, rng)[prefix[:, axis]] << (DIGITS - bits)
            x[:, axis] = scrambled | rng.integers(0, 2 ** (DIGITS - bits), size=n)
        return x * 2.0**-DIGITS
