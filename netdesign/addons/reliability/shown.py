"""Additions of the notional reliability to the reports of a study."""

from netdesign.addons.reliability.section import list_reliability, show_reliability
from netdesign.addons.reliability.sheet import NAME, add_sheet
from netdesign.report.sections.additions import Addition

SHOWN = Addition(
    annex="annex-reliability",
    show=show_reliability,
    list_lines=list_reliability,
    sheet=NAME,
    add_sheet=add_sheet,
)
