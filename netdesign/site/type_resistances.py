"""Resistances that a type sheet gives by dimensions instead of by one number."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from netdesign.outcome import ModelError
from netdesign.resistance.catalogue import (
    SPIRAL,
    Datum,
    find_imperfection,
    find_loop_efficiency,
    find_termination,
    load_catalogue,
)
from netdesign.resistance.ground import (
    PullOutTests,
    limit_proof_load,
)
from netdesign.resistance.post import (
    BucklingResistance,
    compute_buckling_resistance,
)
from netdesign.resistance.products import find_product
from netdesign.resistance.steel import RoundSection
from netdesign.site.cells.findings import Finding
from netdesign.site.readings import Reading, Row, refuse
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import Message, say
from netdesign.words.names import name

_DEFAULT_TERMINATION, _DEFAULT_CURVE = "wedge", "d"
_INCLUDED = "included"  # the ends, in a breaking force that is given
_SOLID = "bar"
SECTION = ("area", "second_moment", "buckling_length", "yield_strength")  # of a post
TEST_COLUMNS = ("test_count", "test_least", "test_mean")
SOIL_COLUMNS = ("soil_cohesion", "soil_friction", "soil_weight")


def compute_tendon(line: Row, findings: list[Finding]) -> Row:
    """Line of an anchor type with the tendon that its steel has, where none is typed.

    Parameters
    ----------
    line : Row
        With the steel that its name means.
    findings : list of Finding
        Appended to: steel that cannot be.
    """
    steel = (line["bar_diameter"], line["bar_strength"])
    is_open = line["tendon"].state != "blank" or lacks_inner(line)
    if is_open or any(reading.state != "given" for reading in steel):
        return line
    return _compute("tendon", _bar, line, steel[0], findings)


def compute_compression(line: Row, findings: list[Finding]) -> Row:
    """Line of a post's type with the compression that its section bears.

    Parameters
    ----------
    line : Row
        As read; the compression stays open without all of its section.
    findings : list of Finding
        Appended to: a section that cannot be.
    """
    if any(line[key].state != "given" for key in SECTION):
        return line
    if line["buckling_curve"].state == "faulty":
        return line
    return _compute("compression", _buckling, line, line["area"], findings)


def _compute(
    key: str,
    rule: Callable[[Row], tuple[float, Message]],
    line: Row,
    first: Reading,
    findings: list[Finding],
) -> Row:
    """Line with a resistance worked out from dimensions, in the cell of the first."""
    try:
        value, derivation = rule(line)
    except ModelError as error:
        refuse(first, say("type.no_resistance"), error.message, findings)
        return line
    computed = replace(
        line[key],
        state="given",
        value=kilonewton_from_newton(value),
        derivation=derivation,
        cell=first.cell,
    )
    return {**line, key: computed}


def find_tests(row: Row) -> PullOutTests | None:
    """Pull-out tests of an anchor type; None where none are given, or all are refused.

    Without a number of tests it is 1; without a mean, the mean is the least force.
    """
    count, least, mean = (row[key] for key in TEST_COLUMNS)
    if least.state != "given" or "faulty" in (count.state, mean.state):
        return None
    average = least.si if mean.given_si is None else mean.si
    if least.si > average:  # ``check_tests`` has refused it
        return None
    return PullOutTests(
        count=count.given_count or 1,
        least=least.si,
        mean=average,
        singles=count.singles,
    )


def check_tests(row: Row, findings: list[Finding]) -> None:
    """Refuse tests, or a ground's strength, that are incomplete or contradictory."""
    _refuse_incomplete(row, SOIL_COLUMNS, findings)
    if row["test_least"].state != "given":  # the others say nothing without it
        _refuse_incomplete(row, TEST_COLUMNS, findings)
        return
    mean = row["test_mean"].given_si
    if mean is not None and row["test_least"].si > mean:
        rule = say("type.exceeds_mean", place=row["test_mean"].place)
        refuse(row["test_least"], rule, say("type.at_most_mean"), findings)


def _refuse_incomplete(
    row: Row, keys: tuple[str, ...], findings: list[Finding]
) -> None:
    """Refuse a line that fills only some of the columns that belong together."""
    typed = [row[key] for key in keys if row[key].state == "given"]
    lacking = [row[key] for key in keys if row[key].state == "blank"]
    if typed and lacking and len(typed) + len(lacking) == len(keys):
        rule = say(
            "type.needs_more", names=tuple(reading.field.name for reading in lacking)
        )
        refuse(typed[0], rule, say("type.all_or_none"), findings)


def check_ends(row: Row, findings: list[Finding]) -> None:
    """Refuse U-bolt grips on a spiral rope: EN 13411-5 is not for these."""
    product = find_product(row["id"].word)
    rope = product.id if product else ""
    if row["termination"].word == "clips" and rope.startswith(SPIRAL):
        rule = say("type.clips_on_spiral", rope=rope)
        refuse(row["termination"], rule, say("type.other_end"), findings)


