"""Generators that are held against nothing, and why."""

from __future__ import annotations

NO_FIGURE = "we know of no published figure of this suite's measures, and of no set by its author"

WITHOUT_REFERENCE = {
    "bestcandidate": NO_FIGURE,
    "electrostatic": NO_FIGURE,
    "oztireli": NO_FIGURE,
    "progressivegbn": "the order of the points is this suite's own; the whole set is that of `gbn`",
    "peak": "we know of no published figure of its profile by default; it shares its program with `step`",
    "targeted": "its spectrum is whatever it is asked for: by default that of `step`, by the same program",
}
"""Why a generator has no figure to agree with, by name."""
