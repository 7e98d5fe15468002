"""Notes and reasons of a study: what was taken for granted, done otherwise, not met.

Also on the net under its snow, for information.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from netdesign.checks import Standard
from netdesign.checks.check import Check
from netdesign.checks.comparison import find_action_factor
from netdesign.checks.schema import ACCEPTANCE_TEST
from netdesign.envelope.ranges import Ranges
from netdesign.outcome import ModelError
from netdesign.site.model import NetRow, Site
from netdesign.snow.creep_law import ICE_DENSITY, CreepLaw
from netdesign.structure.members import GUYS, EndMember, Member
from netdesign.study.guideline_load import list_assumed
from netdesign.study.load_along_row import place_row
from netdesign.study.member_force import RowForces
from netdesign.study.posts import find_snow_pressure
from netdesign.study.records import RowStudy
from netdesign.words.catalogue import load_texts, name_member
from netdesign.words.message import Message, say


def list_site_notes(
    site: Site, rows: Sequence[RowStudy], law: CreepLaw
) -> list[Message]:
    """Notes of the importer, and on the model of the site's snow."""
    sheets = site.of_addons
    without_winter = "Monitoring" in sheets and "Winter" not in sheets
    measured = [say("monitoring.needs_winter")] if without_winter else []
    return [
        *site.notes,
        *_list_law_notes(site, rows, law),
        *_layer_notes(site),
        *measured,
    ]


def _list_law_notes(
    site: Site, rows: Sequence[RowStudy], law: CreepLaw
) -> list[Message]:
    """Say where the creep law is used outside the densities it was fitted to.

    Beside it stands what is known of it there, what the other laws change in the
    governing forces, and the rows whose governing check one of them would turn.
    """
    low, high = (bound * ICE_DENSITY for bound in law.calibrated)
    outside = [
        say(
            "note.outside_calibration",
            what=what,
            least=least,
            largest=largest,
            low=low,
            high=high,
            law=law.name,
        )
        for what, least, largest in _list_density_spans(site)
        if least < low or largest > high
    ]
    if not outside:
        return []
    return [*outside, describe_evidence(law.name), *_describe_other_laws(rows)]


def _describe_other_laws(rows: Sequence[RowStudy]) -> Iterator[Message]:
    """What the other creep laws change in the governing forces, and which they turn."""
    spreads = {row.id: row.model_form for row in rows if row.model_form}
    if not spreads:
        return
    low = min(spread.ratios[0] for spread in spreads.values())
    high = max(spread.ratios[1] for spread in spreads.values())
    yield say("note.other_laws", low=100.0 * (low - 1.0), high=100.0 * (high - 1.0))
    turned = [
        row
        for row, spread in spreads.items()
        if spread.utilisation is not None
        and spread.utilisation <= 1.0 < spread.utilisation * spread.ratios[1]
    ]
    if turned:
        yield say("note.turned_by_law", rows=tuple(turned))


def describe_evidence(law: str) -> Message:
    """What is known of a creep law outside the densities it is given for."""
    key = f"evidence.{law}"
    return say(key if key in load_texts("en") else "evidence.none", law=law)


def _list_density_spans(site: Site) -> list[tuple[Message, float, float]]:
    """Densities over the range [kg/m3]: of uniform snow, and of each row's layers."""
    span = site.ranges["density"]
    spans = []
    if not all(row.layers for row in site.rows):
        spans.append((say("note.snow_densities"), span.low, span.high))
    for row in site.rows:
        if row.layers:
            least = min(layer.density for layer in row.layers_at(span.low))
            largest = max(layer.density for layer in row.layers_at(span.high))
            spans.append((say("note.layer_densities", row=row.id), least, largest))
    return spans


def _layer_notes(site: Site) -> list[Message]:
    """Say what the range of density does to layered snow."""
    return [
        say(
            "note.layers_scaled",
            row=row.id,
            count=len(row.layers),
            density=row.mean_density,
        )
        for row in site.rows
        if row.layers
    ]


def list_judged_notes(forces: RowForces, checks: Sequence[Check]) -> list[Message]:
    """Notes of a row by its inputs and checks."""
    row, ranges, standard = forces.row, forces.site.ranges, forces.standard
    return [
        *list_row_notes(forces),
        *list_test_notes(checks, standard),
        *list_one_anchor_notes(checks),
        *_list_tube_notes(checks),
        *list_guy_notes(row, ranges, checks, standard),
    ]


