"""Rarer looks for garbage in the processes of the command, and none at their end."""

from __future__ import annotations

import atexit
import gc

OBJECTS = 200_000  # Python looks each time that so many more were made than freed; by itself, at 700


def collect_rarely() -> None:
    """Look for garbage seldom: modules and the parts of a figure are many small objects that stay.

    When the process ends, Python would look through all of them once more, for a fifth of a second after
    pictures were drawn; what is to be done at exit, such as the removal of temporary files, is done all the
    same.
    """
    gc.set_threshold(OBJECTS)
    atexit.register(gc.freeze)
