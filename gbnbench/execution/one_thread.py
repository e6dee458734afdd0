"""One thread a worker: by variables that numerical libraries read when loaded, and in those that are."""

from __future__ import annotations

import os
import sys

# The processes share the cores, and CPU seconds then mean one core's seconds. OpenBLAS shares a product out
# among its threads, so that their number shows in the last digits.
ONE_THREAD = {
    "POCL_MAX_PTHREAD_COUNT": "1",  # PoCL up to 4
    "POCL_CPU_MAX_CU_COUNT": "1",  # PoCL from 5
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "VECLIB_MAXIMUM_THREADS": "1",
    # glibc gives memory back and takes it again all through a compilation of kernels, at half its time.
    "MALLOC_ARENA_MAX": "1",
    "MALLOC_TRIM_THRESHOLD_": "4000000000",
    "MALLOC_TOP_PAD_": "67108864",
    "MALLOC_MMAP_MAX_": "0",
}


def one_thread() -> None:
    """Let this process compute with one thread.

    Notes
    -----
    The variables hold for libraries that are yet to be loaded. Those that are there, as numpy is in every job
    of submitit, have read theirs, and are told by threadpoolctl.
    """
    os.environ.update(ONE_THREAD)
    if "numpy" in sys.modules:
        from threadpoolctl import threadpool_limits

        threadpool_limits(1)