def list_row_notes(forces: RowForces) -> list[Message]:
    """List the assumptions about a row."""
    row, notes = forces.row, []
    if not math.isfinite(row.gap):
        notes.append(say("row.ends_free"))
    for width in forces.effects.supports:
        if width.other_width is not None:
            wider, other = width.width, width.other_width
            threshold = say(
                "row.gap_at_threshold", gap=row.gap, wider=wider, other=other
            )
            notes.append(threshold)
    if row.is_overtopped:
        notes.append(say("check.overtopped"))
    return [*notes, *_list_end_notes(forces), *list_assumed(row)]


def _list_end_notes(forces: RowForces) -> Iterator[Message]:
    """List the assumptions about the end of a row: posts, end guy and its anchor."""
    row = forces.row
    if row.has_end and row.post_count is None:
        yield say("row.posts_unknown")
    if row.row_end is not None and forces.at_end is not None:
        yield say("row.end_guy_holds_all")
        yield say("row.end_guy_at_head")


def _list_tube_notes(checks: Sequence[Check]) -> list[Message]:
    """Least lengths of the tubes that bend at the heads of anchors."""
    derived = ((check, check.resistance_derivation) for check in checks)
    notes = (
        say(
            "row.tube_length",
            member=name_member(check.member),
            type=check.resistance_type,
            length=how.arguments["length"],
        )
        for check, how in derived
        if isinstance(how, Message) and how.key == "bending.of_tube"
    )
    return list(dict.fromkeys(notes))


def list_test_notes(checks: Sequence[Check], standard: Standard) -> list[Message]:
    """Proof loads of acceptance tests, where the profile asks for them."""
    factor = standard.find(ACCEPTANCE_TEST)
    if factor is None:
        return []
    return [
        say(
            "row.acceptance_test",
            member=name_member(check.member),
            load=factor.value * high,
            factor=factor.value,
        )
        for check in checks
        if check.mode == "pull_out" and (high := check.read_band("E_d")[1])
    ]


def list_one_anchor_notes(checks: Sequence[Check]) -> list[Message]:
    """Force on one anchor in the place of an end's foot anchor and lateral anchor.

    The two act across each other: the section's force, and a rope's along the row.
    """
    forces: dict[str, float] = {}
    for check in checks:
        force = check.read("E_k") if check.position == "edge" else None
        if force is not None:
            forces[check.member] = max(force, forces.get(check.member, force))
    foot = forces.get(Member.FOOT_ANCHOR)
    along = forces.get(EndMember.LATERAL_ANCHOR)
    if foot is None or along is None:
        return []
    return [say("row.one_anchor", both=math.hypot(foot, along))]


def list_guy_notes(
    row: NetRow, ranges: Ranges, checks: Sequence[Check], standard: Standard
) -> Iterator[Message]:
    """Note on the width of snow that working guys bear beside their design forces.

    Theory: structure/THEORY.md, (S23). Of several supports the least.
    """
    on_action = find_action_factor(standard).value
    try:
        pressure = find_snow_pressure(row, ranges)[0] / 1e3
    except ModelError:  # outside the guideline's closed forms
        return
    across = min(row.net_height, row.held_thickness)
    widths = []
    for guy in GUYS:
        spare = [
            bear_snow(force, check.resistance_kN, _find_cosine(row, ranges, guy))
            for check in checks
            if (check.member, check.mode) == (guy, "rope")
            and check.resistance_kN is not None
            and (force := check.read_band("E_d")[1])
        ]
        if spare and on_action and min(spare) > 0.0:
            width = min(spare) / (on_action * pressure * across)
            named = name_member(guy)
            widths.append(say("row.guy_in_snow", member=named, width=width))
    if widths:
        yield say("row.guys_in_snow", guys=tuple(widths), pressure=pressure)


def bear_snow(force: float, resistance: float, cosine: float) -> float:
    """Load of snow down the slope that a guy bears beside its own force; (S23).

    Parameters
    ----------
    force, resistance : float
        Design values [kN].
    cosine : float
        Of the angle between the guy and the slope's line of fall, at least 0 [-].

    Returns
    -------
    float
        Design value [kN]; 0 where nothing is left.
    """
    if not resistance > force:
        return 0.0
    across = force**2 * (1.0 - cosine**2)
    return math.sqrt(resistance**2 - across) - force * cosine


def _find_cosine(row: NetRow, ranges: Ranges, guy: Member) -> float:
    """Largest cosine of a guy's angle to the line of fall [-]."""
    span, cosines = ranges["inclination"], []
    for points in (
        place_row(row, inclination) for inclination in (span.low, span.high)
    ):
        anchor = points.find_anchor(guy)
        along = abs(points.head[0] - anchor[0])
        cosines.append(along / math.dist(points.head, anchor))
    return max(cosines) * math.cos(row.guys.splay or 0.0)
