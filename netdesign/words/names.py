"""Names of what records name by a key: members, modes, checks, settings."""

from __future__ import annotations

from functools import lru_cache

from netdesign.words.catalogue import load_texts
from netdesign.words.message import Message, say


@lru_cache(maxsize=1024)
def name(family: str, key: str) -> Message:
    """Name of one of a family: text ``family.key``, or the key as it was given."""
    text = f"{family}.{key}"
    if text in load_texts("en"):
        return say(text)
    return as_given(key.replace("_", " "))


def as_given(text: str) -> Message:
    """Somebody else's words, as they are in every language."""
    return say("text.as_given", text=text)


def name_member(member: str) -> Message:
    """Name of a member or an anchor: ``foot_anchor`` as "Foot anchor"."""
    return name("member", member)


def name_mode(mode: str) -> Message:
    """Name of what a member fails by: ``pull_out`` as "pull-out"."""
    return name("mode", mode)


def name_check(member: str, mode: str, position: str = "") -> Message:
    """Name of a check by its member and mode: "Foot anchor, pull-out".

    That of a row's first and last support says so, and that of the one beside it.
    """
    title = say("check.title", member=name_member(member), mode=name_mode(mode))
    key = {"edge": "check.of_end", "second": "check.of_second"}.get(position)
    return say(key, check=title) if key else title
