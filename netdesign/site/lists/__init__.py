"""A list of an office's own: its headings mapped to the input workbook, and read so.

`targets` has what a heading may mean, `list_map` the file of answers, `join` makes of
the list the sheets that the input workbook would have; `ask` writes the file.
"""
