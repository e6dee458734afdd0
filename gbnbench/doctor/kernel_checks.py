"""Checks of every OpenCL kernel of gbnbench against plain numpy, on the user's own device.

Runtimes have miscompiled kernels on some processors (PoCL's tracker, issue 979), so nothing is believed that
was not tried on the device, driver and version at hand.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.integration.integrands.gaussians import GaussianSum
from gbnbench.analysis.integration.integrands.waves import WaveSum
from gbnbench.analysis.precision import SUM_POINTS, PrecisionName, padded, precision_of
from gbnbench.analysis.spatial.discrepancy import discrepancies
from gbnbench.analysis.spatial.pair_counts import pair_counts
from gbnbench.analysis.spectrum.evaluators.gridded.product import griddable
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import AXES
from gbnbench.analysis.spectrum.evaluators.point_slots import COMPENSATED_FROM
from gbnbench.analysis.spectrum.evaluators.turn_rows import TurnRows
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.core.torus import FloatArray, displacement
from gbnbench.doctor.adaptive_sets import adaptive_gradient, sums_of_kernels, voids_of_farthest_points
from gbnbench.doctor.check import Check
from gbnbench.doctor.numpy_discrepancies import numpy_centred_square, numpy_periodic_square, numpy_star_square
from gbnbench.doctor.numpy_references import (
    numpy_box_gradient,
    numpy_gaussians,
    numpy_gradient,
    numpy_pairs,
    numpy_power,
    numpy_swap_fault,
    numpy_turns,
    numpy_waves,
)
from gbnbench.generators.ccvt.assignment import sample_lattice, share_out
from gbnbench.generators.ccvt.swaps import Swaps, placed
from gbnbench.generators.fpo.relocation import Sweeps, move_afresh
from gbnbench.generators.gbn.box import BoxEnergy
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.plan import plan_energy
from gbnbench.opencl import Device, choose

# n, d, fmax: none a multiple of a vector, a tile or a chunk; the one of 613 takes several launches, that
# of 601 several runs on a line. The transforms of fmax = 8 and 10 in the plane have all radices between them;
# for that of 82 points are sorted.
IN_THE_PLANE = ((613, 2, 22), (61, 2, 8), (61, 2, 10), (37, 2, 82))
QUICK_PERIODOGRAMS = ((601, 1, 22), *IN_THE_PLANE, (61, 3, 3), (29, 5, 1))
PERIODOGRAMS = ((7, 1, 19), (131, 2, 11), (333, 2, 5), *QUICK_PERIODOGRAMS)
TURNS = ((83, 3),)  # n, d
# n, d, sigma: wide boxes, then narrow ones, each by every evaluation that serves it.
ENERGIES = ((613, 2, 0.9), (401, 1, 1.0), (83, 2, 1.0), (53, 3, 0.7), (37, 8, 1.0))
QUICK_ENERGIES = ((401, 2, 1.0), (53, 3, 0.7))
QUICK_BOXES = ((90, 2, 1.0),)
BOXES = (*QUICK_BOXES, (1500, 2, 0.5), (120, 3, 1.0), (60, 8, 1.0))
ADAPTIVE = ((61, 2), (71, 3))  # n, d
VOIDS = ((67, False), (67, True))  # n, toroidal
SWEEP, QUICK_SWEEP = 101, 41  # points of the farthest-point kernel's sweep
SWAPS, QUICK_SWAPS = ((31, 77), (11, 300)), ((23, 37),)  # sites, samples of each
PASSES = 1000  # of swaps; a few dozen bring so few to rest
DISCREPANCIES = ((2111, 2), (83, 5))  # n, d; one more than a block of columns
QUICK_DISCREPANCIES = ((83, 5),)
PAIRS = ((1111, 2), (333, 3))  # n, d
QUICK_PAIRS = ((333, 3),)
PAIR_BINS, REACH = 40, 0.25
INTEGRANDS = ((333, 1), (131, 3))  # n, d
QUICK_INTEGRANDS = ((131, 3),)
WIDTHS = (0.05, 0.2)  # of Gaussians, box sides: of one image, and of a polynomial
DISTANCE = 1e-9  # a sweep's departure, in box sides
AMPLITUDE = {"double": 1e-14, "float": 2e-6}  # error allowed, over sqrt(n)
VALUE = 1e-12  # error allowed of a sum of 17 terms of at most 1
SQUARE = 1e-13  # error allowed of a discrepancy's square
GRADIENT = {"double": 1e-11, "float": 1e-4}  # over the largest component


IntArray: TypeAlias = NDArray[np.int64]
KernelChecks: TypeAlias = "Callable[..., Iterator[Check]]"


def _periodogram(n: int, d: int, fmax: int, precision: PrecisionName) -> Iterator[Check]:
    x, f, expected = _exact(n, d, fmax)
    size = f"n={n} d={d} F={fmax}"
    found = {
        "two-group product": periodogram(x, fmax, precision, method="product").power.ravel(),
        "listed frequencies": periodogram(x, precision=precision, frequencies=f).power,
    }
    if griddable(d, fmax, precision):
        found["gridded product"] = periodogram(x, fmax, precision, method="gridded").power.ravel()
    if d <= AXES and choose().is_cpu:
        found["gridded FFT"] = periodogram(x, fmax, precision, method="fft").power.ravel()
    for kernel, power in found.items():
        error = float(np.max(np.abs(np.sqrt(power) - expected)))
        yield Check(kernel, size, precision, error, AMPLITUDE[precision])


def _shells(n: int, d: int, fmax: int, precision: PrecisionName) -> Iterator[Check]:
    x, f, expected = _exact(n, d, fmax)
    streamed = shells(x, fmax, precision, corners=True)
    _, label = np.unique((f**2).sum(axis=1), return_inverse=True)
    mean = np.bincount(label, expected**2) / np.bincount(label)
    error = float(np.max(np.abs(np.sqrt(streamed.power) - np.sqrt(mean[1:]))))
    yield Check("shells", f"n={n} d={d} F={fmax}", precision, error, AMPLITUDE[precision])


def _exact(n: int, d: int, fmax: int) -> tuple[FloatArray, IntArray, FloatArray]:
    """Points, the frequencies of a cube, and the roots of their power by numpy."""
    x = np.random.default_rng(n).random((n, d))
    base = 2 * fmax + 1
    f = np.stack(np.unravel_index(np.arange(base**d), (base,) * d), axis=1).astype(np.int64) - fmax
    return x, f, np.sqrt(numpy_power(x, f))


def _many_points() -> int:
    """Count points so many that on a CPU the product keeps the rounding of its sums (register_sums.cl)."""
    cores = choose().compute_units if choose().is_cpu else 1
    return SUM_POINTS * (COMPENSATED_FROM + 1) * cores + 5


def _turns(n: int, d: int, precision: PrecisionName) -> Iterator[Check]:
    rng, p = np.random.default_rng(n), precision_of(precision)
    x = rng.random((n, d)) * 2.0 ** -rng.integers(0, 70, (n, d))
    rows = TurnRows(p, 1, n, d, padded(n, p.lanes), None)
    rows(p.runtime.readable(x[None]), 1)
    found = p.runtime.download(rows.buffer, np.empty((d, padded(n, p.lanes)), p.turn))[:, :n]
    away = (found - numpy_turns(x, p.turn).T).astype(np.int64 if precision == "double" else np.int32)
    yield Check("fixed-point turns", f"n={n} d={d}", precision, float(np.max(np.abs(away))), 0.0)


def _energy(n: int, d: int, sigma: float, precision: str) -> Iterator[Check]:
    x = np.random.default_rng(n).random((2, n, d))
    expected = np.stack([numpy_gradient(one, sigma) for one in x])
    found = plan_energy(n, d, sigma, precision)
    for method in sorted(c.method for c in (found.chosen, *found.others)):
        gradient = energy_evaluation(n, d, sigma, precision, method=method)(x).gradient
        error = float(np.max(np.abs(gradient - expected)) / np.max(np.abs(expected)))
        yield Check(
            f"gbn gradient, {method}", f"n={n} d={d} sigma={sigma}", precision, error, GRADIENT[precision]
        )


def _box(n: int, d: int, sigma: float, precision: str) -> Iterator[Check]:
    x = np.random.default_rng(n).random((2, n, d))
    expected = np.stack([numpy_box_gradient(one, sigma) for one in x])
    box = BoxEnergy(n, d, sigma, precision)
    error = float(np.max(np.abs(box(x).gradient - expected)) / np.max(np.abs(expected)))
    yield Check(
        f"gbn gradient, {box.method}", f"n={n} d={d} sigma={sigma}", precision, error, GRADIENT[precision]
    )


def _farthest_points(n: int, precision: str) -> Iterator[Check]:
    x = np.random.default_rng(n).random((n, 2))
    work = Sweeps(x[None])
    work.sweep(np.array([True]))
    for v in range(n):
        move_afresh(x, v)
    error = float(np.max(np.abs(displacement(work.download()[0], x))))
    yield Check("farthest-point sweep", f"n={n} d=2", precision, error, DISTANCE)


def _swaps(n: int, capacity: int, precision: str) -> Iterator[Check]:
    rng = np.random.default_rng(n)
    sites, samples = rng.random((n, 2)), sample_lattice(n * capacity, rng)
    work = Swaps(sites, placed(sites, samples[share_out(sites, samples, rng)]))
    for _ in range(PASSES):
        if not work.settled:
            work.sweep(rng)
    error = numpy_swap_fault(work.sites, work.offsets, samples)
    yield Check("swaps of samples", f"n={n} samples={capacity}", precision, error, DISTANCE)


def _discrepancies(n: int, d: int, precision: str) -> Iterator[Check]:
    x = np.random.default_rng(n).random((n, d))
    found = discrepancies(x, ["CD", "L2-star", "L2-periodic"])
    squares = {
        "centred": found["CD"][0] - numpy_centred_square(x),
        "star": found["L2-star"][0] ** 2 - numpy_star_square(x),
        "periodic": found["L2-periodic"][0] ** 2 - numpy_periodic_square(x),
    }
    for kind, error in squares.items():
        yield Check(f"discrepancy, {kind}", f"n={n} d={d}", precision, abs(float(error)), SQUARE)


def _pairs(n: int, d: int, precision: str) -> Iterator[Check]:
    x = np.random.default_rng(n).random((n, d))
    sides = (1.5,) + (1.0,) * (d - 2) + (1 / 1.5,)
    found = pair_counts(x, PAIR_BINS, REACH / PAIR_BINS, sides)
    error = float(np.max(np.abs(found - numpy_pairs(x, PAIR_BINS, REACH, sides))))
    yield Check("pair distances", f"n={n} d={d}", precision, error, 0.0)


def _integrands(n: int, d: int, precision: PrecisionName) -> Iterator[Check]:
    rng = np.random.default_rng(n)
    x, centres = rng.random((n, d)), rng.random((17, d))
    device = precision_of(precision)
    for width in WIDTHS:
        found = GaussianSum(centres, width).on_device(x, device)
        error = float(np.max(np.abs(found - numpy_gaussians(x, centres, width))))
        yield Check("integrand, gaussians", f"n={n} d={d} width={width}", precision, error, VALUE)
    f, phases = rng.integers(-9, 10, (17, d)), rng.random(17)
    error = float(np.max(np.abs(WaveSum(f, phases).on_device(x, device) - numpy_waves(x, f, phases))))
    yield Check("integrand, waves", f"n={n} d={d}", precision, error, VALUE)


def planned_checks(quick: bool, device: Device) -> list[tuple[KernelChecks, tuple[float, ...], str]]:
    """List what is tried on a device.

    Parameters
    ----------
    quick : bool
        Fewer sizes: a second or two.
    device : Device
        In double it is tried where it computes so.

    Returns
    -------
    list of (function, case, precision)
        ``function(*case, precision)`` yields checks.
    """
    planned: list[tuple[KernelChecks, tuple[float, ...], str]] = []
    cubes = (*(QUICK_PERIODOGRAMS if quick else PERIODOGRAMS), (_many_points(), 2, 2))
    for precision in [p for p in ("double", "float") if (p == "float" or device.has_double)]:
        work: list[tuple[KernelChecks, tuple[float, ...]]] = [
            *((_periodogram, case) for case in cubes),
            *((_shells, case) for case in cubes if case[1] > 1),
            *((_turns, case) for case in TURNS),
            *((_energy, case) for case in (QUICK_ENERGIES if quick else ENERGIES)),
            *((_box, case) for case in (QUICK_BOXES if quick else BOXES)),
            *((adaptive_gradient, case) for case in ADAPTIVE),
        ]
        if precision == "float":
            work.extend((sums_of_kernels, case) for case in ADAPTIVE)
        if precision == "double":
            work.extend((_integrands, case) for case in (QUICK_INTEGRANDS if quick else INTEGRANDS))
            work.extend((_pairs, case) for case in (QUICK_PAIRS if quick else PAIRS))
            work.append((_farthest_points, (QUICK_SWEEP if quick else SWEEP,)))
            work.extend((voids_of_farthest_points, case) for case in VOIDS)
            work.extend((_swaps, case) for case in (QUICK_SWAPS if quick else SWAPS))
            work.extend((_discrepancies, case) for case in (QUICK_DISCREPANCIES if quick else DISCREPANCIES))
        planned.extend((function, case, precision) for function, case in work)
    return planned
