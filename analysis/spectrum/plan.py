"""Planning a spectrum before there are points: which evaluator a request gets, why, and what it costs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gbnbench.analysis.precision import PrecisionName
from gbnbench.analysis.spectrum.ball_power import cheapest_request
from gbnbench.analysis.spectrum.box_shells import harmonics_within
from gbnbench.analysis.spectrum.choice import planned
from gbnbench.analysis.spectrum.limits import check_fmax, check_harmonic
from gbnbench.analysis.spectrum.request import SpectrumRequest, box_request, check_band, shell_request
from gbnbench.analysis.spectrum.spectrum_plan import SpectrumPlan
from gbnbench.core.errors import InputError
from gbnbench.core.sides import Sides, as_sides
from gbnbench.opencl import use_device


def plan(
    n: int,
    d: int,
    fmax: int,
    precision: PrecisionName = "double",
    *,
    realizations: int = 1,
    frequencies: int | None = None,
    half: bool = False,
    shells: bool = False,
    band: Sequence[float] | None = None,
    corners: bool = False,
    floor: float | None = None,
    sides: Sequence[float] | None = None,
    device: str | None = None,
) -> SpectrumPlan:
    """Choose how a spectrum will be evaluated, before there are any points.

    Parameters
    ----------
    n, d : int
        Points in a set, and dimension.
    fmax : int
        Largest harmonic on each axis.
    precision : {"double", "float"}
        As in ``gbnbench.periodogram``.
    realizations : int
        Number of sets.
    frequencies : int, optional
        Number of listed frequencies, instead of a cube.
    half : bool
        Only the half of the cube with f_0 >= 0.
    shells, band, corners : bool, (low, high) optional, bool
        As in ``gbnbench.shells``, instead of a cube.
    floor : float, optional
        Smallest power that must be known to 1%.
    sides : sequence of d floats, optional
        Sides of the torus, as in ``gbnbench.periodogram``; a cube if not given.
    device : str, optional
        The OpenCL device, as in ``gbnbench.periodogram``.

    Returns
    -------
    SpectrumPlan
        ``explain()`` says all of it in words.

    Raises
    ------
    InputError
        As ``gbnbench.periodogram`` and ``gbnbench.shells``: what cannot fit is refused with what would.

    Examples
    --------
    >>> print(plan(4096, 8, 1).method)
    product
    """
    listed = 1 if frequencies is None else frequencies
    counts = {"n": n, "d": d, "realizations": realizations, "frequencies": listed}
    for name, value in counts.items():
        if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < 1:
            raise InputError(f"{name} must be an integer of at least 1; got {value!r}")
    kinds = {
        "frequencies": frequencies is not None,
        "half": half,
        "shells": shells or corners or band is not None,
    }
    for name, value in (("half", half), ("shells", shells), ("corners", corners)):
        if not isinstance(value, (bool, np.bool_)):
            raise InputError(f"{name} must be True or False; got {value!r}")
    if sum(kinds.values()) > 1:
        raise InputError(f"ask for one of {', '.join(name for name, wanted in kinds.items() if wanted)}")
    lengths = as_sides(sides, d)
    if frequencies is not None:
        if isinstance(fmax, bool) or not isinstance(fmax, (int, np.integer)) or not 0 <= fmax <= 1 << 63:
            raise InputError(f"fmax must be the largest |f_a| listed, at most 2^63; got {fmax!r}")
        request = SpectrumRequest("listed", n, d, int(fmax), realizations, frequencies)
    elif lengths is not None:
        with use_device(device):
            request = _of_box(n, d, fmax, realizations, kinds, band, corners, lengths, precision, floor)
    elif shells or band is not None or corners:
        request = shell_request(n, d, fmax, realizations, band, corners)
    else:
        f = check_fmax(fmax, d)
        request = SpectrumRequest("half cube" if half else "cube", n, d, f, realizations, (2 * f + 1) ** d)
    with use_device(device):
        return planned(request, precision, floor)


def _of_box(
    n: int,
    d: int,
    fmax: int,
    realizations: int,
    kinds: dict[str, bool],
    band: Sequence[float] | None,
    corners: bool,
    sides: Sides,
    precision: PrecisionName,
    floor: float | None,
) -> SpectrumRequest:
    """Make the request of a torus with unequal sides: a box, or the ball or band of its shells."""
    f = check_harmonic(fmax, d)
    if corners:
        raise InputError("corners are those of a cube; leave them out for a torus with unequal sides")
    if not kinds["shells"]:
        return box_request(n, d, harmonics_within(f, sides), realizations, half=kinds["half"])
    edges = (0.0, float(f)) if band is None else check_band(band, f, f)
    return cheapest_request(n, d, realizations, edges, sides, precision, floor)
