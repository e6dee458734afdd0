"""Rarer looks for garbage in the processes of the command."""

from __future__ import annotations

import gc

OBJECTS = 200_000  # Python looks each time that so many more were made than freed; by itself, at 700


def collect_rarely() -> None:
    """Look for garbage seldom: modules and the parts of a figure are many small objects that stay."""
    gc.set_threshold(OBJECTS)
