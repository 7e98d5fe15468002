"""Reads the input workbook with Rows and Net types into lines of a site.

`sheets` finds its tables, `types` and `rows` join their lines to those that
`netdesign.site.net_rows` builds net rows from, `project` reads the lines of the whole
site.
"""
