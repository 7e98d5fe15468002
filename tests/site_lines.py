"""A site workbook of lines by sheet, as plain cells."""

import xlsxwriter

from netdesign.site.columns.all_tables import SHEETS
from netdesign.site.template import workbook as template


def write_lines(path, lines):
    """Workbook of lines by sheet, at the places that the template gives them.

    Without its formats and notes, it is written and read in a third of the time.
    """
    book = xlsxwriter.Workbook(str(path), {"in_memory": True})
    for plan in SHEETS:
        sheet = book.add_worksheet(plan.name)
        fields = [field for field in plan.fields if field.is_offered]
        for column, field in enumerate(fields):
            sheet.write_string(0, column, field.heading_for("en"))
            for row, line in enumerate(lines.get(plan.name, ()), start=1):
                value = line.get(field.key)
                if isinstance(value, str):
                    if "!" not in value:  # the name of a cell is that in any language
                        value = template._translate(field, value, "en")
                    sheet.write_string(row, column, value)
                elif value is not None:
                    sheet.write_number(row, column, value)
    book.close()
