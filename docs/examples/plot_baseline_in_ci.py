"""
My own sampler in continuous integration
========================================

A sampler that is being worked on should not become worse unnoticed. ``gbnbench compare --baseline RUN``
holds it against an earlier run, measure by measure, and its exit code is 1 where a difference is beyond
three standard errors.
"""

# %%
# A sampler of your own is any object that draws one set: here jitter of a regular grid, by half a cell at
# first. The baseline is a run of the version that you trust, kept with your tests.

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
# Later someone makes the jitter wider. The comparison says so. In a job of continuous integration the
# same are two commands: ``gbnbench compare mine.npz --out trusted`` once, with sets of the version that you
# trust, and ``gbnbench compare mine.npz --baseline trusted`` in each job, with a file of that name which the
# version at hand has made. The exit code of the second fails the job. A source is held against the one of its
# own name.

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
# The reason is seen in the radial power: wider jitter lets low frequencies rise.

figure, axis = plt.subplots(figsize=(6.5, 4), layout="constrained")
for sampler, seed, name in ((Mine(), 0, "trusted"), (Mine(width=0.8), 1, "now")):
    radial = gbnbench.radial(gbnbench.periodogram(sets(sampler, seed), 32))
    axis.loglog(radial.nu, radial.power, label=name)
axis.set(xlabel="nu", ylabel="radial power")
axis.legend()
