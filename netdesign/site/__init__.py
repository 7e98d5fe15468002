"""Input of the engineer: the site workbook and its model."""
