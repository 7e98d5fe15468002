"""Height factors in sheet Winter: of all rows, and of single ones."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from netdesign.site.cells.findings import Finding, add_nearest
from netdesign.site.readings import Row, refuse
from netdesign.words.message import say


def read_factors(
    lines: Sequence[Row], row_ids: Collection[str], findings: list[Finding]
) -> tuple[float | None, Mapping[str, float]]:
    """Height factor of all rows [-], None without one, and those of single rows.

    Parameters
    ----------
    lines : sequence of Row
        Of sheet Winter, at least one.
    row_ids : collection of str
        Ids of sheet Nets; with none, any row may be named.
    findings : list of Finding
        Appended to: an unknown row, a row that comes twice or without a factor, a
        factor that is of no row and not on the first line.
    """
    first = lines[0]
    general = None if first["row"].word else first["height_factor"].given_si
    factors: dict[str, float] = {}
    for line in lines:
        factor = line["height_factor"].given_si
        if line["row"].word:
            _read_row(line, factor, factors, row_ids, findings)
        elif factor is not None and factor != general:
            rule = say("winter_sheet.factor_of_none")
            accepted = say("winter_sheet.factor_place")
            refuse(line["height_factor"], rule, accepted, findings)
    return general, factors


def _read_row(
    line: Row,
    factor: float | None,
    factors: dict[str, float],
    row_ids: Collection[str],
    findings: list[Finding],
) -> None:
    """Keep the factor of a row, or say what is wrong with its line."""
    row, sheet = line["row"], say("sheet.Nets")
    if row_ids and row.word not in row_ids:
        accepted = add_nearest(
            say("accepted.id_of_sheet", sheet=sheet), row.word, row_ids
        )
        refuse(row, say("nets.no_id", sheet=sheet), accepted, findings)
    elif row.word in factors:
        rule = say("winter_sheet.row_twice")
        refuse(row, rule, say("winter_sheet.one_a_row"), findings)
    elif factor is not None:
        factors[row.word] = factor
    elif line["height_factor"].state != "faulty":
        rule = say("winter_sheet.row_without_factor")
        refuse(row, rule, say("winter_sheet.one_a_row"), findings)
