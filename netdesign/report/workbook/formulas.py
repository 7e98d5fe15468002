"""Formulas of calculations and checks: text of cells in, text of a formula out.

A cell counts only if it holds a number of the right sign. A blank, a text or an error
never becomes a factor, and a check that lacks a number never passes. Each formula tests
its own cells; none relies on another cell having been left alone. TRUE is no number to
Excel, and 1 to LibreOffice.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from netdesign.outcome import Verdict
from netdesign.report.words import MISSING, VerdictWords

_ROUNDING = 1e-12  # by which a product of stored numbers may exceed the study's
_SAME = 1e-9  # relative
_COMPARED = 200  # letters of a text that are compared
_ORDER = "(1+1E-9)"  # ends that were divided and multiplied again keep their order


def write_guarded(formula: str, cells: Mapping[str, Sequence[str]]) -> str:
    """Formula of a step: its result where all its cells count, else "-".

    Parameters
    ----------
    formula : str
        Without "=".
    cells : mapping of str to sequence of str
        Cells that it reads, with the bounds of their numbers, such as ``>0``.
    """
    within = [f"{cell}{bound}" for cell, bounds in cells.items() for bound in bounds]
    counted = f"COUNT({','.join(cells)})={len(cells)}"
    conditions = ",".join((counted, *within))
    return f'=IFERROR(IF(AND({conditions}),{formula},"{MISSING}"),"{MISSING}")'


def write_link(cell: str, bounds: Sequence[str] = ()) -> str:
    """Formula that shows the number of another cell, where it is one in its bounds."""
    shown = cell
    for bound in reversed(bounds):
        shown = f'IF({cell}{bound},{shown},"{MISSING}")'
    return f'=IF(ISNUMBER({cell}),{shown},"{MISSING}")'


def write_verdict(
    ends: Sequence[str],
    given: Verdict | None,
    words: Mapping[Verdict, VerdictWords],
    *,
    follows: bool,
) -> str:
    """Verdict of a check, from low, value and high of its utilisation; without "=".

    What the study has ``given`` for another reason than the ratio can hold a pass back,
    and never becomes one; numbers that fail do so all the same, if it ``follows`` them.
    """
    low, value, high = ends
    ordered = f"{low}<={value}*{_ORDER},{value}<={high}*{_ORDER}"
    passes, fails, open_ = (
        quote(words[one].word)
        for one in (Verdict.PASS, Verdict.FAIL, Verdict.NOT_PROVEN)
    )
    by_ratio = f"IF({high}<=1+{_ROUNDING:.0E},{passes},IF({low}>1,{fails},{open_}))"
    known = f"COUNT({','.join(ends)})={len(ends)}"
    live = f"IF({known},IF(AND({ordered}),{by_ratio},{open_}),{open_})"
    if given is None:
        return live
    told = quote(words[given].word)
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
    counts: Mapping[Verdict, str],
    total: int,
    held: str,
    words: Mapping[Verdict, VerdictWords],
) -> str:
    """``outcome.merge_verdicts``: a pass only where all ``total`` parts are one."""
    passes, fails, open_, declared = (
        quote(words[one].word)
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
