"""Formulas of calculations and checks: text of cells in, text of a formula out.

A cell counts only if it holds a number of the right sign. A blank, a text, an error or
TRUE never becomes a factor, and a check that lacks a number never passes. Each formula
tests its own cells; none relies on another cell having been left alone.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from netdesign.outcome import Verdict
from netdesign.report.words import MISSING, UNBOUNDED

ROUNDING = 1e-12  # by which a product of stored numbers may exceed the study's
_SAME = 1e-12  # relative
_SHORT = 20  # signs of a formula; those of ours have more
_COMPARED = 200  # letters of a text; a formula holds 255 of one
_ORDER = "(1+1E-9)"  # ends that were divided and multiplied again keep their order
_RANKS = {
    Verdict.FAIL: 3e6,
    Verdict.NOT_PROVEN: 2e6,
    Verdict.DECLARED: 1e6,
    Verdict.PASS: 0.0,
}
_ROW_RANK = 1e8
_LARGEST = 1e5  # utilisation that counts in the rank
_BEYOND = 2e5  # counts in the place of one without a bound


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
    given: str,
    stored: str,
    words: dict[Verdict, str],
    *,
    is_withheld: bool = False,
) -> str:
    """Verdict of a check of forces, from low, value and high of its utilisation.

    What the study has set in ``given`` can hold a pass back, and never makes one;
    numbers that fail do so all the same. What it has as declared, in ``stored`` too,
    stays so unless the numbers fail. Of a check that ``is_withheld`` they prove
    nothing.
    """
    low, value, high = ends
    passes, fails, open_, declared = (f'"{words[one]}"' for one in _VERDICTS)
    known = ",".join(f"ISNUMBER({end})" for end in ends)
    ordered = f"AND({low}<={value}*{_ORDER},{value}<={high}*{_ORDER})"
    by_ratio = f"IF({high}<=1+{ROUNDING:.0E},{passes},IF({low}>1,{fails},{open_}))"
    live = f"IF(AND({known}),IF({ordered},{by_ratio},{open_}),{open_})"
    is_declared = f"AND({given}={declared},{stored}={declared})"
    is_open = f"{given}={open_}"
    told = f"IF(OR({is_declared},{is_open}),{given},{open_})"
    if not is_withheld:
        told = f"IF(AND(OR({is_declared},{is_open}),{live}={fails}),{fails},{told})"
    held = f"IF({given}={fails},{fails},{told})"
    return f'=IFERROR(IF({given}="{MISSING}",{live},{held}),{open_})'


@dataclass(frozen=True, slots=True, kw_only=True)
class ChangedReasons:
    """Sentences of a check that is no longer as in the study, by what decides now."""

    passes: str
    fails: str
    spans: str  # the resistance, or ends that are not in order
    lacks: str  # a number
    set: str  # by the study


def write_reason(
    ends: Sequence[str],
    places: tuple[str, str],
    conditions: Sequence[tuple[str, str]],
    words: dict[Verdict, str],
    reasons: ChangedReasons,
) -> str:
    """Reason of a check that was changed: it follows the live verdict.

    Parameters
    ----------
    ends : sequence of str
        Low, value and high of the utilisation.
    places : tuple of str
        What the study has set, and the live verdict.
    conditions : sequence of (str, str)
        Conditions of `write_held`, each with the sentence where it does not hold.
    words : mapping of Verdict to str
        Words of the verdicts.
    reasons : ChangedReasons
        Sentences.
    """
    given, verdict = places
    passes, fails = (f'{verdict}="{words[one]}"' for one in _VERDICTS[:2])
    known = ",".join(f"ISNUMBER({end})" for end in ends)
    lacks = _quote(reasons.lacks)
    by_ratio = (
        f"IF({passes},{_quote(reasons.passes)},IF({fails},{_quote(reasons.fails)},"
        f"IF(AND({known}),{_quote(reasons.spans)},{lacks})))"
    )
    by_study = (
        f"IF({verdict}={given},{_quote(reasons.set)},"
        f"IF({fails},{_quote(reasons.fails)},{lacks}))"
    )
    told = f'IF({given}="{MISSING}",{by_ratio},{by_study})'
    for condition, cause in reversed(conditions):
        told = f"IF({condition},{told},{_quote(cause)})"
    return f"IFERROR({told},{lacks})"


def _quote(text: str) -> str:
    """Text in a formula."""
    return '"' + text.replace('"', '""') + '"'


def write_given_verdict(given: str, words: dict[Verdict, str]) -> str:
    """Verdict of a check without forces: that of the study."""
    passes, fails, open_, declared = (f'"{words[one]}"' for one in _VERDICTS)
    known = f"OR({given}={passes},{given}={fails},{given}={declared})"
    return f"=IFERROR(IF({known},{given},{open_}),{open_})"


def write_held(
    verdict: str, conditions: Sequence[str], words: dict[Verdict, str]
) -> str:
    """Verdict of a formula as long as conditions hold; open where one does not."""
    open_ = f'"{words[Verdict.NOT_PROVEN]}"'
    held = f"AND({','.join(conditions)})"
    return f"=IFERROR(IF({held},{verdict.removeprefix('=')},{open_}),{open_})"


def write_merged(
    counts: dict[Verdict, str], total: int, held: str, words: dict[Verdict, str]
) -> str:
    """``outcome.merge_verdicts``: a pass only where all ``total`` parts are one."""
    passes, fails, open_, declared = (f'"{words[one]}"' for one in _VERDICTS)
    passed, told = counts[Verdict.PASS], counts[Verdict.DECLARED]
    is_met = f'AND({held}="{MISSING}",{total}>0,{passed}+{told}={total})'
    return (
        f"=IFERROR(IF({counts[Verdict.FAIL]}>0,{fails},"
        f"IF({is_met},IF({told}>0,{declared},{passes}),{open_})),{open_})"
    )


def write_rank(number: str, verdict: str, ratio: str, words: dict[Verdict, str]) -> str:
    """Number that is largest for the governing check: the verdict, then the ratio.

    That of the net row keeps the ranks of different rows apart.
    """
    worst = "0"
    for one in (Verdict.DECLARED, Verdict.NOT_PROVEN, Verdict.FAIL):
        worst = f'IF({verdict}="{words[one]}",{_RANKS[one]:.0f},{worst})'
    other = f'IF({ratio}="{UNBOUNDED}",{_BEYOND:.0f},-1)'
    used = f"IF(ISNUMBER({ratio}),MIN({ratio},{_LARGEST:.0f}),{other})"
    return f"={number}*{_ROW_RANK:.0f}+{worst}+{used}"


def compute_rank(number: int, verdict: Verdict, ratio: float | None) -> float:
    """Number that the formula of `write_rank` gives."""
    used = -1.0 if ratio is None else min(ratio, _LARGEST)
    if ratio == math.inf:
        used = _BEYOND
    return number * _ROW_RANK + _RANKS[verdict] + used


def write_same(cell: str, value: float | str) -> str:
    """Condition: a cell holds a number or a text of the study."""
    if isinstance(value, str):
        return f"EXACT(LEFT({cell},{_COMPARED}),{_quote(value[:_COMPARED])})"
    near = f"ABS({cell}-{value!r})<={_SAME:.0E}*ABS({value!r})"
    return f"IF(ISNUMBER({cell}),{near},FALSE)"


def write_unchanged(
    numbers: Sequence[tuple[str, str]],
    texts: Sequence[tuple[str, str]],
    conditions: Sequence[str],
) -> str:
    """1 where conditions hold and every live cell shows what the study has, else 0."""
    same = list(conditions)
    same += [f"{live}={stored}" for live, stored in texts]
    same += [
        f"IF(ISNUMBER({stored}),IF(ISNUMBER({live}),"
        f"ABS({live}-{stored})<=1E-9*ABS({stored}),FALSE),{live}={stored})"
        for live, stored in numbers
    ]
    return f"=IFERROR(IF(AND({','.join(same)}),1,0),0)"


_VERDICTS = (Verdict.PASS, Verdict.FAIL, Verdict.NOT_PROVEN, Verdict.DECLARED)


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
