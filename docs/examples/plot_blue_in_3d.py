"""
Is my set blue in three dimensions?
===================================

In the plane one looks at the spectrum. In more dimensions its cube is large and cannot be looked at, and
it is not needed: ``shells`` computes the mean over all frequencies of one length, exactly, without the
cube.
"""

# %%
# Three candidates of 1,000 points: independent ones, a Sobol' sequence, and Gaussian Blue Noise.

import matplotlib.pyplot as plt

import gbnbench

names = ("random", "sobol", "gbn")
sets = {name: gbnbench.generate(name, n=1000, d=3, seed=1) for name in names}
figure, axis = plt.subplots(figsize=(6.5, 4), layout="constrained")
for name, x in sets.items():
    shells = gbnbench.shells(x, 20)
    axis.loglog(shells.nu, shells.power, marker=".", linewidth=0.8, label=name)
axis.axhline(1, color="grey", linewidth=0.8)
axis.set(xlabel="nu, frequency in units of the spacing's", ylabel="radial power")
axis.legend()

# %%
# A set is blue where its power stays far below 1 up to ``nu`` of about one half, and rises to 1 without
# a high peak. One number tells how far down it stays, the noise floor: the mean of power over ``0 < nu
# <= 0.25``. In three dimensions the lowest frequency of 1,000 points is ``nu = 0.1``, so that few
# frequencies make the mean.

for name, x in sets.items():
    found = gbnbench.measures(x)
    print(f"{name:7} noise floor {found['noise_floor']:8.2g}   peak {found['peak']:5.2f}")

# %%
# A set may be blue as a whole and white in its projections, which matters where an integrand depends on
# two of three coordinates. Projections are sets of their own:

for name, x in sets.items():
    floors = [gbnbench.measures(x[:, axes])["noise_floor"] for axes in ([0, 1], [0, 2], [1, 2])]
    print(
        f"{name:7} noise floor of its projections to two coordinates:", *(f"{floor:.2g}" for floor in floors)
    )
