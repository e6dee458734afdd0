"""Words of the pictures of a comparison of stipplings: what was compared, and by what."""

from __future__ import annotations

from gbnbench.reports.captions import NBSP
from gbnbench.studies.stippling_comparison.stippling_results import StipplingRun


def settings(run: StipplingRun) -> str:
    """Describe the settings of a run in one line.

    Parameters
    ----------
    run : StipplingRun
        The comparison.

    Returns
    -------
    str
        Image, n, sets, seed, device and version.
    """
    counts = [
        "-".join(f"{value:,}" for value in sorted({min(values), max(values)}))
        for values in ([s.n for s in run.sources], [s.realizations for s in run.sources])
    ]
    about = run.manifest["settings"]["density"]
    parts = [
        f"{about['name']}, {about['shape'][1]} x {about['shape'][0]} pixels",
        f"n = {counts[0]}",
        f"{counts[1]} set{'' if counts[1] == '1' else 's'}",
        f"seed {run.manifest['seed']}",
        str(run.manifest["device"]["name"]).strip(),
        f"gbnbench {run.manifest['version']}",
    ]
    return " · ".join(part.replace(" ", NBSP) for part in parts)


def patch_text(run: StipplingRun) -> str:
    """Say where the flattest square is; empty where there is none."""
    patch = run.patch
    if patch is None:
        return ""
    return (
        f"The square: the flattest part of the image, {patch.side} pixels a side from x = {patch.column}, "
        f"y = {patch.row}, whose density varies by {100 * patch.variation:.2g}% and holds "
        f"{100 * patch.share:.2g}% of the points."
    )
