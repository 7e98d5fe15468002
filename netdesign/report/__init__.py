"""Outputs: a study as page, workbook, drawings and terminal summary."""
