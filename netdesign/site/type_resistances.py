"""Resistances that a type sheet gives by dimensions instead of by one number."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace

from netdesign.outcome import ModelError
from netdesign.resistance.catalogue import (
    Datum,
    find_bond_stress,
    find_imperfection,
    find_loop_efficiency,
    find_rope_factor,
    find_termination,
    list_constructions,
    load_catalogue,
)
from netdesign.resistance.ground import (
    PullOutTests,
    compute_pull_out_from_bond,
    limit_proof_load,
)
from netdesign.resistance.post import (
    BasePlate,
    BucklingResistance,
    compute_bearing_resistance,
    compute_buckling_resistance,
)
from netdesign.resistance.products import find_product
from netdesign.resistance.steel import compute_bar_resistance, compute_rope_resistance
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.fields import to_si
from netdesign.site.readings import Reading, Row, refuse
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import Message, say
from netdesign.words.names import name

# What says something without the columns beside it.
_ALONE = ("ground", "bar_strength", "yield_strength")
_DEFAULT_GROUTING, _DEFAULT_TERMINATION, _DEFAULT_CURVE = "A", "wedge", "d"
_INCLUDED = "included"  # the ends, in a breaking force that is given
_SPIRAL = "1x"  # how the name of a spiral rope's construction begins
_SOLID = "bar"
SECTION = ("area", "second_moment", "buckling_length", "yield_strength")  # of a post
TEST_COLUMNS = ("test_count", "test_least", "test_mean")
SOIL_COLUMNS = ("soil_cohesion", "soil_friction", "soil_weight")


def fill_in_resistances(row: Row, findings: list[Finding]) -> Row:
    """Line of a type sheet with the resistances that its dimensions give.

    Parameters
    ----------
    row : Row
        As read.
    findings : list of Finding
        Appended to: a number beside its dimensions, dimensions without the others.

    Returns
    -------
    Row
        A computed resistance stands in the place of the empty cell; its
        derivation says how it came about, its cell is that of the first dimension.
    """
    for key in _RULES:
        if key in row:
            row = _apply(key, row, findings)
    return row


def find_tests(row: Row) -> PullOutTests | None:
    """Pull-out tests of an anchor type; None where none, or refused ones, are given.

    Without a number it is one test, without a mean that is the least. A tested
    resistance is that of one test.
    """
    count, least, mean = (row[key] for key in TEST_COLUMNS)
    one = row["pull_out"]
    is_typed = one.state == "given" and one.derivation is None
    if is_typed and row["basis"].word == "tested":
        return PullOutTests(count=1, least=one.si, mean=one.si)
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
    if "soil_cohesion" in row:
        _is_ready(row, SOIL_COLUMNS, findings)
    if "test_count" not in row:
        return
    if row["test_least"].state != "given":  # the others say nothing without it
        _is_ready(row, TEST_COLUMNS, findings)
        return
    mean = row["test_mean"].given_si
    if mean is not None and row["test_least"].si > mean:
        rule = say("type.exceeds_mean", place=row["test_mean"].place)
        refuse(row["test_least"], rule, say("type.at_most_mean"), findings)


def check_ends(row: Row, findings: list[Finding]) -> None:
    """Refuse U-bolt grips on a spiral rope: EN 13411-5 is not for these."""
    if row.get("termination") is None or row["termination"].word != "clips":
        return
    product, typed = find_product(row["id"].word), row["construction"].word
    rope = typed or (product.id if product else "")
    if rope.startswith(_SPIRAL):
        rule = say("type.clips_on_spiral", rope=rope)
        refuse(row["termination"], rule, say("type.other_end"), findings)


def check_section(row: Row, findings: list[Finding]) -> None:
    """Refuse a section that is another than the one that its type is named after."""
    typed = row.get("section")
    if typed is None or typed.state != "given":
        return
    given, named = find_product(typed.word), find_product(row["id"].word)
    if given and named and given.id != named.id:
        place = row["id"].place
        rule = say("type.other_section", section=given.id, place=place, name=named.id)
        refuse(typed, rule, say("accepted.one_of_two"), findings)


def _apply(key: str, row: Row, findings: list[Finding]) -> Row:
    field = row[key].field
    governing = _find_governing(key, row)
    if governing:
        _tell_governing(row, field.computed_from, governing, findings)
        return row
    if key == "pull_out" and lacks_ground(row):  # a net row may give it
        return row
    if not _is_ready(row, field.computed_from, findings):
        return row
    first = row[field.computed_from[0]]
    if any(row[one].state == "faulty" for one in field.computed_with):
        return row
    if key == "tendon" and lacks_inner(row):  # may be a tube: not known
        return row
    try:
        value, derivation = _RULES[key](row)
    except ModelError as error:
        refuse(first, say("type.no_resistance"), error.message, findings)
        return row
    computed = replace(
        row[key],
        state="given",
        value=kilonewton_from_newton(value),
        derivation=derivation,
        cell=first.cell,
    )
    return {**row, key: computed}


def _find_governing(key: str, row: Row) -> Reading | None:
    """Reading that governs over dimensions: the resistance itself, or tests of it."""
    tests = TEST_COLUMNS if key == "pull_out" else ()
    given = (row[one] for one in (key, *tests) if row[one].state == "given")
    return next(given, None)


def _tell_governing(
    row: Row, needed: tuple[str, ...], governing: Reading, findings: list[Finding]
) -> None:
    """Say that dimensions beside a resistance are kept, and do not count."""
    typed = (row[key] for key in needed if row[key].derivation is None)
    beside = next((one for one in typed if one.state == "given"), None)
    if beside and beside.field.key not in _ALONE:
        name, place = governing.field.name, governing.place
        rule_text = say("type.governs", name=name, place=place)
        refuse(beside, rule_text, "", findings, severity="note")


# What has to be given for a bound from above; the rest may be the best there is.
_LEAST_KNOWN = {"rope": ("rope_diameter",)}


def list_beside(row: Row) -> Iterator[tuple[Reading, float]]:
    """Resistances as given, with what their dimensions give [N]; not of the bond.

    Where some of these are not given, with the most that they may give, if it is less.
    """
    for key in ("tendon", "rope", "compression", "bearing"):
        given = row.get(key)
        if given is None or given.state != "given" or given.derivation:
            continue
        field = given.field
        lacking = [one for one in field.computed_from if row[one].state != "given"]
        parts = (*field.computed_from, *field.computed_with)
        is_faulty = any(row[one].state == "faulty" for one in parts)
        if any(row[one].derivation for one in parts):  # of a product: asked elsewhere
            continue
        is_open = bool(lacking) or (key == "tendon" and lacks_inner(row))
        needed = _LEAST_KNOWN.get(key, field.computed_from)
        if is_faulty or not set(needed).isdisjoint(lacking):
            continue
        with suppress(ModelError):  # no resistance at all: nothing to compare
            most = _compute_bare_rope(row) if key == "rope" else _RULES[key](row)[0]
            if not is_open or given.si > most:
                yield given, most


def find_bond(row: Row, pull_out: float) -> float | None:
    """Mean bond stress under a pull-out force [N] over the bond length [kPa].

    None without the dimensions of the bond.
    """
    parts = (row["drill_diameter"], row["bond_length"])
    if any(one.state != "given" for one in parts):
        return None
    surface = math.pi * parts[0].si * parts[1].si
    return pull_out / surface / 1e3


def _is_ready(row: Row, keys: tuple[str, ...], findings: list[Finding]) -> bool:
    """All columns are given; some without the others are a finding.

    A ground may stand alone, and says where a type was tested; so may a steel.
    """
    present = [row[key] for key in keys if key in row]
    asking = [row[key] for key in keys if key in row and key not in _ALONE]
    given = [reading for reading in asking if reading.state == "given"]
    if any(reading.state == "faulty" for reading in present) or not given:
        return False
    lacking = [key for key in keys if row[key].state == "blank"]
    if lacking:
        names = tuple(row[key].field.name for key in lacking)
        rule = say("type.needs_more", names=names)
        refuse(given[0], rule, say("type.all_or_none"), findings)
    return not lacking


def _describe_origin(datum: Datum) -> Message:
    """Status and source of a number of the catalogue."""
    status = name("status", datum.status)
    return say("derivation.origin", status=status, source=datum.source)


def _bar(row: Row) -> tuple[float, Message]:
    diameter, strength = row["bar_diameter"], row["bar_strength"]
    value = compute_bar_resistance(diameter.si, strength.si, read_inner(row))
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


def _bond(row: Row) -> tuple[float, Message]:
    ground, grouting = row["ground"].word, row["grouting"].word or _DEFAULT_GROUTING
    ground_name = row["ground"].field.name_word(ground)
    bond = find_bond_stress(ground, grouting, ground_name=ground_name)
    diameter, length = row["drill_diameter"], row["bond_length"]
    value = compute_pull_out_from_bond(
        drill_diameter=diameter.si,
        bond_length=length.si,
        bond_stress=1e3 * bond.value,
    )
    return value, say(
        "derivation.bond",
        diameter=diameter.number,
        length=length.number,
        stress=bond.value,
        ground=ground_name,
        grouting=grouting,
        origin=_describe_origin(bond),
    )


def name_termination(row: Row) -> str:
    """Kind of a rope's ends; the one with the largest loss where none is given."""
    return row["termination"].word or _DEFAULT_TERMINATION


