"""The input workbook with Rows and Net types: read, and joined to lines of a site.

`sheets` finds its tables, `types` and `rows` join their lines to those that
`netdesign.site.net_rows` builds net rows from, `project` reads what holds for the site.
"""
