"""Prices of types from a csv file: type, price, per; in any of the languages."""

from __future__ import annotations

import csv
import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path

from netdesign.edge.causes import explain
from netdesign.edge.given_files import decode_utf8, list_faults, read_bounded
from netdesign.outcome import TerrainError
from netdesign.study.parts import NET, Per, Price, Prices
from netdesign.words.message import Message, say

_MOST_BYTES = 1_000_000
_HEADINGS = ({"type", "typ"}, {"price", "prix", "preis"}, {"per", "par", "je", "pro"})
_NETS = ("filet", "netz")
_PER: Mapping[str, Per] = {
    **dict.fromkeys(("piece", "pièce", "piece(s)", "stück", "stk", "pce"), "piece"),
    **dict.fromkeys(("m", "metre", "meter", "mètre"), "m"),
    **dict.fromkeys(("m2", "m²"), "m2"),
}


def read_prices(path: Path, types: Collection[str]) -> Prices:
    """Read prices; every type of the workbook needs one, and so does the net.

    Parameters
    ----------
    path : Path
        Lines of type, price and ``piece``, ``m`` or ``m2``; columns apart by
        semicolons, commas or tabs. With semicolons a comma may be the decimal mark.
    types : collection of str
        Of the workbook.

    Raises
    ------
    TerrainError
        With all faults at once.
    """
    try:
        text = decode_utf8(read_bounded(path, _MOST_BYTES))
    except (OSError, ValueError) as error:
        told = say("prices.unreadable", file=path.name, cause=explain(error))
        raise TerrainError(told) from None
    faults: list[Message] = []
    found: dict[str, tuple[Price, ...]] = {}
    for number, (name, price) in _list_prices(text, faults):
        if name.lower() in _NETS and name not in types:
            name = NET
        if name not in types and name != NET:
            faults.append(say("prices.strange", line=number, type=name))
        found[name] = (*found.get(name, ()), price)
    missing = tuple(one for one in (*types, NET) if one not in found)
    if missing and not faults:
        faults.append(say("prices.missing", types=missing))
    if faults:
        told_all = [say("text.at_place", place=path.name, text=one) for one in faults]
        raise TerrainError(list_faults(told_all))
    return found


def _list_prices(
    text: str, faults: list[Message]
) -> Iterator[tuple[int, tuple[str, Price]]]:
    first = text.lstrip().partition("\n")[0]
    mark = next((one for one in ";\t," if one in first), ";")
    lines = [
        (number, [cell.strip() for cell in line])
        for number, line in enumerate(csv.reader(text.splitlines(), delimiter=mark), 1)
        if any(cell.strip() for cell in line)
    ]
    heads = [one.lower() for one in lines[0][1]] if lines else []
    known = (one in names for one, names in zip(heads, _HEADINGS, strict=False))
    if len(heads) != len(_HEADINGS) or not all(known):
        faults.append(say("prices.headings"))
        return
    for number, cells in lines[1:]:
        price = _read_price(cells, mark)
        if price is None:
            faults.append(say("prices.line", line=number))
        else:
            yield number, (cells[0], price)


def _read_price(cells: Sequence[str], mark: str) -> Price | None:
    if len(cells) != len(_HEADINGS) or not cells[0]:
        return None
    per = _PER.get(cells[2].lower())
    text = cells[1].replace(",", ".") if mark != "," else cells[1]
    try:
        amount = float(text)
    except ValueError:
        return None
    if per is None or not (math.isfinite(amount) and amount >= 0.0):
        return None
    return Price(amount=amount, per=per)
