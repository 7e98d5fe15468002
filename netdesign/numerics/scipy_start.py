"""SciPy's first import, without what it would load only to copy it.

SciPy copies NumPy's namespace when its first part is imported. NumPy loads some of its
parts only when they are asked for; the copy asks for all of them, tools for tests and
for Fortran among them. That is a third of the import, and nothing here uses them.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec, module_from_spec
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


@contextmanager
def importing_parts_of(*packages: str) -> Iterator[None]:
    """Time in which modules of packages of SciPy are imported without the others.

    A package stands there by its place and is not executed. Afterwards it is as if
    nobody had asked for it: whoever does gets it whole, with the modules that are
    loaded. Of ``scipy.spatial`` rotations and distances are left out, of
    ``scipy.special`` its copies for other kinds of arrays, which take longer than all
    else.
    """
    with importing_scipy():
        specs = {one: find_spec(one) for one in packages if one not in sys.modules}
        placed = {one: module_from_spec(spec) for one, spec in specs.items() if spec}
        sys.modules.update(placed)
        try:
            yield
        finally:
            for one in placed:
                del sys.modules[one]
