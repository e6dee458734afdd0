"""Cyan, magenta, yellow and black: how dark each ink is to be, and how many of all dots it gets."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.io.images import Image
from gbnbench.studies.stippling.darkness import PLAIN, Darkness, ToneCurve, bare

NAMES = ("cyan", "magenta", "yellow", "black")
PRINTED = ("yellow", "magenta", "cyan", "black")  # light inks first


def ink_darkness(image: Image, curve: ToneCurve = PLAIN) -> dict[str, Darkness]:
    """Part an image into its inks.

    Parameters
    ----------
    image : Image
        The image.
    curve : ToneCurve
        Taken of each ink by itself, 1 less an ink's share being its tone.

    Returns
    -------
    dict of str to Darkness
        By the names of the inks in the order of printing, without those that the image needs nowhere.

    Raises
    ------
    InputError
        If it needs none, or light is to be dense.
    """
    if curve.invert:
        raise InputError("invert goes with one ink; colours have no negative here")
    inks = image.inks.astype(np.float64)
    found = {}
    for name in PRINTED:
        values = curve.darkness(1 - inks[..., NAMES.index(name)])
        if values.any():
            found[name] = Darkness(values, f"{image.name}, {name}", image.remarks)
    if not found:
        raise InputError(bare(image.name))
    return found


def shared_out(darkness: Mapping[str, Darkness], n: int) -> dict[str, int]:
    """Share dots out among inks in proportion to what they cover, each at least one.

    Parameters
    ----------
    darkness : mapping of str to Darkness
        By the names of the inks.
    n : int
        Dots in all, at least one an ink.

    Returns
    -------
    dict of str to int
        They add up to n.

    Raises
    ------
    InputError
        If there are fewer dots than inks.
    """
    if n < len(darkness):
        raise InputError(f"{len(darkness)} inks need as many dots at least; got n={n}")
    covered = np.array([one.coverage for one in darkness.values()])
    ends = np.rint((n - len(covered)) * np.cumsum(covered) / covered.sum()).astype(int)
    counts = 1 + np.diff(ends, prepend=0)
    return dict(zip(darkness, counts.tolist(), strict=True))
