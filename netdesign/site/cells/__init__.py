"""Cells of spreadsheets of any format, and findings about them."""
