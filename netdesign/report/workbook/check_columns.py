"""Columns of the sheet of checks."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from netdesign.quantities import QUANTITIES
from netdesign.report.blocks import Column
from netdesign.report.words import Words, add_unit, name_heading

# Quantities of every case, in columns of their own.
CASE_QUANTITIES = ("density_kg_m3", "friction_deg", "inclination_deg")
_ENDS = {-1: "heading.low", 1: "heading.high"}


@dataclass(frozen=True)
class Field:
    """Column of the sheet.

    Attributes
    ----------
    letter, quantity, heading, width
        Its letter, keys of its quantity and heading, and how wide it is. Without a key
        of a heading, a quantity of a case stands under its name, any other under its
        symbol.
    step, end : str, int
        Step of the calculation that it shows, and which end of it: -1, 0, 1.
    is_of_study : bool
        It has values of the stored study: hidden, and its heading says "study".
    """

    letter: str
    quantity: str
    heading: str
    width: float
    step: str = ""
    end: int = 0
    is_of_study: bool = False

    @cached_property
    def index(self) -> int:
        """Place of the column, from zero."""
        *tens, ones = (ord(sign) - ord("A") for sign in self.letter)
        return ones + 26 * sum(ten + 1 for ten in tens)

    @cached_property
    def is_number(self) -> bool:
        """True if its cells are numbers."""
        return bool(self.quantity) or self.heading == "heading.no"

    @cached_property
    def bare(self) -> Column:
        """The column without a heading."""
        return Column(heading="", quantity=self.quantity, is_number=self.is_number)

    def name(self, words: Words) -> Column:
        """The column under its heading."""
        heading = words(self.heading) if self.heading else self._name(words)
        if self.is_of_study:
            study = words("heading.study")
            heading = words("show.label", label=study, text=heading)
        return Column(heading=heading, quantity=self.quantity, is_number=self.is_number)

    def _name(self, words: Words) -> str:
        row = QUANTITIES[self.quantity]
        if self in CASES:
            return name_heading(words, self.quantity)
        label = row.symbol
        if self.end:
            label = f"{label} {words(_ENDS[self.end])}"
        return add_unit(label, row.unit)


def _step(letter: str, quantity: str, step: str, end: int = 0) -> Field:
    return Field(letter, quantity, "", 7, step, end)


LEAD = (
    Field("A", "", "heading.no", 4),
    Field("B", "", "heading.net_row", 9),
    Field("C", "", "heading.check", 20),
    Field("D", "", "heading.clause", 9),
)
_ACTIONS = (
    _step("E", "action_kN", "E_k", -1),
    _step("F", "action_kN", "E_k"),
    _step("G", "action_kN", "E_k", 1),
)
RESISTANCE_K = _step("L", "resistance_characteristic_kN", "R_k")
RATIOS = (
    _step("O", "utilisation", "μ", -1),
    _step("P", "utilisation", "μ"),
    _step("Q", "utilisation", "μ", 1),
)
STEPS = (
    *_ACTIONS,
    _step("H", "action_factor", "γ_E"),
    _step("I", "demand_kN", "E_d", -1),
    _step("J", "demand_kN", "E_d"),
    _step("K", "demand_kN", "E_d", 1),
    RESISTANCE_K,
    _step("M", "resistance_factor", "γ_R"),
    _step("N", "resistance_kN", "R_d"),
    *RATIOS,
)
SET = Field("R", "", "heading.set_by_study", 10)
VERDICT = Field("S", "", "heading.verdict", 15)
TAIL = (
    Field("W", "", "heading.resistance_from", 18),
    Field("X", "", "heading.reason", 50),
)
LOADS = (
    Field("Y", "coupled_kN", "", 7, end=1),
    Field("Z", "guideline_kN", "", 7),
    Field("AA", "", "heading.governing_load", 16),
)
CASES = tuple(
    Field(letter, quantity, "", 8.5)
    for letter, quantity in zip("TUV", CASE_QUANTITIES, strict=True)
)
# Hidden: what the live cells are compared with, and what is sorted by.
RANK = Field("AB", "", "heading.rank", 8)
UNCHANGED = Field("AC", "", "heading.as_in_study", 8)
STUDY_TEXTS = (
    Field("AD", "", "heading.resistance_from", 8, is_of_study=True),
    Field("AE", "", "heading.reason", 8, is_of_study=True),
)
STUDY_VERDICT = Field("AF", "", "heading.verdict", 8, is_of_study=True)
STUDY_NUMBERS = (
    Field("AG", "utilisation", "", 8, end=-1, is_of_study=True),
    Field("AH", "utilisation", "", 8, end=1, is_of_study=True),
    Field("AI", "resistance_characteristic_kN", "", 8, is_of_study=True),
)
# Of a study with further ranges; after the hidden ones, whose letters stay.
FURTHER = Field("AJ", "", "heading.further_values", 24)
AS_CALCULATED = Field("AK", "", "heading.as_calculated", 8)
SHOWN = (*LEAD, *STEPS, SET, VERDICT, *CASES, *TAIL, *LOADS)
HIDDEN = (RANK, UNCHANGED, *STUDY_TEXTS, STUDY_VERDICT, *STUDY_NUMBERS, AS_CALCULATED)
FOLDED = (_ACTIONS[0], _ACTIONS[2])  # E_d has the same ends; a click unfolds them
FIELDS = tuple(sorted((*SHOWN, *HIDDEN, FURTHER), key=lambda field: field.index))
