"""Numpy's products on one thread, as the others are counted: its idle threads spin and cost CPU time."""

from __future__ import annotations

import contextlib
import ctypes
from collections.abc import Callable, Iterator
from pathlib import Path

PREFIXES, SUFFIXES = ("scipy_openblas", "openblas"), ("64_", "")


@contextlib.contextmanager
def one_blas_thread() -> Iterator[bool]:
    """Hold every loaded OpenBLAS to one thread; yields whether there was one (another BLAS is left alone)."""
    found = list(_libraries())
    before = [count() for count, _ in found]
    for _, set_count in found:
        set_count(1)
    try:
        yield bool(found)
    finally:
        for (_, set_count), threads in zip(found, before, strict=True):
            set_count(threads)


def _libraries() -> Iterator[tuple[Callable[[], int], Callable[[int], object]]]:
    """Getter and setter of the number of threads, of each OpenBLAS that this process has loaded."""
    try:
        maps = Path("/proc/self/maps").read_text()
    except OSError:  # not Linux
        return
    paths = {line.split(maxsplit=5)[-1] for line in maps.splitlines() if "openblas" in line.lower()}
    for path in sorted(paths):
        try:
            library = ctypes.CDLL(path)
        except OSError:
            continue
        for prefix in PREFIXES:
            for suffix in SUFFIXES:
                with contextlib.suppress(AttributeError):
                    yield (
                        getattr(library, f"{prefix}_get_num_threads{suffix}"),
                        getattr(library, f"{prefix}_set_num_threads{suffix}"),
                    )
