"""One BLAS thread a process: the matrices are small, and sums keep their order."""

from __future__ import annotations

import os

THREAD_VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def pin_threads() -> None:
    """Ask for one thread; of use only before numpy is imported."""
    os.environ.update(dict.fromkeys(THREAD_VARIABLES, "1"))
