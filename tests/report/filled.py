"""Sections that a report must have, and those of its blocks that say something."""

from netdesign.report.blocks import Figure, Figures, Heading, Items, Paragraph, Part
from netdesign.report.sections.basis import anchor_rows

ROW = ("checks",)
ANNEXES = ("checks", "quality", "cases", "profile", "verify")


def list_sections(study, *, has_annexes=False):
    """Ids of all sections that a report must have."""
    anchors = dict.fromkeys(anchor_rows(study).values())
    of_rows = [f"{anchor}-{name}" for anchor in anchors for name in ROW]
    annexes = [f"annex-{name}" for name in ANNEXES] if has_annexes else []
    return ["decision", "schedule", "basis", *of_rows, "worked", *annexes]


def list_filled(blocks):
    """Ids of the parts with more than headings."""
    for block in blocks:
        if isinstance(block, Part):
            yield from list_filled(block.blocks)
            if block.id and any(map(_says, block.blocks)):
                yield block.id


def _says(block):
    """True of a block that shows something; a table without rows says why."""
    match block:
        case Heading():
            return False
        case Part():
            return any(map(_says, block.blocks))
        case Items():
            return bool(block.items)
        case Paragraph():
            return bool(block.text)
        case Figure():
            return bool(block.svg)
        case Figures():
            return any(map(_says, block.figures))
    return True
