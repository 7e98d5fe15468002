"""Resistance of steel that corrodes, at the end of the design life."""

from __future__ import annotations

from dataclasses import replace

from netdesign.checks import Standard
from netdesign.outcome import ModelError
from netdesign.resistance.catalogue import Datum
from netdesign.resistance.corrosion import BARE, Wear, find_loss, leave_area
from netdesign.site.model import AnchorType, NetRow, Resistance
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import Message, say
from netdesign.words.names import name


def corrode(
    given: Resistance, row: NetRow, standard: Standard
) -> tuple[Resistance, Message | None]:
    """Resistance with the steel that is left, and why it may not last so long.

    None is known where that is not given. As it is, and no doubt, of what does not
    corrode, and where the profile leaves corrosion to others.
    """
    wear, life = given.wear, row.design_life
    if wear is None or "corrosion" in standard.not_checked:
        return given, None
    unsaid = row.list_unsaid_wear(given)
    if unsaid or life is None:
        lack = say("corrosion.lacks", names=unsaid)
        return replace(given, value=None, dimensions=None, lack=lack), lack
    if not wear.is_bare:
        return given, _doubt_protection(wear, life)
    try:
        return _reduce(given, wear, life), None
    except ModelError as error:
        return given, error.message


def _doubt_protection(wear: Wear, life: int) -> Message | None:
    if wear.protection in BARE:
        return say("corrosion.of_rope")
    years = wear.protected_years or 0
    return say("corrosion.short", years=years, life=life) if years < life else None


def _reduce(given: Resistance, wear: Wear, life: int) -> Resistance:
    loss = find_loss(wear.soil, life)
    outer, inner = wear.outer or 0.0, wear.inner or 0.0
    share = leave_area(outer, inner, loss.value / 1e3)
    if not share:
        raise ModelError(say("corrosion.nothing_left", years=life))
    if isinstance(given.dimensions, AnchorType) and given.dimensions.section:
        section = replace(given.dimensions.section, outer=outer - 2e-3 * loss.value)
        return replace(given, dimensions=replace(given.dimensions, section=section))
    if given.value is None:
        return given
    derivation = _describe(given, wear, life, loss, share)
    return replace(given, value=share * given.value, derivation=derivation)


def _describe(
    given: Resistance, wear: Wear, life: int, loss: Datum, share: float
) -> Message:
    origin = {"status": name("status", loss.status), "source": loss.source}
    told = {"of": given.derivation} if given.derivation else {}
    return say(
        "corrosion.left_of" if told else "corrosion.left",
        **told,
        before=kilonewton_from_newton(given.value or 0.0),
        share=share,
        loss=loss.value,
        years=life,
        soil=say(f"choice.soil.{wear.soil}"),
        origin=say("derivation.origin", **origin),
    )
