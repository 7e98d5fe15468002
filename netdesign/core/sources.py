"""Files of the compiled core, and the digest by which a library knows its text.

It stands alone: the build hook reads it before the package is installed.
"""

from __future__ import annotations

import hashlib
from functools import lru_cache
from pathlib import Path

ROOM = Path(__file__).resolve().parent
LIBRARY = ROOM / "_core.so"  # the same name on every system
SOURCES = (
    *("plan.c", "front.c", "element.c", "contact.c", "step.c", "flow.c"),
    *("place.c", "cable.c"),
)
HEADERS = ("core.h", "element.h")


@lru_cache
def digest_sources() -> str:
    """First digits of the SHA-256 of the C sources.

    The library has those of the text that it was built from; it is not taken where the
    text has changed since.
    """
    digest = hashlib.sha256()
    for name in (*HEADERS, *SOURCES):
        digest.update((ROOM / name).read_bytes())
    return digest.hexdigest()[:12]
