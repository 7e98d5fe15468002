"""Net row of a site as winters load it: middle of the ranges, all else as designed."""

from __future__ import annotations

from collections.abc import Sequence

from netdesign.envelope.ranges import Case
from netdesign.outcome import ModelError
from netdesign.site.model import NetRow, Site, StationWinter
from netdesign.snow.creep_law import BOUTILLIER_2004
from netdesign.study.case_solver import build_scene
from netdesign.winter.day import WinterRow
from netdesign.words.message import say

ASSUMED_FACTOR = 1.0  # snow height at the rows over the station's, where none is given
# Largest height of a series over the design height: beyond, metres may be centimetres.
_PLAUSIBLE = (0.15, 15.0)


def build_winter_row(site: Site, row: NetRow, winter: StationWinter) -> WinterRow:
    """Row with the middle of friction angle and inclination of the site's ranges.

    Raises
    ------
    ModelError
        If the model refuses the row.
    """
    case = Case(
        density=_find_middle(site, "density"),
        friction_angle=_find_middle(site, "friction_angle"),
        inclination=_find_middle(site, "inclination"),
    )
    scene = build_scene(row, case, BOUTILLIER_2004)
    return WinterRow(
        id=row.id,
        scene=scene,
        layout=row.layout,
        height_factor=winter.find_factor(row.id) or ASSUMED_FACTOR,
    )


def _find_middle(site: Site, name: str) -> float:
    interval = site.ranges[name]
    return (interval.low + interval.high) / 2.0


def require_plausible_heights(
    rows: Sequence[WinterRow], designed: Sequence[NetRow], winter: StationWinter
) -> None:
    """Refuse heights of which metres may have been taken for centimetres.

    Raises
    ------
    ModelError
        Naming the first row that they do not fit.
    """
    highest = max(winter.series.heights)
    for row, net_row in zip(rows, designed, strict=True):
        share = row.find_thickness(highest) / net_row.snow_thickness
        if not _PLAUSIBLE[0] <= share <= _PLAUSIBLE[1]:
            raise ModelError(
                say(
                    "winter.unlikely_heights",
                    highest=highest,
                    row=row.id,
                    share=share,
                )
            )
