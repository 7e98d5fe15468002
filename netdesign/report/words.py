"""Numbers, verdicts and names as the words that every output shows.

Nothing else in the package rounds a number or names a verdict.
"""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING

from netdesign.edge.input_files import make_printable
from netdesign.outcome import Verdict
from netdesign.quantities import QUANTITIES
from netdesign.site.columns.fields import normalise
from netdesign.words.catalogue import (
    Language,
    fill_text,
    load_tables,
    load_texts,
    name_check,
    name_member,
    render,
    round_force_up,
    set_marks,
    write_unit,
)
from netdesign.words.message import Argument, Message, say

if TYPE_CHECKING:  # they bring numpy, which a list of profiles does without
    from netdesign.checks.check import CasePoint, Check
    from netdesign.site.model import InputEcho

MISSING = "-"
UNBOUNDED = "∞"  # a utilisation beyond any number
_FIGURES = 5  # of a calculated number: its relative error is at most a thousandth
_BLANKS = re.compile("[ \n]+")
_POINT = re.compile(r"(?<=\d)\.(?=\d)")
_SAME = 1e-12  # relative; a typed number after its way through SI units


@dataclass(frozen=True, slots=True)
class Words:
    """The texts of one language, as the reports ask for them: ``words(key, ...)``."""

    language: Language = "en"

    def __call__(self, key: str, /, **arguments: Argument) -> str:
        """Text of a key with its gaps filled."""
        return fill_text(key, arguments, self.language)

    def join(self, parts: Iterable[str]) -> str:
        """Parts of one cell, one after the other."""
        return self("text.parts", parts=tuple(parts))

    def show(self, message: Message | None) -> str:
        """Message on one line; "-" for none."""
        return show_text(render(message, self.language)) if message else MISSING

    def write(self, number: str) -> str:
        """Number in Python's notation with the decimal mark of the language."""
        return set_marks(number, self.language)

    def write_formula(self, formula: str) -> str:
        """Formula of ours whose numbers have the decimal mark of the language."""
        return _POINT.sub(self.write("."), formula)

    def show_number(self, key: str, value: float | None) -> str:
        """Value of the quantity ``key`` with its decimals, without unit.

        Examples
        --------
        >>> ENGLISH.show_number("demand_kN", 126.26)
        '126'
        >>> Words("fr").show_number("snow_thickness_m", 2.5)
        '2,50'
        >>> ENGLISH.show_number("utilisation", 1.0004)  # never rounded down to a pass
        '>1.000'
        >>> ENGLISH.show_number("utilisation", math.inf)  # nothing resists
        '∞'
        """
        form, is_ratio = QUANTITIES[key], key == "utilisation"
        if is_ratio and value == math.inf:
            return UNBOUNDED
        if value is None or not math.isfinite(value):
            return MISSING
        decimals = form.count_decimals(value)
        if decimals is None:
            return self.show_given(round(value, form.most))
        shown = f"{value:.{decimals}{'e' if form.scientific else 'f'}}"
        if not float(shown):
            shown = shown.removeprefix("-")
        over = is_ratio and value > 1 and float(shown) <= 1
        return self.write(f">{shown}" if over else shown)

    def show_minimum(self, force: float | None) -> str:
        """Force in kN that has to be reached, rounded up."""
        known = None if force is None else round_force_up(force)
        return self.show_number("demand_kN", known)

    def show_fixed(self, value: float | None, decimals: int) -> str:
        """Number with so many decimals; "-" for none."""
        return MISSING if value is None else self.write(f"{value:.{decimals}f}")

    def show_given(self, value: float) -> str:
        """Typed value, as it is; a value with more digits, with five.

        Examples
        --------
        >>> ENGLISH.show_given(30.000000000000004), Words("de").show_given(366.8)
        ('30', '366,8')
        >>> ENGLISH.show_given(22.03125), ENGLISH.show_given(12345678.9)
        ('22.031', '12345679')
        """
        if not math.isfinite(value):
            return MISSING
        shown = f"{value:.6g}"
        if not math.isclose(float(shown), value, rel_tol=_SAME):
            shown = _round_figures(value)
        return self.write(shown)

    def show_digits(self, value: float | None) -> str:
        """Number to five significant digits: enough to redo what follows from it."""
        if value is None:
            return MISSING
        if value == math.inf:
            return UNBOUNDED
        is_long = math.isfinite(value) and abs(value) >= 1e5
        return self.write(f"{value:.0f}" if is_long else f"{value:.5g}")

    def show_share(self, value: float | None) -> str:
        """Pure number of any size: ``3.8e-16``, ``1.08``."""
        return MISSING if value is None else self.write(f"{value:.3g}")

    def show_quantity(self, value: float | str, unit: str) -> str:
        """Chosen value, with its unit if it has one; a force to three digits.

        Examples
        --------
        >>> ENGLISH.show_quantity(356.67, "kN"), ENGLISH.show_quantity(100.0, "a")
        ('357 kN', '100 years')
        """
        if isinstance(value, str):
            text = value
        elif unit == "kN":
            text = self.show_number("max_kN", value)
        else:
            text = self.show_given(value)
        named = self("unit.years") if unit == "a" else unit
        return show_text(append_unit(text, named))

    def show_with_unit(self, key: str, value: float | None) -> str:
        """Number and unit; the sign of a missing number has no unit."""
        return append_unit(self.show_number(key, value), QUANTITIES[key].unit)

    def show_band(self, key: str, low: float | None, high: float | None) -> str:
        """Band of a number: ``0.842 to 0.871``."""
        if low is None or high is None or not math.isfinite(high):
            return MISSING
        ends = {"low": self.show_number(key, low), "high": self.show_number(key, high)}
        return self("show.band", **ends)

    def show_range(self, values: Collection[float]) -> str:
        """Least and largest of pure numbers: ``0.12 to 3.4``."""
        low, high = self.show_share(min(values)), self.show_share(max(values))
        return self("show.band", low=low, high=high)

    def name_case(self, case: CasePoint | None) -> str:
        """Name of a case: ``350 kg/m³, φ 30°, θ 25°``, and what else ranges."""
        if case is None:
            return MISSING
        density, *others = case.values.items()
        return ", ".join((self.show_with_unit(*density), *self.name_values(others)))

    def name_values(self, values: Iterable[tuple[str, float]]) -> list[str]:
        """Values of quantities with their symbols and units: ``φ 30°``."""
        return [
            f"{QUANTITIES[key].symbol} {self.show_with_unit(key, x)}"
            for key, x in values
        ]


