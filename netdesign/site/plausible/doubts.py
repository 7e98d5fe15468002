"""Numbers of one line that can hardly be meant, alone or beside others of the line.

What is usual: usual.toml. A doubt is a reading and the sentence on it, in the form of
the rule of a finding: it reads after the text in question.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Container, Iterator, Mapping
from functools import lru_cache
from importlib.resources import files
from typing import Any, TypeAlias

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
# Quantities of a product by the columns that give them; the first is what is asked for.
_OF_PRODUCT: Mapping[str, Mapping[str, tuple[str, ...]]] = {
    "Anchors": {
        "tendon": ("yield_force", "ultimate_force"),
        "bar_diameter": ("outer_diameter",),
        "inner_diameter": ("inner_diameter",),
        "bar_strength": ("yield_strength", "ultimate_strength"),
    },
    "Ropes": {"rope": ("breaking_force",), "rope_diameter": ("rope_diameter",)},
    "Posts": {
        "area": ("area",),
        "second_moment": ("second_moment_weak",),
        "section_modulus": ("section_modulus_strong", "section_modulus_weak"),
        "post_width": ("width", "depth"),
    },
}


@lru_cache(maxsize=1)
def load_usual() -> dict[str, Any]:
    """Load what is usual, as its file gives it."""
    file = files(__package__).joinpath("usual.toml")
    return tomllib.loads(file.read_text(encoding="utf-8"))


def list_doubts(line: Row, sheet: str) -> Iterator[Doubt]:
    """Doubts about the numbers of a line, each by itself and beside the others.

    Parameters
    ----------
    line : mapping of str to Reading
        Of any sheet.
    sheet : str
        Its name in English.
    """
    typed = {key: one for key, one in line.items() if _is_meant(one, f"{sheet}.{key}")}
    alone = dict(_list_unlike(typed, line, sheet))
    for key, reading in typed.items():
        told = _doubt_alone(reading, f"{sheet}.{key}")
        if told and key not in alone:
            alone[key] = told
    for key, reading in typed.items():
        told = alone.get(key) or _doubt_beside(reading, f"{sheet}.{key}", line, alone)
        told = told or _doubt_tested(reading, key, line)
        if told:
            yield reading, told


def _is_meant(reading: Reading, column: str) -> bool:
    """A number is typed, and no zero that says that there is none."""
    has_zero = column in load_usual()["zero"]["columns"]
    return is_typed(reading) and not (has_zero and reading.number == 0.0)


def is_typed(reading: Reading) -> bool:
    """A number stands in the cell; it was not worked out from others."""
    is_given = reading.state == "given" and reading.derivation is None
    return is_given and isinstance(reading.value, float)


def _doubt_alone(reading: Reading, column: str) -> Message | None:
    least, most, source = load_usual()["alone"].get(column, (-math.inf, math.inf, ""))
    if least <= reading.number <= most:
        return None
    return say(
        "plausible.alone",
        number=reading.number,
        low=least,
        high=most,
        unit=reading.field.unit,
        source=say(f"plausible.source_{source}"),
    )


def _doubt_beside(
    reading: Reading, column: str, line: Row, doubted: Container[str]
) -> Message | None:
    """Doubt by others of the line, none of which is in doubt itself."""
    for least, most, powers in load_usual()["beside"].get(column, ()):
        others = [line[key] for key in powers]
        if any(one.state != "given" or not one.number for one in others):
            continue
        if any(key in doubted for key in powers):
            continue
        scale = math.prod(line[key].si ** power for key, power in powers.items())
        if not least * scale <= reading.si <= most * scale:
            unit = reading.field.unit
            return say(
                "plausible.beside",
                others=tuple(map(_name_with_value, others)),
                low=from_si(least * scale, unit),
                high=from_si(most * scale, unit),
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
    typed: Mapping[str, Reading], line: Row, sheet: str
) -> Iterator[tuple[str, Message]]:
    """Numbers of a type that are not those of the product that it is named after."""
    columns = _OF_PRODUCT.get(sheet, {})
    product = find_product(line["id"].word) if columns else None
    if product is None:
        return
    for key in (one for one in columns if one in typed):
        reading = typed[key]
        spans = [product.values[one] for one in columns[key] if one in product.values]
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
