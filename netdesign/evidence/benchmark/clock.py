"""Wall and processor time of a piece of work."""

from __future__ import annotations

import os
import sys
import time
from types import TracebackType

_MEGABYTE = 2**20


class Clock:
    """Measures what runs within a ``with``; processes that have ended count too.

    Attributes
    ----------
    wall_s, cpu_s : float
        Known at the end [s]. Processor time tells of the work even where other
        programs keep the machine busy.
    """

    wall_s: float
    cpu_s: float

    def __enter__(self) -> Clock:
        """Start."""
        self._wall, self._cpu = time.perf_counter(), _read_cpu()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Stop."""
        self.wall_s = time.perf_counter() - self._wall
        self.cpu_s = _read_cpu() - self._cpu


def _read_cpu() -> float:
    """Processor time of this process and of its ended children [s]."""
    ended = os.times()  # of the children of Windows it knows nothing
    return time.process_time() + ended.children_user + ended.children_system


def read_peak() -> float | None:
    """Largest memory of this process so far [MB]; None on Windows."""
    try:
        import resource
    except ImportError:
        return None
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (_MEGABYTE if sys.platform == "darwin" else 1024)
