"""
Exactly n Poisson-disk points
=============================

Dart throwing starts from a given distance, which determines the number of points. Most applications need
the opposite: exactly ``n`` points that are as far apart as they can be while remaining random.
"""

# %%
# There are four ways to get exactly 1,000 points on the torus. ``maximalpoisson`` relaxes its radius until
# ``n`` points fill the domain, so that no gap is left; ``elimination`` draws many and removes those that are
# too near; ``bestcandidate`` adds the farthest of several candidates; ``fpo`` moves points until they
# are nearly as far apart as is possible without a lattice.

import matplotlib.pyplot as plt

import gbnbench

names = ("maximalpoisson", "elimination", "bestcandidate", "fpo")
figure, axes = plt.subplots(2, 4, figsize=(12, 6), layout="constrained")
for (points, line), name in zip(axes.T, names, strict=True):
    x = gbnbench.generate(name, n=1000, d=2, seed=3)
    radial = gbnbench.radial(gbnbench.periodogram(x, 64)).to_frame()
    points.plot(*x.T, "k.", markersize=2)
    points.set(title=name, aspect="equal", xticks=[], yticks=[])
    line.semilogy(radial.nu, radial.power, linewidth=1)
    line.set(xlabel="nu", ylim=(1e-3, 10))
    found = gbnbench.measures(x)
    print(f"{name:15} {len(x)} points, least distance {found['min_distance']:.3f} of the hexagonal lattice's")

# %%
# A larger least distance comes with a higher peak in the spectrum, and none of the four has as little power
# at low frequencies as Gaussian Blue Noise. ``gbnbench compare elimination fpo gbn`` shows all of this side
# by side.
