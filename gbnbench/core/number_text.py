"""Numbers as text: three significant digits, and standard errors to the decimals of their values."""

from __future__ import annotations

import math

NOTHING = "–"
ROUNDING = 1e-12  # of a value: an error below is that of the arithmetic, not of chance
UNITS = ((86400.0, "days"), (3600.0, "hours"), (60.0, "minutes"))


def number(value: float) -> str:
    """Three significant digits: plain from 0.001 to 100,000, else scientific; "–" for nan.

    Examples
    --------
    >>> [number(v) for v in (0.9951, 1.0, 12345.6, 0.000123, -12.34, float("nan"), 0.0)]
    ['0.995', '1.00', '12346', '1.23e-4', '-12.3', '–', '0']
    """
    if math.isnan(value):
        return NOTHING
    if math.isinf(value):
        return "∞" if value > 0 else "-∞"
    if value == 0:
        return "0"
    mantissa, exponent = f"{value:.2e}".split("e")
    power = int(exponent)
    if power < -3 or power > 4:
        return f"{mantissa}e{power}"
    return f"{value:.{max(2 - power, 0)}f}"


def error_number(value: float, error: float) -> str:
    """Write a standard error to as many decimals as its value, or to its first digit where that is smaller.

    Parameters
    ----------
    value : float
        The value that it belongs to.
    error : float
        The standard error.

    Returns
    -------
    str
        Empty where there is nothing to write; 0 where it is mere rounding, below 1e-12 of the value.

    Examples
    --------
    >>> error_number(0.995, 0.0123), error_number(1.23e-7, 4e-9), error_number(3.21, 0.0004)
    ('0.012', '0.04', '0.0004')
    """
    if not (math.isfinite(value) and math.isfinite(error)) or value == 0:
        return ""
    text = number(value)
    mantissa, mark, exponent = text.partition("e")
    if mark:
        error /= 10.0 ** int(exponent)
    digits = len(mantissa.partition(".")[2])
    if error < ROUNDING * abs(float(mantissa)):
        return "0"
    digits = max(digits, -math.floor(math.log10(error))) if error < 10.0**-digits else digits
    return f"{error:.{min(digits, 12)}f}" if digits <= 12 else f"{error:.0e}"


def duration(seconds: float) -> str:
    """Write a time in the largest unit of which there is one and a half; "–" for nan.

    Examples
    --------
    >>> [duration(t) for t in (0.0312, 59.4, 150, 7200, 400000, float("nan"))]
    ['0.031 s', '59 s', '2.5 minutes', '2 hours', '4.63 days', '–']
    """
    if math.isnan(seconds):
        return NOTHING
    for size, unit in UNITS:
        if seconds >= 1.5 * size:
            return f"{seconds / size:,.3g} {unit}"
    return f"{seconds:.2g} s" if seconds < 10 else f"{seconds:.0f} s"
