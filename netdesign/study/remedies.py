"""Resistance, type and post spacing with which a check passes.

Forces follow resistance and spacing in exact proportion: no case is solved. The type is
the weakest one of the workbook that does, else the smallest part of the catalogue:
bars, ropes and post sections, by size.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace

from netdesign.checks import OpenKind, find_resistance
from netdesign.checks.check import Change
from netdesign.checks.comparison import find_partial_factor
from netdesign.resistance.catalogue import (
    find_imperfection,
    find_rope_factor,
    find_termination,
    load_catalogue,
    load_products,
)
from netdesign.resistance.post import compute_buckling_resistance
from netdesign.resistance.products import find_product
from netdesign.resistance.steel import RoundSection, compute_rope_resistance
from netdesign.site.model import Resistance, Site
from netdesign.structure.members import NAMED_BY, EndMember, Member, NetPart
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.case_records import PullRecord
from netdesign.study.member_checks import MemberCheck, find_lasting
from netdesign.study.posts import find_short_post
from netdesign.study.row_resistances import corrode
from netdesign.study.row_to_check import Basis
from netdesign.study.scopes import CLOSE
from netdesign.units import kilonewton_from_newton, kilonewton_if_known
from netdesign.words.message import Message, say
from netdesign.words.names import name


def list_remedies(member_check: MemberCheck) -> list[Change]:
    """List the changes with which a failing, unproven or close check passes."""
    basis = member_check.forces
    is_of_ground = (
        member_check.resistance.mode in ("sliding", "wedge")
        and member_check.resistance.dimensions
    )
    is_of_head = (
        member_check.resistance.mode == "direction"
    )  # of which E_d sin δ is told
    if is_of_ground or is_of_head or not _is_worth_telling(basis, member_check):
        return []  # sliding goes with what presses the base; a ground is as it is
    changes = _list_resistance_remedies(basis, member_check)
    _, used = member_check.check.utilisation_band
    if used is None:
        return _annotate(member_check, changes)
    # ropes' forces are in no proportion to the spacing, and the maker's is as it is
    if not basis.row.panels and member_check.check.governs != "maker":
        spacing = basis.row.layout.post_spacing
        changes.append(find_spacing_remedy(spacing, member_check.width, used))
    return _annotate(member_check, changes)


def _annotate(member_check: MemberCheck, changes: list[Change]) -> list[Change]:
    """Add a note to the changes that do not suffice alone.

    Another type has its own condition.
    """
    if member_check.check.has_open(OpenKind.UNSOLVED):
        note = say("change.as_far_as_solved")
        return [replace(change, note=note) for change in changes]
    if member_check.check.has_open(OpenKind.RESISTANCE_IN_DOUBT):
        note = say("change.if_rest_proven")
        return [x if x.sense == "has" else replace(x, note=note) for x in changes]
    return changes


def _is_worth_telling(basis: Basis, member_check: MemberCheck) -> bool:
    """The check has a force, and its utilisation is at least 0.9."""
    demand, used = (member_check.check.read_band(symbol)[1] for symbol in ("E_d", "μ"))
    if not demand or basis.row.is_overtopped:
        return False
    return used is None or used >= CLOSE


def _list_resistance_remedies(basis: Basis, member_check: MemberCheck) -> list[Change]:
    """Characteristic resistance that is needed, and the type that has it."""
    standard, check = basis.standard, member_check.check
    demand, factor = check.read_band("E_d")[1], check.read("γ_R")
    note: Message | None = None
    if factor is None:  # nothing is given, and so no basis: suppose a test
        tested = standard.find_resistance_factor(member_check.resistance.mode, "tested")
        factor = tested.value_si if tested else None
        note = say("change.on_basis_of_tests")
    if factor is None or demand is None:
        return []
    change = Change(
        quantity=say("change.characteristic_resistance"),
        unit="kN",
        now=check.read("R_k"),
        bound=math.ceil(demand * factor * 10.0 - 1e-9) / 10.0,
        sense="at least",
        note=note,
    )
    if member_check.force is not None and member_check.force.on.shared is not None:
        return [change]  # another rope has another stiffness, and so another force
    kind = find_type_change(basis, member_check.resistance, demand, member_check.pull)
    return [change, kind] if kind else [change]


def find_spacing_remedy(
    post_spacing: float, width: LoadedWidth, utilisation: float
) -> Change:
    """Largest post spacing at which a check passes: every force is in proportion."""
    is_edge = width.position == "edge"
    part = 0.5 if is_edge else 1.0
    left = width.width / utilisation
    if is_edge:
        left -= width.end_factor * width.end_length
    # the part of an end effect that begins at another support falls with the spacing
    reached = width.end_factor * width.share * post_spacing**2
    root = left**2 - 4.0 * part * reached
    widest = (left + math.sqrt(root)) / (2.0 * part) if left > 0.0 <= root else 0.0
    bound = math.floor(100.0 * widest + 1e-9) / 100.0
    return Change(
        quantity=say("change.post_spacing"),
        unit="m",
        now=post_spacing,
        bound=bound if bound > 0.0 else None,
        sense="at most",
        note=None if bound > 0.0 else say("change.end_effect_too_much"),
    )


_ANCHORS = (
    *(Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR),
    *(EndMember.LATERAL_ANCHOR, EndMember.END_GUY_ANCHOR),
)


def find_ground(site: Site, type_id: str) -> str:
    """Ground of an anchor type of the workbook; "" where it is not given."""
    grounds = (kind.ground for kind in site.catalogue if kind.type_id == type_id)
    return next((ground for ground in grounds if ground), "")


def holds_in_ground(member: str, now: str, other: Resistance) -> bool:
    """Validity of a type in the ground of the type that it would replace.

    A type without a given ground proves nothing in any ground.

    Parameters
    ----------
    member : str
        What the type is for; only anchors stand in a ground.
    now : str
        Ground of the row, or of the type that is there; "" for an unknown one.
    other : Resistance
        Of the type that would replace it.
    """
    return member not in _ANCHORS or not now or now == other.ground


def find_type_change(
    basis: Basis, resistance: Resistance, demand: float, pull: PullRecord | None
) -> Change | None:
    """Type whose design resistance reaches the design ``demand`` [kN].

    First the weakest type of the workbook, whether a net row uses it or not, those
    whose own resistance is proven before the others; else the smallest part of the
    catalogue. None where the type that is there does, where it is that of another
    member, or nothing is known that would.

    An anchor type of another ground, or of one that is not known, is none of them.
    ``pull`` is that on the anchor.
    """
    if resistance.member in NAMED_BY:
        return None
    enough = list(_list_enough(basis, resistance, demand, pull))
    sure = [candidate for candidate in enough if candidate.note is None]
    if any(candidate.type_id == resistance.type_id for candidate in sure or enough):
        return None
    if enough:
        weakest = min(
            sure or enough, key=lambda candidate: (candidate.design, candidate.type_id)
        )
        quantity = say("change.type_of_workbook", type=weakest.type_id)
        return _record(quantity, weakest.value, resistance, weakest.note)
    size = _find_enough_size(basis, resistance, demand)
    _, open_lasting = find_lasting(basis, resistance, pull)
    return (
        _record(*size, resistance, _find_note(resistance, open_lasting))
        if size
        else None
    )


def _find_enough_size(
    basis: Basis, resistance: Resistance, demand: float
) -> Size | None:
    """Smallest part of the catalogue that bears a design force [kN]."""
    factor = basis.standard.find_resistance_factor(resistance.mode, "declared")
    needed = demand / _find_share(resistance)
    return find_size(resistance, needed * factor.value_si) if factor else None


def _find_note(resistance: Resistance, open_lasting: Message | None) -> Message | None:
    """Condition of another type; a border rope's stiffness changes its force."""
    if open_lasting:
        return say("change.if_rest_proven")
    is_of_net = resistance.member in tuple(NetPart)
    return say("change.solve_again") if is_of_net else None


