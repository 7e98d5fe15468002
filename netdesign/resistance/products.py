"""Sections, bars and ropes of norms and makers, found by the name of a type.

A name that matches no product, two products, or one product twice gives None: a false
hit is worse than a miss. Data and patterns: products.toml.
"""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Iterator
from itertools import chain
from typing import Any

from netdesign.resistance.catalogue import (
    Product,
    join,
    load_catalogue,
    load_products,
    make_bar,
    make_beam,
    make_hollow_bar,
    make_hollow_section,
    make_rope,
)

_LONGEST_NAME = 200
_ONE_SIZE = 1.1  # of the largest diameter to the least: makers differ by less
_NOMINAL = "nominal_diameter"  # of a hollow bar of which no other is stated
_DECIMAL = r"(\d+(?:\.\d+)?)"
_END = r"(?:(?= ?mm(?!\w))|(?![\w/]|\.\d))"
_NUMBER = rf"(?<![\w./]){_DECIMAL}{_END}"
_SIZES = rf"(?<![\w./]){_DECIMAL} ?[x/*] ?{_DECIMAL}(?: ?[x/*] ?{_DECIMAL})?{_END}"


def find_product(name: str) -> Product | None:
    """Product that a type is named after, as an office writes it.

    Examples
    --------
    >>> find_product("post HEB 120, S355").id
    'HEB120'
    >>> find_product("R7") is None
    True
    """
    text = _simplify(name)
    if re.search(load_products()["text"]["several"], text):
        return None
    finders = (
        _find_beam,
        _find_hollow_section,
        _find_bar,
        _find_hollow_bar,
        _find_rope,
    )
    products = [product for find in finders if (product := find(text)) is not None]
    return products[0] if len(products) == 1 else None


def find_bar(name: str) -> Product | None:
    """Bar that a type is named after; None where the name has no size of that bar.

    Examples
    --------
    >>> find_bar("GEWI 32").id
    'GEWI 32'
    >>> find_bar("GEWI 35") is None
    True
    >>> find_bar("R25N").id
    'R25 N'
    """
    product = find_product(name)
    if product is None or not product.family.endswith("bar"):
        return None
    size = "outer_diameter" if "outer_diameter" in product.values else _NOMINAL
    least, largest = product.values[size]
    return product if largest < _ONE_SIZE * least else None


def _simplify(name: str) -> str:
    """Fold a name: no accents, lengths, forces or drilled holes; "@" for a diameter."""
    text = re.sub("[®™]", "", name[:_LONGEST_NAME])
    text = unicodedata.normalize("NFKD", text).casefold()
    text = "".join(sign for sign in text if not unicodedata.combining(sign))
    text = re.sub("[×✕]", "x", re.sub("[–—‐‑]", "-", text)).replace("_", " ")
    text = re.sub(r"(?<=\d),(?=\d)", ".", text)
    text = re.sub(r" ?[ø⌀∅] ?=? ?", " @", text)
    patterns = load_products()["text"]
    text = re.sub(patterns["diameter"], "@", text)
    text = re.sub(patterns["length_or_force"], " ", text)
    text = re.sub(r"(?<=[a-z]{3})(?=\d)", " ", text)
    hole, size = patterns["hole"], r"\d+(?:\.\d+)?"
    after = rf"{hole}[ :=@\-]*{size}(?: ?mm)?(?!\w)"
    before = rf"(?<![\w./]){size} ?(?:mm)? ?{hole}(?![a-z]|[ :=@\-]*\d)"
    text = re.sub(f"{after}|{before}", " ", text)
    return " ".join(text.split())


def _has_word(pattern: str, text: str) -> bool:
    return re.search(rf"(?<![a-z])(?:{pattern})(?![a-z])", text) is not None


def _find_beam(text: str) -> Product | None:
    table = load_products()["section"]["series"]
    sections = {
        (series, next(filter(None, match.groups())))
        for series, entry in table.items()
        for match in re.finditer(
            rf"(?<![a-z0-9])(?:{entry['pattern']})(?![a-z0-9]|/\d\d)", text
        )
    }
    series, size = sections.pop() if len(sections) == 1 else ("", "")
    row = table.get(series, {}).get("sizes", {}).get(size)
    return join(f"{series}{size}", "section", [make_beam(row)]) if row else None


def _find_hollow_section(text: str) -> Product | None:
    table = load_products()["hollow_section"]
    is_round = _has_word(table["round_word"], text)
    is_box = _has_word(table["box_word"], text)
    sections: set[tuple[float, ...]] = set()
    for match in re.finditer(_SIZES, text):
        sizes = [float(size) for size in match.groups() if size]
        is_marked = text[: match.start()].endswith("@") or sizes[0] % 1.0 != 0.0
        if is_box or (is_round and len(sizes) == 3):
            sections |= _read_box(sizes, table)
        if not is_box and (is_round or is_marked):
            sections |= _read_tube(sizes, table, slack=0.5 if is_round else 0.0)
    if len(sections) != 1:
        return None
    sizes = list(sections.pop())
    name = "x".join(f"{size:g}" for size in sizes)
    kind = "CHS" if len(sizes) == 2 else "RHS"
    return join(f"{kind} {name}", "section", make_hollow_section(tuple(sizes)))


def _read_tube(
    sizes: list[float], table: dict[str, Any], slack: float
) -> set[tuple[float, ...]]:
    """Diameter and wall, if there is such a tube; a length may follow."""
    nearest: float = min(table["diameters"], key=lambda size: abs(size - sizes[0]))
    fits = abs(nearest - sizes[0]) <= slack and sizes[1] in table["walls"]
    return {(nearest, sizes[1])} if fits and sizes[1] <= nearest / 5.0 else set()


