"""What the engineer gives: the site workbook and its model."""
