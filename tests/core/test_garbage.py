"""Garbage in the processes of the command: none is looked for at their end, and all else is done there."""

from __future__ import annotations

import subprocess
import sys

PROGRAM = """
import atexit, gc, weakref
from gbnbench.core.garbage import OBJECTS, collect_rarely

class Kept:
    pass

kept = Kept()
kept.itself = kept
weakref.finalize(kept, print, "finalized")
atexit.register(lambda: print("frozen", gc.get_freeze_count() > 1000))
collect_rarely()
atexit.register(print, "tidied")
assert gc.get_threshold()[0] == OBJECTS
"""


def test_at_the_end_all_objects_are_left_alone() -> None:
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True)
    assert sorted(done.stdout.splitlines()) == ["finalized", "frozen True", "tidied"]