def reduce_breaking(row: Row) -> tuple[float, Message | None]:
    """Resistance of a rope by its breaking force and its ends [N], and how.

    A force that is said to include the ends stays as it is.
    """
    kind, force = name_termination(row), row["rope"]
    loss = find_termination(kind)
    if kind == _INCLUDED:
        return force.si, None
    return loss.value * force.si, say(
        "derivation.breaking",
        force=force.number,
        loss=loss.value,
        termination=name("termination", kind),
        origin=_describe_origin(loss),
    )


def may_be_rope(line: Row) -> bool:
    """An anchor whose tendon is a rope, or of which nothing says what it is."""
    if line["kind"].word:
        return line["kind"].word == "rope anchor"
    product = find_product(line["id"].word)
    return product is None or not product.family.endswith("bar")


def reduce_loop(row: Row) -> tuple[float, Message]:
    """Resistance of a rope anchor's tendon with its loop [N], and how; (R31)."""
    force, given = row["tendon"], row["loop_efficiency"]
    loss, how = find_loop_loss(row), say("derivation.loop_given", place=given.place)
    if given.given_si is None:
        how = _describe_origin(find_loop_efficiency())
    return loss * force.si, say(
        "derivation.loop", force=force.number, loss=loss, origin=how
    )


def find_loop_loss(row: Row) -> float:
    """Loss factor k_e of an anchor's loop [-]; 1 of one that has none."""
    given = row["loop_efficiency"].given_si
    if not may_be_rope(row):
        return 1.0
    return find_loop_efficiency().value if given is None else given


