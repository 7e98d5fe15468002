"""Refuses a report that contradicts its own numbers or lacks a section."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from html.parser import HTMLParser

from netdesign.checks.schema import MODES_WITHOUT_FORCE
from netdesign.errors import NetDesignError
from netdesign.outcome import Verdict, merge_verdicts
from netdesign.structure.members import ROPE_OF
from netdesign.study.records import CheckRecord, Study, list_verdicts
from netdesign.study.values import show_value
from netdesign.words.message import Message, say

_TOLERANCE = 1e-9  # relative; products of two stored numbers differ by rounding only
_DRAWING = re.compile(r"<svg.*?</svg>", re.DOTALL)
_HEADINGS = ("h1", "h2", "h3", "h4")
# Tags that bound neither a section nor a heading: most of a page, and slow to parse.
_OTHER_TAG = re.compile(r"<(?!/?(?:section|h[1-4])\b)[^>]*>")


def require_consistent(study: Study) -> None:
    """Refuse a study whose verdicts or ratios do not follow from its numbers.

    Raises
    ------
    NetDesignError
        If a verdict is not that of its parts (a pass may be held back as not
        proven), a pass is not supported by its utilisation, or a design value
        or a utilisation is not what its parts give.
    """
    whole = say("audit.study")
    _require_earned(whole, study.verdict, (row.verdict for row in study.rows))
    for row in study.rows:
        place = say("audit.row", row=row.id)
        parts = list_verdicts(row.checks, row.independent)
        _require_earned(place, row.verdict, parts)
        for check in row.checks:
            where = say("audit.check", place=place, check=check.id)
            _require_sound(where, check)
            _require_floor(where, check, study.profile.floor)


def tell_value(place: Message, name: str, stored: object, follows: object) -> Message:
    """A sentence on a value, by its name in the document, that is not what follows."""
    one, other = show_value(stored), show_value(follows)
    return say("audit.unequal", place=place, name=name, stored=one, follows=other)


def tell_verdict(place: Message, stored: Verdict, follows: Verdict) -> Message:
    """A sentence on a verdict that is not that of its parts."""
    verdict, merged = say(f"verdict.{stored}"), say(f"verdict.{follows}")
    return say("audit.verdict", place=place, verdict=verdict, merged=merged)


def _require_earned(place: Message, whole: Verdict, parts: Iterable[Verdict]) -> None:
    merged = merge_verdicts(parts)
    better = (Verdict.PASS, Verdict.DECLARED)
    is_held_back = whole is Verdict.NOT_PROVEN and merged in better
    if whole is not merged and not is_held_back:
        raise NetDesignError(tell_verdict(place, whole, merged))


def _require_sound(place: Message, check: CheckRecord) -> None:
    _require_parts(place, check)
    for name, whole, parts in (
        ("demand_kN", check.demand_kN, _product(check.read("E_k"), check.read("γ_E"))),
        (
            "resistance_kN",
            check.resistance_kN,
            _ratio(check.read("R_k"), check.read("γ_R")),
        ),
        (
            "utilisation",
            check.utilisation,
            _ratio(check.demand_kN, check.resistance_kN),
        ),
    ):
        if whole is None or (parts is None and name != "utilisation"):
            continue
        if parts is None or not math.isclose(whole, parts, rel_tol=_TOLERANCE):
            raise NetDesignError(tell_value(place, name, whole, parts))
    _require_sizes(place, check)
    if (check.verdict is Verdict.DECLARED) and check.declared is None:
        raise NetDesignError(say("audit.declared_by_nobody", place=place))
    if check.verdict is Verdict.PASS and not _is_without_force(check):
        _, high = check.utilisation_band
        if high is None or not high <= 1:
            raise NetDesignError(
                say(
                    "audit.pass_not_supported",
                    place=place,
                    verdict=say("verdict.pass"),
                    high=show_value(high),
                )
            )


def _require_floor(place: Message, check: CheckRecord, floor: str) -> None:
    """Refuse a demand below the guideline's load, and a pass that does not know it."""
    force = check.read("E_k")
    if not check.is_of_force or force is None or floor == "none":
        return
    if check.member in ROPE_OF:  # the guideline knows no load of ropes along the row
        return
    if check.mode == "sliding":
        return
    least = check.read("E_g")
    if least is None:
        return
    ends = [force, *_divide_demands(check)]
    is_above = all(end >= least * (1.0 - _TOLERANCE) for end in ends)
    if not is_above:
        raise NetDesignError(say("audit.below_floor", place=place, least=least))


def _divide_demands(check: CheckRecord) -> list[float]:
    """Ends of the demand without the factor, as far as they are known [kN]."""
    ends = (check.read_band("E_d")[0], check.read_band("E_d")[1])
    factor = check.read("γ_E")
    return [end / factor for end in ends if end is not None and factor]


def _require_sizes(place: Message, check: CheckRecord) -> None:
    """Refuse forces below zero, and a demand outside its own band."""
    ends = (check.read_band("E_d")[0], check.demand_kN, check.read_band("E_d")[1])
    known = [0.0, *(end for end in ends if end is not None)]
    sizes = (check.read("E_k"), check.read("R_k"))
    is_sound = known == sorted(known)
    is_sound &= all(size is None or size >= 0.0 for size in sizes)
    if not is_sound:
        raise NetDesignError(say("audit.size_or_band", place=place))


def _require_parts(place: Message, check: CheckRecord) -> None:
    """Refuse factors not above zero, and a design resistance without its parts."""
    divisors = (check.read("γ_E"), check.read("γ_R"), check.resistance_kN)
    if not all(one is None or one > 0.0 for one in divisors):
        raise NetDesignError(say("audit.not_above_zero", place=place))
    has_parts = check.read("R_k") and check.read("γ_R")
    if check.resistance_kN is not None and not has_parts:
        raise NetDesignError(say("audit.without_parts", place=place))


def _is_without_force(check: CheckRecord) -> bool:
    is_geometry = check.id.startswith("geometry.")
    return not check.is_of_force and (is_geometry or check.mode in MODES_WITHOUT_FORCE)


def _product(left: float | None, right: float | None) -> float | None:
    return None if left is None or right is None else left * right


def _ratio(above: float | None, below: float | None) -> float | None:
    return None if above is None or not below else above / below


def require_sections(page: str, expected: Iterable[str]) -> None:
    """Refuse a page in which an expected section is missing or only a heading.

    Raises
    ------
    NetDesignError
        Naming every such section.
    """
    reader = _SectionReader()
    reader.feed(_OTHER_TAG.sub(" ", _DRAWING.sub(" drawing ", page)))
    missing = [name for name in expected if not reader.words.get(name)]
    if missing:
        raise NetDesignError(say("audit.empty_sections", sections=tuple(missing)))


class _SectionReader(HTMLParser):
    """Counts the words below the headings of each ``<section id=...>``."""

    def __init__(self) -> None:
        super().__init__()
        self.words: dict[str, int] = {}
        self._open: list[tuple[str, str]] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        name = (dict(attrs).get("id") or "") if tag == "section" else ""
        self._open.append((tag, name))
        if name:
            self.words[name] = 0

    def handle_endtag(self, tag: str) -> None:
        while self._open and self._open.pop()[0] != tag:
            pass

    def handle_data(self, data: str) -> None:
        if any(tag in _HEADINGS for tag, _ in self._open):
            return
        for _, name in self._open:
            if name:
                self.words[name] += len(data.split())
