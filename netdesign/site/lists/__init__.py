"""Reads an office's own list: its headings are mapped to the input workbook.

`targets` has the columns that a heading may mean, `list_map` reads the file of
answers, `ask` writes it, and `join` builds the sheets of the input workbook.
"""
