"""``netdesign glide``: the stored glide factors, measured again.

It speaks English only: it is for whoever develops or examines the program.
"""

from __future__ import annotations

import click


@click.command()
def glide() -> None:
    """Measure the glide factors of slip lengths again, beside the stored table."""
    from netdesign.coupling.steady.glide_factor import measure_glide_factor
    from netdesign.snow.creep_law import CREEP_LAWS
    from netdesign.snow.ground import load_glide_tables

    click.echo("creep law          slip length / d   N stored   N measured")
    for name, table in load_glide_tables().items():
        for ratio, stored in zip(table.slip_ratios, table.glide_factors, strict=True):
            measured = measure_glide_factor(CREEP_LAWS[name], ratio)
            click.echo(f"{name:18} {ratio:15g} {stored:10.4f} {measured:12.4f}")
