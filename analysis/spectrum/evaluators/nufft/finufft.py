"""FINUFFT (Barnett, Magland & af Klinteberg 2019), which is loaded on first use: ``pip install finufft``.

Reference: SIAM J. Sci. Comput. 41(5), 2019. Times were fitted to 476 calls of version 2.5.1 on an EPYC core,
of which 98% lie within a factor of two; errors were measured with n = 16 to 3e5 and F = 4 to 20,000.
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

# Small FFTs with wide kernels, or large with narrow. The first magnifies rounding at the corners of a grid.
NARROW, WIDE = Upsampling(1.25, 1e-7, together=((1.0, 1e5),)), Upsampling(2.0)


def transform(
    x: FloatArray, strengths: Any, modes: tuple[int, ...], tolerance: float, upsampling: float
) -> Any:
    """Transform points by FINUFFT, whose own choice of upsampling hardly depends on the sizes.

    Parameters and returns are those of ``transform_library.Transform``. FINUFFT is given 2 pi (x - rint(x)),
    where the difference is exact; 2 pi x would round twice as coarsely.
    """
    import finufft

    call: Any = (finufft.nufft1d1, finufft.nufft2d1, finufft.nufft3d1)[len(modes) - 1]
    return call(
        *np.ascontiguousarray((2 * math.pi * x).T),
        strengths,
        modes if len(modes) > 1 else max(modes),
        eps=tolerance,
        isign=-1,
        nthreads=1,
        upsampfac=upsampling,
    )


FINUFFT = Library(
    name="FINUFFT",
    package="finufft",
    tightest=(1e-14, 1e-14, 1e-14),
    upsampling=(WIDE, NARROW),
    narrowest=2,
    costs=(
        TransformCost(230e3, 1.1, 18, 48, 3.6, 2.1, 0.06),
        TransformCost(330e3, 5.6, 45, 54, 0.56, 1.06, 0.52),
        TransformCost(380e3, 0.0, 99, 54, 0.34, 1.1, 0.50),
    ),
    roundings=(
        Rounding(15.0, 1.0, 0.1, 0.5, 100.0, 3.0, ((1.0, 5.0),), 10_000),
        Rounding(15.0, 1.0, 0.1, 0.5, 100.0, 3.0, ((1.0, 8.0),), 100_000),
        Rounding(15.0, 1.0, 0.1, 0.5, 100.0, 3.0, ((1.0, 20.0),), 100_000),
    ),
    typical=0.35,
    coherent=30.0,
    transform=transform,
)
