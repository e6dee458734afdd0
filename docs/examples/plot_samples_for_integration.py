"""
Which samples for my integral?
==============================

The error of an average over samples depends on both spectra: the samples' and the integrand's. Smooth
integrands have little power at high frequencies, so that a low noise floor pays; edges have much, and
then it pays less.
"""

# %%
# Variance of the estimate against the number of samples, for smooth bumps and for half spaces with an
# edge, each with a known integral, over random shifts of the samples.

import tempfile

import gbnbench

study = gbnbench.integrate(
    ["random", "jittered", "sobol", "gbn"],
    n=[64, 256, 1024],
    instances=8,
    realizations=4,
    out=tempfile.mkdtemp(),
    quiet=True,
)
figure = study.figure()

# %%
# Slopes of the variance: -1 is that of independent samples. For the edge all blue-noise sets end near
# -1.5; for the smooth bumps Gaussian Blue Noise leaves the others behind.

print(study.slopes.to_string(index=False))
