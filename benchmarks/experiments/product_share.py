"""Share of the multiply-add peak that whole requests of the two-group product reach, beside a BLAS.

    python -m gbnbench.benchmarks.experiments.product_share [D,F,N ...]

The clock of a shared machine wanders by a fifth within minutes, so that the peak is measured before and after
each round of requests. A share is the median over rounds. The arithmetic that counts is one multiply-add a
frequency of the cube and point; tables, sines, padding and the call itself count as nothing. The BLAS is
numpy's, which multiplies ready tables of the same sizes, and makes neither tables nor powers.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

import numpy as np

from gbnbench import periodogram
from gbnbench.analysis.precision import PrecisionName, precision_of
from gbnbench.analysis.spectrum.digits import cheapest_division, half_size
from gbnbench.analysis.spectrum.evaluators.point_slots import tile_columns, tile_rows
from gbnbench.execution.one_thread import one_thread
from gbnbench.opencl.peak_rate import fma_peak

# d, F, n
CASES = (
    *((4, 4, 4096), (8, 1, 4096), (8, 1, 16_384), (6, 2, 4096), (10, 1, 4096), (7, 2, 4096)),
    *((12, 1, 4096), (6, 4, 4096)),
)
PRECISIONS: tuple[PrecisionName, ...] = ("double", "float")
HEAD = ("request", "frequencies", "double, ms", "share", "float, ms", "share", "double over float")
ROUNDS = 15
SECONDS = 0.02  # of the calls of a round


def share_of_peak(call: Callable[[], object], flops: float, precision: PrecisionName) -> tuple[float, float]:
    """Time a call in rounds, each between two measurements of the peak.

    Parameters
    ----------
    call : callable
        What is timed.
    flops : float
        Its useful flops, two a multiply-add.
    precision : {"double", "float"}
        That of the peak.

    Returns
    -------
    milliseconds, share : float
        Medians over rounds of the least CPU time, and of its share of the peak.
    """
    call()
    times = max(1, int(SECONDS / _cpu_seconds(call)))
    found, before = [], fma_peak(precision)
    for _ in range(ROUNDS):
        least = min(_cpu_seconds(call) for _ in range(times))
        after = fma_peak(precision)
        found.append((1e3 * least, flops / least / ((before + after) / 2)))
        before = after
    milliseconds, share = np.median(found, axis=0)
    return float(milliseconds), float(share)


def _cpu_seconds(call: Callable[[], object]) -> float:
    began = time.process_time()
    call()
    return time.process_time() - began


def request_share(d: int, fmax: int, n: int, precision: PrecisionName) -> tuple[float, float]:
    """Measure a whole request for a cube.

    Parameters
    ----------
    d, fmax, n : int
        Dimension, largest harmonic on each axis, and points.
    precision : {"double", "float"}
        That of the request.

    Returns
    -------
    milliseconds, share : float
        As ``share_of_peak`` gives them.
    """
    x = np.random.default_rng(0).random((n, d))
    flops = 2.0 * n * (2 * fmax + 1) ** d
    return share_of_peak(lambda: periodogram(x, fmax, precision, method="product"), flops, precision)


def blas_share(a: int, b: int, n: int, precision: PrecisionName) -> float:
    """Measure numpy's product of ready tables.

    Parameters
    ----------
    a, b, n : int
        Frequencies of the half spaces of the two groups, and points.
    precision : {"double", "float"}
        That of the tables.

    Returns
    -------
    float
        Share of the peak.
    """
    rng, real = np.random.default_rng(0), precision_of(precision).real
    left, right = rng.random((2 * a - 1, n)).astype(real), rng.random((n, 2 * b - 1)).astype(real)
    out = np.empty((len(left), right.shape[1]), real)
    return share_of_peak(lambda: np.matmul(left, right, out=out), 2.0 * n * out.size, precision)[1]


def row(d: int, fmax: int, n: int) -> str:
    """Measure one case in both precisions, and say it in a row of a Markdown table.

    Parameters
    ----------
    d, fmax, n : int
        Dimension, largest harmonic on each axis, and points.

    Returns
    -------
    str
    """
    p = precision_of("double")
    divided = cheapest_division(d, fmax, tile_rows(p), tile_columns(p))
    a, b = half_size(divided.leading), half_size(divided.trailing)
    ours = [request_share(d, fmax, n, precision) for precision in PRECISIONS]
    cells = [f"d = {d}, F = {fmax}, n = {n:,}", f"{a} and {b}"]
    cells += [text for ms, share in ours for text in (f"{ms:.2f}", f"{share:.2f}")]
    cells.append(f"{ours[0][0] / ours[1][0]:.2f}")
    cells += [f"{blas_share(a, b, n, precision):.2f}" for precision in PRECISIONS]
    return f"| {' | '.join(cells)} |"


def main(cases: list[str]) -> None:
    """Print the table.

    Parameters
    ----------
    cases : list of str
        Each "d,F,n"; ``CASES`` if there are none.
    """
    one_thread()  # before the device is opened
    print(f"| {' | '.join((*HEAD, *(f'BLAS, {precision}' for precision in PRECISIONS)))} |")
    print(f"|---|---|{'--:|' * (len(HEAD) + len(PRECISIONS) - 2)}")
    for case in [tuple(map(int, text.split(","))) for text in cases] or CASES:
        print(row(*case), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
