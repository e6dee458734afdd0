"""
What a radial mean hides
========================

The radial mean of a spectrum treats all directions alike. A set whose power is low along the axes and
high along the diagonals can have the radial power of an isotropic one. Anisotropy tells them apart: the
variance of power over each ring, in units of its squared mean.
"""

# %%
# We compare jittered points, a Sobol' sequence and Gaussian Blue Noise, with eight sets of each. The power
# of one frequency of a random set is distributed exponentially; its variance equals its squared mean.
# The mean over eight sets has an eighth of that: -9 dB, which is where an isotropic method lies.

import matplotlib.pyplot as plt
import numpy as np

import gbnbench

REALIZATIONS = 8
names = ("jittered", "sobol", "gbn")
figure, axes = plt.subplots(2, 3, figsize=(10, 6), layout="constrained")
for (plane, ring), name in zip(axes.T, names, strict=True):
    x = gbnbench.generate(name, n=1024, d=2, seed=0, realizations=REALIZATIONS)
    spectrum = gbnbench.periodogram(x, 64)
    shells = gbnbench.shells(x, 64)
    plane.imshow(np.log10(spectrum.power).T, origin="lower", extent=(-64.5, 64.5) * 2, vmin=-3, vmax=1)
    plane.set(title=name, xlabel="frequency")
    several = shells.count >= 8  # a ring of four frequencies says little of directions
    variance = shells.deviation[several] / (shells.count[several] / 2 - 1)  # f and -f have the same power
    ratio = variance / shells.power[several] ** 2
    ring.plot(shells.nu[several], 10 * np.log10(ratio), ".", markersize=2)
    ring.axhline(-10 * np.log10(REALIZATIONS), color="black", linewidth=0.8)
    ring.set(xlabel="nu", ylabel="anisotropy in dB", ylim=(-20, 5))
    print(f"{name:9} anisotropy {gbnbench.measures(x)['anisotropy_db']:6.1f} dB")

# %%
# The Sobol' sequence stands out: its power is low along the axes and high elsewhere, which its radial
# mean alone does not show.
