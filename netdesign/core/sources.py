"""Files of the compiled core, and the digest by which a library knows its text.

It stands alone: the build hook reads it before the package is installed.
"""

from __future__ import annotations

import hashlib
import os
from functools import lru_cache
from pathlib import Path

ROOM = Path(__file__).resolve().parent
LIBRARY = ROOM / "_core.so"  # the same name on every system
SOURCES = (
    *("plan.c", "front.c", "element.c", "contact.c", "step.c", "flow.c"),
    *("place.c", "cable.c", "round.c", "panel.c"),
)
HEADERS = ("core.h", "element.h", "round.h")
# No fused arithmetic, no freedom with sums: results are equal between processors.
FLAGS = ("-std=c11", "-O3", "-ffp-contract=off", "-fno-math-errno")

# The environment's word on the core, in any case; without one it is taken.
SWITCH = "NETDESIGN_CORE"
SWITCHED_OFF = "numpy"


def read_switch() -> str:
    """Word of the environment on the core, in small letters; empty if there is none."""
    return os.environ.get(SWITCH, "").strip().lower()


@lru_cache
def digest_sources() -> str:
    """First digits of the SHA-256 of the C sources and of the compiler's flags.

    The library has those of the text that it was built from; it is not taken where
    text or flags have changed since.
    """
    digest = hashlib.sha256(" ".join(FLAGS).encode())
    for name in (*HEADERS, *SOURCES):
        digest.update((ROOM / name).read_bytes())
    return digest.hexdigest()[:12]
