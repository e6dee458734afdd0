"""
A window that is no torus
=========================

Cells under a microscope and trees in a plot are what a window shows of a pattern that continues beyond it.
Measured as a torus, points near opposite sides would count as neighbours. ``in_window`` makes no such
error, and gives every number a standard error from a single set.
"""

# %%
# A pattern with repulsion, seen through a window of 300 by 200: points of dart throwing in a larger
# domain, of which the window shows a part.

import matplotlib.pyplot as plt

import gbnbench

whole = 500 * gbnbench.generate("darts", n=2500, d=2, seed=5)
seen = whole[(whole[:, 0] < 300) & (whole[:, 1] < 200)]
found = gbnbench.in_window(seen, 0, [300, 200])

structure, pairs = found.structure_factor, found.pair_correlation
print(found.to_frame().to_string())

# %%
# The structure factor and the pair correlation with their 95% intervals.

figure, (points, left, right) = plt.subplots(1, 3, figsize=(12, 3.5), layout="constrained")
points.plot(*seen.T, "k.", markersize=2)
points.set(aspect="equal", title=f"{len(seen)} points in a window")
left.plot(structure.k, structure.S)
left.fill_between(structure.k, structure.low, structure.high, alpha=0.3)
left.set(xlabel="k in radians a unit", title="structure factor S(k)", ylim=(0, 2))
right.plot(pairs.r, pairs.g)
right.fill_between(
    pairs.r, pairs.g - 1.96 * pairs.standard_error, pairs.g + 1.96 * pairs.standard_error, alpha=0.3
)
right.set(xlabel="r", title="pair correlation g(r)", ylim=(0, 2))
for axis in (left, right):
    axis.axhline(1, color="grey", linewidth=0.8)
