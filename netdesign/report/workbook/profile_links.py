"""Cells of the limit profile's sheet that the factors of the checks are read from."""

from __future__ import annotations

from dataclasses import dataclass

from netdesign.checks.schema import ACTION_FACTOR
from netdesign.report.workbook.writer import Book
from netdesign.study.records import CheckRecord, Study

FIRST_LINE = 5  # of the profile's table, counted from one
VALUE_COLUMN = "C"


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
