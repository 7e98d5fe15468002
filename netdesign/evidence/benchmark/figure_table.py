"""Figures of an envelope or of a panel, each with what is asked of it, as lines."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from netdesign.report.words import ENGLISH, Words
from netdesign.words.catalogue import render

_HEAD = ("schema", "what", "reach", "reached")


def print_figure(
    row: Mapping[str, Any], write: Callable[[str], object], words: Words = ENGLISH
) -> None:
    """Write what was measured, whether it is reached, and every value."""
    state = words("against.reached" if row["reached"] else "against.not_reached")
    write(render(row["what"], words.language))
    reach = render(row["reach"], words.language)
    write(words("bench.reach", reach=reach, state=state))
    for name, value in row.items():
        if name not in _HEAD:
            for one in value if isinstance(value, list) else [value]:
                write(f"  {words(f'bench_value.{name}'):32} {_show(one, words)}")


def _show(value: object, words: Words) -> str:
    if isinstance(value, Mapping):
        parts = (
            f"{words(f'bench_value.{name}')} {_show(one, words)}"
            for name, one in value.items()
        )
        return words.join(parts)
    if isinstance(value, bool):
        return words("bench.yes" if value else "bench.no")
    if isinstance(value, float):
        return words.write(f"{value:.4g}")
    return "-" if value is None else str(value)
