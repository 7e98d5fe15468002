"""Common style of the drawings: inks, size of the text, width of the print area."""

INK = "#1b1e22"
GREY = "#7d838b"  # of lines; words of that grey are too pale to read
SOFT = "#596069"
PALE = "#d3d7dc"
SNOW = "#f3f5f7"
ACCENT = "#b23a1e"  # forces and what governs; nothing else
WIDTH_IN = 6.9  # of the print area of A4
TEXT_PT = 8.0  # not less on paper, where a drawing is 180 mm wide
