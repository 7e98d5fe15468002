"""What changed between two studies: inputs, governing cases, verdicts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from netdesign.given_files import make_printable
from netdesign.report.check_view import find_governing
from netdesign.study import RowStudy, Study

SCHEMA = "netdesign.diff/1"


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """One value that is not the same in both studies; None where one has none.

    Attributes
    ----------
    area : str
        ``study``, ``project``, ``profile``, ``settings``, ``range``, ``input``,
        ``verdict`` or ``governing``.
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
        sentence = f"{place}{self.what}: {_show(self.old)} -> {_show(self.new)}"
        return make_printable(sentence.replace("\n", " "))


def compare_studies(old: Study, new: Study) -> list[Change]:
    """Every change from one study to another, the verdicts first."""
    rows_old = {row.id: row for row in old.rows}
    rows_new = {row.id: row for row in new.rows}
    ids = list(dict.fromkeys((*rows_old, *rows_new)))
    changes = [
        *_compare("verdict", "", {"verdict": old.verdict}, {"verdict": new.verdict}),
        *_compare_rows("verdict", ids, rows_old, rows_new),
        *_compare_rows("governing", ids, rows_old, rows_new),
        *_compare("project", "", asdict(old.project), asdict(new.project)),
        *_compare("profile", "", _list_profile(old), _list_profile(new)),
        *_compare(
            "range", "", _list_inputs(old.range_inputs), _list_inputs(new.range_inputs)
        ),
        *_compare_rows("input", ids, rows_old, rows_new),
        *_compare("settings", "", _list_settings(old), _list_settings(new)),
    ]
    return list(changes)


def write_difference(changes: Sequence[Change]) -> dict[str, Any]:
    """JSON document of the changes."""
    return {"schema": SCHEMA, "changes": [asdict(change) for change in changes]}


def _compare_rows(
    area: str,
    ids: Sequence[str],
    old: Mapping[str, RowStudy],
    new: Mapping[str, RowStudy],
) -> Iterator[Change]:
    describe = {
        "verdict": _list_verdict,
        "governing": _list_governing,
        "input": _list_row_inputs,
    }[area]
    for name in ids:
        if name in old and name in new:
            yield from _compare(area, name, describe(old[name]), describe(new[name]))
        elif area == "verdict":
            yield Change(
                area=area,
                row=name,
                what="net row",
                old=str(old[name].verdict) if name in old else None,
                new=str(new[name].verdict) if name in new else None,
            )


def _compare(
    area: str, row: str, old: Mapping[str, Any], new: Mapping[str, Any]
) -> Iterator[Change]:
    for what in dict.fromkeys((*old, *new)):
        before, after = old.get(what), new.get(what)
        if before != after:
            yield Change(area=area, row=row, what=what, old=before, new=after)


def _list_verdict(row: RowStudy) -> dict[str, Any]:
    return {"verdict": str(row.verdict)}


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
    for extreme in row.extremes:
        found[f"largest {extreme.quantity} [kN]"] = extreme.max_kN
    return found


def _list_inputs(inputs: Sequence[Any]) -> dict[str, Any]:
    return {
        f"{echo.label} [{echo.unit}]" if echo.unit else echo.label: echo.value
        for echo in inputs
    }


def _list_row_inputs(row: RowStudy) -> dict[str, Any]:
    return _list_inputs(row.inputs)


def _list_profile(study: Study) -> dict[str, Any]:
    profile = study.profile
    values = {f"{value.id} [{value.unit}]": value.value for value in profile.values}
    return {"profile": profile.id, "edition": profile.edition, **values}


def _list_settings(study: Study) -> dict[str, Any]:
    provenance = study.provenance
    return {
        "version": provenance.version,
        "site file": provenance.site_file,
        **provenance.settings,
        **provenance.libraries,
    }


def _show(value: Any) -> str:
    if value is None or value == "":
        return "none"
    return f"{value:.4g}" if isinstance(value, float) else str(value)
