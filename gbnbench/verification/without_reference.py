"""Generators without a reference to compare them with, and why."""

from __future__ import annotations

NO_FIGURE = "we know of no published figure for any of this suite's measures, and of no set by its author"

WITHOUT_REFERENCE = {
    "bestcandidate": NO_FIGURE,
    "electrostatic": NO_FIGURE,
    "oztireli": NO_FIGURE,
    "progressivegbn": "the order of the points is this suite's own; the whole set is that of `gbn`",
    "peak": "we know of no published figure for its default profile; it shares its code with `step`",
    "targeted": "its spectrum is whatever is requested; by default it is that of `step`, with the same code",
}
"""Why a generator has no figure to agree with, by name."""
