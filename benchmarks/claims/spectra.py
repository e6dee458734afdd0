"""Claims of Supplement C: how spectra are counted and averaged."""

from __future__ import annotations

import math
from collections.abc import Iterator

from gbnbench.analysis.radial import radial
from gbnbench.analysis.shells import digit_classes, exact_shells
from gbnbench.benchmarks.claims.claim import Row, holds, reported
from gbnbench.benchmarks.claims.sets import FAST, Sets


def rings(sets: Sets) -> Iterator[Row]:
    """Measure what annuli of width 1 and 2 do near radius 1 and near radius 40."""
    drawn = sets.draw(FAST, n=4096, sets=2)
    spectrum = drawn.spectrum
    exact = radial(spectrum)
    found = {}
    for width in (1.0, 2.0):
        means = radial(spectrum, by="annuli", width=width)
        for near in (1.0, 40.0):
            k = int(abs(means.frequency - near).argmin())
            centre = (math.floor(means.frequency[k] / width) + 0.5) * width
            found[width, near, "shift"] = abs(float(means.frequency[k]) / centre - 1)
            j = int(abs(exact.frequency - means.frequency[k]).argmin())
            found[width, near, "power"] = float(means.power[k] / exact.power[j])
    for width in (1.0, 2.0):
        for what, title in (
            ("shift", "shift of its mean radius from its middle, relative"),
            ("power", "its power over that of the exact shell at its mean radius"),
        ):
            near, far = found[width, 1.0, what], found[width, 40.0, what]
            yield reported(
                f"{what}-{width:g}-1",
                f"annulus of width {width:g} near radius 1: {title}",
                "",
                near,
                of=drawn,
            )
            distorted = near > 3 * far if what == "shift" else abs(math.log(near)) > abs(math.log(far))
            yield reported(
                f"{what}-{width:g}-40",
                f"annulus of width {width:g} near radius 40: {title}",
                "less distorted than near 1",
                far,
                of=drawn,
                holds=holds(distorted),
            )


def digits(_: Sets) -> Iterator[Row]:
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
