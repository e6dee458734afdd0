"""Exact periodograms in any dimension: P(f) = |sum_k exp(-2 pi i f.x_k)|^2 / n at integer frequencies.

A whole cube is a two-group product (two_group.py), listed frequencies are summed one by one; either way
phases are exact, from fixed-point coordinates, and so are sums to the precision asked for.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gbnbench.analysis.precision import padded, precision_of
from gbnbench.analysis.two_group import TwoGroupProduct
from gbnbench.errors import InputError
from gbnbench.opencl import runtime
from gbnbench.results import Spectrum
from gbnbench.torus import FloatArray, as_realizations

MEMORY_SHARE = 0.5  # of the machine's memory that one cube may take


def periodogram(
    x: ArrayLike,
    fmax: int | None = None,
    precision: str = "double",
    frequencies: ArrayLike | None = None,
) -> Spectrum:
    """Exact power at every integer frequency with |f_a| <= fmax, or at those listed.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) array_like
        Points on the unit torus; power is averaged over realizations.
    fmax : int
        Largest harmonic on each axis, cycles per unit length, at least 1.
    precision : {"double", "float"}
        Of the phases, tables and sums of 128 points; those sums are added in double where the device has it.
        The power floor, where the truth is 0, is about 1e-29 in double and 1e-13 in float.
    frequencies : (m, d) array_like of int, optional
        Frequencies instead of a cube; any int64.

    Returns
    -------
    Spectrum
        ``power`` is (2*fmax+1,)*d float64 with DC, which equals n, at the centre; (m,) for listed
        frequencies. 1 in expectation for white noise.

    Raises
    ------
    InputError
        If x is not points of [0, 1)^d, fmax is not a positive integer, both or neither of fmax and
        frequencies are given, or the cube does not fit in memory (the text says what would).
    DeviceError
        If there is no OpenCL device, or it lacks the precision.

    Notes
    -----
    Eq. (10) of Ahmed, Ren & Wonka (2022), divided by n as in PSA. A coordinate is rounded to a multiple of
    2**-64 of a turn (2**-32 in float); from there f.x mod 1 is exact at any f, and the error of an amplitude
    is that of the cosines and their sum: about 4e-16 sqrt(n) rms in double, 4e-7 sqrt(n) in float up to
    |f| = 512, where rounded coordinates begin to count.

    Examples
    --------
    >>> import numpy as np
    >>> lattice = np.stack(np.meshgrid(*[np.arange(4) / 4] * 2), axis=-1).reshape(-1, 2)
    >>> periodogram(lattice, 4).power[4, ::2].round(12).tolist()
    [16.0, 0.0, 16.0, 0.0, 16.0]
    """
    points = as_realizations(x)
    if (fmax is None) == (frequencies is None):
        raise InputError(
            "give either fmax or frequencies: periodogram(x, 64) or periodogram(x, frequencies=f)"
        )
    if frequencies is not None:
        return _listed(points, _check_frequencies(frequencies, points.shape[2]), precision)
    fmax = check_fmax(fmax, points.shape[2])
    each = powers(points, fmax, precision)
    mean = next(each)
    for power in each:
        mean += power
    mean /= len(points)
    return spectrum_of(mean, points.shape, fmax, precision)


def spectrum_of(power: FloatArray, shape: tuple[int, ...], fmax: int, precision: str = "double") -> Spectrum:
    """Label a mean cube of ``powers`` with what made it; shape is that of its (realizations, n, d) points."""
    realizations, n, d = shape
    return Spectrum(
        power=power,
        n=n,
        d=d,
        realizations=realizations,
        fmax=fmax,
        precision=precision,
        method="two-group product",
        device=runtime().device.label,
    )


def powers(x: FloatArray, fmax: int, precision: str = "double") -> Iterator[FloatArray]:
    """Yield each realization's cube of power, (2*fmax+1,)*d float64, in order.

    Parameters
    ----------
    x : (realizations, n, d) float64
        Checked points.
    fmax : int
        Checked by ``check_fmax``.
    precision : {"double", "float"}
        As in ``periodogram``.
    """
    product = TwoGroupProduct(precision_of(precision), x.shape[1], x.shape[2], fmax)
    for realization in x:
        yield product.power(realization)


def check_fmax(fmax: object, d: int) -> int:
    """Return fmax as an int whose cube fits in memory, or say which would.

    Raises
    ------
    InputError
        If fmax is not a positive integer or (2*fmax+1)**d doubles do not fit.
    """
    if isinstance(fmax, bool) or not isinstance(fmax, (int, np.integer)) or fmax < 1:
        raise InputError(f"fmax must be an integer of at least 1; got {fmax!r}")
    count = (2 * int(fmax) + 1) ** d
    room = int(MEMORY_SHARE * os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")) // 24
    if count > room:
        fitting = (math.floor(room ** (1 / d)) - 1) // 2
        way_out = (
            f"the largest fmax that fits is {fitting}" if fitting >= 1 else "list the frequencies you need"
        )
        raise InputError(
            f"fmax={fmax} in d={d} means {count:.3g} frequencies, of which {room:.3g} fit in memory; "
            f"{way_out}"
        )
    return int(fmax)


def largest_fmax(count: int, d: int) -> int:
    """Largest F with (2F+1)**d <= count, at least 1."""
    f = max(1, math.floor((math.pow(count, 1 / d) - 1) / 2))
    while (2 * f + 3) ** d <= count:  # the root may round down
        f += 1
    return f


def _check_frequencies(frequencies: ArrayLike, d: int) -> NDArray[np.int64]:
    f = np.asarray(frequencies)
    if f.ndim != 2 or f.shape[1] != d or len(f) == 0:
        raise InputError(f"frequencies must be (m, {d}), one row a frequency, m >= 1; got shape {f.shape}")
    if f.dtype.kind == "f" and np.array_equal(f, np.rint(f)) and np.abs(f).max() < 2.0**63:
        f = f.astype(np.int64)
    if f.dtype.kind not in "iu" or (f.dtype.kind == "u" and f.max() >= 2**63):
        raise InputError(f"frequencies must be integers of 64 bits (cycles per unit length); got {f.dtype}")
    return f.astype(np.int64)


def _listed(x: FloatArray, frequencies: NDArray[np.int64], precision: str) -> Spectrum:
    """Power at listed frequencies, one sine and cosine a point and frequency."""
    p = precision_of(precision)
    program = p.program("selected.cl")
    m, d = frequencies.shape
    stride = padded(m, p.lanes)
    rows = np.zeros((d, stride), np.int64)
    rows[:, :m] = frequencies.T
    device_frequencies = p.runtime.upload(rows.astype(np.uint64).astype(p.turn))
    out = p.runtime.empty(stride * np.dtype(p.sum).itemsize)
    local = p.runtime.group
    total = np.zeros(m)
    for realization in x:
        program.run(
            "selected",
            (padded(stride // p.lanes, local),),
            (local,),
            device_frequencies,
            p.upload_points(realization),
            out,
            np.uint32(stride),
            np.uint32(d),
            np.uint64(x.shape[1]),
        )
        total += p.runtime.download(out, np.empty(stride, p.sum))[:m]
    return Spectrum(
        power=total / len(x),
        n=x.shape[1],
        d=d,
        realizations=len(x),
        fmax=max(abs(int(frequencies.max())), abs(int(frequencies.min()))),
        frequencies=frequencies,
        precision=precision,
        method="direct sum at listed frequencies",
        device=p.runtime.device.label,
    )
