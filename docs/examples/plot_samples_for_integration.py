"""
Which samples for my integral?
==============================

The error of an average over samples depends on both spectra: the samples' and the integrand's. Smooth
integrands have little power at high frequencies, so that a low noise floor helps a lot. Integrands with
edges have much power there, so that it helps less.
"""

# %%
# The plots show the variance of the estimate, over random shifts of the samples, against the number of
# samples. The integrands are smooth bumps and half spaces with an edge, all with known integrals.

import tempfile

import matplotlib.pyplot as plt

import gbnbench

study = gbnbench.integrate(
    ["random", "jittered", "sobol", "gbn"],
    n=[64, 256, 1024],
    instances=8,
    realizations=4,
    out=tempfile.mkdtemp(),
    quiet=True,
)

figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
for axis, (integrand, rows) in zip(axes, study.table.groupby("integrand"), strict=True):
    for source, part in rows.groupby("source", sort=False):
        axis.loglog(part.n, part.variance, marker=".", label=source)
    axis.set(title=integrand, xlabel="samples", ylabel="variance of the estimate")
    axis.legend()

# %%
# Slopes of the variance: -1 is that of independent samples. For the edge all blue-noise sets end near
# -1.5; for the smooth bumps Gaussian Blue Noise leaves the others behind.

print(study.slopes.to_string(index=False))
