"""Base laws: what holds the snowpack on the ground."""

from __future__ import annotations

import math
import tomllib
from bisect import bisect_right
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from typing import Literal

import numpy as np

from netdesign.numerics.arrays import Number
from netdesign.outcome import ModelError, require_one_of, require_within
from netdesign.words.message import say

GroundKind = Literal["free", "no-slip", "sliding"]
GROUND_KINDS: tuple[GroundKind, ...] = ("free", "no-slip", "sliding")

DEFAULT_CREEP_LAW = "boutillier-2004"
_SMALLEST_GLIDE_FACTOR = 1.001  # below it the ground does not slip
_TABLE_FILE = "glide_factors.toml"


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundLaw:
    """Relation of velocity and shear stress on the ground.

    Attributes
    ----------
    kind : str
        ``free``: no shear stress, the snow glides freely (the paper).
        ``no-slip``: rough frozen ground, the snow does not move on it.
        ``sliding``: velocity is slip length times the creep law's shear rate, both of
        the snow that lies on the ground.
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
                raise ModelError(say("ground.slip_needed", slip=self.slip_length))
        elif self.slip_length != 0.0:
            raise ModelError(
                say(
                    "ground.slip_foreign",
                    slip=self.slip_length,
                    kind=say(f"ground_kind.{self.kind}"),
                )
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class GlideStep:
    """Two neighbouring entries of a table, with a straight line between them.

    Attributes
    ----------
    glide_factors : tuple of float
        N below and above [-].
    slip_ratios : tuple of float
        Slip length over snow thickness, below and above [-].
    """

    glide_factors: tuple[float, float]
    slip_ratios: tuple[float, float]

    def interpolate(self, glide_factor: float) -> float:
        """Slip ratio on the line.

        Parameters
        ----------
        glide_factor : float
            N [-], of the step.

        Returns
        -------
        float
            Slip length over snow thickness [-].
        """
        (low, high), (start, end) = self.glide_factors, self.slip_ratios
        return start + (glide_factor - low) / (high - low) * (end - start)


@dataclass(frozen=True, slots=True, kw_only=True)
class GlideTable:
    """Glide factors of one creep law, both ascending.

    Attributes
    ----------
    slip_ratios : tuple of float
        Slip length over snow thickness [-].
    glide_factors : tuple of float
        N [-].
    """

    slip_ratios: tuple[float, ...]
    glide_factors: tuple[float, ...]

    def find_step(self, glide_factor: float) -> GlideStep:
        """Neighbouring entries between which a glide factor lies.

        Parameters
        ----------
        glide_factor : float
            N [-], from 1 to the table's last.
        """
        factors, ratios = (1.0, *self.glide_factors), (0.0, *self.slip_ratios)
        above = min(bisect_right(factors, glide_factor), len(factors) - 1)
        return GlideStep(
            glide_factors=(factors[above - 1], factors[above]),
            slip_ratios=(ratios[above - 1], ratios[above]),
        )

    def find_glide_factor(self, slip_ratio: Number) -> Number:
        """Glide factor of a slip length, or of each of many.

        Parameters
        ----------
        slip_ratio : float or ndarray
            Slip length over snow thickness [-].

        Returns
        -------
        float or ndarray
            N [-]; beyond the table that of its end.
        """
        factors, ratios = (1.0, *self.glide_factors), (0.0, *self.slip_ratios)
        factor = np.interp(slip_ratio, ratios, factors)
        return factor if isinstance(slip_ratio, np.ndarray) else float(factor)


@lru_cache(maxsize=1)
def load_glide_tables() -> dict[str, GlideTable]:
    """Stored tables of the creep laws, by their names."""
    text = files(__package__).joinpath(_TABLE_FILE).read_text(encoding="utf-8")
    return {
        name: GlideTable(
            slip_ratios=tuple(table["slip_ratios"]),
            glide_factors=tuple(table["glide_factors"]),
        )
        for name, table in tomllib.loads(text).items()
    }


LARGEST_GLIDE_FACTOR = load_glide_tables()[DEFAULT_CREEP_LAW].glide_factors[-1]


def compute_slip_length(
    glide_factor: float, snow_thickness: float, creep_law: str = DEFAULT_CREEP_LAW
) -> float:
    """Slip length that raises snow pressure on a wall by the glide factor N.

    Parameters
    ----------
    glide_factor : float
        N of the guidelines [-], above 1 and at most the table's last.
    snow_thickness : float
        Normal to the slope [m].
    creep_law : str
        Name of the set.

    Returns
    -------
    float
        Slip length D* [m], linear between the entries of the stored table.

    Raises
    ------
    ModelError
        If there is no table, or the factor lies outside it: no extrapolation.
    """
    step = find_glide_step(glide_factor, creep_law)
    return step.interpolate(glide_factor) * snow_thickness


def find_glide_step(
    glide_factor: float, creep_law: str = DEFAULT_CREEP_LAW
) -> GlideStep:
    """Entries of a creep law's table that give the slip length of a glide factor.

    Parameters
    ----------
    glide_factor : float
        N of the guidelines [-], above 1 and at most the table's last.
    creep_law : str
        Name of the set.

    Raises
    ------
    ModelError
        If there is no table, or the factor lies outside it: no extrapolation.
    """
    tables = load_glide_tables()
    if creep_law not in tables:
        raise ModelError(say("ground.no_table", law=creep_law, known=tuple(tables)))
    table = tables[creep_law]
    if math.isfinite(glide_factor) and glide_factor > table.glide_factors[-1]:
        raise ModelError(
            say(
                "ground.beyond_table",
                glide=glide_factor,
                law=creep_law,
                largest=table.glide_factors[-1],
                ratio=table.slip_ratios[-1],
            )
        )
    require_within(
        "glide factor", glide_factor, _SMALLEST_GLIDE_FACTOR, table.glide_factors[-1]
    )
    return table.find_step(glide_factor)


def build_ground_from_glide_factor(
    glide_factor: float, snow_thickness: float, creep_law: str = DEFAULT_CREEP_LAW
) -> GroundLaw:
    """Ground law for a glide factor; N = 1 is no slip.

    Parameters
    ----------
    glide_factor : float
        N of the guidelines, at least 1 [-].
    snow_thickness : float
        Normal to the slope [m].
    creep_law : str
        Name of the set.

    Raises
    ------
    ModelError
        If the table of slip lengths does not reach to the factor.
    """
    if glide_factor == 1.0:
        return GroundLaw(kind="no-slip")
    slip = compute_slip_length(glide_factor, snow_thickness, creep_law)
    return GroundLaw(kind="sliding", slip_length=slip)
