"""From a cell to a value: one cell, read as one field."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from decimal import Decimal
from typing import Literal

from netdesign.outcome import ModelError
from netdesign.resistance.ground import SingleTest
from netdesign.site.cells.cells import Cell
from netdesign.site.cells.findings import Finding, Refusal, Severity, add_nearest
from netdesign.site.cells.numbers import (
    DecimalMark,
    is_moment,
    parse_number,
    read_grade,
    split_range,
    split_unit,
)
from netdesign.site.columns.fields import (
    KNOWN_UNITS,
    UNCLEAR_UNITS,
    Field,
    convert_unit,
    normalise,
    normalise_unit,
    to_si,
)
from netdesign.site.model import InputEcho
from netdesign.words.catalogue import write_unit
from netdesign.words.message import Message, say

State = Literal["given", "blank", "default", "faulty"]

_LONGEST_TEXT = 200


@dataclass(frozen=True, slots=True, kw_only=True)
class Reading:
    """One input as typed and as understood.

    Attributes
    ----------
    field : Field
        What it is.
    state : str
        ``given``, ``blank`` (nothing typed), ``default`` (assumed) or ``faulty`` (a
        finding says why).
    value : float, str or None
        As understood, in the field's first unit; None where there is none.
    text : str
        As typed, with the unit where that of the column is another.
    cell : Cell or None
        None where the sheet has no such column.
    derivation : Message or None
        How the value follows from other inputs; None where it was typed.
    singles : tuple of SingleTest
        Pull-out tests of sheet Tests that it is the number of.
    span : tuple of float, or None
        Low and high end of a range that the cell holds, in the field's first unit;
        then the value is the more severe of them.
    """

    field: Field
    state: State
    value: float | str | None = None
    text: str = ""
    cell: Cell | None = None
    derivation: Message | None = None
    singles: tuple[SingleTest, ...] = ()
    span: tuple[float, float] | None = None

    @property
    def place(self) -> str:
        """Cell such as ``Rows!C5``; empty where the sheet has no such column."""
        return self.cell.place if self.cell else ""

    @property
    def number(self) -> float:
        """The value in the field's first unit; an error unless it is a number."""
        if not isinstance(self.value, float):
            raise ModelError(say("cell.no_number_read", name=self.field.name))
        return self.value

    @property
    def si(self) -> float:
        """The value in SI units; an error unless it is a number."""
        return to_si(self.number, self.field.unit)

    @property
    def given_si(self) -> float | None:
        """The value in SI units where it was typed; None of a default or empty cell."""
        return self.si if self.state == "given" else None

    @property
    def known_si(self) -> float | None:
        """The value in SI units, typed or assumed; None where there is none."""
        return self.si if self.state in ("given", "default") else None

    @property
    def given_count(self) -> int | None:
        """The whole number where it was typed; None of a default or an empty cell."""
        return int(self.number) if self.state == "given" else None

    @property
    def word(self) -> str:
        """The value of a word, id or text; empty where nothing is given."""
        return self.value if isinstance(self.value, str) else ""

    def echo(self, named: Message | None = None) -> InputEcho:
        """Input as the report shows it, perhaps by another name than its column's."""
        return InputEcho(
            label=named or self.field.name,
            unit=self.field.unit,
            text=self.text,
            value="" if self.value is None else self.value,
            cell="default" if self.state == "default" else self.place,
            derivation=self.derivation,
        )


Row = Mapping[str, Reading]  # the readings of one line, by field key


def read_cell(cell: Cell, field: Field, unit: str, findings: list[Finding]) -> Reading:
    """Read one cell as one field; a fault goes to ``findings``.

    Parameters
    ----------
    cell : Cell
        The cell, blank or not.
    field : Field
        What it should hold.
    unit : str
        Unit of the column; one of ``field.units``, or empty for words.
    findings : list of Finding
        Appended to.

    Returns
    -------
    Reading
        Its value in the field's first unit.
    """
    if field.may_range and isinstance(cell.value, str):
        ends = split_range(cell.value)
        if ends:
            return _read_range(cell, field, unit, ends, findings)
    understood = _understand(cell, field, unit)
    if isinstance(understood, Refusal):
        findings.append(cell.finding(*understood, field.title_in(unit)))
        return Reading(field=field, state="faulty", text=cell.text, cell=cell)
    if understood is None:
        return read_nothing(field, cell)
    return Reading(
        field=field,
        state="given",
        value=understood,
        text=_describe_typed(cell, field, unit),
        cell=cell,
    )


_SEVERE_IS_LOW = ("slack",)  # a tauter net pulls harder


