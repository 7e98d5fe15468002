"""Columns of the workbook: fields, units, headings in each language."""
