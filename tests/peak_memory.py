"""Peak memory of a child process, as text that begins the child's program."""

import sys
from pathlib import Path

import pytest

# Its own: what `getrusage` tells contains the parent's, of which it was forked.
PEAK = """
def peak():
    status = open("/proc/self/status").read().splitlines()
    return next(int(one.split()[1]) for one in status if one[:6] == "VmHWM:") // 1024
"""
needs_peak = pytest.mark.skipif(
    not Path("/proc/self/status").is_file(), reason=f"not told on {sys.platform}"
)
