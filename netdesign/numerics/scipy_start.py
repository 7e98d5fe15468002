"""SciPy's first import, without what it would load only to copy it.

SciPy copies NumPy's namespace when its first part is imported. NumPy loads some of its
parts only when they are asked for; the copy asks for all of them, tools for tests and
for Fortran among them. That is a third of the import, and nothing here uses them.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np


@contextmanager
def importing_scipy() -> Iterator[None]:
    """Time in which NumPy lists those of its names that are loaded, and no others.

    Every name can be asked for as ever; where SciPy copies nothing, nothing changes.
    """
    space: dict[str, Any] = vars(np)
    told = ("__all__", "__dir__")
    before: dict[str, Any] = {name: space[name] for name in told if name in space}
    loaded = [name for name in np.__all__ if name in space]
    space.update(__all__=loaded, __dir__=lambda: loaded)
    try:
        yield
    finally:
        del space["__dir__"]
        space.update(before)
