"""Workbook to fill in: its sheets, notes and drawing, and cells marked in a copy."""
