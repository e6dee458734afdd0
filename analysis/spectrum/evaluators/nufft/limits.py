"""Dimensions and tolerances that FINUFFT serves."""

from __future__ import annotations

from gbnbench.core.errors import InputError

DIMENSIONS = 3  # FINUFFT has transforms up to this dimension
TIGHTEST, LOOSEST = 1e-14, 1e-1  # range of tolerances in which the error follows them


def check_tolerance(d: int, tolerance: float) -> None:
    """Refuse dimensions and tolerances that FINUFFT does not serve.

    Parameters
    ----------
    d : int
        Dimension.
    tolerance : float
        Tolerance of FINUFFT.

    Raises
    ------
    InputError
        If d is above 3 or the tolerance is out of 1e-14 .. 0.1.
    """
    if d > DIMENSIONS:
        raise InputError(
            f"FINUFFT transforms at most {DIMENSIONS} dimensions; got d={d}. Ask for an exact method"
        )
    if not TIGHTEST <= tolerance <= LOOSEST:
        raise InputError(
            f"a tolerance of FINUFFT must lie in {TIGHTEST:g} .. {LOOSEST:g}; got {tolerance:g}. "
            "Below that ask for an exact method"
        )
