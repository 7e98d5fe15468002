"""The example site with some of its net rows, as a workbook that is soon solved."""

from xlsxwriter.utility import xl_col_to_name

from netdesign.site.columns.all_tables import SHEETS
from tests.old_example import load_example
from tests.site_lines import write_lines


def write_short_example(path, rows, *, leans=False, cells=None):
    """Write these net rows.

    A net that does not lean over a range keeps to its least inclination. ``cells`` are
    those of the sheet Nets that differ, by row and column.
    """
    lines = load_example()
    lines["Nets"] = [
        _cut(line) | (cells or {}).get(line["id"], {})
        for line in lines["Nets"]
        if line["id"] in rows
    ]
    confirmed = list(_confirm_gaps(lines["Nets"]))
    lines["Ends"] = [line for line in lines["Ends"] if line["row"] in rows]
    lines["Declared"] = [line for line in lines["Declared"] if line["row"] in rows]
    lines["Declared"] += confirmed
    if not leans:
        lines["Ranges"][2]["high"] = lines["Ranges"][2]["low"]
    write_lines(path, lines)


def _cut(line):
    """A row that goes on into others, beside works that are not in the workbook."""
    if "neighbour" not in line:
        return line
    said = ("row_end", "neighbour")
    return {key: value for key, value in line.items() if key not in said} | {"gap": 0.0}


def _confirm_gaps(nets):
    """Lines that confirm that works beside these rows are not in the workbook."""
    (plan,) = (one for one in SHEETS if one.name == "Nets")
    keys = [field.key for field in plan.fields if field.is_offered]
    column = xl_col_to_name(keys.index("gap"))
    for line, net in enumerate(nets, start=2):
        if net.get("gap") == 0.0:
            yield {
                "row": "all",
                "check": f"Nets!{column}{line} = 0",
                "document": "Survey of the older works",
                "author": "B. Example",
                "date": "2026-05-04",
            }
