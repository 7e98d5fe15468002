"""What changed between two studies: verdicts, checks, inputs, and all else."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from itertools import groupby
from typing import Any, TypeVar

from netdesign.edge.given_files import make_printable
from netdesign.outcome import Verdict
from netdesign.report.view.check_view import find_governing
from netdesign.study.records import CheckRecord, RowStudy, Study
from netdesign.study.values import Difference, compare_values

SCHEMA = "netdesign.diff/1"
_MET, _UNMET = "met", "not met"
_PASSING = (str(Verdict.PASS), _MET)
_RANKS = {str(Verdict.PASS): 0, _MET: 0, str(Verdict.NOT_PROVEN): 1, _UNMET: 1}
_WORST = 2  # rank of a failure, and of what is no longer there
# Values of a check that are told one by one; what follows from them is told in sum.
_OF_CHECK = {
    "utilisation": "utilisation",
    "demand_kN": "demand [kN]",
    "demand_low_kN": "demand, low end [kN]",
    "demand_high_kN": "demand, high end [kN]",
    "resistance_kN": "resistance [kN]",
    "action_factor": "action factor",
    "resistance_characteristic_kN": "characteristic resistance [kN]",
    "resistance_factor": "resistance factor",
    "resistance_basis": "resistance basis",
    "resistance_type": "resistance type",
    "clause": "clause",
}
_MOST_DIGITS = 17  # tell any two numbers apart
_Value = TypeVar("_Value")


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """One value that is not the same in both studies; None where one has none.

    Attributes
    ----------
    area : str
        ``verdict``, ``governing``, ``check``, ``project``, ``profile``, ``range``,
        ``input``, ``settings`` or ``other``.
    row : str
        Id of the net row; empty for the whole study.
    what : str
        Name of the value.
    old, new : object
        The values, in the unit that ``what`` names.
    """

    area: str
    row: str = ""
    what: str
    old: Any
    new: Any

    def __str__(self) -> str:
        """``R1: utilisation: 0.73 -> 0.81``."""
        place = f"{self.row}: " if self.row else ""
        sentence = f"{place}{self.what}: {' -> '.join(_show(self.old, self.new))}"
        return make_printable(sentence.replace("\n", " "))

    @property
    def is_turned(self) -> bool:
        """A verdict that is another now, or is gone; not a new one that passes."""
        is_new_pass = self.old is None and self.new in _PASSING
        return self.area == "verdict" and not is_new_pass


def compare_studies(old: Study, new: Study) -> list[Change]:
    """Every change from one study to another, what was lost first.

    Only the time and the command of the two are left out.
    """
    rows_old = {row.id: row for row in old.rows}
    rows_new = {row.id: row for row in new.rows}
    ids = list(dict.fromkeys((*rows_old, *rows_new)))
    pairs = [(name, rows_old.get(name), rows_new.get(name)) for name in ids]
    both = [(name, one, other) for name, one, other in pairs if one and other]
    verdicts = [
        *_compare("verdict", "", {"verdict": old.verdict}, {"verdict": new.verdict}),
        *(change for pair in pairs for change in _compare_verdicts(*pair)),
    ]
    return [
        *sorted(verdicts, key=_rank),
        *_compare_rows("governing", both, _list_governing),
        *_compare_rows("check", both, _list_checks),
        *_compare("project", "", asdict(old.project), asdict(new.project)),
        *_compare("profile", "", _list_profile(old), _list_profile(new)),
        *_compare(
            "range", "", _list_inputs(old.range_inputs), _list_inputs(new.range_inputs)
        ),
        *_compare_rows("input", both, lambda row: _list_inputs(row.inputs)),
        *_compare("settings", "", _list_settings(old), _list_settings(new)),
        *_compare_rest("", _keep_rest(old), _keep_rest(new)),
        *(
            change
            for name, one, other in both
            for change in _compare_rest(
                name, _keep_row_rest(one), _keep_row_rest(other)
            )
        ),
    ]


def write_difference(changes: Sequence[Change]) -> dict[str, Any]:
    """JSON document of the changes."""
    return {"schema": SCHEMA, "changes": [asdict(change) for change in changes]}


def _rank(change: Change) -> tuple[bool, bool]:
    """Sort key of a verdict: passes that are lost, then all else that got worse."""
    ranks = [_RANKS.get(str(one), _WORST) for one in (change.old, change.new)]
    is_worse = change.is_turned and (change.old is None or ranks[1] > ranks[0])
    return not (is_worse and change.old in _PASSING), not is_worse


def _compare_verdicts(
    name: str, old: RowStudy | None, new: RowStudy | None
) -> Iterator[Change]:
    """Verdict of a row and of all in it; of a row that came or went, only its own."""
    if old and new:
        yield from _compare("verdict", name, _list_verdicts(old), _list_verdicts(new))
        return
    ends = [str(row.verdict) if row else None for row in (old, new)]
    yield Change(area="verdict", row=name, what="net row", old=ends[0], new=ends[1])


def _compare_rows(
    area: str,
    pairs: Sequence[tuple[str, RowStudy, RowStudy]],
    describe: Callable[[RowStudy], Mapping[str, Any]],
) -> Iterator[Change]:
    for name, old, new in pairs:
        yield from _compare(area, name, describe(old), describe(new))


def _compare(
    area: str, row: str, old: Mapping[str, Any], new: Mapping[str, Any]
) -> Iterator[Change]:
    for what in dict.fromkeys((*old, *new)):
        before, after = old.get(what), new.get(what)
        if before != after:
            yield Change(area=area, row=row, what=what, old=before, new=after)


def _compare_rest(row: str, old: object, new: object) -> Iterator[Change]:
    """The first of the other values that differ in each part, and their number."""

    def name_part(one: Difference) -> str:
        return one.place.partition(".")[0]

    differences = compare_values(old, new, is_exact=True)
    for _, found in groupby(sorted(differences, key=name_part), key=name_part):
        first, *others = found
        more = f", and {len(others)} more" if others else ""
        what = first.place + more
        yield Change(
            area="other", row=row, what=what, old=first.stored, new=first.again
        )


def _list_verdicts(row: RowStudy) -> dict[str, str]:
    return {
        "verdict": str(row.verdict),
        **{f"check {name}": str(c.verdict) for name, c in _name_checks(row).items()},
        **_name_all(
            (f"independent check {one.name}", _MET if one.is_met else _UNMET)
            for one in row.independent
        ),
    }


def _name_all(pairs: Iterable[tuple[str, _Value]]) -> dict[str, _Value]:
    """Values by their names; a name used again gets the number of its use."""
    named: dict[str, _Value] = {}
    counts: Counter[str] = Counter()
    for name, value in pairs:
        counts[name] += 1
        named[f"{name} ({counts[name]})" if counts[name] > 1 else name] = value
    return named


def _name_checks(row: RowStudy) -> dict[str, CheckRecord]:
    return _name_all((check.id, check) for check in row.checks)


def _list_governing(row: RowStudy) -> dict[str, Any]:
    """Governing check with its numbers, and the largest force of each member."""
    found: dict[str, Any] = {}
    check = find_governing(row.checks)
    if check is not None:
        found["governing check"] = check.id
        found["utilisation"] = check.utilisation
        found["demand [kN]"] = check.demand_kN
        found["resistance [kN]"] = check.resistance_kN
        point = asdict(check.case) if check.case else {}
        found |= {f"governing case, {key}": value for key, value in point.items()}
    for name, one in _name_all((one.quantity, one) for one in row.extremes).items():
        found[f"largest {name} [kN]"] = one.max_kN
        found[f"upper bound of {name} [kN]"] = one.upper_bound_kN
    return found


def _list_checks(row: RowStudy) -> dict[str, Any]:
    return {
        f"{name}: {label}": getattr(check, key)
        for name, check in _name_checks(row).items()
        for key, label in _OF_CHECK.items()
    }


def _list_inputs(inputs: Sequence[Any]) -> dict[str, Any]:
    return _name_all(
        (f"{echo.label} [{echo.unit}]" if echo.unit else echo.label, echo.value)
        for echo in inputs
    )


def _list_profile(study: Study) -> dict[str, Any]:
    profile = study.profile
    values = _name_all((f"{one.id} [{one.unit}]", one.value) for one in profile.values)
    named = {"profile": profile.id, "edition": profile.edition}
    return named | {"version": profile.version, "choice": profile.choice} | values


def _list_settings(study: Study) -> dict[str, Any]:
    provenance = study.provenance
    return {
        "version": provenance.version,
        "site file": provenance.site_file,
        **provenance.settings,
        **provenance.libraries,
    }


def _keep_rest(study: Study) -> object:
    """Parts of a study that are told in sum only."""
    return {
        "profile": {
            "title": study.profile.title,
            "sha256": study.profile.sha256,
            "values": [replace(one, value=0.0) for one in study.profile.values],
        },
        "rows": {"order": ", ".join(row.id for row in study.rows)},
        "range_inputs": [replace(echo, value="") for echo in study.range_inputs],
        "notes": study.notes,
        "provenance": {"site_sha256": study.provenance.site_sha256},
    }


def _keep_row_rest(row: RowStudy) -> object:
    """Parts of a net row that are told in sum only."""
    told = dict.fromkeys(_OF_CHECK) | {"verdict": Verdict.PASS, "clause": ""}
    told |= {"resistance_basis": "", "resistance_type": ""}
    return replace(
        row,
        verdict=Verdict.PASS,
        checks=[replace(check, **told) for check in row.checks],  # type: ignore[arg-type]
        extremes=[
            replace(one, max_kN=0.0, upper_bound_kN=None) for one in row.extremes
        ],
        inputs=[replace(echo, value="") for echo in row.inputs],
        independent=[replace(one, is_met=True) for one in row.independent],
    )


def _show(old: Any, new: Any) -> tuple[str, str]:
    """Both values, with as many digits as tell them apart."""
    for digits in range(4, _MOST_DIGITS + 1):
        shown = _round(old, digits), _round(new, digits)
        if shown[0] != shown[1]:
            break
    return shown


def _round(value: Any, digits: int) -> str:
    if value is None or value == "":
        return "none"
    return f"{value:.{digits}g}" if isinstance(value, float) else str(value)
