"""Words of the section drawing that stand apart from it: scale and legend."""

from __future__ import annotations

from netdesign.report.drawing.label_board import Box, LabelBoard
from netdesign.report.drawing.letters import measure_words
from netdesign.report.drawing.plain_svg import WIDTH, Chart
from netdesign.report.drawing.section_frame import Paper
from netdesign.report.drawing.style import ACCENT, INK, TEXT_PT
from netdesign.report.words import Words

SLIP_DASH = "2.2 1.5"  # of the net where the snow slips on it
_LEGEND = (
    ("drawing.net_sticks", INK, 1.8, ""),
    ("drawing.net_slips", INK, 1.8, SLIP_DASH),
    ("drawing.force_on_ground", ACCENT, 1.5, ""),
)
_LEGEND_TOP, _LEGEND_LINE = 12.0, 13.0
LEGEND_BOTTOM = _LEGEND_TOP + len(_LEGEND) * _LEGEND_LINE
_KEY, _EDGE = 19.0, 8.0  # length of a line of the legend, room beside it [pt]


def draw_scale_bar(sketch: Chart, paper: Paper, board: LabelBoard) -> None:
    """Bar of a round length near one inch, at the lower left."""
    inch = 72.0 / paper.scale
    length = max(step for step in (0.5, 1, 2, 5, 10) if step <= max(0.5, 0.9 * inch))
    left, bottom = _EDGE, paper.height - 6.0
    right = left + length * paper.scale
    sketch.line([(left, bottom), (right, bottom)], width=1.6)
    middle = ((left + right) / 2, bottom - 4.5)
    sketch.text(*middle, f"{sketch.write_tick(length)} m", anchor="middle")
    board.reserve(Box(left, bottom - 2 * TEXT_PT, right, bottom))


def draw_legend(sketch: Chart, words: Words, board: LabelBoard) -> None:
    """Explain the lines; the words end at them, however wide their font is."""
    right = WIDTH - _EDGE
    for place, (key, stroke, width, dash) in enumerate(_LEGEND):
        y = _LEGEND_TOP + _LEGEND_LINE * place
        ends = [(right - _KEY, y), (right, y)]
        sketch.line(ends, stroke=stroke, width=width, dash=dash)
        end = right - _KEY - 6.0
        sketch.text(end, y + 2.6, words(key), anchor="end")
        left = end - measure_words(words(key), TEXT_PT)
        board.reserve(Box(left, y - TEXT_PT, WIDTH, y + 5.0))