def _find_share(resistance: Resistance) -> float:
    """Share of a resistance that corrosion leaves [-]; a larger bar loses less."""
    how = resistance.derivation
    share = how.arguments.get("share") if how and resistance.wear else None
    return float(str(share)) if share else 1.0


@dataclass(frozen=True, slots=True)
class _Enough:
    """A type that reaches a demand: design and characteristic resistance [kN]."""

    type_id: str
    design: float
    value: float
    note: Message | None


def _list_enough(
    basis: Basis, resistance: Resistance, demand: float, pull: PullRecord | None
) -> Iterator[_Enough]:
    """List the types of the workbook that reach a demand in the same ground."""
    row, standard = basis.row, basis.standard
    ground = row.ground_type or resistance.ground
    for other in basis.site.catalogue:
        is_here = holds_in_ground(resistance.member, ground, other)
        if other.mode != resistance.mode or not is_here:
            continue
        other = replace(other, member=resistance.member)
        lasting, worn = corrode(other, basis)
        if worn or find_short_post(other, basis):
            continue
        value = find_resistance(lasting, standard).value
        factor = find_partial_factor(other, standard)
        if value is None or factor is None:
            continue
        _, open_lasting = find_lasting(basis, other, pull)
        design = value / factor.value_si
        if design >= demand:
            yield _Enough(other.type_id, design, value, _find_note(other, open_lasting))


