"""The ways to a point set's power spectrum that are compared, each in its best form.

Every one is prepared with (realizations, n, d) points and fmax and gives the mean power over realizations:
ours in one call, the others set by set. Nothing is kept between calls, but where a name says so.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import PrecisionName
from gbnbench.analysis.spectrum.evaluators.cube_product import CubeProduct
from gbnbench.analysis.spectrum.evaluators.direct_sum import DirectSum
from gbnbench.analysis.spectrum.evaluators.numpy_product.evaluator import NumpyProduct
from gbnbench.analysis.spectrum.evaluators.protocol import Evaluator
from gbnbench.analysis.spectrum.evaluators.registry import title_of
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.plan import plan
from gbnbench.benchmarks.spectra.transform_libraries import squared, transform_calls
from gbnbench.core.torus import FloatArray
from gbnbench.opencl import runtime

NAIVE_RATE = 2e8  # sines and cosines a second at least, to leave out what takes too long
SEPARABLE_RATE = 1.5e9  # the same of numpy's products of complex exponentials
ZGEMM_FROM = 4  # dimensions from which the product alone, its tables ready, is a rival
Power = Callable[[], FloatArray]


@dataclass(frozen=True)
class Rival:
    """One method.

    Attributes
    ----------
    name : str
        As tables and pictures say it.
    family : str
        What one curve joins.
    precision : str
        "double" or "float".
    prepare : callable
        (points, fmax) -> call that returns the mean power.
    evaluation : str
        Which of gbnbench's it is; empty for the others'.
    """

    name: str
    family: str
    precision: str
    prepare: Callable[[FloatArray, int], Power]
    evaluation: str = ""


def ours(n: int, d: int, fmax: int, sets: int) -> Iterator[Rival]:
    """Yield gbnbench's own ways on this device: its choice, and the plain product where that is another.

    Parameters
    ----------
    n, d, fmax, sets : int
        Points in a set, dimension, largest harmonic, number of sets.

    Returns
    -------
    iterator of Rival
    """
    precisions: tuple[PrecisionName, ...] = ("double", "float") if runtime().device.has_double else ("float",)
    for precision in precisions:
        chosen = title_of(plan(n, d, fmax, precision, realizations=sets).method)
        call = partial(_chosen, precision=precision)
        yield Rival(f"gbnbench {precision}", "gbnbench", precision, call, chosen)
        if chosen != CubeProduct.title:
            call = partial(_evaluated, evaluator=CubeProduct(precision))
            title = CubeProduct.title
            yield Rival(f"{title} {precision}", title, precision, call, title)


def rivals(n: int, d: int, fmax: int, sets: int, longest: float) -> Iterator[Rival]:
    """Yield every way to the power of points of this size, ours first.

    Parameters
    ----------
    n, d, fmax, sets : int
        Points in a set, dimension, largest harmonic, number of sets.
    longest : float
        Seconds of a call beyond which the naive kernel, and numpy's complex exponentials, are left out.

    Returns
    -------
    iterator of Rival
    """
    yield from ours(n, d, fmax, sets)
    call = partial(_evaluated, evaluator=NumpyProduct("double"))
    yield Rival("gbnbench without a device", "gbnbench without a device", "double", call, NumpyProduct.title)
    work = float((2 * fmax + 1) ** d) * n * sets / 2
    if runtime().device.has_double and work <= longest * NAIVE_RATE:
        yield Rival("naive kernel", "naive kernel", "double", _naive, DirectSum.title)
    if work <= longest * SEPARABLE_RATE:
        yield Rival("numpy separable", "numpy separable", "double", _set_by_set(separable))
    if d >= ZGEMM_FROM:
        yield Rival("zgemm on ready tables", "zgemm on ready tables", "double", _ready)
    for library, tolerance, transform in transform_calls(d):
        name = f"{library} {tolerance:.0e}".replace("e-0", "e-")
        yield Rival(name, library, "double", _set_by_set(transform))


def half_space(fmax: int, d: int) -> NDArray[np.int64]:
    """List one of each pair f, -f, and 0: the second half of the cube.

    Parameters
    ----------
    fmax, d : int
        Largest harmonic on each axis, and dimension.

    Returns
    -------
    (m, d) int64
    """
    base = 2 * fmax + 1
    index = np.arange(base**d // 2, base**d)
    return np.stack(np.unravel_index(index, (base,) * d), axis=1) - fmax


def tables(x: FloatArray, fmax: int) -> list[NDArray[np.complex128]]:
    """Tabulate the complex exponentials of two groups of dimensions.

    Parameters
    ----------
    x : (n, d) float64
        Points.
    fmax : int
        Largest harmonic on each axis.

    Returns
    -------
    list of (n, (2*fmax+1)**dims) complex128
    """
    f = np.arange(-fmax, fmax + 1)
    made = []
    for group in (x[:, : x.shape[1] // 2], x[:, x.shape[1] // 2 :]):
        table = np.ones((len(x), 1), complex)
        for coordinate in group.T:
            axis = np.exp(-2j * np.pi * coordinate[:, None] * f)
            table = (table[:, :, None] * axis[:, None]).reshape(len(x), -1)
        made.append(table)
    return made


def separable(x: FloatArray, fmax: int) -> FloatArray:
    """Compute power by tables in numpy and one complex product (zgemm).

    Parameters
    ----------
    x : (n, d) float64
        Points.
    fmax : int
        Largest harmonic on each axis.

    Returns
    -------
    (2*fmax+1,)*d float64
    """
    a, b = tables(x, fmax)
    return squared(a.T @ b, len(x)).reshape((2 * fmax + 1,) * x.shape[1])


def _set_by_set(method: Callable[[FloatArray, int], FloatArray]) -> Callable[[FloatArray, int], Power]:
    def prepare(x: FloatArray, fmax: int) -> Power:
        def call() -> FloatArray:
            mean = method(x[0], fmax)
            for one in x[1:]:
                mean += method(one, fmax)
            mean /= len(x)
            return mean

        return call

    return prepare


def _chosen(x: FloatArray, fmax: int, precision: PrecisionName) -> Power:
    return lambda: periodogram(x, fmax, precision).power


def _evaluated(x: FloatArray, fmax: int, evaluator: Evaluator) -> Power:
    return lambda: evaluator.cube(x, fmax, None, half=False, mean=True)[0]


def _naive(x: FloatArray, fmax: int) -> Power:
    """One sine and cosine a point and frequency of the half space, on the same device."""
    shape = (2 * fmax + 1,) * x.shape[2]
    frequencies = half_space(fmax, x.shape[2])

    def call() -> FloatArray:
        half = periodogram(x, frequencies=frequencies).power
        return np.concatenate([half[:0:-1], half]).reshape(shape)

    return call


def _ready(x: FloatArray, fmax: int) -> Power:
    """Take the product alone; its tables are made beforehand and not counted."""
    ready = [tables(one, fmax) for one in x]
    shape = (2 * fmax + 1,) * x.shape[2]

    def call() -> FloatArray:
        mean = sum(squared(a.T @ b, x.shape[1]) for a, b in ready) / len(ready)
        return np.asarray(mean).reshape(shape)

    return call
