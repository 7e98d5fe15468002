"""The table of USAGE.md on empty cells, from the columns.

``python -m tests.site.columns.empty_cells`` writes it into USAGE.md.
"""

from pathlib import Path

import netdesign
from netdesign.site.columns.all_tables import PROJECT_ITEMS, SHEETS

USAGE = Path(netdesign.__file__).parent / "USAGE.md"
HEAD = (
    "| sheet | columns | left empty | never better, since |",
    "|---|---|---|---|",
)


def list_columns(plan):
    """Columns of a sheet and what its lines may name, which may be left empty."""
    known = (*plan.fields, *(PROJECT_ITEMS if plan.name == "Project" else plan.items))
    return [one for one in known if one.empty]


def build_table():
    """Lines of the table: one for each statement of a sheet."""
    lines = list(HEAD)
    for plan in SHEETS:
        by_statement = {}
        for one in list_columns(plan):
            statement = (one.empty["means"], one.empty["why"])
            by_statement.setdefault(statement, []).append(one)
        for (means, why), columns in by_statement.items():
            lines.append(f"| {plan.name} | {join_names(columns)} | {means} | {why} |")
    return "\n".join(lines) + "\n"


def join_names(columns):
    """Names of columns, with a comma between those that say the same."""
    ways = {}
    for one in columns:
        ways.setdefault(one.alternative_to or one.key, []).append(str(one.name))
    return "; ".join(map(", ".join, ways.values()))


def find_table(text):
    """Table as it stands in a text: from its head to the first blank line."""
    start = text.index(HEAD[0])
    return text[start : text.index("\n\n", start) + 1]


def write_table():
    """Put the table in the place of the one that stands in USAGE.md."""
    text = USAGE.read_text(encoding="utf-8")
    USAGE.write_text(text.replace(find_table(text), build_table()), encoding="utf-8")


if __name__ == "__main__":
    write_table()