def _read_range(
    cell: Cell,
    field: Field,
    unit: str,
    ends: tuple[str, str, str],
    findings: list[Finding],
) -> Reading:
    """Read a cell that holds a range; its value is the more severe end."""
    faults: list[Finding] = []
    single = replace(field, may_range=False)
    low, high = (
        read_cell(
            replace(cell, value=f"{end} {ends[2]}".rstrip()), single, unit, faults
        )
        for end in ends[:2]
    )
    if not faults and low.number > high.number:
        rule = say("range.below_low", place=cell.place)
        faults.append(
            cell.finding(rule, say("range.low_to_high"), field.title_in(unit))
        )
    findings.extend(replace(fault, text=cell.text) for fault in faults)
    if faults:
        return Reading(field=field, state="faulty", text=cell.text, cell=cell)
    severe = low if field.key in _SEVERE_IS_LOW else high
    span = None if low.number == high.number else (low.number, high.number)
    return replace(severe, field=field, text=cell.text, cell=cell, span=span)


def explain_unit(unit: str, field: Field) -> Refusal:
    """Reason why a unit, or the lack of one, is none of a field."""
    rule = say("heading.unknown_unit") if unit else say("heading.no_unit")
    if unit in UNCLEAR_UNITS:
        rule = say("heading.unclear_unit", readings=UNCLEAR_UNITS[unit])
    units = tuple(f"[{write_unit(name)}]" for name in field.units)
    return Refusal(rule, say("accepted.units", units=units))


def _describe_typed(cell: Cell, field: Field, unit: str) -> str:
    """Text as typed; with its unit where that is another than the field's."""
    if unit == field.unit or (isinstance(cell.value, str) and cell.own_unit):
        return cell.text
    shown = _take_number(cell, unit) if _is_percentage(cell) else cell.text
    return f"{shown:g} {unit}" if isinstance(shown, float) else f"{cell.text} {unit}"


def read_nothing(field: Field, cell: Cell | None) -> Reading:
    """Read an optional field where nothing is typed, or no column exists."""
    return Reading(field=field, state="blank", cell=cell)


def rename(reading: Reading, field: Field) -> Reading:
    """Reading as another quantity, under the name of the column that it stands in."""
    column = reading.field
    named = column.name if field.units else column.title
    return replace(reading, field=replace(field, named=named))


def work_out(
    reading: Reading, field: Field, value: float | str, how: Message
) -> Reading:
    """Quantity that follows from a cell, in its first unit."""
    named = rename(reading, field)
    return replace(named, state="given", value=value, derivation=how, span=None)


def refuse(
    reading: Reading,
    rule: Message,
    accepted: Message | str,
    findings: list[Finding],
    *,
    severity: Severity = "error",
) -> None:
    """Add a finding about a reading.

    A reading without a cell stands for a missing heading, a finding already.
    """
    if reading.cell is not None:
        title = reading.field.title
        finding = reading.cell.finding(rule, accepted, title, severity=severity)
        findings.append(finding)


def refuse_beside(reading: Reading, other: Reading, findings: list[Finding]) -> None:
    """Refuse a reading beside another that says the same, or the contrary."""
    rule = say("cell.beside", name=other.field.name, place=other.place)
    refuse(reading, rule, say("accepted.one_of_two"), findings)


def refuse_misfits(row: Row, findings: list[Finding]) -> None:
    """Refuse cells of a line beside what they do not fit, or without what they need."""
    for reading in row.values():
        if reading.state != "given":
            continue
        field = reading.field
        for word, unfit in ((row[key], words) for key, words in field.not_with.items()):
            if word.word in unfit:
                name, name_word = word.field.name, word.field.name_word
                others = tuple(
                    name_word(choice)
                    for choice in word.field.words
                    if choice not in unfit
                )
                typed, place = name_word(word.word), word.place
                rule = say("cell.not_with", name=name, word=typed, place=place)
                accepted = say("cell.empty_or", name=name, words=others)
                refuse(reading, rule, accepted, findings)
        for lacking in (row[key] for key in field.needs):
            if lacking.state == "blank":
                rule = say("type.needs_more", names=(lacking.field.name,))
                refuse(reading, rule, lacking.field.accepted, findings)


def refuse_stored(cell: Cell) -> Refusal | None:
    """Reason why the stored content of a cell cannot be read; None if it can."""
    if cell.is_error:
        return Refusal(say("cell.error_value"), say("cell.value_or_formula"))
    if cell.formula and cell.value is None:
        return Refusal(say("cell.formula_without_result"), say("cell.open_and_save"))
    return None


def _understand(cell: Cell, field: Field, unit: str) -> float | str | Refusal | None:
    if refusal := refuse_stored(cell):
        return refusal
    if cell.is_blank:
        refusal = Refusal(say("cell.empty"), field.accepted)
        return refusal if field.required else None
    if field.kind in ("number", "count"):
        return _understand_number(cell, field, unit)
    if field.kind == "word":
        return _understand_word(cell, field)
    text = _understand_text(cell, field)
    if field.kind == "date" and isinstance(text, str) and not is_moment(text):
        return Refusal(say("cell.no_date"), field.accepted)
    if field.kind == "document" and isinstance(text, str) and not _is_document(text):
        return Refusal(say("cell.no_document"), say("cell.document_accepted"))
    return text


