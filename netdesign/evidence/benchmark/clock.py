"""Wall and processor time of a piece of work."""

from __future__ import annotations

import resource
import time
from types import TracebackType


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
    both = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    used = [resource.getrusage(who) for who in both]
    return sum(one.ru_utime + one.ru_stime for one in used)
