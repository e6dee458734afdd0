"""
Normalisation: freud, MDAnalysis and scipy
==========================================

Different fields define the same quantities with different units and factors. This page compares our
definitions with those of three packages, by numbers.
"""

# %%
# **Structure factor.** The power ``P(f)`` of points on the unit torus, at integer frequencies, is the
# structure factor ``S(k)`` of particles in a periodic box of side ``L`` at ``k = 2 pi f / L``, in
# radians a unit of length. Both are 1 for independent points. ``freud`` averages it over bins of
# ``|k|``; we average our powers over the same bins, whose edges lie between shells. One more difference
# matters: ``freud`` uses only those ``k`` whose three components are all positive or zero, an eighth of
# the directions. The power of a single set differs from direction to direction, so that means over this
# octant differ at random from means over all directions.

import freud
import matplotlib.pyplot as plt
import numpy as np
from scipy.stats import qmc

import gbnbench

L, BINS = 7.0, 12
unit = 2 * np.pi / L
x = gbnbench.generate("gbn", n=512, d=3, seed=0)
theirs = freud.diffraction.StaticStructureFactorDirect(
    bins=BINS, k_min=0.5 * unit, k_max=(BINS + 0.5) * unit, num_sampled_k_points=0
)
theirs.compute((freud.box.Box.cube(L), (x - 0.5) * L))

power = gbnbench.periodogram(x, BINS).power
f = np.indices(power.shape) - BINS
length = np.sqrt((f**2).sum(axis=0))


def mean_over_bins(chosen):
    """Mean power over the frequencies chosen, in bins of width one."""
    group = np.rint(length[chosen]).astype(int) - 1
    return np.bincount(group, power[chosen]) / np.bincount(group)


inside = (length > 0.5) & (length < BINS + 0.5)
everywhere = mean_over_bins(inside)
octant = mean_over_bins(inside & (f >= 0).all(axis=0))

figure, axis = plt.subplots(figsize=(6.5, 4), layout="constrained")
axis.semilogy(np.arange(1, BINS + 1), everywhere, label="gbnbench, all directions")
axis.semilogy(np.arange(1, BINS + 1), octant, "o", fillstyle="none", label="gbnbench, the octant of freud")
axis.semilogy(theirs.bin_centers / unit, theirs.S_k, "x", label="freud")
axis.set(xlabel="|k| L / 2 pi", ylabel="structure factor")
axis.legend()
worst = np.max(np.abs(np.sqrt(theirs.S_k) - np.sqrt(octant)))
print(f"largest difference of the square root of S(k) over the same directions: {worst:.0e}")

# %%
# They agree to the single precision in which freud computes. That precision is coarse compared with the
# lowest powers here, whose square root is 5e-6.
#
# **Pair correlation.** ``g(r)`` tends to 1 at large distances in all packages. It divides the number of
# pairs by the number that is expected of independent points. We expect ``n - 1`` others for each point, and
# so does MDAnalysis's ``InterRDF`` if a point is excluded from its own neighbours. freud by default expects
# ``n`` others, so that its values are lower by a factor of ``(n - 1) / n``.

import MDAnalysis
from MDAnalysis.analysis.rdf import InterRDF

from gbnbench.analysis.spatial.rdf import pair_density

bins, reach = 20, 0.4  # of the torus's side
ours = pair_density(x[np.newaxis], bins, reach / bins)[0]

pairs = freud.density.RDF(bins=bins, r_max=reach * L)
pairs.compute((freud.box.Box.cube(L), (x - 0.5) * L))

universe = MDAnalysis.Universe.empty(len(x), trajectory=True)
universe.atoms.positions = x * L
universe.dimensions = [L, L, L, 90, 90, 90]
others = InterRDF(
    universe.atoms, universe.atoms, nbins=bins, range=(0, reach * L), exclusion_block=(1, 1)
).run()

factor = len(x) / (len(x) - 1)
print("   r/L   gbnbench  freud  x n/(n-1)  MDAnalysis")
for k in range(6, bins, 4):
    r = (k + 0.5) * reach / bins
    by_freud = f"{pairs.rdf[k]:6.4f} {pairs.rdf[k] * factor:10.5f}"
    print(f"{r:6.2f} {ours[k]:10.5f} {by_freud} {others.results.rdf[k]:11.5f}")

# %%
# **Discrepancy.** ``scipy.stats.qmc.discrepancy`` returns squared discrepancies, and so do we.

wrap_around = gbnbench.measures(x)["discrepancy_wd"]
print(f"gbnbench {wrap_around:.10g}, scipy {qmc.discrepancy(x, method='WD'):.10g}")
