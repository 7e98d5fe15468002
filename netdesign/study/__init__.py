"""Check of a site: cases of each net row, judged, as records of one study."""
