"""Checks the anchors of snow nets by a coupled snowpack-net calculation."""

import os
from functools import lru_cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from netdesign.public import *

    __version__: str

# The linear problems are small: threads of the BLAS make them 3 to 10 times slower
# (measured). Works if NumPy is not loaded yet; a value that is set already is kept.
for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")

# Names for use from Python. ``public.py`` says where each one lives.
__all__ = [
    "AnchorForces",
    "FailedPanel",
    "FailedSolution",
    "FailedSupport",
    "GroundLaw",
    "Interval",
    "Layer",
    "Net",
    "NetDesignError",
    "Panel",
    "PanelSolution",
    "Ranges",
    "Rope",
    "RowEnvelope",
    "Scene",
    "Scope",
    "Site",
    "Snowpack",
    "Solution",
    "SolveError",
    "SolverSettings",
    "Standard",
    "Study",
    "SupportLayout",
    "build_ground_from_glide_factor",
    "build_layered_snowpack",
    "check",
    "find_anchor_forces",
    "find_envelope",
    "find_guideline_load",
    "load_standard",
    "read_scene",
    "read_site",
    "read_study",
    "solve_panel",
    "solve_steady",
    "write_reports",
    "write_site_workbook",
]


@lru_cache
def _read_version() -> str:
    from importlib.metadata import version  # slow to import

    return version("netdesign")


if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        """Public name, loaded when it is first asked for: help needs no solver."""
        if name == "__version__":
            return _read_version()
        if name not in __all__:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        from netdesign import public

        return getattr(public, name)


def __dir__() -> list[str]:
    """Names of the module, those not loaded yet included."""
    return sorted({*globals(), *__all__})