ENGLISH = Words()


@dataclass(frozen=True, slots=True, kw_only=True)
class VerdictWords:
    """One verdict: its symbol, which survives a photocopy, word, and what it means."""

    symbol: str
    style: str  # class of the style sheet
    word: str = ""
    meaning: str = ""


VERDICTS = {
    Verdict.PASS: VerdictWords(symbol="✓", style="pass"),
    Verdict.FAIL: VerdictWords(symbol="✗", style="fail"),
    Verdict.NOT_PROVEN: VerdictWords(symbol="?", style="not-proven"),
    Verdict.DECLARED: VerdictWords(symbol="†", style="declared"),
}


def show_verdict(verdict: Verdict, words: Words) -> VerdictWords:
    """Verdict in a language."""
    word, meaning = (words(f"{kind}.{verdict}") for kind in ("verdict", "meaning"))
    return replace(VERDICTS[verdict], word=word, meaning=meaning)


def show_text(text: str) -> str:
    """Text on one line without control characters; "-" if nothing is left.

    No-break spaces stay: French sets them before some marks.
    """
    if text.isprintable() and "  " not in text:
        return text.strip() or MISSING
    return _BLANKS.sub(" ", make_printable(text)).strip() or MISSING


# First words of ids that say already what they name.
_ROW_NOUNS = frozenset(
    ("row", "net", "ligne", "rang", "rangée", "filet", "reihe", "werkreihe", "netz")
)


def name_row(ids: str, words: Words, count: int = 1) -> str:
    """``Net row R1``, and ``Row 1`` where an office calls its rows so.

    Parameters
    ----------
    ids : str
        Id, or several with commas.
    words : Words
        Of the report.
    count : int
        Number of ids.
    """
    first = ids.split()[0].strip(".:").casefold() if ids.split() else ""
    if first in _ROW_NOUNS:
        return ids
    key = "net_row" if count == 1 else "net_rows"
    return f"{words(f'heading.{key}')} {ids}"


def _round_figures(value: float) -> str:
    """Computed number as an engineer writes it: five figures, no zeros behind them."""
    if abs(value) < 1e-4:
        return f"{value:.{_FIGURES}g}"
    places = max(0, _FIGURES - 1 - math.floor(math.log10(abs(value))))
    shown = f"{value:.{places}f}"
    return shown.rstrip("0").rstrip(".") if places else shown


def show_unit(unit: str) -> str:
    """Unit as an engineer writes it: ``kg/m³`` for the workbook's ``kg/m3``."""
    return write_unit(show_text(unit))


def append_unit(shown: str, unit: str) -> str:
    """Shown number with its unit: ``4.0 kN``, ``25°``; a missing one has none."""
    named = show_unit(unit)
    if MISSING in (shown, named):
        return shown
    return f"{shown}{named}" if named == "°" else f"{shown} {named}"


def understand(echo: InputEcho, words: Words) -> float | str:
    """An input as understood; a word of its column in the reader's language."""
    choice = find_choice(echo)
    return words.show(choice) if choice else echo.value


def find_choice(echo: InputEcho) -> Message | None:
    """Word of a column that an input was understood as; None where it is none."""
    if isinstance(echo.value, float) or not isinstance(echo.label, Message):
        return None
    column = echo.label.key.rpartition(".")[2]
    key = f"choice.{column}.{normalise(echo.value)}"
    return say(key) if key in load_texts("en") else None


def show_member(words: Words, member: str) -> str:
    """``foot_anchor`` as ``Foot anchor``."""
    return words.show(name_member(member))


def show_check(words: Words, check: Check) -> str:
    """Member and mode of a check: ``Foot anchor, pull-out``."""
    return words.show(name_check(check.member, check.mode, check.position))


def name_heading(words: Words, key: str) -> str:
    """Heading of a column: label, and unit in brackets."""
    quantity = QUANTITIES[key]
    return add_unit(words.show(quantity.label), quantity.unit)


def add_unit(label: str, unit: str) -> str:
    """``Demand [kN]``; a label alone without a unit."""
    return f"{label} [{unit}]" if unit else label


def show_own(words: Words, text: str) -> str:
    """Text of a profile or creep law: in the language if it comes with the program.

    A profile is a document of its own, in its own language; those that come with the
    program have translations, found by the whole text.
    """
    key = _list_own_texts().get(text)
    return words(key) if key else show_text(text)


_OWN = (
    *("profile_title", "profile_about", "profile_text", "profile_source"),
    "profile_choice",
    "creep_law",
)


@lru_cache(maxsize=1)
def _list_own_texts() -> dict[str, str]:
    return {text: key for key, text in load_tables("en", _OWN).items()}
