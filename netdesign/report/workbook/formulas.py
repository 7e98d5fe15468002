"""Formulas of calculations and checks: text of cells in, text of a formula out.

A cell counts only if it holds a number of the right sign. A blank, a text, an error or
TRUE never becomes a factor, and a check that lacks a number never passes. Each formula
tests its own cells; none relies on another cell having been left alone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from netdesign.outcome import Verdict
from netdesign.report.words import MISSING

_ROUNDING = 1e-12  # by which a product of stored numbers may exceed the study's
_SAME = 1e-9  # relative
_SHORT = 20  # signs of a formula; those of ours have more
_COMPARED = 200  # letters of a text that are compared
_ORDER = "(1+1E-9)"  # ends that were divided and multiplied again keep their order


def write_guarded(formula: str, conditions: Sequence[str]) -> str:
    """Formula of a step: its result where all conditions on its cells hold, else "-".

    Parameters
    ----------
    formula : str
        Without "=".
    conditions : sequence of str
        Those of `is_given`; at least one.
    """
    return (
        f'=IFERROR(IF(AND({",".join(conditions)}),{formula},"{MISSING}"),"{MISSING}")'
    )


def write_link(cell: str, *bounds: str, otherwise: str = MISSING) -> str:
    """Formula that shows the number of another cell, where it is one in its bounds."""
    return f'=IF({is_given(cell, *bounds)},{cell},"{otherwise}")'


def write_verdict(
    ends: Sequence[str],
    given: Verdict | None,
    words: Mapping[Verdict, str],
    *,
    follows: bool,
) -> str:
    """Verdict of a check, from low, value and high of its utilisation; without "=".

    What the study has ``given`` for another reason than the ratio can hold a pass back,
    and never becomes one; numbers that fail do so all the same, if it ``follows`` them.
    """
    low, value, high = ends
    known = ",".join(f"ISNUMBER({end})" for end in ends)
    ordered = f"AND({low}<={value}*{_ORDER},{value}<={high}*{_ORDER})"
    passes, fails, open_ = (
        quote(words[one]) for one in (Verdict.PASS, Verdict.FAIL, Verdict.NOT_PROVEN)
    )
    by_ratio = f"IF({high}<=1+{_ROUNDING:.0E},{passes},IF({low}>1,{fails},{open_}))"
    live = f"IF(AND({known}),IF({ordered},{by_ratio},{open_}),{open_})"
    if given is None:
        return live
    told = quote(words[given])
    if not follows or given is Verdict.FAIL:
        return told
    return f"IF({live}={fails},{fails},{told})"


def decide_by_ratio(low: float | None, high: float | None) -> Verdict:
    """Verdict of the formula in the sheet: by the band of the utilisation alone."""
    if low is None or high is None:
        return Verdict.NOT_PROVEN
    if high <= 1.0 + _ROUNDING:
        return Verdict.PASS
    return Verdict.FAIL if low > 1 else Verdict.NOT_PROVEN


def write_merged(
    counts: Mapping[Verdict, str], total: int, held: str, words: Mapping[Verdict, str]
) -> str:
    """``outcome.merge_verdicts``: a pass only where all ``total`` parts are one."""
    passes, fails, open_, declared = (
        quote(words[one])
        for one in (Verdict.PASS, Verdict.FAIL, Verdict.NOT_PROVEN, Verdict.DECLARED)
    )
    passed, told = counts[Verdict.PASS], counts[Verdict.DECLARED]
    is_met = f'AND({held}="{MISSING}",{total}>0,{passed}+{told}={total})'
    return (
        f"=IFERROR(IF({counts[Verdict.FAIL]}>0,{fails},"
        f"IF({is_met},IF({told}>0,{declared},{passes}),{open_})),{open_})"
    )


def write_same(cell: str, value: float | str) -> str:
    """Condition: a cell holds a number or a text of the study."""
    if isinstance(value, str):
        return f"EXACT(LEFT({cell},{_COMPARED}),{quote(value[:_COMPARED])})"
    near = f"ABS({cell}-{value!r})<={_SAME:.0E}*ABS({value!r})"
    return f"IF(ISNUMBER({cell}),{near},FALSE)"


def quote(text: str) -> str:
    """Text of ours in a formula; a formula holds 255 letters of one."""
    return '"' + text.replace('"', '""') + '"'


def is_given(cell: str, *bounds: str) -> str:
    """Condition: a cell holds a number within bounds such as ``>0``; TRUE is none.

    LibreOffice reads TRUE and FALSE from a file as formulas that give 1 and 0: they are
    told from those of ours by their length.
    """
    ours = f"LEN(_xlfn.FORMULATEXT({cell}))>{_SHORT}"
    is_number = f"IF(_xlfn.ISFORMULA({cell}),{ours},NOT(ISLOGICAL({cell})))"
    within = ",".join(f"{cell}{bound}" for bound in bounds)
    known = f"AND(IF(OR({cell}=1,{cell}=0),{is_number},TRUE),{within})"
    return f"IF(ISNUMBER({cell}),{known},FALSE)"