def find_proof_limit(row: Row, *, has_loop: bool) -> float | None:
    """Largest load of a test that the tendon of an anchor type allows [N]; (R32).

    Of a bar its tensile strength is that of its product, or no more than it yields at.

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


def _rope(row: Row) -> tuple[float, Message]:
    construction = row["construction"].word
    kind = name_termination(row)
    if kind == _INCLUDED:  # there is no breaking force that could include it
        kind = _DEFAULT_TERMINATION
    factor, loss = find_rope_factor(construction, "K"), find_termination(kind)
    diameter, grade = row["rope_diameter"], row["grade"]
    value = compute_rope_resistance(
        diameter=diameter.si,
        grade=grade.si,
        breaking_factor=factor.value,
        termination=loss.value,
    )
    return value, say(
        "derivation.rope",
        factor=factor.value,
        diameter=diameter.number,
        grade=grade.number,
        loss=loss.value,
        construction=construction,
        origin=_describe_origin(factor),
        termination=row["termination"].field.name_word(kind),
        loss_origin=_describe_origin(loss),
    )


def find_breaking(row: Row) -> float | None:
    """Breaking force of a rope without the loss of its ends [N]; None if not known."""
    rope = row["rope"]
    return rope.given_si if rope.derivation is None else _compute_bare_rope(row)


def _compute_bare_rope(row: Row) -> float:
    """Breaking force by dimensions, without ends [N]; the most that it may be."""
    grade, construction = row["grade"], row["construction"].word
    factors = [
        find_rope_factor(one, "K").value
        for one in ([construction] if construction else list_constructions())
    ]
    return compute_rope_resistance(
        diameter=row["rope_diameter"].si,
        grade=to_si(grade.field.bounds[1], grade.field.unit)
        if grade.given_si is None
        else grade.si,
        breaking_factor=max(factors),
        termination=1.0,
    )


def _buckling(row: Row) -> tuple[float, Message]:
    curve, found = name_curve(row), compute_buckling(row)
    imperfection = find_imperfection(curve)
    return found.value, say(
        "derivation.buckling",
        reduction=found.reduction,
        area=row["area"].number,
        strength=row["yield_strength"].number,
        slenderness=found.slenderness,
        curve=curve,
        imperfection=imperfection.value,
        critical=kilonewton_from_newton(found.critical),
        modulus=load_catalogue()["buckling"]["E_MPa"],
        second_moment=row["second_moment"].number,
        length=row["buckling_length"].number,
        origin=_describe_origin(imperfection),
    )


def read_plate(row: Row) -> BasePlate:
    """Base plate of a post, all of it given."""
    return BasePlate(
        length=row["plate_length"].si,
        width=row["plate_width"].si,
        stress=row["bearing_stress"].si,
    )


def _bearing(row: Row) -> tuple[float, Message]:
    return compute_bearing_resistance(read_plate(row)), say(
        "derivation.bearing",
        length=row["plate_length"].number,
        width=row["plate_width"].number,
        stress=row["bearing_stress"].number,
    )


# Of a resistance its value [N] and how it follows from what ``columns.toml`` names.
_RULES: Mapping[str, Callable[[Row], tuple[float, Message]]] = {
    "tendon": _bar,
    "pull_out": _bond,
    "rope": _rope,
    "compression": _buckling,
    "bearing": _bearing,
}


def lacks_inner(line: Row) -> bool:
    """Lack of an inner diameter of an anchor that may be hollow.

    A bar that is known by its name has one, or is solid.
    """
    is_solid = line["kind"].word == _SOLID
    return (
        line["bar_diameter"].state == "given"
        and line["bar_diameter"].derivation is None
        and line["inner_diameter"].state != "given"
        and not is_solid
    )


def lacks_ground(line: Row) -> bool:
    """Lack of nothing but the ground for the bond of an anchor."""
    bond = ("drill_diameter", "bond_length")
    return line["ground"].state == "blank" and all(
        line[key].state == "given" for key in bond
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
