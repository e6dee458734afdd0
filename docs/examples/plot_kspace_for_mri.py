"""
Sampling k-space for magnetic resonance imaging
===============================================

A scanner measures an image's Fourier transform, *k-space*, and the fewer places it visits, the shorter the
scan. For compressed sensing these places should be random, so that missing data look like noise rather
than like ghosts. They should be dense at the centre, where the energy is, and leave neither gaps nor clumps.
Blue noise that follows a density has these properties.
"""

# %%
# The density falls with the distance from the centre; outside of the circle nothing is measured. Any
# function of the position can be the density. Independent samples of the same density are the usual choice,
# and are shown for comparison.

import matplotlib.pyplot as plt
import numpy as np

import gbnbench

SIDE, SAMPLES = 256, 6000
row, column = (np.indices((SIDE, SIDE)) + 0.5) / SIDE - 0.5
radius = np.hypot(row, column)
density = np.where(radius < 0.5, (1 - radius / 0.5) ** 2 + 0.02, 0)

blue = gbnbench.stipple(1 - density / density.max(), SAMPLES, seed=2).points
independent = gbnbench.stipple(1 - density / density.max(), SAMPLES, method="rejection", seed=2).points

# %%
# The point-spread function is the image of a single bright point. Aliasing is its part beyond
# the central peak. Blue noise keeps a zone about the peak clear, and moves the aliasing to large
# distances, where it is spread as noise.

figure, axes = plt.subplots(2, 2, figsize=(8, 8), layout="constrained")
for (places, spread), points, name in zip(
    axes.T, (blue, independent), ("blue noise", "independent"), strict=True
):
    places.plot(*points.T, "k.", markersize=1)
    places.set(aspect="equal", title=f"k-space, {name}", xlim=(0, 1), ylim=(0, 1), xticks=[], yticks=[])
    function = gbnbench.periodogram(points % 1, SIDE // 2)
    decibel = 10 * np.log10(function.power.T / SAMPLES)
    spread.imshow(decibel, origin="lower", vmin=-60, vmax=0, extent=(-128.5, 128.5) * 2)
    spread.set(title="point-spread function in dB", xlabel="pixels")
    f = np.hypot(*np.indices(function.power.shape) - SIDE // 2)
    near = (f > 8) & (f < 24)
    aliasing = 10 * np.log10(function.power[near].mean() / SAMPLES)
    print(f"{name:12} energy of aliasing from 8 to 24 pixels: {aliasing:.1f} dB")
