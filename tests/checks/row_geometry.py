"""Geometry of a net row, and its checks, without the rest of the row."""

from dataclasses import dataclass

from netdesign.checks.geometry import (
    check_gap,
    check_height,
    check_inclination,
    check_row_spacing,
    check_slope,
)


@dataclass(frozen=True, kw_only=True)
class RowGeometry:
    inclination_low: float
    inclination_high: float
    slope_angle: float
    snow_thickness: float
    net_height: float
    upslope_length: float
    gap: float


def check_geometry(row, standard):
    """Checks as `study/row_checks.py` lists them."""
    slope, height = row.slope_angle, row.net_height
    checks = (
        check_inclination(row.inclination_low, row.inclination_high, standard),
        check_slope(slope, standard),
        check_height(height, row.snow_thickness, standard),
        check_row_spacing(slope, height, row.upslope_length, standard),
        check_gap(row.gap, standard),
    )
    return [check for check in checks if check is not None]
