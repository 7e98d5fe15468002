"""Net rows on terrain: an importer and an exporter around the ordinary workbook."""
