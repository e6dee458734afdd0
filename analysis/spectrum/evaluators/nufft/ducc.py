"""ducc0 (Reinecke), under the GPL and so an extra: ``pip install gbnbench[fast]``. It is loaded on first use.

Times were fitted to 2,600 calls of version 0.42 on a Xeon core, of which 98% in 3D and more in 1D and 2D
lie within a factor of two; errors were measured with n = 1 to 1e6 and F = 1 to 3e6.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gbnbench.analysis.spectrum.evaluators.nufft.transform_library import (
    Library,
    Rounding,
    TransformCost,
    Upsampling,
)
from gbnbench.core.torus import FloatArray

# Factor of the points in the bound of rounding, by tolerance and dimension: some three times the
# largest met on coincident points, n = 1 to 1e6, where the grid is as small as ducc0 makes it.
LINE = ((1e-14, 2.0), (1e-13, 8.0), (1e-12, 10.0), (1e-11, 45.0), (1e-10, 100.0), (1e-9, 300.0))
PLANE = ((1e-14, 2.0), (1e-13, 25.0), (1e-12, 200.0), (1e-11, 2e3), (1e-10, 9e3), (1e-9, 1e5), (1e-8, 1.5e6))
SPACE = (
    (1e-14, 2.0),
    (1e-13, 25.0),
    (1e-12, 100.0),
    (1e-11, 800.0),
    (1e-10, 3e3),
    (1e-9, 2e4),
    (1e-6, 2.5e7),
)
# The same where the grid is held wide, as it is where that is expected to be cheaper.
WIDE, LEAST_WIDE, WIDE_TOGETHER = 2.0, 1.9, ((1e-14, 2.0), (5e-14, 8.0))


def transform(
    x: FloatArray, strengths: Any, modes: tuple[int, ...], tolerance: float, upsampling: float
) -> Any:
    """Transform points by ducc0, which chooses its kernel and upsampling by a model of its own.

    Where a wide grid is expected to be cheaper, it is held to one, whose rounding is not magnified.

    Parameters and returns are those of ``transform_library.Transform``.
    """
    import ducc0

    call: Any = ducc0.nufft.nu2u
    return call(
        points=strengths,
        coord=x,
        forward=True,
        epsilon=tolerance,
        nthreads=1,
        out=np.empty(modes, np.complex128),
        periodicity=1.0,
        **({"sigma_min": LEAST_WIDE} if upsampling >= WIDE else {}),
    )


DUCC0 = Library(
    name="ducc0",
    package="ducc0",
    tightest=(3e-15, 7.5e-15, 1.7e-14),  # a little above ducc0.nufft.bestEpsilon
    upsampling=(
        Upsampling(1.2, 5e-9),
        Upsampling(1.35, 5e-11),
        Upsampling(1.5, 2e-12),
        Upsampling(1.75, 5e-14),
        Upsampling(WIDE, 3e-14, WIDE_TOGETHER),
        Upsampling(2.5, together=WIDE_TOGETHER),
    ),
    narrowest=4,
    costs=(
        TransformCost(42e3, 1.1, 14, 40, 0.98, 0.65, 0.17),
        TransformCost(43e3, 16, 33, 44, 0.34, 0.78, 0.20),
        TransformCost(51e3, 100, 52, 48, 0.34, 1.26, 0.07),
    ),
    roundings=(
        Rounding(18.0, 7e-4, 2.0, 1.0, 100.0, 5e-3, LINE, math.inf),
        Rounding(21.0, 7e-4, 4.0, 1.0, 100.0, 5e-3, PLANE, math.inf),
        Rounding(21.0, 7e-4, 12.0, 1.0, 100.0, 5e-3, SPACE, math.inf),
    ),
    typical=0.25,
    coherent=10.0,
    transform=transform,
)