def _record(
    quantity: Message, value: float, resistance: Resistance, note: Message | None
) -> Change:
    return Change(
        quantity=quantity,
        unit="kN",
        now=kilonewton_if_known(resistance.value),
        bound=math.floor(value * 10.0) / 10.0,
        sense="has",
        note=note,
    )


_CONSTRUCTION, _GRADE, _TERMINATION = "6x36-IWRC", 1770e6, "clips"
_ROPES_MM = (8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 32, 36, 40)
_BAR_STRENGTH = 500.0  # of a bar without a given steel [MPa]


# A part of the catalogue: what it is, and its characteristic resistance [kN].
Size = tuple[Message, float]


def find_size(resistance: Resistance, needed: float) -> Size | None:
    """Smallest part in the place of a type that bears a characteristic force [kN].

    None where the catalogue has none that bears it, or where the workbook does not say
    what the part is made of, as the section of a post.
    """
    sizes = _BY_MODE.get(resistance.mode)
    parts = sizes(resistance) if sizes else iter(())
    return next((part for part in parts if part[1] >= needed), None)


def _list_ropes(_: Resistance) -> Iterator[Size]:
    factor = find_rope_factor(_CONSTRUCTION)
    loss = find_termination(_TERMINATION)
    for diameter in _ROPES_MM:
        value = compute_rope_resistance(
            diameter=diameter / 1e3,
            grade=_GRADE,
            breaking_factor=factor.value,
            termination=loss.value,
        )
        part = say(
            "change.rope",
            diameter=diameter,
            construction=_CONSTRUCTION,
            grade=_GRADE / 1e6,
            termination=name("termination", _TERMINATION),
            status=name("status", loss.status),
        )
        yield part, kilonewton_from_newton(value)


def _list_bars(resistance: Resistance) -> Iterator[Size]:
    """Solid bars of the catalogue, of the steel of the type's own bar."""
    how = _find_derivation(resistance, "derivation.bar")
    strength = _take(how, "strength") if how else _BAR_STRENGTH
    every = (product["diameters"] for product in load_products()["bar"])
    for diameter in sorted({size for sizes in every for size in sizes}):
        section = RoundSection(outer=diameter / 1e3, strength=strength * 1e6)
        part = say("change.bar", diameter=float(diameter), strength=strength)
        yield part, kilonewton_from_newton(section.axial_resistance)


def _list_sections(resistance: Resistance) -> Iterator[Size]:
    """Sections of the series of a post, by size, of its steel and buckling length."""
    how = _find_derivation(resistance, "derivation.buckling")
    if how is None:
        return
    series, sizes = _find_series(resistance.type_id)
    strength = _take(how, "strength")
    imperfection = find_imperfection(str(how.arguments["curve"])).value
    for size in sorted(sizes, key=int):
        product = find_product(f"{series} {size}")
        if product is None:
            continue
        buckling = compute_buckling_resistance(
            area=product.values["area"][0],
            second_moment=product.values["second_moment_weak"][0],
            length=_take(how, "length"),
            yield_strength=strength * 1e6,
            modulus=1e6 * load_catalogue()["buckling"]["E_MPa"],
            imperfection=imperfection,
        )
        part = say("change.section", name=f"{series}{size}", grade=strength)
        yield part, kilonewton_from_newton(buckling.value)


def _find_series(type_id: str) -> tuple[str, Mapping[str, object]]:
    """Series of the section that a type is named after, with its sizes."""
    product = find_product(type_id)
    table = load_products()["section"]["series"]
    for series, sizes in table.items():
        if product and product.id.startswith(series):
            return series, sizes["sizes"]
    return "", {}


def _find_derivation(resistance: Resistance, key: str) -> Message | None:
    """Way in which a resistance was worked out as built, where it is this one."""
    how = resistance.derivation
    as_built = how.arguments.get("of") if how else None  # before it corrodes
    how = as_built if isinstance(as_built, Message) else how
    return how if how is not None and how.key == key else None


def _take(how: Message, key: str) -> float:
    return float(str(how.arguments[key]))


_BY_MODE: Mapping[str, Callable[[Resistance], Iterator[Size]]] = {
    "rope": _list_ropes,
    "tendon": _list_bars,
    "compression": _list_sections,
}
