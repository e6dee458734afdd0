"""
My own sampler in continuous integration
========================================

A sampler that is being worked on should not become worse unnoticed. ``gbnbench compare --baseline RUN``
compares it with an earlier run, measure by measure. The exit code is 1 if a measure is worse by more than
three standard errors.
"""

# %%
# A sampler of your own is any object that draws one set. Here it jitters a regular grid, at first by half a
# cell. The baseline is a run of the version that you trust, which you keep with your tests.

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import matplotlib.pyplot as plt
import numpy as np

import gbnbench


@dataclass(frozen=True)
class Mine:
    """One point in each cell of a regular grid, anywhere in the middle ``width`` of the cell."""

    name: ClassVar[str] = "mine"
    width: float = 0.5

    def __call__(self, n, d, rng):
        """Draw one set."""
        side = round(n ** (1 / d))
        cells = np.stack(np.meshgrid(*[np.arange(side)] * d), axis=-1).reshape(n, d)
        return (cells + 0.5 + self.width * (rng.random((n, d)) - 0.5)) / side


def sets(sampler, seed):
    """Eight sets of 256 points."""
    return np.array([sampler(256, 2, np.random.default_rng([seed, k])) for k in range(8)])


folder = Path(tempfile.mkdtemp())
gbnbench.compare({"mine": sets(Mine(), 0)}, out=folder / "trusted", quiet=True)

# %%
# Later someone makes the jitter wider, and the comparison shows it. In continuous integration two commands
# do the same. Run ``gbnbench compare mine.npz --out trusted`` once, with sets made by the version that you
# trust. In each job, run ``gbnbench compare mine.npz --baseline trusted``, with a file of the same name made
# by the current version; its exit code fails the job. Each source is compared with the one of the same name.

after = gbnbench.compare(
    {"mine": sets(Mine(width=0.8), 1)}, out=folder / "now", baseline=folder / "trusted", quiet=True
)
print("worse than the baseline:", after.worse)
print(
    after.measures.loc[
        after.measures.verdict != "", ["measure", "value", "standard_error", "verdict"]
    ].to_string(index=False)
)

# %%
# The radial power shows the reason: wider jitter raises the power at low frequencies.

figure, axis = plt.subplots(figsize=(6.5, 4), layout="constrained")
for sampler, seed, name in ((Mine(), 0, "trusted"), (Mine(width=0.8), 1, "now")):
    radial = gbnbench.radial(gbnbench.periodogram(sets(sampler, seed), 32))
    axis.loglog(radial.nu, radial.power, label=name)
axis.set(xlabel="nu", ylabel="radial power")
axis.legend()