def _read_box(sizes: list[float], table: dict[str, Any]) -> set[tuple[float, ...]]:
    """Depth, width and wall, of three sizes or, where it is square, of two."""
    *sides, wall = sizes
    depth, width = max(sides), min(sides)
    fits = {depth, width} <= set(table["sides"]) and wall in table["walls"]
    return {(depth, width, wall)} if fits and wall <= width / 5.0 else set()


def _find_bar(text: str) -> Product | None:
    table: list[dict[str, Any]] = load_products()["bar"]
    hits = (
        (entry, match)
        for entry in table
        if (match := re.search(rf"(?<![a-z0-9])(?:{entry['pattern']})(?![a-z])", text))
    )
    first, match = next(hits, (None, None))
    if first is None or match is None:
        return None
    same = [entry for entry in table if entry["id"] == first["id"]]
    sizes = [size for entry in same for size in entry["diameters"]]
    size = _find_diameter(text, match, sizes, may_precede=first.get("behind", False))
    if size is None and first.get("plain", False):
        return None
    fitting = [
        make_bar(entry, entry["diameters"] if size is None else [size])
        for entry in same
        if size is None or size in entry["diameters"]
    ]
    name = first["id"] if size is None else f"{first['id']} {size:g}"
    return join(name, "solid bar", fitting)


def _find_diameter(
    text: str, match: re.Match[str], sizes: list[float], *, may_precede: bool
) -> float | None:
    """Diameter that follows a bar's name, else the one that is marked as such."""
    before, after = text[: match.start()], text[match.end() :]
    between = load_products()["text"]["between"]
    direct = re.match(between + _DECIMAL + _END, after)
    if may_precede and direct is None:
        direct = re.search(rf"(?<![\w./]){_DECIMAL} ?$", before)
    if direct is not None:
        return _pick_size(float(direct[1]), sizes)
    marked = {_pick_size(size, sizes) for size in _list_marked(f"{before} ; {after}")}
    marked.discard(None)
    return marked.pop() if len(marked) == 1 else None


def _pick_size(number: float, sizes: list[float]) -> float | None:
    """Size of the list that a number stands for; its decimals may be left out."""
    near = (s for s in sizes if number in (s, math.floor(s), math.ceil(s)))
    return next(near, None)


def _list_marked(text: str) -> Iterator[float]:
    """Numbers with the sign of a diameter, or in mm."""
    for match in re.finditer(rf"(@ ?)?{_NUMBER}( ?mm(?!\w))?", text):
        if match[1] or match[3]:
            yield float(match[2])


def _find_hollow_bar(text: str) -> Product | None:
    table = load_products()["hollow"]
    is_said = _has_word(table["word"], text)
    bars: set[tuple[str, str]] = set()
    for match in re.finditer(table["pattern"], text):
        letter, size, mark, number, titan = match.groups()
        if titan:
            bars.add(("TITAN", re.sub(" ?[/x-] ?", "/", titan)))
        elif is_said or mark or number:
            bars.add((f"{letter}{size}".upper(), mark or number or ""))
    series, mark = bars.pop() if len(bars) == 1 else ("", "")
    fitting = [
        make_hollow_bar(bar, family)
        for family in table["family"]
        for bar in family["bars"]
        if bar["series"] == series and mark in ("", *bar["marks"])
    ]
    name = f"{series} {mark}".strip().upper()
    return join(name, "hollow bar", fitting) if fitting else None


def _find_rope(text: str) -> Product | None:
    table = load_products()["rope"]
    strands = {
        match[1]: table["strands"][match[1].replace(" ", "")]
        for match in re.finditer(table["pattern"], text)
        if match[1].replace(" ", "") in table["strands"]
    }
    is_said = _has_word(table["word"], text)
    if (
        len(strands) > 1
        or not (strands or is_said)
        or re.search(table["not_word"], text)
    ):
        return None
    written, meant = next(iter(strands.items()), ("rope", None))
    rest = text.replace(written, " ") if strands else text
    diameter = _find_rope_diameter(rest, table, is_enough=bool(strands))
    if diameter is None:
        return None
    names = meant or set(chain.from_iterable(table["strands"].values()))
    ropes = load_catalogue()["rope"]["construction"]
    ropes = [rope for rope in ropes if rope.partition("-")[0] in names]
    numbers = {float(match[1]) for match in re.finditer(r"(?<!\d)(\d{4})(?!\d)", rest)}
    grades = [float(grade) for grade in load_catalogue()["rope"]["grade"]["values"]]
    fitting = [
        make_rope(rope, diameter, [g for g in grades if g in numbers] or grades)
        for rope in _keep_cores(ropes, rest, table["cores"])
    ]
    return join(f"{written.replace(' ', '')} {diameter:g} mm", "rope", fitting)


def _find_rope_diameter(
    text: str, table: dict[str, Any], *, is_enough: bool
) -> float | None:
    """The only diameter [mm]; with a construction a number without sign is enough."""
    if re.search(r"(?<![\w.])\d ?x ?@?\d", text):  # several ropes
        return None
    low, high = table["diameters"]
    diameters = {number for number in _list_marked(text) if low <= number <= high}
    if is_enough and not diameters:
        numbers = {float(match[1]) for match in re.finditer(_NUMBER, text)}
        diameters = {number for number in numbers if low <= number <= high}
    return diameters.pop() if len(diameters) == 1 else None


def _keep_cores(ropes: list[str], text: str, cores: dict[str, str]) -> list[str]:
    """Constructions with a core that the name states; all where it states none."""
    named = [core for core, pattern in cores.items() if _has_word(pattern, text)]
    return [rope for rope in ropes if rope.partition("-")[2] in named] or ropes
