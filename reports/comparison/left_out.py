"""Pictures that a group of sources has no data for, and what each of them needs."""

from __future__ import annotations

from collections.abc import Sequence

from gbnbench.runs.comparison_result import SourceResult


def left_out(sources: Sequence[SourceResult]) -> str:
    """Name the pictures that none of the sources has, as in dimensions where they mean nothing.

    Parameters
    ----------
    sources : sequence of SourceResult
        Sources shown together.

    Returns
    -------
    str
        A sentence; empty where every picture is there.
    """
    needs = {
        "zone plate (in the plane)": any(s.zone_plate is not None for s in sources),
        "valence (of distinct points, d = 2 and 3)": any(s.d == 2 or s.valence is not None for s in sources),
        "g(r) (enough points, d up to 8)": any(s.rdf is not None for s in sources),
    }
    missing = [title for title, there in needs.items() if not there]
    return f"Not made for want of data: {', '.join(missing)}." if missing else ""
