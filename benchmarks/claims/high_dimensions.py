"""Claims about the descent in more than two dimensions (Sec. 4.8)."""

from __future__ import annotations

from collections.abc import Iterator

from gbnbench.benchmarks.claims.claim import BESIDE, ClaimRow, holds, reported
from gbnbench.benchmarks.claims.sets import FAST, SetCache


def dimensions(sets: SetCache) -> Iterator[ClaimRow]:
    """Level eps of the lowest shell after 500 steps of descent, by the dimension and the step."""
    for step, title in (("auto", "the step that curvature allows"), ("authors", "the authors' step")):
        found: list[float] = []
        for d in (2, 3, 4, 8):
            drawn = sets.draw(f"gbn[iterations=500,step={step}]", d=d, sets=2)
            found.append(drawn.level)
            yield reported(
                f"{step}-{d}",
                f"P exp(-4 pi^2 nu^2) at |f| = 1 after 500 steps, d = {d}, {title}",
                "" if d == 2 else "below that of d = 2",
                found[-1],
                of=drawn,
                holds=BESIDE if d == 2 else holds(found[-1] < found[0]),
            )


def high(sets: SetCache) -> Iterator[ClaimRow]:
    """Floors of the same number of points in 2 to 8 dimensions, and that 20 dimensions move at all."""
    plane = sets.draw(FAST, sets=8)
    for d in (2, 3, 4, 6, 8):
        drawn = plane if d == 2 else sets.draw(FAST, d=d, sets=4)
        yield reported(
            f"level-{d}",
            f"P exp(-4 pi^2 nu^2) at |f| = 1 after 320 gradients, d = {d}",
            "" if d == 2 else "that of d = 2 or less",
            drawn.level,
            of=drawn,
            holds=BESIDE if d == 2 else holds(drawn.level < 2 * plane.level),
        )
        yield reported(f"at-1-{d}", f"P(|f| = 1), d = {d}", "", drawn.lowest, of=drawn)
    drawn = sets.draw(FAST, n=256, d=20, sets=2)
    yield reported(
        "twenty",
        "P(|f| = 1) in 20 dimensions, white noise being 1",
        "blue noise (far below 1)",
        drawn.lowest,
        of=drawn,
        holds=holds(drawn.lowest < 1e-3),
    )
