"""From the line of a net row to the panel between its posts, or why there is none."""

from __future__ import annotations

from collections.abc import Mapping

from netdesign.panel.inputs import CUTS, Panel, Rope
from netdesign.site.cells.findings import Finding
from netdesign.site.model import BorderRope, RowPanel
from netdesign.site.readings import Reading, Row, refuse
from netdesign.words.message import Message, say

# Without these there is no panel: none of them has a default.
_NEEDED = ("net_cut", "ridge_rope", "ridge_sag", "lower_rope", "lower_sag")
_ROPES = ("ridge_rope", "lower_rope")
_OPTIONAL = (*_NEEDED, "mid_anchors")
_WITHOUT_MODEL = ("none", "triangular")


def check_panel(row: Row, ropes: Mapping[str, Row], findings: list[Finding]) -> None:
    """Refuse what a line says of ropes beside a panel system of no ropes.

    Of a panel that lacks something it is noted that what is there is not used.
    """
    system = row["panel_system"]
    begun = [row[key] for key in _OPTIONAL if row[key].state == "given"]
    if system.word == "none":
        for reading in begun:
            rule = say("panel.beside_none", place=system.place)
            refuse(reading, rule, say("panel.empty_or_ropes"), findings)
    named = [ropes.get(one.word) for one in list_ropes(row)]
    of_ropes = [rope["axial_stiffness"] for rope in named if rope]
    read = [system, *(row[key] for key in _OPTIONAL), *of_ropes]
    is_faulty = None in named or any(one.state == "faulty" for one in read)
    if is_faulty or system.word in _WITHOUT_MODEL:
        return
    begun += [system] if system.state == "given" else []
    if begun and (lacking := _list_lacking(row, ropes)):
        rule = say("panel.unused", names=tuple(lacking))
        refuse(begun[-1], rule, say("panel.whole"), findings, severity="note")


def read_panel(
    row: Row, ropes: Mapping[str, Row]
) -> tuple[RowPanel | None, Message | None]:
    """Panel of a net row without a fault, and what is missing of it.

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
    lacking = _list_lacking(row, ropes)
    if not system and all(row[key].state == "blank" for key in _NEEDED):
        return None, say("panel.not_given")
    if lacking:
        return None, say("panel.incomplete", names=tuple(lacking))
    return _build_panel(row, ropes), None


def list_ropes(row: Row) -> list[Reading]:
    """Cells that name a border rope."""
    return [row[key] for key in _ROPES if row[key].word]


def _list_lacking(row: Row, ropes: Mapping[str, Row]) -> list[Message]:
    keys = ("panel_system", *_NEEDED)
    lacking = [row[key].field.name for key in keys if row[key].state != "given"]
    named = dict.fromkeys(one.word for one in list_ropes(row))
    return lacking + [
        say("panel.stiffness_of", id=one)
        for one in named
        if ropes[one]["axial_stiffness"].state != "given"
    ]


def _build_panel(row: Row, ropes: Mapping[str, Row]) -> RowPanel:
    ridge, lower = (ropes[row[key].word] for key in _ROPES)
    return RowPanel(
        panel=Panel(
            post_spacing=row["post_spacing"].si,
            lower=_build_rope(lower, row["lower_sag"]),
            upper=_build_rope(ridge, row["ridge_sag"]),
            cut=next(cut for cut in CUTS if cut == row["net_cut"].word),
            has_mid_anchors=row["mid_anchors"].word == "yes",
        ),
        lower=_describe_rope(lower),
        upper=_describe_rope(ridge),
    )


def _build_rope(line: Row, sag: Reading) -> Rope:
    return Rope(stiffness=line["axial_stiffness"].si, sag=sag.si)


def _describe_rope(line: Row) -> BorderRope:
    breaking = line["rope"]
    return BorderRope(
        type_id=line["id"].word,
        breaking=breaking.given_si,
        source=line["rope" if breaking.state == "given" else "id"].place,
    )
