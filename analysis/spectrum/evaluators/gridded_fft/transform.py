"""Transform of a real grid, of which only the harmonics that are wanted are kept, by SciPy's or ducc0's FFT.

ducc0 (Reinecke) takes half to a third of the time of SciPy's pocketfft, its ancestor. It is under the GPL, so it is
an extra (``pip install gbnbench[fast]``) that is used where it is installed.
"""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec
from typing import Any

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import RealGrid


@cache
def ducc_available() -> bool:
    """Tell whether ducc0 is installed and loads here."""
    if find_spec("ducc0") is None:
        return False
    try:
        import ducc0 as _  # noqa: F401 - only whether it loads
    except (ImportError, OSError, RuntimeError):
        return False
    return True


def harmonics(grid: RealGrid, nodes: NDArray[np.floating[Any]], threads: int) -> NDArray[Any]:
    """Transform the grids of a batch.

    Parameters
    ----------
    grid : RealGrid
        Their layout.
    nodes : (sets, *grid.shape) float64 or float32
        The grids.
    threads : int
        Threads that share the work.

    Returns
    -------
    complex128 or complex64
        (sets, fmax + 1) in 1D, (sets, nodes, fmax + 1) in 2D, and (sets, nodes, 2 fmax + 1, fmax + 1) in 3D. The
        last axis has f >= 0; on the others negative harmonics stand behind the positive ones.
    """
    m, f = grid.nodes, grid.fmax
    real = nodes[(..., *(slice(m) for _ in range(max(grid.d - 1, 1))))] if grid.d > 2 else nodes[..., :m]
    last = _real(real, threads)[..., : f + 1]
    if grid.d == 1:
        return last
    if grid.d == 2:
        return _complex(last, 1, threads)
    middle = _complex(last, 2, threads)
    return _complex(np.concatenate([middle[:, :, : f + 1], middle[:, :, m - f :]], axis=2), 1, threads)


def _real(real: NDArray[Any], threads: int) -> NDArray[Any]:
    if ducc_available():
        import ducc0

        return ducc0.fft.r2c(real, axes=(real.ndim - 1,), nthreads=threads)
    return scipy.fft.rfft(real, axis=-1, workers=threads)


def _complex(part: NDArray[Any], axis: int, threads: int) -> NDArray[Any]:
    if ducc_available():
        import ducc0

        return ducc0.fft.c2c(part, axes=(axis,), nthreads=threads)
    return scipy.fft.fft(part, axis=axis, workers=threads)
