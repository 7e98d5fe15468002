"""``netdesign glide``: the stored glide factors, measured again."""

from __future__ import annotations

import click

from netdesign.commands.language import tell
from netdesign.commands.options import language_option
from netdesign.words.catalogue import Language
from netdesign.words.message import say


@click.command()
@language_option()
def glide(*, language: Language) -> None:
    """Measure the glide factors of slip lengths again, beside the stored table."""
    from netdesign.coupling.steady.rigid import measure_glide_factor
    from netdesign.snow.creep_law import CREEP_LAWS
    from netdesign.snow.ground import load_glide_tables

    tell(say("glide.heads"), language)
    for name, table in load_glide_tables().items():
        for ratio, stored in zip(table.slip_ratios, table.glide_factors, strict=True):
            measured = measure_glide_factor(CREEP_LAWS[name], ratio)
            numbers = {"ratio": ratio, "stored": stored, "measured": measured}
            tell(say("glide.line", law=name, **numbers), language)