def find_bond(row: Row, pull_out: float) -> float | None:
    """Mean bond stress under a pull-out force [N] over the bond length [kPa].

    None without the dimensions of the bond.
    """
    parts = (row["drill_diameter"], row["bond_length"])
    if any(reading.state != "given" for reading in parts):
        return None
    surface = math.pi * parts[0].si * parts[1].si
    return pull_out / surface / 1e3


def _describe_origin(datum: Datum) -> Message:
    """Status and source of a number of the catalogue."""
    status = name("status", datum.status)
    return say("derivation.origin", status=status, source=datum.source)


def _bar(row: Row) -> tuple[float, Message]:
    diameter, strength = row["bar_diameter"], row["bar_strength"]
    section = RoundSection(
        outer=diameter.si, inner=read_inner(row), strength=strength.si
    )
    value = section.axial_resistance
    inner = row["inner_diameter"]
    if inner.state == "given":
        return value, say(
            "derivation.tube",
            outer=diameter.number,
            inner=inner.number,
            strength=strength.number,
        )
    return value, say(
        "derivation.bar", diameter=diameter.number, strength=strength.number
    )


def reduce_breaking(row: Row) -> tuple[float, Message | None]:
    """Resistance of a rope by its breaking force and its ends [N], and how.

    A force that is said to include the ends stays as it is.
    """
    termination, force = row["termination"].word or _DEFAULT_TERMINATION, row["rope"]
    loss = find_termination(termination)
    if termination == _INCLUDED:
        return force.si, None
    return loss.value * force.si, say(
        "derivation.breaking",
        force=force.number,
        loss=loss.value,
        termination=name("termination", termination),
        origin=_describe_origin(loss),
    )


def may_be_rope(line: Row) -> bool:
    """Whether an anchor's tendon is a rope, or may be, as its kind is not given."""
    if line["kind"].word:
        return line["kind"].word == "rope anchor"
    product = find_product(line["id"].word)
    return product is None or not product.family.endswith("bar")


def reduce_loop(row: Row) -> tuple[float, Message]:
    """Resistance of a rope anchor's tendon with its loop [N], and how; (R31)."""
    force, loss = row["tendon"], find_loop_loss(row)
    how = _describe_origin(find_loop_efficiency())
    return loss * force.si, say(
        "derivation.loop", force=force.number, loss=loss, origin=how
    )


def find_loop_loss(row: Row) -> float:
    """Loss factor k_e of an anchor's loop [-]; 1 of one that has none."""
    return find_loop_efficiency().value if may_be_rope(row) else 1.0


def find_proof_limit(row: Row, *, has_loop: bool) -> float | None:
    """Largest load of a test that the tendon of an anchor type allows [N]; (R32).

    A bar breaks at the ultimate force of its product, else where its tendon yields.

    Parameters
    ----------
    row : mapping of str to Reading
        Line of sheet Anchors.
    has_loop : bool
        A rope anchor's loop counts; else the most that its rope may bear.
    """
    tendon = row["tendon"].given_si
    if tendon is None:
        return None
    tendon *= find_loop_loss(row) if has_loop else 1.0
    product = None if may_be_rope(row) else find_product(row["id"].word)
    ultimate, _ = (
        product.values.get("ultimate_force", (0.0, 0.0)) if product else (0, 0)
    )
    return limit_proof_load(tendon, max(tendon, ultimate))


def _buckling(row: Row) -> tuple[float, Message]:
    curve, buckling = name_curve(row), compute_buckling(row)
    imperfection = find_imperfection(curve)
    return buckling.value, say(
        "derivation.buckling",
        reduction=buckling.reduction,
        area=row["area"].number,
        strength=row["yield_strength"].number,
        slenderness=buckling.slenderness,
        curve=curve,
        imperfection=imperfection.value,
        critical=kilonewton_from_newton(buckling.critical),
        modulus=load_catalogue()["buckling"]["E_MPa"],
        second_moment=row["second_moment"].number,
        length=row["buckling_length"].number,
        origin=_describe_origin(imperfection),
    )


def lacks_inner(line: Row) -> bool:
    """Whether an anchor that may be hollow lacks its inner diameter.

    A bar that is recognised by its name has one, or is solid.
    """
    is_solid = line["kind"].word == _SOLID
    return (
        line["bar_diameter"].state == "given"
        and line["bar_diameter"].derivation is None
        and line["inner_diameter"].state != "given"
        and not is_solid
    )


def read_inner(line: Row) -> float:
    """Inner diameter of an anchor's steel [m]; 0 of a solid bar."""
    return line["inner_diameter"].given_si or 0.0


def compute_buckling(line: Row) -> BucklingResistance:
    """Buckling resistance of a post by its dimensions, all of them given."""
    return compute_buckling_resistance(
        area=line["area"].si,
        second_moment=line["second_moment"].si,
        length=line["buckling_length"].si,
        yield_strength=line["yield_strength"].si,
        modulus=1e6 * load_catalogue()["buckling"]["E_MPa"],
        imperfection=find_imperfection(name_curve(line)).value,
    )


def name_curve(line: Row) -> str:
    """Buckling curve of a post; the lowest where none is given."""
    return line["buckling_curve"].word or _DEFAULT_CURVE
