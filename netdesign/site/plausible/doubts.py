"""Numbers of one line that can hardly be meant, alone or beside others of the line.

What is usual stands with the columns, in columns.toml. A doubt is a reading and the
sentence on it, in the form of the rule of a finding: it reads after the text in
question.
"""

from __future__ import annotations

import math
from collections.abc import Container, Iterator, Mapping
from typing import TypeAlias

from netdesign.resistance.products import find_product
from netdesign.site.columns.unit_names import from_si
from netdesign.site.readings import Reading, Row
from netdesign.words.message import Message, say

Doubt: TypeAlias = tuple[Reading, Message]

_TOLERANCE = 0.05  # of a value of the catalogue
_LOSS = 0.25  # what corrosion or a termination may take of a force of the catalogue
_FORCES = ("tendon", "rope")
_TESTED = ("pull_out", "test_mean")
_MOST_TESTED = 1.12  # times the tendon, whose strength may be given as that of yield


def list_doubts(line: Row) -> Iterator[Doubt]:
    """Doubts about the numbers of a line, each by itself and beside the others.

    Parameters
    ----------
    line : mapping of str to Reading
        Of any sheet.
    """
    typed = {key: one for key, one in line.items() if _is_meant(one)}
    alone = dict(_list_unlike(typed, line))
    for key, reading in typed.items():
        told = _doubt_alone(reading)
        if told and key not in alone:
            alone[key] = told
    for key, reading in typed.items():
        told = alone.get(key) or _doubt_beside(reading, line, alone)
        told = told or _doubt_tested(reading, key, line)
        if told:
            yield reading, told


def _is_meant(reading: Reading) -> bool:
    """A number is typed, and no zero that says that there is none."""
    says_none = reading.field.zero_says_none and reading.value == 0.0
    return is_typed(reading) and not says_none


def is_typed(reading: Reading) -> bool:
    """A number stands in the cell; it was not worked out from others."""
    is_given = reading.state == "given" and reading.derivation is None
    return is_given and isinstance(reading.value, float)


def _doubt_alone(reading: Reading) -> Message | None:
    usual = reading.field.usual
    if usual is None or usual.least <= reading.number <= usual.most:
        return None
    return say(
        "plausible.alone",
        number=reading.number,
        low=usual.least,
        high=usual.most,
        unit=reading.field.unit,
        source=say(f"plausible.source_{usual.source}"),
    )


def _doubt_beside(
    reading: Reading, line: Row, doubted: Container[str]
) -> Message | None:
    """Doubt by others of the line, none of which is in doubt itself."""
    for usual in reading.field.beside:
        others = [line[key] for key in usual.powers]
        if any(one.state != "given" or not one.number for one in others):
            continue
        if any(key in doubted for key in usual.powers):
            continue
        scale = math.prod(line[key].si ** power for key, power in usual.powers.items())
        low, high = usual.least * scale, usual.most * scale
        if not low <= reading.si <= high:
            unit = reading.field.unit
            return say(
                "plausible.beside",
                others=tuple(map(_name_with_value, others)),
                low=from_si(low, unit),
                high=from_si(high, unit),
                unit=unit,
            )
    return None


def _doubt_tested(reading: Reading, key: str, line: Row) -> Message | None:
    """No test pulls more out of the ground than its tendon bears."""
    tendon = line.get("tendon")
    if key not in _TESTED or tendon is None or tendon.state != "given":
        return None
    is_tested = key == "test_mean" or line["basis"].word == "tested"
    if not is_tested or reading.si <= _MOST_TESTED * tendon.si:
        return None
    return say("plausible.tested", tendon=_name_with_value(tendon))


def _name_with_value(reading: Reading) -> Message:
    return say(
        "plausible.named",
        name=reading.field.name,
        number=reading.number,
        unit=reading.field.unit,
        place=reading.place,
    )


def _list_unlike(
    typed: Mapping[str, Reading], line: Row
) -> Iterator[tuple[str, Message]]:
    """Numbers of a type that are not those of the product that it is named after."""
    columns = {
        key: one.field.of_product for key, one in typed.items() if one.field.of_product
    }
    product = find_product(line["id"].word) if columns else None
    if product is None:
        return
    for key, names in columns.items():
        reading = typed[key]
        spans = [product.values[one] for one in names if one in product.values]
        if not spans:
            continue
        if key in _FORCES or key == "bar_strength":  # yield to ultimate
            spans = [(min(low for low, _ in spans), max(high for _, high in spans))]
        loss = _LOSS if key in _FORCES else _TOLERANCE
        if any(
            (1.0 - loss) * low <= reading.si <= (1.0 + _TOLERANCE) * high
            for low, high in spans
        ):
            continue
        unit = reading.field.unit
        known = tuple(_name_span(from_si(a, unit), from_si(b, unit)) for a, b in spans)
        yield (
            key,
            say(
                "plausible.unlike",
                product=product.id,
                known=known,
                unit=unit,
                sources=product.sources,
            ),
        )


def _name_span(low: float, high: float) -> Message:
    if math.isclose(low, high, rel_tol=1e-6):
        return say("plausible.one", number=low)
    return say("plausible.span", low=low, high=high)
