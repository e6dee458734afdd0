"""Claims of Supplement C: how spectra are counted and averaged."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spectrum.shells import digit_classes, exact_shells
from gbnbench.benchmarks.claims.claim import ClaimRow, holds, reported
from gbnbench.benchmarks.claims.sets import SetCache


def rings(sets: SetCache) -> Iterator[ClaimRow]:
    """Measure what annuli of width 1 and 2 do near radius 1 and near radius 40 to stratified points."""
    drawn = sets.draw("jittered", n=4096, sets=200)
    spectrum = drawn.spectrum
    exact = radial(spectrum)
    for width in (1.0, 2.0):
        means = radial(spectrum, by="annuli", width=width)
        found = {}
        for near in (1.0, 40.0):
            k = int(abs(means.frequency - near).argmin())
            middle = (math.floor(means.frequency[k] / width) + 0.5) * width
            around = np.argsort(abs(exact.frequency - middle))[: 2 if near == 1 else 20]
            line = np.polyfit(np.log(exact.frequency[around]), np.log(exact.power[around]), 1)
            found[near] = (
                abs(float(means.frequency[k]) / middle - 1),
                abs(float(means.power[k]) / math.exp(np.polyval(line, math.log(middle))) - 1),
            )
        for which, what, title in (
            (0, "shift", "shift of its mean radius from its middle, relative"),
            (1, "power", "error of its power as that of its middle, relative"),
        ):
            near_1, near_40 = found[1.0][which], found[40.0][which]
            yield reported(
                f"{what}-{width:g}-1",
                f"annulus of width {width:g} near radius 1: {title}",
                "",
                near_1,
                of=drawn,
            )
            yield reported(
                f"{what}-{width:g}-40",
                f"annulus of width {width:g} near radius 40: {title}",
                "far less than near radius 1 (a third)",
                near_40,
                of=drawn,
                holds=holds(near_40 < near_1 / 3),
            )


def digits(_: SetCache) -> Iterator[ClaimRow]:
    """Classes of digits beside distinct radii."""
    for d, fmax in ((2, 64), (3, 16), (8, 2)):
        classes, shells = digit_classes(fmax, d).size, exact_shells(fmax, d).size
        yield reported(
            f"classes-{d}",
            f"combinations of digits over distinct radii, d = {d}, |f| <= {fmax}",
            "1",
            classes / shells,
            d=d,
            holds=holds(classes == shells),
        )