# What stands in a document's cell where there is none, or none yet.
_NO_DOCUMENT = re.compile(
    r"none|no|nil|na|unknown|pending|applied for|requested|to follow|tbd|tbc|yes|ok"
    r"|keine?r?|nein|unbekannt|beantragt|folgt|offen|ja|liegt vor|vorhanden"
    r"|aucune?|non|néant|inconnu|demandée?|en cours|oui|sans"
)


def _is_document(text: str) -> bool:
    """A text may be the number or title of a document."""
    plain = " ".join(re.sub(r"[^\w\s]", "", text).casefold().split())
    return len(plain) > 1 and not _NO_DOCUMENT.fullmatch(plain)


def _understand_number(cell: Cell, field: Field, unit: str) -> float | str | Refusal:
    if field.phrase and isinstance(cell.value, str):
        match = re.fullmatch(field.phrase, cell.value.strip())
        if match:
            return match[match.lastgroup or 0]
    grade = read_grade(cell.value) if field.is_grade else None
    number = _take_number(cell, unit) if grade is None else grade
    if isinstance(number, Refusal):
        return number
    value = convert_unit(number, unit, field.unit)
    low, high = field.bounds
    if not low <= value <= high:
        is_other = bool(cell.formula) or unit != field.unit
        rule = say("cell.out_of_range")
        if is_other:
            rule = say("cell.gives_out_of_range", value=value, unit=field.unit)
        return Refusal(rule, field.accepted)
    if field.kind == "count" and not value.is_integer():
        return Refusal(say("cell.not_whole"), field.accepted)
    return value


def _take_number(cell: Cell, unit: str) -> float | Refusal:
    """Read a number as the column's unit has it; refuse one shown in another unit."""
    if isinstance(cell.value, str):
        return _take_typed_number(cell.value.strip(), cell.decimal_mark, unit)
    number = parse_number(cell.value, cell.decimal_mark)
    if isinstance(number, Refusal):
        return number
    shown = _name_number(number, cell.shown_unit)
    if cell.is_percent:
        if unit in ("-", "%"):
            return _shift(number, 2) if unit == "%" else number
        shown = _name_number(100 * number, "%")
    elif not cell.shown_unit or normalise_unit(cell.shown_unit) == unit:
        return number
    rule = say("cell.format_ambiguous", shown=shown, number=number)
    if unit:
        rule = say("cell.format_other_unit", shown=shown, number=number, unit=unit)
    return Refusal(rule, say("accepted.plain_number"))


def _name_number(number: float, unit: str) -> Message:
    """Number with the unit that the cell's format shows, if it shows one."""
    if not unit:
        return say("value.number", number=number)
    return say("text.number_in", number=number, typed=unit)


def _take_typed_number(text: str, mark: DecimalMark, unit: str) -> float | Refusal:
    """Read a text such as ``3,0 m``, whose unit must be that of the column.

    A percentage is a share, too.
    """
    typed, typed_unit = split_unit(text)
    own = normalise_unit(typed_unit)
    if not typed_unit or own not in KNOWN_UNITS:
        return parse_number(text, mark)
    number = parse_number(typed, mark)
    if own == unit or isinstance(number, Refusal):
        return number
    if (own, unit) == ("%", "-"):
        return _shift(number, -2)
    rule = say("cell.other_unit", typed=typed_unit, unit=unit)
    if not unit:
        rule = say("cell.unit_not_wanted", typed=typed_unit)
    return Refusal(rule, say("accepted.plain_number"))


def _is_percentage(cell: Cell) -> bool:
    """A cell shows a number of hundredths, by its format or in its text."""
    return cell.is_percent or (
        isinstance(cell.value, str) and cell.value.strip().endswith("%")
    )


def _shift(number: float, digits: int) -> float:
    """Number shifted by decimal digits: 0.285 is 28.5 %, not 28.499999999999996."""
    return float(Decimal(repr(number)).scaleb(digits))


def knows_word(field: Field, text: str) -> bool:
    """A text is one of the accepted spellings of a column of words."""
    cell = Cell(file="", sheet="", row=1, column=1, value=text)
    return isinstance(_understand_word(cell, field), str)


def _understand_word(cell: Cell, field: Field) -> str | Refusal:
    spellings = {normalise(name): word for name, word in field.spellings.items()}
    word = spellings.get(normalise(str(cell.value)))
    if word is None:
        accepted = add_nearest(
            field.accepted, str(cell.value), dict.fromkeys(field.spellings, "")
        )
        return Refusal(say("cell.unknown_word"), accepted)
    return word


def _understand_text(cell: Cell, field: Field) -> str | Refusal:
    value = cell.value
    if field.kind == "id" and (
        isinstance(value, bool) or not isinstance(value, str | int | float)
    ):
        return Refusal(say("cell.not_a_name"), say("cell.name_accepted"))
    if isinstance(value, float) and value.is_integer():
        value = int(value)  # a program may store the name 7 as 7.0
    text = str(value).strip().removesuffix(" 00:00:00")  # a date is no time of day
    if len(text) > _LONGEST_TEXT:
        return Refusal(
            say("cell.too_long"), say("cell.most_characters", most=_LONGEST_TEXT)
        )
    return text
