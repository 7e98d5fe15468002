"""From the line of a net row to the panel between its posts."""

from __future__ import annotations

from collections.abc import Mapping

from netdesign.panel.assumed import Ends, find_stiffness, list_panels
from netdesign.panel.inputs import CUTS
from netdesign.site.cells.findings import Finding
from netdesign.site.model import BorderRope, RowPanel
from netdesign.site.readings import Row, refuse
from netdesign.site.type_resistances import find_breaking
from netdesign.words.message import Message, say

_NEEDED = ("net_cut", "ridge_rope", "ridge_sag", "lower_rope", "lower_sag")
_ROPES = ("ridge_rope", "lower_rope")
_OPTIONAL = (*_NEEDED, "mid_anchors")


def check_panel(row: Row, findings: list[Finding]) -> None:
    """Refuse what a line says of ropes beside a panel system of no ropes."""
    system = row["panel_system"]
    if system.word != "none":
        return
    for reading in (row[key] for key in _OPTIONAL):
        if reading.state == "given":
            rule = say("panel.beside_none", place=system.place)
            refuse(reading, rule, say("panel.empty_or_ropes"), findings)


def read_panel(
    row: Row, ropes: Mapping[str, Row]
) -> tuple[RowPanel | None, Message | None]:
    """Panel of a net row without a fault, and why its forces may be other ones.

    What is not given of a panel is assumed.

    Parameters
    ----------
    row : mapping of str to Reading
        Line of sheet Nets.
    ropes : mapping of str to mapping of str to Reading
        Lines of sheet Ropes by id.

    Returns
    -------
    RowPanel or None, Message or None
        Both None of a row without ropes between its posts.
    """
    system = row["panel_system"].word
    if system == "none":
        return None, None
    if system == "triangular":
        return None, say("panel.triangular")
    lack = None if system else say("panel.no_system")
    return _build_panel(row, ropes), lack


def _build_panel(row: Row, ropes: Mapping[str, Row]) -> RowPanel:
    ridge, lower = (ropes.get(row[key].word) for key in _ROPES)
    mid = row["mid_anchors"].word
    return RowPanel(
        panels=list_panels(
            row["post_spacing"].si,
            cut=next((cut for cut in CUTS if cut == row["net_cut"].word), None),
            sags=(row["ridge_sag"].given_si, row["lower_sag"].given_si),
            stiffnesses=(_find_stiffness(ridge), _find_stiffness(lower)),
            has_mid_anchors=mid == "yes" if mid else None,
        ),
        lower=_describe_rope(lower),
        upper=_describe_rope(ridge),
        assumed=tuple(_list_assumed(row, ropes)),
    )


def _list_assumed(row: Row, ropes: Mapping[str, Row]) -> list[Message]:
    keys = ("panel_system", *_OPTIONAL)
    lacking = [row[key].field.name for key in keys if row[key].state != "given"]
    named = dict.fromkeys(row[key].word for key in _ROPES if row[key].word)
    return lacking + [
        say("panel.stiffness_of", id=one)
        for one in named
        if ropes[one]["axial_stiffness"].state != "given"
    ]


def _find_stiffness(line: Row | None) -> Ends:
    if line is None:
        return find_stiffness(None, None)
    return find_stiffness(line["axial_stiffness"].given_si, find_breaking(line))


def _describe_rope(line: Row | None) -> BorderRope:
    if line is None:
        return BorderRope(type_id="", breaking=None, source="Nets")
    breaking = line["rope"]
    return BorderRope(
        type_id=line["id"].word,
        breaking=breaking.given_si,
        source=line["rope" if breaking.state == "given" else "id"].place,
    )
