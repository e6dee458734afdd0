"""Exact periodograms in any dimension: P(f) = |sum_k exp(-2 pi i f.x_k)|^2 / n at integer frequencies."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gbnbench.analysis.precision import PrecisionName
from gbnbench.analysis.spectrum.box_shells import harmonics_within
from gbnbench.analysis.spectrum.choice import choose
from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.protocol import Evaluator
from gbnbench.analysis.spectrum.evaluators.registry import Method
from gbnbench.analysis.spectrum.input_checks import check_frequencies, check_weights
from gbnbench.analysis.spectrum.limits import check_fmax, check_harmonic
from gbnbench.analysis.spectrum.request import Frequencies, SpectrumRequest, box_request
from gbnbench.core.errors import InputError
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.sides import Sides, as_sides
from gbnbench.core.torus import FloatArray, as_realizations
from gbnbench.opencl import use_device


def periodogram(
    x: ArrayLike,
    fmax: int | None = None,
    precision: PrecisionName = "double",
    frequencies: ArrayLike | None = None,
    *,
    weights: ArrayLike | None = None,
    half: bool = False,
    floor: float | None = None,
    method: Method | None = None,
    sides: ArrayLike | None = None,
    device: str | None = None,
) -> Spectrum:
    """Exact power at every integer frequency with |f_a| <= fmax, or at those listed.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) array_like
        Points on the unit torus; power is averaged over realizations.
    fmax : int
        Largest harmonic on each axis, cycles per unit length, at least 1; with sides the largest |k|.
    precision : {"double", "float"}
        Precision of the phases, tables and sums of 128 points; those sums are added in double where the
        device has it. With a floor, "double" stands for whichever precision resolves it.
    frequencies : (m, d) array_like of int, optional
        Frequencies instead of a cube; any int64.
    weights : (n,) or (realizations, n) array_like, optional
        Weights of the points: F = sum_k w_k exp(-2 pi i f.x_k) and P = |F|^2 / sum_k w_k^2, so that white
        noise still has power 1 in expectation.
    half : bool
        Only the half of the cube with f_0 >= 0; the other is its mirror image.
    floor : float, optional
        Smallest power that must be known to 1%: lets the cheapest evaluation be chosen that resolves it,
        float or, in up to three dimensions, a non-uniform FFT (``gbnbench.plan`` tells which and why).
    method : {"product", "gridded", "fft", "nufft", "numpy", "direct"}, optional
        An evaluator instead of the cheapest: the two-group product, the gridded product, the gridded FFT, the
        non-uniform FFT of ducc0 or FINUFFT, the product in plain numpy, or the direct sum for listed
        frequencies.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given. The wave vector of f is
        k_a = f_a / s_a, the volume being 1, and the box of frequencies that holds the ball |k| <= fmax is
        evaluated: |f_a| <= fmax s_a.
    device : str, optional
        Part of the name of the OpenCL device, or its position, as in ``GBNBENCH_DEVICE``, which it overrides.

    Returns
    -------
    Spectrum
        ``power`` is (2*fmax+1,)*d float64 with DC at the centre, (fmax+1, 2*fmax+1, ...) for a half with DC
        at its first row's centre, (m,) for listed frequencies; 1 in expectation for white noise, n at DC.
        ``error_rms`` and ``error_bound`` tell how far its square root may be off, ``method`` how it was
        found.

    Raises
    ------
    InputError
        If x is not points of [0, 1)^d, fmax is not a positive integer, both or neither of fmax and
        frequencies are given, weights or sides do not fit, floor is below what any evaluator resolves, or the
        cube does not fit in memory (the text says what would).
    DeviceError
        If the OpenCL device lacks the precision. Without any device numpy computes.

    Notes
    -----
    Eq. (10) of Ahmed, Ren & Wonka (2022), divided by n as in PSA. A coordinate is rounded to a multiple of
    2**-64 of a turn (2**-32 in float); from there f.x mod 1 is exact at any f, and the error of an amplitude
    is that of the cosines and their sum: about 3e-16 sqrt(n) rms in double (6e-16 by the gridded FFT),
    2e-7 sqrt(n) in float up to |f| = 512, where rounded coordinates begin to count.

    Examples
    --------
    >>> import numpy as np
    >>> lattice = np.stack(np.meshgrid(*[np.arange(4) / 4] * 2), axis=-1).reshape(-1, 2)
    >>> periodogram(lattice, 4).power[4, ::2].round(12).tolist()
    [16.0, 0.0, 16.0, 0.0, 16.0]
    """
    points = as_realizations(x)
    sets, n, d = points.shape
    if (fmax is None) == (frequencies is None):
        raise InputError(
            "give either fmax or frequencies: periodogram(x, 64) or periodogram(x, frequencies=f)"
        )
    w = check_weights(weights, sets, n)
    lengths = as_sides(sides, d)
    if frequencies is not None:
        if half:
            raise InputError("half is of a cube; list only the frequencies wanted")
        wanted = check_frequencies(frequencies, d)
        with use_device(device):
            return listed_spectrum(points, wanted, precision, w, floor, method, lengths)
    f, request = cube_request(n, d, fmax, sets, lengths, half=half)
    with use_device(device):
        evaluator = choose(request, precision, floor, method)
        power, errors, evaluator = evaluator.evaluate(points, request, w, mean=True)
        errors = errors.averaged(sets, n)
        return made_spectrum(
            power, request, evaluator, errors, fmax=f, half=half, weighted=w is not None, sides=lengths
        )


def cube_request(
    n: int, d: int, fmax: object, realizations: int, sides: Sides | None, *, half: bool = False
) -> tuple[int, SpectrumRequest]:
    """Check fmax, and make the request for its cube or, for unequal sides, for the box round its ball.

    Parameters
    ----------
    n, d : int
        Points of a set, and dimension.
    fmax : object
        What the user gave.
    realizations : int
        Number of sets.
    sides : tuple of d floats or None
        As ``as_sides`` returns them.
    half : bool
        Only the half with f_0 >= 0.

    Returns
    -------
    fmax : int
    request : SpectrumRequest

    Raises
    ------
    InputError
        If fmax is not a positive integer, or the powers do not fit in memory.
    """
    if sides is None:
        f = check_fmax(fmax, d)
        kind: Frequencies = "half cube" if half else "cube"
        return f, SpectrumRequest(kind, n, d, f, realizations, (2 * f + 1) ** d)
    f = check_harmonic(fmax, d)
    return f, box_request(n, d, harmonics_within(f, sides), realizations, half=half)


def listed_spectrum(
    x: FloatArray,
    frequencies: NDArray[np.int64],
    precision: str,
    weights: FloatArray | None,
    floor: float | None,
    method: str | None,
    sides: Sides | None,
) -> Spectrum:
    """Mean power of sets at listed frequencies.

    Parameters
    ----------
    x : (realizations, n, d) float64
        Checked points.
    frequencies : (m, d) int64
        Checked frequencies.
    precision, weights, floor, method
        As in ``periodogram``.
    sides : tuple of d floats or None
        As ``as_sides`` returns them.

    Returns
    -------
    Spectrum
    """
    sets, n, d = x.shape
    fmax = max(abs(int(frequencies.max())), abs(int(frequencies.min())))
    request = SpectrumRequest("listed", n, d, fmax, sets, len(frequencies))
    evaluator = choose(request, precision, floor, method)
    power, errors = evaluator.listed(x, frequencies, weights)
    errors = errors.averaged(sets, n)
    weighted = weights is not None
    return made_spectrum(
        power, request, evaluator, errors, frequencies=frequencies, weighted=weighted, sides=sides
    )


def made_spectrum(
    power: FloatArray, request: SpectrumRequest, evaluator: Evaluator, errors: Errors, **more: Any
) -> Spectrum:
    """Make the result of an evaluation.

    Parameters
    ----------
    power : float64
        Mean over the sets of the request.
    request : SpectrumRequest
        What was evaluated.
    evaluator : Evaluator
        Which evaluated it.
    errors : Errors
        Of the mean.
    **more
        Other fields of the spectrum, and those that differ from the request's.

    Returns
    -------
    Spectrum
    """
    return Spectrum(
        power=power,
        n=request.n,
        d=request.d,
        realizations=request.realizations,
        precision=evaluator.precision,
        method=evaluator.method,
        device=evaluator.device,
        error_rms=errors.rms,
        error_bound=errors.bound,
        **{"fmax": request.fmax, **more},
    )
