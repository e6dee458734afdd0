"""The line of ``gbnbench stipple`` that tells the dots it drew: how many, how large, on what page."""

from __future__ import annotations

import numpy as np

from gbnbench.reports.stippling.page import Page

DIGITS = 3  # of a diameter below a millimetre, and decimals of a larger one


def summary(page: Page, *, sized: bool = True, across: bool = True) -> str:
    """Tell how many dots there are of each ink, how large, and on what page.

    Parameters
    ----------
    page : Page
        The page, with at least one dot.
    sized : bool
        Whether sizes are told: a file of points has none.
    across : bool
        Whether that of the dots is among them: a pen has its own.

    Returns
    -------
    str

    Examples
    --------
    >>> from gbnbench.reports.stippling.page import DotLayer
    >>> dot = DotLayer("black", "#000000", np.array([[2.0, 1.0]]), np.array([0.000005]))
    >>> summary(Page(160, 120, (dot,)))
    '1 dot of black, 0.00001 mm across, on 160 x 120 mm'
    >>> summary(Page(160, 120, (dot,)), sized=False)
    '1 dot of black'
    >>> summary(Page(160, 120, (dot,)), across=False)
    '1 dot of black, on 160 x 120 mm'
    """
    said = ", ".join(
        f"{len(layer.radii):,} dot{'s' * (len(layer.radii) != 1)} of {layer.name}" for layer in page.layers
    )
    if not sized:
        return said
    on = f"on {page.width:g} x {page.height:.4g} mm"
    if not across:
        return f"{said}, {on}"
    radii = np.concatenate([layer.radii for layer in page.layers])
    least, most = (_millimetres(2 * float(radius)) for radius in (radii.min(), radii.max()))
    wide = least if least == most else f"{least} to {most}"
    return f"{said}, {wide} mm across, {on}"


def _millimetres(length: float) -> str:
    return np.format_float_positional(length, DIGITS, fractional=length >= 1, trim="-")
