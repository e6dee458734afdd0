"""CPU time to one noise floor: Nesterov's method beside the paper's descent."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.published_quality import AUTHORS_FLOOR

SPEEDUP = (
    "case", "precision", "against", "floor", "sets", "cpu_s", "gradients", "their_cpu_s", "their_gradients",
    "ratio", "ratio_min", "ratio_max",
)  # fmt: skip


def speedup(floors: pd.DataFrame) -> pd.DataFrame:
    """CPU seconds to one floor, Nesterov beside each descent of its precision.

    Parameters
    ----------
    floors : DataFrame
        Columns ``FLOOR_TIME``.

    Returns
    -------
    DataFrame
        Columns ``SPEEDUP``. The floor is that of the authors' sets, 6.6e-10, or the deepest that every set
        of both methods reaches where that is higher; seconds and gradients are medians over the sets, found
        between stops on straight lines in log-log scale; the ratio is taken set by set, its median, least
        and largest given.
    """
    rows = []
    whole = floors[floors.kernel == "whole"]
    for (case, precision), part in whole.groupby(["case", "precision"], sort=False):
        ours, theirs = part[part.method == "nesterov"], part[part.method == "descent"]
        for name, other in theirs.groupby("curve", sort=False):
            deepest = pd.concat([ours, other]).groupby(["curve", "set"]).noise_floor.min()
            floor = max(AUTHORS_FLOOR, float(deepest.max()))
            mine, his = crossings(ours, floor), crossings(other, floor)
            ratio = his[:, 0] / mine[:, 0]
            rows.append(
                {
                    "case": case,
                    "precision": precision,
                    "against": name,
                    "floor": floor,
                    "sets": len(ratio),
                    "cpu_s": float(np.median(mine[:, 0])),
                    "gradients": float(np.median(mine[:, 1])),
                    "their_cpu_s": float(np.median(his[:, 0])),
                    "their_gradients": float(np.median(his[:, 1])),
                    "ratio": float(np.median(ratio)),
                    "ratio_min": float(ratio.min()),
                    "ratio_max": float(ratio.max()),
                }
            )
    return pd.DataFrame(rows, columns=SPEEDUP)


def crossings(curve: pd.DataFrame, floor: float) -> FloatArray:
    """Find where each set of a curve first reaches a floor.

    Parameters
    ----------
    curve : DataFrame
        Rows of one curve.
    floor : float
        The noise floor.

    Returns
    -------
    (sets, 2) float64
        CPU seconds and gradients; nan where a set does not reach it.
    """
    found = []
    for _, part in curve.groupby("set"):
        level = np.log(part.noise_floor.to_numpy(float))
        spent = np.log(part[["cpu_s", "gradients"]].to_numpy(float))
        below = np.flatnonzero(level <= math.log(floor))
        if not len(below):
            found.append(np.full(2, math.nan))
        elif (k := int(below[0])) == 0:
            found.append(np.exp(spent[0]))
        else:
            share = (level[k - 1] - math.log(floor)) / (level[k - 1] - level[k])
            found.append(np.exp(spent[k - 1] + share * (spent[k] - spent[k - 1])))
    return np.array(found)
