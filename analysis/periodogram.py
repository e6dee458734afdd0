"""Exact periodograms in any dimension: P(f) = |sum_k exp(-2 pi i f.x_k)|^2 / n at integer frequencies.

The cube of frequencies is split in a leading and a trailing group of dimensions; each group's half space is
enumerated by base-(2F+1) digits (Ahmed, Ren & Wonka 2022, App. C), its cosines and sines are tabulated from
exact fixed-point phases, and the amplitudes are a register-tiled real product of the two tables.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gbnbench.errors import DeviceError, InputError
from gbnbench.opencl import Program, Runtime, runtime
from gbnbench.results import Spectrum
from gbnbench.torus import FloatArray, as_realizations, fixed_point

SUM_POINTS = 128  # points summed in registers before the sum goes on in double
TABLE_POINTS = 32  # points whose table rows one work-item fills
TABLE_BYTES = 4 << 20  # both groups' tables together: what stays in a core's cache
MEMORY_SHARE = 0.5  # of the machine's memory that one cube may take
GROUP = "gbnbench.analysis"


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
    product = _TwoGroupProduct(_precision(precision), x.shape[1], x.shape[2], fmax)
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


@dataclass(frozen=True)
class _Precision:
    """A precision on the device at hand: types, lanes and program definitions."""

    runtime: Runtime
    double: bool
    lanes: int
    real: type[np.floating[Any]]
    turn: type[np.unsignedinteger[Any]]
    sum: type[np.floating[Any]]

    def program(self, *files: str, **defines: object) -> Program:
        definitions = {
            "DOUBLE": int(self.double),
            "LANES": self.lanes,
            "SUM": "double" if self.sum is np.float64 else "float",
            "SUM_POINTS": SUM_POINTS,
            **defines,
        }
        return self.runtime.program(GROUP, ("/vector.cl", "/turns.cl", *files), definitions)

    def upload_points(self, x: FloatArray) -> Any:
        """One contiguous row of fixed-point coordinates a dimension."""
        return self.runtime.upload(fixed_point(x, np.dtype(self.turn).itemsize * 8).T)


def _precision(name: str) -> _Precision:
    if name not in ("double", "float"):
        raise InputError(f'precision must be "double" or "float"; got {name!r}')
    chosen = runtime()
    double = name == "double"
    if double and not chosen.device.has_double:
        raise DeviceError(
            f'{chosen.device.label} has no double precision; use precision="float" or another device'
        )
    return _Precision(
        runtime=chosen,
        double=double,
        lanes=chosen.lanes(name),
        real=np.float64 if double else np.float32,
        turn=np.uint64 if double else np.uint32,
        sum=np.float64 if chosen.device.has_double else np.float32,
    )


def _padded(count: int, step: int) -> int:
    return -(-count // step) * step


class _Group:
    """One group of dimensions: its half space of frequencies and its tables for a chunk of points."""

    def __init__(self, p: _Precision, program: Program, dims: int, fmax: int, step: int, chunk: int) -> None:
        base = 2 * fmax + 1
        self.dims = dims
        self.count = (base**dims + 1) // 2
        self.stride = _padded(self.count, step)
        self._p, self._program = p, program
        itemsize = np.dtype(p.real).itemsize
        self._frequency = p.runtime.empty(max(dims, 1) * self.stride * itemsize)
        self.cosine = p.runtime.empty(chunk * self.stride * itemsize)
        self.sine = p.runtime.empty(chunk * self.stride * itemsize)
        local = p.runtime.group
        program.run(
            "digits",
            (_padded(self.stride, local),),
            (local,),
            self._frequency,
            np.uint64((base**dims - 1) // 2),
            np.uint32(self.count),
            np.uint32(self.stride),
            np.uint32(dims),
            np.uint64(base),
        )

    def fill(self, x: Any, offset: int, n: int, begin: int, points: int) -> None:
        """Tabulate points begin .. begin+points of the coordinates that start at row offset of x."""
        local = self._p.runtime.group
        blocks = _padded(self.stride // self._p.lanes, local)
        self._program.run(
            "tables",
            (blocks, -(-points // TABLE_POINTS)),
            (local, 1),
            self._frequency,
            x,
            self.cosine,
            self.sine,
            np.uint32(self.stride),
            np.uint32(self.dims),
            np.uint64(n),
            np.uint64(offset * n + begin),
            np.uint32(points),
        )


class _TwoGroupProduct:
    """Buffers and programs for one (n, d, fmax), used for one realization after another."""

    def __init__(self, p: _Precision, n: int, d: int, fmax: int) -> None:
        self._p, self.n, self.d, self.fmax = p, n, d, fmax
        self.rows = 3 if p.lanes > 1 else 4
        base = 2 * fmax + 1
        leading = d // 2
        per_point = (
            sum((base**dims + 1) // 2 for dims in (leading, d - leading)) * 2 * np.dtype(p.real).itemsize
        )
        chunk = min(
            _padded(n, SUM_POINTS), max(SUM_POINTS, TABLE_BYTES // per_point // SUM_POINTS * SUM_POINTS)
        )
        program = p.program(
            "digits.cl", "tables.cl", "product.cl", "power.cl", ROWS=self.rows, TABLE_POINTS=TABLE_POINTS
        )
        self._chunk, self._program = chunk, program
        self.a = _Group(p, program, leading, fmax, math.lcm(self.rows, p.lanes), chunk)
        self.b = _Group(p, program, d - leading, fmax, p.lanes, chunk)
        itemsize = np.dtype(p.sum).itemsize
        self._zeros = np.zeros(4 * self.a.stride * self.b.stride, p.sum)
        self._amplitude = p.runtime.empty(self._zeros.nbytes)
        self._power = p.runtime.empty(base**d * itemsize)

    def power(self, x: FloatArray) -> FloatArray:
        """One realization's cube of power."""
        p, a, b = self._p, self.a, self.b
        points = p.upload_points(x)
        p.runtime.update(self._amplitude, self._zeros)
        local = p.runtime.group
        for begin in range(0, self.n, self._chunk):
            count = min(self._chunk, self.n - begin)
            a.fill(points, 0, self.n, begin, count)
            b.fill(points, a.dims, self.n, begin, count)
            self._program.run(
                "product",
                (_padded(b.stride // p.lanes, local), -(-a.count // self.rows)),
                (local, 1),
                a.cosine,
                a.sine,
                np.uint32(a.stride),
                b.cosine,
                b.sine,
                np.uint32(b.stride),
                self._amplitude,
                np.uint32(count),
            )
        self._program.run(
            "power",
            (_padded(b.count, local), a.count),
            (local, 1),
            self._amplitude,
            np.uint32(a.count),
            np.uint32(a.stride),
            np.uint32(b.count),
            np.uint32(b.stride),
            p.sum(self.n),
            self._power,
        )
        base = 2 * self.fmax + 1
        cube = p.runtime.download(self._power, np.empty(base**self.d, p.sum))
        return cube.astype(np.float64, copy=False).reshape((base,) * self.d)


def _listed(x: FloatArray, frequencies: NDArray[np.int64], precision: str) -> Spectrum:
    """Power at listed frequencies, one sine and cosine a point and frequency."""
    p = _precision(precision)
    program = p.program("selected.cl")
    m, d = frequencies.shape
    stride = _padded(m, p.lanes)
    padded = np.zeros((d, stride), np.int64)
    padded[:, :m] = frequencies.T
    device_frequencies = p.runtime.upload(padded.astype(np.uint64).astype(p.turn))
    out = p.runtime.empty(stride * np.dtype(p.sum).itemsize)
    local = p.runtime.group
    total = np.zeros(m)
    for realization in x:
        program.run(
            "selected",
            (_padded(stride // p.lanes, local),),
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
        fmax=int(np.abs(frequencies).max()),
        frequencies=frequencies,
        precision=precision,
        method="direct sum at listed frequencies",
        device=p.runtime.device.label,
    )
