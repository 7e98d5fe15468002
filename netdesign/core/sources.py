"""Files of the compiled core, what compiles them, and the digest of their text.

It stands alone: the build hook reads it before the package is installed.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import tempfile
from functools import lru_cache
from pathlib import Path

ROOM = Path(__file__).resolve().parent
LIBRARY = ROOM / "_core.so"  # the same name on every system
CHECKOUT = ROOM.parents[1] / "pyproject.toml"  # there where nothing was installed
SOURCES = (
    *("plan.c", "front.c", "element.c", "contact.c", "step.c", "flow.c"),
    *("place.c", "cable.c", "round.c", "history.c"),
    *("dense.c", "yielding.c", "panel.c"),
)
HEADERS = ("core.h", "element.h", "round.h")
# No fused arithmetic, no freedom with sums: results are equal between processors.
FLAGS = ("-std=c11", "-O3", "-ffp-contract=off", "-fno-math-errno")
# Comments, and strings, whose slashes begin none.
_STRINGS = re.compile(
    r"""/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'""", re.DOTALL
)
_SHARED = ("-fPIC", "-shared", "-fvisibility=hidden")

# The environment's word on the core, in any case; without one it is taken.
SWITCH = "NETDESIGN_CORE"
SWITCHED_OFF = "numpy"


def read_switch() -> str:
    """Word of the environment on the core, in small letters; empty if there is none."""
    return os.environ.get(SWITCH, "").strip().lower()


def take_code(text: str) -> str:
    """C text without comments, blank lines and blanks at ends of lines."""
    text = _STRINGS.sub(lambda hit: " " if hit[0].startswith("/") else hit[0], text)
    return "\n".join(line.rstrip() for line in text.split("\n") if line.strip())


@lru_cache
def digest_sources() -> str:
    """First digits of the SHA-256 of the C code and of the compiler's flags.

    The library has those of the code that it was built from; it is not taken where
    code or flags have changed since.
    """
    digest = hashlib.sha256(" ".join(FLAGS).encode())
    for name in (*HEADERS, *SOURCES):
        digest.update(take_code((ROOM / name).read_text(encoding="utf-8")).encode())
    return digest.hexdigest()[:12]


def find_compiler() -> str | None:
    """``CC``, or the first compiler found; None where the core is switched off."""
    if read_switch() == SWITCHED_OFF:
        return None
    names = (os.environ.get("CC", ""), "cc", "gcc", "clang")
    return next((path for name in names if name and (path := shutil.which(name))), None)


def compile_core(compiler: str, library: Path, more: tuple[str, ...] = ()) -> str:
    """Compile the core to a library; what went wrong, or nothing.

    The library is there whole or not at all, whoever else compiles it at the same time;
    a program that runs keeps the old one.
    """
    version = f'-DND_VERSION="{digest_sources()}"'
    files = [str(ROOM / name) for name in SOURCES]
    options = [*FLAGS, *_SHARED, *more, version]
    try:
        with tempfile.TemporaryDirectory(dir=library.parent, prefix="_core.") as folder:
            made = Path(folder) / library.name
            subprocess.run(
                [compiler, *options, *files, "-o", str(made), "-lm"],
                check=True,
                capture_output=True,
                text=True,
                errors="replace",
            )
            made.replace(library)
    except (OSError, subprocess.CalledProcessError) as error:
        return str(getattr(error, "stderr", "") or error)
    return ""
