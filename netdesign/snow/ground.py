"""Base laws: what holds the snowpack on the ground."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from netdesign.errors import ModelError
from netdesign.guards import require_one_of, require_within

GroundKind = Literal["free", "no-slip", "sliding"]
GROUND_KINDS: tuple[GroundKind, ...] = ("free", "no-slip", "sliding")

# Slip length over snow thickness at which the snow pressure on a rigid wall is N
# times that without slip (n = 3; within 3 % over 275 to 410 kg/m3 and slopes of
# 35 to 45 degrees). Recipe: wall normal to the slope, height = thickness.
_GLIDE_FACTORS = np.array([1.0, 1.1, 1.2, 1.34, 1.52, 1.76, 2.07, 2.45])
_SLIP_RATIOS = np.array([0.0, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0])
LARGEST_GLIDE_FACTOR = float(_GLIDE_FACTORS[-1])


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundLaw:
    """Relation of velocity and shear stress on the ground.

    Attributes
    ----------
    kind : str
        ``free``: no shear stress, the snow glides freely (the paper).
        ``no-slip``: rough frozen ground, the snow does not move on it.
        ``sliding``: velocity is slip length times the creep law's shear rate.
    slip_length : float
        Slip length D* [m]; positive for ``sliding``, otherwise 0.
    """

    kind: GroundKind = "free"
    slip_length: float = 0.0

    def __post_init__(self) -> None:
        """Refuse a slip length that does not belong to the kind."""
        require_one_of("ground law", self.kind, GROUND_KINDS)
        if self.kind == "sliding":
            if not (math.isfinite(self.slip_length) and self.slip_length > 0):
                raise ModelError(
                    f"slip length = {self.slip_length!r}: a sliding ground needs a "
                    "finite slip length above 0 m"
                )
        elif self.slip_length != 0.0:
            raise ModelError(
                f"slip length = {self.slip_length!r}: only a sliding ground has one, "
                f"this one is {self.kind}"
            )


def compute_slip_length(glide_factor: float, snow_thickness: float) -> float:
    """Slip length that raises snow pressure on a wall by the glide factor N.

    Parameters
    ----------
    glide_factor : float
        N of the guidelines [-], above 1 and at most ``LARGEST_GLIDE_FACTOR``.
    snow_thickness : float
        Normal to the slope [m].

    Returns
    -------
    float
        Slip length D* [m].

    Raises
    ------
    ModelError
        If the factor lies outside the table: there is no extrapolation.

    Validity
    --------
    Creep exponent 3; linear between the entries of the table above, which was
    measured with this model.
    """
    require_within("glide factor", glide_factor, 1.001, LARGEST_GLIDE_FACTOR)
    ratio = np.interp(glide_factor, _GLIDE_FACTORS, _SLIP_RATIOS)
    return float(ratio) * snow_thickness


def build_ground_from_glide_factor(
    glide_factor: float, snow_thickness: float
) -> GroundLaw:
    """Ground law for a glide factor N [-]; N = 1 is no slip."""
    if glide_factor == 1.0:
        return GroundLaw(kind="no-slip")
    return GroundLaw(
        kind="sliding", slip_length=compute_slip_length(glide_factor, snow_thickness)
    )
