"""``netdesign glide``: glide factors against slip lengths, measured again."""

from __future__ import annotations

from typing import Any

import click

from netdesign.commands.options import take_options
from netdesign.commands.usage import tell
from netdesign.words.message import say


@click.command()
@take_options("glide")
def glide(**_: Any) -> None:
    """Measure the glide factors of slip lengths again, beside the stored table."""
    from netdesign.coupling.steady.rigid import measure_glide_factor
    from netdesign.snow.creep_law import CREEP_LAWS
    from netdesign.snow.ground import load_glide_tables

    tell(say("glide.heads"))
    for name, table in load_glide_tables().items():
        for ratio, stored in zip(table.slip_ratios, table.glide_factors, strict=True):
            measured = measure_glide_factor(CREEP_LAWS[name], ratio)
            numbers = {"ratio": ratio, "stored": stored, "measured": measured}
            tell(say("glide.line", law=name, **numbers))
