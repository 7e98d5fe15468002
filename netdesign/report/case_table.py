"""Study -> one flat table of all cases, for the engineer's own evaluations."""

from __future__ import annotations

from typing import TYPE_CHECKING

from netdesign.edge.json_text import list_fields
from netdesign.study.records import Study
from netdesign.words.catalogue import Language, render

if TYPE_CHECKING:
    import pandas

# Signs that make a spreadsheet program read a text as a formula.
_FORMULA_STARTS = ("=", "+", "-", "@", "\t", "\r")


def build_case_table(study: Study, language: Language = "en") -> pandas.DataFrame:
    """All cases of all net rows, one a line; units are part of the column names.

    Missing forces of failed cases stay missing; outcome and reason say why.
    """
    import pandas

    lines = []
    for row in study.rows:
        for record in row.cases:
            fields = list_fields(record)
            point = list_fields(fields.pop("case"))
            fields["reason"] = render(record.reason, language) if record.reason else ""
            lines.append({"net_row": row.id, **point, **fields})
    return pandas.DataFrame(lines)


def render_cases(study: Study, language: Language = "en") -> bytes:
    """CSV text of the table, UTF-8; texts never read as formulas."""
    table = build_case_table(study, language)
    for name in ("net_row", "outcome", "reason"):
        if name in table:
            table[name] = table[name].map(_disarm)
    return table.to_csv(index=False, lineterminator="\n").encode()


def _disarm(text: str) -> str:
    return f"'{text}" if text.startswith(_FORMULA_STARTS) else str(text)
