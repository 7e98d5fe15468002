"""Cells of spreadsheets of any format, and what is found wrong in them."""
