"""Checks the anchors of snow nets by a coupled snowpack-net calculation."""

import os
import re
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from netdesign.public import *

    __version__: str

# The linear problems are small: threads of the BLAS make them 3 to 10 times slower
# (measured). Works if NumPy is not loaded yet; a value that is set already is kept.
for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")


@lru_cache
def _read_version() -> str:
    from importlib.metadata import version  # slow to import

    return version("netdesign")


@lru_cache
def _list_names() -> list[str]:
    """Names for use from Python, of ``public.py`` as it is written: not imported."""
    text = Path(__file__).with_name("public.py").read_text(encoding="utf-8")
    return sorted(re.findall(r" as (\w+),?$", text, re.M))


if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        """Public name, loaded when it is first asked for: help needs no solver."""
        if name == "__version__":
            return _read_version()
        if name == "__all__":
            return _list_names()
        if name not in _list_names():
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        from netdesign import public

        return getattr(public, name)


def __dir__() -> list[str]:
    """Names of the module, those not loaded yet included."""
    return sorted({*globals(), *_list_names()})
