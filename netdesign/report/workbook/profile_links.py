"""Cells of the limit profile's sheet: factors that checks read, values they rest on.

Factors on action and resistance are live. All other values went into the study's
forces and resistances: where one is changed, no check is proven until the site is
checked again.
"""

from __future__ import annotations

from dataclasses import dataclass

from netdesign.checks.schema import ACTION_FACTOR
from netdesign.report.workbook.writer import Book
from netdesign.study.records import CheckRecord, Study

FIRST_LINE = 5  # of the profile's table, counted from one
VALUE_COLUMN = "C"
UNCHANGED = "profile_unchanged"  # name of a cell: 1 where no value but factors differs
_WATCH = 7  # column of what is watched, hidden; beyond the table
_SAME = 1e-12  # relative
# Derivations of resistances that follow the factors; their cells hold the study's.
_FOLLOWING = ("post_bending.", "derivation.sliding")


@dataclass(frozen=True, slots=True)
class ProfileCell:
    """Place of a value of the profile, and the value."""

    place: str  # "'Limit profile'!$C$9"
    value: float


class Factors:
    """Places of a study's factors; its profile has each of them once."""

    def __init__(self, book: Book, study: Study) -> None:
        self._cells = {
            value.id: ProfileCell(
                book.refer("profile", f"${VALUE_COLUMN}${line}"), value.value
            )
            for line, value in enumerate(study.profile.values, FIRST_LINE)
        }

    def on_action(self) -> ProfileCell | None:
        """Factor on every action; None where the profile has none."""
        return self._cells.get(ACTION_FACTOR)

    def on_resistance(self, check: CheckRecord) -> ProfileCell | None:
        """Factor of a check's mode on its basis, else of its mode."""
        general = f"resistance.{check.mode}"
        named = f"{general}.{check.resistance_basis}"
        return self._cells.get(named) or self._cells.get(general)


def watch_profile(book: Book, study: Study) -> None:
    """Name the cell that tells whether the profile's values are those of the study."""
    sheet = book.workbook.get_worksheet_by_name(book.name("profile"))
    factors = Factors(book, study)
    live: set[str] = set()
    for row in study.rows:
        linked = (factors.on_resistance(check) for check in row.checks)
        live |= {factor.place for factor in linked if factor}
    if on_action := factors.on_action():
        live.add(on_action.place)
    values = list(enumerate(study.profile.values, FIRST_LINE))
    for line, value in values:
        cell = f"${VALUE_COLUMN}${line}"
        if book.refer("profile", cell) not in live:
            same = f"=IFERROR(IF({write_same(cell, value.value)},1,0),0)"
            sheet.write_formula(line - 1, _WATCH, same, None, 1)
    sheet.set_column(_WATCH, _WATCH, None, None, {"hidden": True})
    column = chr(ord("A") + _WATCH)
    head, last = FIRST_LINE - 1, FIRST_LINE + len(values)
    least = f"=MIN(1,{column}{FIRST_LINE}:{column}{last})"
    sheet.write_formula(head - 1, _WATCH, least, None, 1)
    place = book.refer("profile", f"${column}${head}")
    book.workbook.define_name(UNCHANGED, f"={place}")


def write_same(cell: str, number: float) -> str:
    """Condition: a cell holds a number of the study."""
    near = f"ABS({cell}-{number!r})<={_SAME:.0E}*ABS({number!r})"
    return f"IF(ISNUMBER({cell}),{near},FALSE)"


def follows_factors(check: CheckRecord) -> bool:
    """True if a factor is in the characteristic resistance itself."""
    told = check.resistance_derivation
    return told is not None and told.key.startswith(_FOLLOWING)
