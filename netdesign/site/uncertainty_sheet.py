"""Sheet Uncertainty: what is known of the scatter of some quantities.

It serves the notional reliability alone; no check hangs on it.
"""

from __future__ import annotations

from collections.abc import Mapping

from netdesign.site.cells.findings import Finding
from netdesign.site.headings import Table
from netdesign.site.lines import refuse_unknown_ids
from netdesign.site.model import UncertainQuantity
from netdesign.site.readings import Row, refuse
from netdesign.site.tables import read_rows
from netdesign.words.message import say


def read_uncertainty(
    table: Table | None, places: Mapping[str, str], findings: list[Finding]
) -> tuple[UncertainQuantity, ...]:
    """Lines of the sheet, one for each quantity of a net row, or of all.

    Parameters
    ----------
    table : Table or None
        Sheet Uncertainty, if there is one.
    places : mapping of str to str
        Cells of the ids of sheet Nets.
    findings : list of Finding
        Appended to: unknown rows, a quantity that comes twice.
    """
    found: dict[tuple[str, str], UncertainQuantity] = {}
    lines = read_rows(table, findings)
    if places:
        refuse_unknown_ids((one["row"] for one in lines), places, findings)
    for line in lines:
        if any(one.state == "faulty" for one in line.values()):
            continue
        quantity = _read_line(line)
        key = (quantity.row_id, quantity.name)
        if key in found:
            rule = say("uncertainty.twice")
            refuse(line["variable"], rule, say("uncertainty.once"), findings)
        found[key] = quantity
    return tuple(found.values())


# Words of the column that are not the names of their quantities.
_NAMES = {"model factor": "model"}


def _read_line(line: Row) -> UncertainQuantity:
    word = line["variable"].word
    return UncertainQuantity(
        row_id=line["row"].word,
        name=_NAMES.get(word, word).replace(" ", "_"),
        distribution=line["distribution"].word.lower(),
        mean_ratio=line["mean_ratio"].given_si,
        variation=line["variation"].si,
        period=line["period"].given_si,
        source=line["source"].word,
    )
