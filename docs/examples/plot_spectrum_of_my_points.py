"""
The spectrum of my points in the plane
======================================

You have points in a square and want to know whether they are blue noise. Three lines give the power
spectrum and its radial mean; the rest is the picture.
"""

# %%
# The points are in a unit of their own, here pixels of a square of 512. They are brought onto the unit
# torus first: the domain must be periodic, or treated as :doc:`a window <plot_window>`.

import matplotlib.pyplot as plt
import numpy as np

import gbnbench

pixels = 512 * gbnbench.generate("fpo", n=1024, seed=7)  # in place of your own array of shape (n, 2)

x = gbnbench.scale(pixels, low=0, high=512)
spectrum = gbnbench.periodogram(x, 64)  # exact power at every integer frequency with |f_a| <= 64
radial = gbnbench.radial(spectrum).to_frame()  # mean over all frequencies of one length

# %%
# Power 1 is white noise. Blue noise has a dark disc about the centre; a ring tells that distances are
# nearly equal, and single bright dots would tell of a lattice. The dashed line is the frequency of the
# nominal grid's spacing, ``nu = 1``.

figure, (points, plane, line) = plt.subplots(1, 3, figsize=(11, 3.5), layout="constrained")
points.plot(*pixels.T, "k.", markersize=2)
points.set(title="points", aspect="equal", xticks=[0, 512], yticks=[0, 512])
drawn = plane.imshow(np.log10(spectrum.power).T, origin="lower", extent=(-64.5, 64.5) * 2, vmin=-3, vmax=1)
plane.set(title="log10 of power", xlabel="frequency", ylabel="frequency")
figure.colorbar(drawn, ax=plane)
line.semilogy(radial.nu, radial.power)
line.axvline(1, color="grey", linestyle="--")
line.set(title="radial power", xlabel="nu", ylim=(1e-3, 10))

# %%
# Each number of the usual table, or the reason why it has none:

found = gbnbench.measures(x)
for name in ("noise_floor", "peak", "min_distance"):
    print(f"{name:13} {found[name]:.3g}")
print(
    f"computed by {spectrum.method}; the square root of each power is off by {spectrum.error_rms:.0e} (rms)"
)
